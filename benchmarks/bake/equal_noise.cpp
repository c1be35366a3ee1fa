#include "equal_noise.h"

#include <algorithm>
#include <cmath>

namespace sigmascape::bench {
namespace {

struct Rung {
  double seconds = 0.0;
  Noise noise;
};

/// The time at which the ladder reaches `wanted`; beyond its ends as though error fell with the root of time.
template <typename Error>
double seconds_for(const std::vector<Rung>& ladder, double wanted, Error error) {
  std::size_t upper = 1;
  while (upper + 1 < ladder.size() && error(ladder[upper]) > wanted) ++upper;
  const Rung& a = ladder[upper - 1];
  const Rung& b = ladder[upper];
  const bool is_between = error(a) >= wanted && error(b) <= wanted && error(a) > error(b);
  if (!is_between) {
    const Rung& nearest = error(a) < wanted ? a : b;
    return nearest.seconds * std::pow(error(nearest) / wanted, 2.0);
  }
  const double part = std::log(error(a) / wanted) / std::log(error(a) / error(b));
  return a.seconds * std::pow(b.seconds / a.seconds, part);
}

}  // namespace

EqualNoise equal_noise(PaperLooks& looks, const radar::Aspect& aspect, std::uint32_t plain_samples,
                       std::span<const bake::Sampling> samplings) {
  constexpr std::uint64_t seed = 100;
  const TimedLook one = looks.plain(aspect, plain_samples, seed);
  const TimedLook other = looks.plain(aspect, plain_samples, seed + 1);
  const TimedLook direct = looks.direct(aspect, 4, seed);
  const auto texels = noisy_texels(one.power, other.power, direct.power);
  const Total plain = total_of(one.power, other.power);

  EqualNoise result;
  result.plain = noise_of(one.power, other.power, texels);
  result.plain_seconds = 0.5 * (one.processor_seconds + other.processor_seconds);
  result.noisy_share = static_cast<double>(texels.size()) /
                       static_cast<double>(std::ranges::count_if(direct.power, [](float p) { return p > 0.0F; }));

  std::vector<Rung> ladder;
  double ours_error = 0.0;
  for (const bake::Sampling& sampling : samplings) {
    const TimedLook ours = looks.ours(aspect, sampling, seed + 2), again = looks.ours(aspect, sampling, seed + 3);
    ladder.push_back(
        {0.5 * (ours.processor_seconds + again.processor_seconds), noise_of(ours.power, again.power, texels)});
    const Total in_all = total_of(ours.power, again.power);
    result.mean_ratio = in_all.power / plain.power;
    ours_error = in_all.standard_error;
    result.honesty = honesty_of({ours.power, ours.errors}, {again.power, again.errors}, texels);
    const Noise& reached = ladder.back().noise;
    if (ladder.size() > 1 && reached.median_relative < result.plain.median_relative && reached.l1 < result.plain.l1) {
      break;
    }
  }
  result.mean_ratio_error = std::hypot(ours_error, plain.standard_error) / plain.power;
  result.median_seconds =
      seconds_for(ladder, result.plain.median_relative, [](const Rung& rung) { return rung.noise.median_relative; });
  result.l1_seconds = seconds_for(ladder, result.plain.l1, [](const Rung& rung) { return rung.noise.l1; });
  return result;
}

}  // namespace sigmascape::bench
