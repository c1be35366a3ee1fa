#include "sharing.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "noise.h"

#include "sigmascape/base/units.h"

namespace sigmascape::bench {
namespace {

constexpr std::size_t side = 256, cell = 4;

radar::Rectangle piece_of(const radar::Rectangle& extent, double texel_m) {
  const auto whole_texels = [texel_m](double length_m) { return std::round(length_m / texel_m) * texel_m; };
  const double side_m = static_cast<double>(side) * texel_m;
  const double west_m = extent.west_m + whole_texels((extent.width_m() - side_m) / 2.0);
  const double south_m = extent.south_m + whole_texels((extent.height_m() - side_m) / 2.0);
  return {west_m, south_m, west_m + side_m, south_m + side_m};
}

std::vector<float> mean_of(const std::vector<float>& one, const std::vector<float>& other) {
  std::vector<float> mean(one.size());
  std::ranges::transform(one, other, mean.begin(), [](float a, float b) { return 0.5F * (a + b); });
  return mean;
}

/// dB of the means over squares of texels.
std::vector<double> cells_db(const std::vector<float>& texels) {
  std::vector<double> sums((side / cell) * (side / cell));
  for (std::size_t i = 0; i < texels.size(); ++i)
    sums[(i / side / cell) * (side / cell) + i % side / cell] += static_cast<double>(texels[i]);
  for (double& sum : sums) sum = std::max(db_from_linear(sum / static_cast<double>(cell * cell)), -45.0);
  return sums;
}

double rms_db(const std::vector<float>& map, const std::vector<float>& truth) {
  const std::vector<double> tested = cells_db(map), reference = cells_db(truth);
  double squares = 0.0;
  for (std::size_t i = 0; i < tested.size(); ++i) squares += std::pow(tested[i] - reference[i], 2.0);
  return std::sqrt(squares / static_cast<double>(tested.size()));
}

MapError error_of(const std::vector<float>& map, const std::vector<float>& truth,
                  const std::vector<std::size_t>& texels) {
  const auto error = [&](std::size_t i) {
    return std::abs(static_cast<double>(map[i]) - static_cast<double>(truth[i]));
  };
  double errors = 0.0, power = 0.0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    errors += error(i);
    power += static_cast<double>(truth[i]);
  }
  std::vector<double> relative;
  for (const std::size_t i : texels) {
    if (truth[i] > 0.0F) relative.push_back(error(i) / static_cast<double>(truth[i]));
  }
  return {errors / power, rms_db(map, truth), median_of(std::move(relative))};
}

double total(const std::vector<float>& map) {
  double sum = 0.0;
  for (const float texel : map) sum += static_cast<double>(texel);
  return sum;
}

}  // namespace

Sharing what_sharing_gives(const scene::Scene& scene, const radar::Aspect& aspect, std::uint32_t samples,
                           std::uint32_t truth_samples) {
  PaperLooks looks(scene, piece_of(scene.extent, bake::BakeSettings{}.patches.texel_m), 1, 2);
  constexpr std::uint64_t seed = 300;
  const bake::Sampling sampling{.samples_per_texel = samples}, finest{.samples_per_texel = truth_samples};
  const auto own = looks.ours(aspect, sampling, seed).power, again = looks.ours(aspect, sampling, seed + 1).power;
  const auto shared = looks.shared(aspect, sampling, seed).power;
  const auto truth = mean_of(looks.ours(aspect, finest, seed + 2).power, looks.ours(aspect, finest, seed + 3).power);
  const auto texels = noisy_texels(own, again, looks.direct(aspect, 4, seed).power);
  return {error_of(own, truth, texels), error_of(shared, truth, texels), total(shared) / total(own)};
}

}  // namespace sigmascape::bench
