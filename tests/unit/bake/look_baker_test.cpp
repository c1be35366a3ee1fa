#include "sigmascape/bake/look_baker.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "sigmascape/base/units.h"
#include "sigmascape/scene/solid_mesh.h"
#include "validation/validation_record.h"

namespace sigmascape::bake {
namespace {

constexpr double side_m = 128.0;

/// Level grass with a block of glossy walls in the middle: edges, layover, shadow and paths of several bounces.
scene::Scene scene_with_block() {
  scene::Scene scene;
  scene.name = "block";
  scene.extent = {0, 0, side_m, side_m};
  scene.terrain = {0, side_m, side_m, Array2D<float>(2, 2, 0.0F)};
  const scatter::Material ground{
      .name = "ground", .model = scatter::LambertParameters{0.3, {0.1, 0.5}}, .source = {}};
  const scatter::Material wall{.name = "wall", .model = scatter::LambertParameters{0.7, {0.1, 0.5}}, .source = {}};
  scene.ground = {{0, side_m, side_m, 1, 1}, Array2D<scene::MaterialIndex>(1, 1, scene.material_index(ground))};
  for (const float x : {40.0F, 70.0F}) {
    scene.prototypes.push_back(scene::box_mesh({12, 31, 14}, scene.material_index(wall)));
    scene.instances.push_back(
        {.prototype = static_cast<std::uint32_t>(scene.prototypes.size() - 1), .x_m = x, .y_m = 60.0F, .yaw_rad = 0.3F});
  }
  return scene;
}

BakeSettings settings_with(const Sampling& sampling) {
  BakeSettings settings;
  settings.aspects = {{radians_from_deg(60.0)}, {radians_from_deg(30.0)}, {10e9}};
  settings.patches = {2.0, 256};
  settings.sampling = sampling;
  return settings;
}

BakedLook baked(const scene::Scene& scene, BakeSettings settings, std::uint64_t seed) {
  settings.seed = seed;
  const LookBaker baker(scene, settings);
  SilentProgress silent;
  return baker.bake({0, 0}, settings.aspects.look(0).aspect, silent).front();
}

double power(const BakedLook& look, std::size_t texel) {
  return static_cast<double>(look.sigma0.values()[texel].power(radar::Polarization::Sum));
}

double squared_error(const BakedLook& look, std::size_t texel) {
  return std::pow(static_cast<double>(look.relative_errors.values()[texel]) * power(look, texel), 2.0);
}

/// Mean and scatter of bakes with independent scrambles against what each said of its own error.
struct Honesty {
  double predicted_over_actual = 0.0;  ///< root mean square of the predicted over that of the actual errors
  double covered = 0.0;                ///< part of the texels whose truth the 95 % interval holds
  std::size_t texels = 0;
};

Honesty honesty_of(const scene::Scene& scene, const Sampling& sampling, int repetitions) {
  std::vector<BakedLook> looks;
  for (int i = 0; i < repetitions; ++i) looks.push_back(baked(scene, settings_with(sampling), 1000U + unsigned(i)));
  Honesty honesty;
  double predicted = 0.0, actual = 0.0;
  std::size_t covered = 0, intervals = 0;
  const double count = repetitions;
  for (std::size_t texel = 0; texel < looks.front().sigma0.size(); ++texel) {
    double sum = 0.0, squares = 0.0, errors = 0.0;
    for (const BakedLook& look : looks) {
      sum += power(look, texel);
      squares += power(look, texel) * power(look, texel);
      errors += squared_error(look, texel);
    }
    const double mean = sum / count;
    const double variance = (squares - sum * mean) / (count - 1.0);
    // Texels that vary at all, and not so seldom that a few bakes cannot tell how much.
    if (!(variance > 1e-6 * mean * mean) || errors / count > mean * mean) continue;
    predicted += errors / count / (mean * mean);
    actual += variance / (mean * mean);
    ++honesty.texels;
    for (const BakedLook& look : looks) {
      // The mean of the others stands for the truth; its own error widens the interval.
      const double others = (sum - power(look, texel)) / (count - 1.0);
      const double error = std::sqrt(squared_error(look, texel) + variance / (count - 1.0));
      covered += std::abs(power(look, texel) - others) <= 1.96 * error ? 1U : 0U;
      ++intervals;
    }
  }
  honesty.predicted_over_actual = std::sqrt(predicted / actual);
  honesty.covered = static_cast<double>(covered) / static_cast<double>(intervals);
  return honesty;
}

TEST(LookBaker, ErrorsAreHonestWithAFixedNumberOfSamples) {
  const Honesty honesty = honesty_of(scene_with_block(), {.samples_per_texel = 256}, 12);
  std::printf("fixed: ratio %.3f covered %.3f texels %zu\n", honesty.predicted_over_actual, honesty.covered, honesty.texels);
}

TEST(LookBaker, ErrorsAreHonestWithAnAdaptiveNumberOfSamples) {
  const Honesty honesty = honesty_of(scene_with_block(), {.target_db = 0.2, .most_samples = 512}, 12);
  std::printf("adaptive: ratio %.3f covered %.3f texels %zu\n", honesty.predicted_over_actual, honesty.covered, honesty.texels);
}

TEST(LookBaker, AdaptiveSamplingHasTheMeanOfFixedSampling) {
  const scene::Scene scene = scene_with_block();
  const auto mean_of = [&](const Sampling& sampling, int repetitions, double& standard_error) {
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < repetitions; ++i) {
      const BakedLook look = baked(scene, settings_with(sampling), 50U + unsigned(i));
      double total = 0.0;
      for (std::size_t texel = 0; texel < look.sigma0.size(); ++texel) total += power(look, texel);
      sum += total;
      squares += total * total;
    }
    const double mean = sum / repetitions;
    standard_error = std::sqrt((squares / repetitions - mean * mean) / (repetitions - 1));
    return mean;
  };
  double fixed_error = 0.0, adaptive_error = 0.0;
  const double fixed = mean_of({.samples_per_texel = 128}, 16, fixed_error);
  const double adaptive = mean_of({.target_db = 1.0, .most_samples = 64}, 16, adaptive_error);
  std::printf("fixed %.5f +- %.5f adaptive %.5f +- %.5f\n", fixed, fixed_error, adaptive, adaptive_error);
}

}  // namespace
}  // namespace sigmascape::bake
