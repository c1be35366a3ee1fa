#include "sigmascape/radar/coherent_plan.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/advised_number.h"
#include "sigmascape/radar/doppler.h"
#include "sigmascape/radar/radar_title.h"
#include "sigmascape/radar/rectangle_distances.h"
#include "sigmascape/radar/strip_beam.h"
#include "sigmascape/radar/window_response.h"

namespace sigmascape::radar {
namespace {

/// Where the middle of the area lies as the radar flies: on the map and above it.
struct Sight {
  Vec3d away;  ///< from the radar, at time zero or, of a strip, as its beam passes
  double range_m, ground_range_m, off_course_rad, horizontal_speed_mps;
};

Sight sight_of(const Radar& radar, Vec3d away) {
  return {away, length(away), std::hypot(away.x, away.y), off_course_rad(radar.velocity_mps, away),
          std::hypot(radar.velocity_mps.x, radar.velocity_mps.y)};
}

/// The smaller of the angles to the course and to where the radar comes from.
double off_the_line_rad(double off_course_rad) {
  return std::min(off_course_rad, pi - off_course_rad);
}

bool beam_straddles_course(const Radar& radar, const Sight& sight) {
  return off_the_line_rad(sight.off_course_rad) < radar.beam_width_rad / 2.0;
}

[[noreturn]] void refuse_straight_ahead(const Radar& radar, const Sight& sight, const char* advice) {
  throw Error(
      title_of(radar),
      fmt::format("flies straight towards or away from what it maps, {:.2g}° off its course, where Doppler does "
                  "not tell places apart",
                  deg_from_radians(off_the_line_rad(sight.off_course_rad))),
      advice);
}

/// Window's half-power width times looks: cells of one look in the width of the finished map.
double cells_of_width(const Radar& radar) {
  return WindowResponse(radar.waveform.window).half_power_width() * radar.processing.looks;
}

/// Half-power width on the ground along constant range for an interval of one second, all looks together.
double resolution_in_a_second_m(const Radar& radar, const Sight& sight) {
  return cells_of_width(radar) * cross_range_resolution_m(sight.range_m, wavelength_m(radar.frequency_hz),
                                                          sight.horizontal_speed_mps, 1.0, sight.off_course_rad);
}

/// The widest that a cell becomes, on the course itself: cos φ falls by half a cell of Doppler to both sides.
/// docs/physics/doppler.md, Eq. (3a).
double width_on_course_m(const Radar& radar, const Sight& sight, double interval_s) {
  const double cells_mps = 4.0 * sight.horizontal_speed_mps * interval_s * sight.ground_range_m / sight.range_m;
  const double fall = cells_of_width(radar) * wavelength_m(radar.frequency_hz) / cells_mps;
  return 2.0 * sight.ground_range_m * std::acos(std::max(-1.0, 1.0 - fall));
}

/// What no interval resolves, for no path sees a place from more than all sides: w n λ/4. docs/physics/doppler.md,
/// Eq. (3b).
double finest_of_any_interval_m(const Radar& radar) {
  return cells_of_width(radar) * wavelength_m(radar.frequency_hz) / 4.0;
}

/// Of what is advised.
constexpr int digits = 3;

/// What would not be refused of the key that asks for this width.
std::string advice_for_coarser(const Radar& radar, double width_m, double interval_s, double finest_m) {
  const double too_fine = finest_m / width_m;
  const std::string fewer_looks = radar.processing.looks > 1 ? " or fewer looks" : "";
  if (radar.processing.interval_s)
    return fmt::format("give mode.interval_s of less than {:g}{}", rounded_down(interval_s / too_fine, digits),
                       fewer_looks);
  if (radar.mode == Mode::DopplerBeamSharpening) {
    const double sharpening = radar.processing.sharpening.value_or(usual_sharpening);
    return fmt::format("give mode.sharpening of less than {:g}{}", rounded_down(sharpening / too_fine, digits),
                       fewer_looks);
  }
  return fmt::format("give mode.along_resolution_m of more than {:g}{}", rounded_up(finest_m, digits), fewer_looks);
}

void plan_interval(const Radar& radar, const Sight& sight, CoherentPlan& plan) {
  const Processing& asked = radar.processing;
  if (!(sight.ground_range_m > 0.0)) {
    throw Error(title_of(radar), "is straight above what it maps, where nothing lies across",
                "map ground farther to the side");
  }
  if (!asked.interval_s && beam_straddles_course(radar, sight))
    refuse_straight_ahead(radar, sight, "map ground farther to the side, or state mode.interval_s");
  const double in_a_second_m = resolution_in_a_second_m(radar, sight);
  const double wanted_m =
      radar.mode == Mode::DopplerBeamSharpening
          ? radar.beam_width_rad * sight.ground_range_m / asked.sharpening.value_or(usual_sharpening)
          : asked.along_resolution_m.value_or(radar.range_resolution_m);
  plan.interval_s = asked.interval_s.value_or(in_a_second_m / wanted_m);
  const double width_m = in_a_second_m / plan.interval_s, finest_m = finest_of_any_interval_m(radar);
  if (width_m <= finest_m) {
    throw Error(
        title_of(radar),
        fmt::format("cannot map to {:.3g} m across range{} at a wavelength of {:.3g} m, however long it flies past",
                    width_m, plan.looks > 1 ? fmt::format(" with {} looks", plan.looks) : "",
                    wavelength_m(radar.frequency_hz)),
        advice_for_coarser(radar, width_m, plan.interval_s, finest_m));
  }
  plan.along_resolution_m = std::min(width_m, width_on_course_m(radar, sight, plan.interval_s));
}

/// What a radar file is not read with, and a radar may be given attribute by attribute.
void check_processing(const Radar& radar) {
  const Processing& asked = radar.processing;
  const bool sharpens = radar.mode == Mode::DopplerBeamSharpening, strips = radar.mode == Mode::Stripmap;
  const auto refuse_idle = [&](bool is_idle, const char* name) {
    if (is_idle)
      throw Error(title_of(radar), fmt::format("has {}, which means nothing in its mode", name), "leave it out");
  };
  refuse_idle(strips && asked.interval_s.has_value(), "interval_s");
  refuse_idle(sharpens && asked.along_resolution_m.has_value(), "along_resolution_m");
  refuse_idle(!sharpens && asked.sharpening.has_value(), "sharpening");
  if (asked.interval_s && (asked.along_resolution_m || asked.sharpening)) {
    throw Error(title_of(radar),
                fmt::format("has interval_s and {}, which say the same thing",
                            asked.sharpening ? "sharpening" : "along_resolution_m"),
                "leave out one of them");
  }
}

/// The sine of the angle ahead of broadside at which the point is seen as one edge of the beam passes it. The beam
/// keeps its azimuth, and the point is seen less or more steeply the earlier or later it is passed.
double sine_at_edge(const Radar& radar, Vec3d away, double edge_rad) {
  const Vec3d flight = radar.velocity_mps;
  const double azimuth = std::atan2(away.x, away.y) + edge_rad;
  const auto beside_edge = [&](Vec3d v) { return v.x * std::cos(azimuth) - v.y * std::sin(azimuth); };
  const Vec3d then = away - flight * (beside_edge(away) / beside_edge(flight));
  return dot(then, flight) / (length(then) * length(flight));
}

/// What the beam's Doppler band gives along the flight: w n λ/(2 |sin φ₁ − sin φ₂|). docs/physics/doppler.md, Eq. (5a).
double finest_of_strip_m(const Radar& radar, const Sight& sight) {
  const double half_beam = radar.beam_width_rad / 2.0;
  const double sines =
      std::abs(sine_at_edge(radar, sight.away, half_beam) - sine_at_edge(radar, sight.away, -half_beam));
  return cells_of_width(radar) * wavelength_m(radar.frequency_hz) / (2.0 * sines);
}

void plan_strip(const Radar& radar, const Sight& sight, CoherentPlan& plan) {
  if (!(sight.ground_range_m > 0.0) || beam_straddles_course(radar, sight))
    refuse_straight_ahead(radar, sight, "map ground farther to the side");
  const double finest_m = finest_of_strip_m(radar, sight);
  plan.along_resolution_m = radar.processing.along_resolution_m.value_or(std::max(finest_m, radar.range_resolution_m));
  if (plan.along_resolution_m < finest_m * (1.0 - 1e-9)) {
    throw Error(title_of(radar),
                fmt::format("cannot map a strip to {:g} m along the flight with {} looks of a beam of {:.3g}°",
                            plan.along_resolution_m, plan.looks, deg_from_radians(radar.beam_width_rad)),
                fmt::format("give mode.along_resolution_m of at least {:.3g}{} or a wider beam",
                            rounded_up(finest_m, digits), plan.looks > 1 ? ", fewer looks" : ""));
  }
  // Band over Doppler rate, which the whole speed and the angle in space decide.
  const double sine = std::sin(plan.squint_rad);
  plan.interval_s = cells_of_width(radar) * wavelength_m(radar.frequency_hz) * sight.range_m /
                    (2.0 * length(radar.velocity_mps) * sine * sine * plan.along_resolution_m);
}

/// What the pulses of the interval resolve across range, with all that the line of sight turns meanwhile and not only
/// at the rate that it has in the middle: w n λ/(2 |q·(u₁ − u₂)|). docs/physics/doppler.md, Eq. (3b).
double width_of_turn_m(const Radar& radar, const Sight& sight, double interval_s) {
  const Vec3d flown = radar.velocity_mps * (interval_s / 2.0);
  const Vec3d turned = normalized(sight.away + flown) - normalized(sight.away - flown);
  const double across = std::abs(sight.away.x * turned.y - sight.away.y * turned.x) / sight.ground_range_m;
  return cells_of_width(radar) * wavelength_m(radar.frequency_hz) / (2.0 * across);
}

void check_turn(const Radar& radar, const CoherentPlan& plan, Vec3d middle, std::vector<std::string>& warnings) {
  const Sight sight = sight_of(radar, middle - radar.position);
  if (beam_straddles_course(radar, sight)) return;
  const double width_m = width_of_turn_m(radar, sight, plan.interval_s);
  if (width_m <= 1.05 * resolution_in_a_second_m(radar, sight) / plan.interval_s) return;
  warnings.push_back(
      fmt::format("the interval of {:.3g} s is that of small angles, and the line of sight turns so far in it that "
                  "pulses resolve {:.3g} m across range and not the {:.3g} m of this map; map more coarsely, or count "
                  "on a longer interval",
                  plan.interval_s, width_m, plan.along_resolution_m));
}

double doppler_of_hz(const Radar& radar, Vec3d place) {
  return doppler_hz(range_rate_mps({radar.position, radar.velocity_mps}, {place}), wavelength_m(radar.frequency_hz));
}

}  // namespace

CoherentPlan coherent_plan(const Radar& radar, Vec3d aim) {
  const double speed_mps = length(radar.velocity_mps);
  if (!(speed_mps > 0.0))
    throw Error(title_of(radar), "stands still",
                "give it a velocity, platform.speed_mps: coherent modes live from motion");
  check_processing(radar);
  aim = earth_of(radar).bent(aim, {radar.position.x, radar.position.y});
  const Sight sight = sight_of(radar, radar.mode == Mode::Stripmap ? way_as_passed(radar, aim) : aim - radar.position);
  CoherentPlan plan{.looks = radar.processing.looks,
                    .squint_rad = std::acos(
                        std::clamp(dot(sight.away, radar.velocity_mps) / (sight.range_m * speed_mps), -1.0, 1.0))};
  if (radar.mode == Mode::Stripmap) {
    plan_strip(radar, sight, plan);
  } else {
    plan_interval(radar, sight, plan);
  }
  plan.blind_wedge_rad =
      blind_wedge_rad(wavelength_m(radar.frequency_hz), sight.horizontal_speed_mps, plan.interval_s / plan.looks,
                      radar.beam_width_rad, std::atan2(std::abs(sight.away.z), sight.ground_range_m));
  return plan;
}

std::vector<std::string> plan_warnings(const Radar& radar, const CoherentPlan& plan, const Rectangle& area,
                                       double height_m) {
  std::vector<std::string> warnings;
  const Vec3d ahead = normalized(radar.velocity_mps);
  double off_the_line = pi, least_side = 0.0, most_side = 0.0, least_hz = 1e300, most_hz = -1e300;
  for (const Vec3d corner : corners_of(area, height_m)) {
    const Vec3d away = corner - radar.position;
    off_the_line = std::min(off_the_line, off_the_line_rad(off_course_rad(radar.velocity_mps, away)));
    const double side = ahead.x * away.y - ahead.y * away.x;
    least_side = std::min(least_side, side);
    most_side = std::max(most_side, side);
    const double frequency_hz = doppler_of_hz(radar, corner);
    least_hz = std::min(least_hz, frequency_hz);
    most_hz = std::max(most_hz, frequency_hz);
  }
  const bool on_both_sides = least_side < 0.0 && most_side > 0.0;
  if (radar.mode != Mode::Stripmap && (on_both_sides || off_the_line < plan.blind_wedge_rad)) {
    warnings.push_back(fmt::format(
        "part of what is mapped lies in the blind wedge about the course, within {:.3g}° of it, where it is no "
        "sharper than the real beam; map ground farther to the side or use a longer mode.interval_s",
        deg_from_radians(plan.blind_wedge_rad)));
  }
  if (on_both_sides) {
    warnings.emplace_back(
        "what is mapped lies on both sides of the course, and left and right have the same Doppler and fall onto one "
        "another; map one side");
  }
  const Vec2d centre = area.centre();
  const Vec3d middle{centre.x, centre.y, height_m};
  if (radar.mode != Mode::Stripmap) check_turn(radar, plan, middle, warnings);
  const double prf_hz = radar.waveform.pulse_repetition_hz, middle_hz = doppler_of_hz(radar, middle);
  if (radar.mode == Mode::Stripmap) {
    const double width = WindowResponse(radar.waveform.window).half_power_width();
    const double band_hz = plan.looks * width * length(radar.velocity_mps) / plan.along_resolution_m;
    if (band_hz > prf_hz) {
      warnings.push_back(fmt::format(
          "the processed Doppler band of {:.4g} Hz is wider than the pulse repetition "
          "frequency of {:g} Hz and folds over; send more pulses or ask for a coarser mode.along_resolution_m",
          band_hz, prf_hz));
    }
  } else if (most_hz - least_hz > prf_hz) {
    warnings.push_back(
        fmt::format("the Doppler of what is mapped spans {:.4g} Hz, more than the pulse repetition "
                    "frequency of {:g} Hz, and folds over; map less or send more pulses",
                    most_hz - least_hz, prf_hz));
  } else if (const double reach_hz = std::max(most_hz - middle_hz, middle_hz - least_hz); 2.0 * reach_hz > prf_hz) {
    warnings.push_back(
        fmt::format("the Doppler of what is mapped reaches {:.4g} Hz from that of its middle, more than half of the "
                    "pulse repetition frequency of {:g} Hz, and the slant image has what lies beyond at its other end; "
                    "map less or send more pulses",
                    reach_hz, prf_hz));
  }
  return warnings;
}

}  // namespace sigmascape::radar
