#include "sigmascape/live/pose.h"

#include <cmath>
#include <fmt/format.h>

#include "sigmascape/base/error.h"

namespace sigmascape::live {
namespace {

constexpr double furthest_m = 1e7;

bool lies_within(Vec3d vector, double most) {
  return std::abs(vector.x) <= most && std::abs(vector.y) <= most && std::abs(vector.z) <= most;
}

}  // namespace

void check(const Pose& pose, const std::string& where) {
  const Vec3d at = pose.position, v = pose.velocity_mps;
  if (!lies_within(at, furthest_m)) {
    throw Error(where, fmt::format("stands at ({}, {}, {}) m", at.x, at.y, at.z),
                fmt::format("give a position within {:g} m of the origin of the atlas' frame", furthest_m));
  }
  if (!(std::abs(pose.first_azimuth_rad) <= 1e6)) {
    throw Error(where, fmt::format("has its first beam at {} rad", pose.first_azimuth_rad),
                "give an azimuth clockwise from north");
  }
  if (!(pose.first_range_m >= 0.0 && pose.first_range_m <= furthest_m)) {
    throw Error(where, fmt::format("has its first range at {} m", pose.first_range_m),
                fmt::format("give 0 to {:g}", furthest_m));
  }
  if (!lies_within(v, 1e5)) {
    throw Error(where, fmt::format("flies at ({}, {}, {}) m/s", v.x, v.y, v.z), "give no more than 1e5 either way");
  }
  if (!std::isfinite(pose.moment.time_s))
    throw Error(where, fmt::format("is at time {} s", pose.moment.time_s), "give a number");
}

radar::RangeAzimuthGrid bins_of(const LiveSettings& settings, const Pose& pose) {
  return {pose.first_range_m,     settings.range_step_m,  settings.ranges,
          pose.first_azimuth_rad, settings.beam_step_rad, settings.beams};
}

void check_step(std::size_t first_beam, std::size_t count, std::size_t beams) {
  if (first_beam >= beams) {
    throw Error("first_beam", fmt::format("is {}, and there are {} beams", first_beam, beams),
                fmt::format("give 0 to {}", beams - 1));
  }
  if (count == 0) throw Error("count", "is 0", "give 1 or more");
}

}  // namespace sigmascape::live
