#include "sigmascape/radar/coherent_warnings.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/coherent_advice.h"
#include "sigmascape/radar/coherent_sight.h"
#include "sigmascape/radar/doppler.h"
#include "sigmascape/radar/doppler_span.h"
#include "sigmascape/radar/rectangle_distances.h"
#include "sigmascape/radar/rectangle_parts.h"

namespace sigmascape::radar {
namespace {

/// Which way the resolution is that the interval gives.
const char* direction_told(const Radar& radar) {
  return radar.mode == Mode::Stripmap ? "along the flight" : "across range";
}

/// Ground near the course and on both sides of it.
void check_sides(const Radar& radar, const CoherentPlan& plan, const Rectangle& area, double height_m,
                 std::vector<std::string>& warnings) {
  const Vec3d ahead = normalized(radar.velocity_mps);
  double off_the_line = pi, least_side = 0.0, most_side = 0.0;
  for (const Vec3d corner : corners_of(area, height_m)) {
    const Vec3d away = corner - radar.position;
    off_the_line = std::min(off_the_line, off_the_line_rad(off_course_rad(radar.velocity_mps, away)));
    const double side = ahead.x * away.y - ahead.y * away.x;
    least_side = std::min(least_side, side);
    most_side = std::max(most_side, side);
  }
  const bool on_both_sides = least_side < 0.0 && most_side > 0.0;
  if (radar.mode != Mode::Stripmap && (on_both_sides || off_the_line < plan.blind_wedge_rad)) {
    warnings.push_back(fmt::format(
        "part of what is mapped lies in the blind wedge about the course, within {:.3g}° of it, where it is no "
        "sharper than the real beam, and σ0 does not hold there and close beside; map ground farther to the side, or "
        "more finely by {}",
        deg_from_radians(plan.blind_wedge_rad), keys_of_resolution(radar)));
  }
  if (on_both_sides) {
    warnings.emplace_back(
        "what is mapped lies on both sides of the course, and left and right have the same Doppler and fall onto one "
        "another; map one side");
  }
}

/// Across the line of sight, of a strip along the flight.
void check_resolves(const Radar& radar, const CoherentPlan& plan, const Rectangle& area,
                    std::vector<std::string>& warnings) {
  const Vec2d course{radar.velocity_mps.x, radar.velocity_mps.y};
  const Vec2d away = area.centre() - Vec2d{radar.position.x, radar.position.y};
  const Vec2d along = radar.mode == Mode::Stripmap ? course : Vec2d{-away.y, away.x};
  const auto [least_m, most_m] = span_over(area, [&](Vec2d place) { return dot(place, along) / length(along); });
  if (!(plan.along_resolution_m > most_m - least_m)) return;
  warnings.push_back(
      fmt::format("the resolution of {:.3g} m {} is wider than what is mapped, {:.3g} m, and "
                  "nothing of it is told apart; map more, or more finely by {}",
                  plan.along_resolution_m, direction_told(radar), most_m - least_m, keys_of_resolution(radar)));
}

/// Each look in so few pulses answers in another shape than that of its window.
void check_pulses(const Radar& radar, const CoherentPlan& plan, std::vector<std::string>& warnings) {
  constexpr double few = 4.0;
  const double pulses = plan.interval_s * radar.waveform.pulse_repetition_hz / plan.looks;
  if (!(std::round(pulses) < few)) return;
  warnings.push_back(
      fmt::format("each look has {:.0f} pulse{}, too few for the resolution of {:.3g} m {} and for the side lobes of "
                  "its window; {} or a higher waveform.pulse_repetition_hz",
                  pulses, std::round(pulses) > 1.0 ? "s" : "", plan.along_resolution_m, direction_told(radar),
                  advice_for_longer(radar, plan.along_resolution_m, plan.interval_s, few / pulses)));
}

/// What the pulses of the interval resolve across range, with all that the line of sight turns meanwhile and not only
/// at the rate that it has in the middle: w n λ/(2 |q·(u₁ − u₂)|). docs/physics/doppler.md, Eq. (3b).
double width_of_turn_m(const Radar& radar, const CoherentSight& sight, double interval_s) {
  const Vec3d flown = radar.velocity_mps * (interval_s / 2.0);
  const Vec3d turned = normalized(sight.away + flown) - normalized(sight.away - flown);
  const double across = std::abs(sight.away.x * turned.y - sight.away.y * turned.x) / sight.ground_range_m;
  return cells_of_width(radar) * wavelength_m(radar.frequency_hz) / (2.0 * across);
}

void check_turn(const Radar& radar, const CoherentPlan& plan, Vec3d middle, std::vector<std::string>& warnings) {
  const CoherentSight sight = coherent_sight(radar, middle - radar.position);
  if (beam_straddles_course(radar, sight)) return;
  const double width_m = width_of_turn_m(radar, sight, plan.interval_s);
  if (width_m <= 1.05 * resolution_in_a_second_m(radar, sight) / plan.interval_s) return;
  warnings.push_back(
      fmt::format("the interval of {:.3g} s is that of small angles, and the line of sight turns so far in it that "
                  "pulses resolve {:.3g} m across range and not the {:.3g} m of this map; map more coarsely, or count "
                  "on a longer interval",
                  plan.interval_s, width_m, plan.along_resolution_m));
}

/// Doppler beyond what pulses know, and beyond the image's axis, in whose middle is that of the area's middle.
void check_folding(const Radar& radar, const Rectangle& area, Vec3d middle, std::vector<std::string>& warnings) {
  const DopplerSpan span = doppler_span(radar, corners_of(area, middle.z));
  if (auto folds = doppler_that_folds(radar, span, "what is mapped")) return warnings.push_back(*std::move(folds));
  const double prf_hz = radar.waveform.pulse_repetition_hz, middle_hz = doppler_of_hz(radar, middle);
  const double reach_hz = std::max(span.most_hz - middle_hz, middle_hz - span.least_hz);
  if (!(2.0 * reach_hz > prf_hz)) return;
  warnings.push_back(
      fmt::format("the Doppler of what is mapped reaches {:.4g} Hz from that of its middle, more than half of the "
                  "pulse repetition frequency of {:g} Hz, and the slant image has what lies beyond at its other end; "
                  "map less or send more pulses",
                  reach_hz, prf_hz));
}

}  // namespace

std::vector<std::string> plan_warnings(const Radar& radar, const CoherentPlan& plan, const Rectangle& area,
                                       double height_m) {
  const Vec2d centre = area.centre();
  const Vec3d middle{centre.x, centre.y, height_m};
  std::vector<std::string> warnings;
  check_sides(radar, plan, area, height_m, warnings);
  check_resolves(radar, plan, area, warnings);
  check_pulses(radar, plan, warnings);
  if (radar.mode == Mode::Stripmap) return warnings;
  check_turn(radar, plan, middle, warnings);
  check_folding(radar, area, middle, warnings);
  return warnings;
}

}  // namespace sigmascape::radar
