#include "sigmascape/receiver/target_passage.h"

#include <cmath>

namespace sigmascape::receiver {
namespace {

/// When it would be if the target kept on as at that time.
std::optional<double> time_of_passage(const radar::Motion& target, double time_s, const radar::Motion& platform,
                                      double closing_mps) {
  const Vec3d relative = platform.velocity_mps - target.velocity_mps;
  const double speed_mps = length(relative), sine = closing_mps / speed_mps;
  if (!(std::abs(sine) < 1.0)) return std::nullopt;
  const Vec3d ahead = relative * (1.0 / speed_mps);
  const Vec3d away = target.position - target.velocity_mps * time_s - platform.position;
  const double along_m = dot(away, ahead), least_m = length(away - ahead * along_m);
  return (along_m - least_m * sine / std::sqrt(1.0 - sine * sine)) / speed_mps;
}

}  // namespace

std::optional<TargetPassage> target_passage(const radar::Track& target, const radar::Motion& platform,
                                            double closing_mps, double near_s) {
  constexpr int most_legs = 64;
  constexpr double same_moment_s = 1e-7;
  double time_s = near_s;
  for (int leg = 0; leg < most_legs; ++leg) {
    const radar::Motion motion{target.position_at(time_s), target.velocity_at(time_s)};
    const auto next_s = time_of_passage(motion, time_s, platform, closing_mps);
    if (!next_s) return std::nullopt;
    if (std::abs(*next_s - time_s) > same_moment_s) {
      time_s = *next_s;
      continue;
    }
    const Vec3d away = motion.position - (platform.position + platform.velocity_mps * time_s);
    if (!(length(away) > 0.0)) return std::nullopt;
    return TargetPassage{.time_s = time_s,
                         .target = motion,
                         .away = away,
                         .range_m = length(away),
                         .relative_speed_mps = length(platform.velocity_mps - motion.velocity_mps)};
  }
  return std::nullopt;
}

}  // namespace sigmascape::receiver
