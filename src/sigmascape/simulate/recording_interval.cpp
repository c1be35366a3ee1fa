#include "sigmascape/simulate/recording_interval.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/radar/coherent_plan.h"
#include "sigmascape/radar/mode_words.h"
#include "sigmascape/radar/rectangle_distances.h"
#include "sigmascape/radar/vantage.h"

namespace sigmascape::simulate {
namespace {

/// By so little less nothing is lost that could be told.
constexpr double as_good_as = 0.99;
/// More pulses than nobody asks for unwittingly.
constexpr double very_many_pulses = 1e5;

Vec3d middle_of(const radar::Rectangle& area, const terrain::HeightField& terrain) {
  const Vec2d centre = area.centre();
  return {centre.x, centre.y, terrain.height_at(centre)};
}

/// The band that a place is processed over is swept in a time that goes with its range.
double strip_interval_s(const radar::Radar& radar, const radar::Rectangle& area, Vec3d middle, double of_middle_s) {
  const radar::Vantage vantage = radar::vantage_of_strip(radar, {middle.x, middle.y});
  const Vec2d course{radar.velocity_mps.x, radar.velocity_mps.y};
  const double middle_range_m = length(middle - vantage.place_for({middle.x, middle.y}));
  double half_s = 0.0;
  for (const Vec3d corner : radar::corners_of(area, middle.z)) {
    const Vec3d platform = vantage.place_for({corner.x, corner.y}), flown = platform - radar.position;
    const double passes_s = dot(Vec2d{flown.x, flown.y}, course) / dot(course, course);
    const double processed_s = of_middle_s * length(corner - platform) / middle_range_m;
    half_s = std::max(half_s, std::abs(passes_s) + 0.5 * processed_s);
  }
  return 2.0 * half_s;
}

/// Nothing where the mode cannot map the area, which may still be recorded.
std::optional<double> interval_if_mapped_s(const radar::Radar& radar, const radar::Rectangle& area,
                                           const terrain::HeightField& terrain) {
  try {
    return interval_of_mode_s(radar, area, terrain);
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<double> interval_of_mode_s(const radar::Radar& radar, const radar::Rectangle& area,
                                         const terrain::HeightField& terrain) {
  if (radar.mode == radar::Mode::RealBeam) return std::nullopt;
  const Vec3d middle = middle_of(area, terrain);
  const radar::CoherentPlan plan = radar::coherent_plan(radar, middle);
  return radar.mode == radar::Mode::Stripmap ? strip_interval_s(radar, area, middle, plan.interval_s) : plan.interval_s;
}

double recording_interval_s(std::optional<double> asked_s, const radar::Radar& radar, const radar::Rectangle& area,
                            const terrain::HeightField& terrain) {
  return asked_s ? *asked_s : interval_of_mode_s(radar, area, terrain).value_or(usual_interval_s);
}

std::vector<std::string> interval_warnings(std::optional<double> asked_s, const radar::Radar& radar,
                                           const radar::Rectangle& area, const terrain::HeightField& terrain) {
  const auto needed_s = interval_if_mapped_s(radar, area, terrain);
  if (!needed_s) return {};
  const bool strips = radar.mode == radar::Mode::Stripmap;
  const double pulses = *needed_s * radar.waveform.pulse_repetition_hz;
  if (!asked_s && strips && pulses > very_many_pulses) {
    return {
        fmt::format("pulses of the whole strip are recorded, {:.3g} s or {:.0f} of them; state a shorter interval "
                    "where a part of it will do",
                    *needed_s, pulses)};
  }
  if (!asked_s || !(*asked_s < as_good_as * *needed_s)) return {};
  if (strips) {
    return {
        fmt::format("pulses are recorded for {:.3g} s, and the strip takes {:.3g} s until its beam has passed over "
                    "all that is mapped; leave the interval out to record all of it",
                    *asked_s, *needed_s)};
  }
  return {
      fmt::format("pulses are recorded for {:.3g} s, and the {} of this radar adds up {:.3g} s: across range they "
                  "tell apart {:.3g} times less than its map; leave the interval out to record as long",
                  *asked_s, radar::mode_word(radar.mode), *needed_s, *needed_s / *asked_s)};
}

void tell_of_mode(const radar::Radar& radar, const radar::Rectangle& area, const terrain::HeightField& terrain,
                  std::map<std::string, std::string>& words) {
  words["radar_mode"] = radar::mode_word(radar.mode);
  if (const auto interval_s = interval_if_mapped_s(radar, area, terrain))
    words["mode_interval_s"] = fmt::format("{:.6g}", *interval_s);
}

}  // namespace sigmascape::simulate
