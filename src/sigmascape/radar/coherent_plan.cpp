#include "sigmascape/radar/coherent_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/advised_number.h"
#include "sigmascape/radar/coherent_advice.h"
#include "sigmascape/radar/coherent_sight.h"
#include "sigmascape/radar/doppler.h"
#include "sigmascape/radar/radar_title.h"
#include "sigmascape/radar/rectangle_distances.h"
#include "sigmascape/radar/rectangle_parts.h"
#include "sigmascape/radar/strip_beam.h"

namespace sigmascape::radar {
namespace {

[[noreturn]] void refuse_straight_ahead(const Radar& radar, const CoherentSight& sight, const std::string& advice) {
  throw Error(
      title_of(radar),
      fmt::format("flies straight towards or away from what it maps, {:.2g}° off its course, where Doppler does "
                  "not tell places apart",
                  deg_from_radians(off_the_line_rad(sight.off_course_rad))),
      advice);
}

/// The widest that a cell becomes, on the course itself: cos φ falls by half a cell of Doppler to both sides.
/// docs/physics/doppler.md, Eq. (3a).
double width_on_course_m(const Radar& radar, const CoherentSight& sight, double interval_s) {
  const double cells_mps = 4.0 * sight.horizontal_speed_mps * interval_s * sight.ground_range_m / sight.range_m;
  const double fall = cells_of_width(radar) * wavelength_m(radar.frequency_hz) / cells_mps;
  return 2.0 * sight.ground_range_m * std::acos(std::max(-1.0, 1.0 - fall));
}

/// What no interval resolves, for no path sees a place from more than all sides: w n λ/4. docs/physics/doppler.md,
/// Eq. (3b).
double finest_of_any_interval_m(const Radar& radar) {
  return cells_of_width(radar) * wavelength_m(radar.frequency_hz) / 4.0;
}

/// Beyond this nobody flies straight, nor are pulses counted.
constexpr double longest_interval_s = 1e4;

void check_not_endless(const Radar& radar, double width_m, double interval_s) {
  if (interval_s <= longest_interval_s) return;
  throw Error(title_of(radar),
              fmt::format("takes {:.3g} s to tell apart {:.3g} m across range at {:.3g} m/s", interval_s, width_m,
                          std::hypot(radar.velocity_mps.x, radar.velocity_mps.y)),
              "give a higher platform.speed_mps, or " +
                  advice_for_coarser(radar, width_m, interval_s, width_m * interval_s / longest_interval_s));
}

/// Each look takes a pulse, and Doppler takes two.
void check_has_pulses(const Radar& radar, double width_m, double interval_s) {
  const double repetition_hz = radar.waveform.pulse_repetition_hz, pulses = interval_s * repetition_hz;
  const double looks = radar.processing.looks, fewest = std::max(2.0, looks);
  if (std::round(pulses) >= fewest) return;
  throw Error(
      title_of(radar),
      fmt::format("has {:.3g} pulse{} in an interval of {:.3g} s, at a pulse repetition frequency of {:g} Hz, and {}",
                  pulses, pulses == 1.0 ? "" : "s", interval_s, repetition_hz,
                  looks > 1.0 ? fmt::format("{:g} looks, each of which takes one", looks) : "Doppler takes two"),
      advice_for_longer(radar, width_m, interval_s, fewest / pulses) + " or a higher waveform.pulse_repetition_hz");
}

/// The interval as pulses have it, the nearest in which every look has the same number of them.
double in_whole_pulses_s(const Radar& radar, double width_m, double interval_s) {
  check_has_pulses(radar, width_m, interval_s);
  const double repetition_hz = radar.waveform.pulse_repetition_hz, looks = radar.processing.looks;
  return looks * std::max(1.0, std::round(interval_s * repetition_hz / looks)) / repetition_hz;
}

void plan_interval(const Radar& radar, const CoherentSight& sight, CoherentPlan& plan) {
  const Processing& asked = radar.processing;
  if (!(sight.ground_range_m > 0.0)) {
    throw Error(title_of(radar), "is straight above what it maps, where nothing lies across",
                "map ground farther to the side");
  }
  if (!asked.interval_s && beam_straddles_course(radar, sight)) {
    const char* const in_place_of = asked.along_resolution_m ? " in place of mode.along_resolution_m"
                                    : asked.sharpening       ? " in place of mode.sharpening"
                                                             : "";
    refuse_straight_ahead(radar, sight,
                          fmt::format("map ground farther to the side, or state mode.interval_s{}", in_place_of));
  }
  const double in_a_second_m = resolution_in_a_second_m(radar, sight);
  const double wanted_m =
      radar.mode == Mode::DopplerBeamSharpening
          ? radar.beam_width_rad * sight.ground_range_m / asked.sharpening.value_or(usual_sharpening)
          : asked.along_resolution_m.value_or(radar.range_resolution_m);
  const double interval_s = asked.interval_s.value_or(in_a_second_m / wanted_m);
  const double width_m = in_a_second_m / interval_s, finest_m = finest_of_any_interval_m(radar);
  if (width_m <= finest_m) {
    throw Error(
        title_of(radar),
        fmt::format("cannot map to {:.3g} m across range{} at a wavelength of {:.3g} m, however long it flies past",
                    width_m, plan.looks > 1 ? fmt::format(" with {} looks", plan.looks) : "",
                    wavelength_m(radar.frequency_hz)),
        advice_for_coarser(radar, width_m, interval_s, finest_m));
  }
  check_not_endless(radar, width_m, interval_s);
  plan.interval_s = in_whole_pulses_s(radar, width_m, interval_s);
  plan.along_resolution_m = std::min(in_a_second_m / plan.interval_s, width_on_course_m(radar, sight, plan.interval_s));
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
  const double azimuth = azimuth_of(away) + edge_rad;
  const auto beside_edge = [&](Vec3d v) { return v.x * std::cos(azimuth) - v.y * std::sin(azimuth); };
  const Vec3d then = away - flight * (beside_edge(away) / beside_edge(flight));
  return dot(then, flight) / (length(then) * length(flight));
}

/// What the beam's Doppler band gives along the flight: w n λ/(2 |sin φ₁ − sin φ₂|). docs/physics/doppler.md, Eq. (5a).
double finest_of_strip_m(const Radar& radar, const CoherentSight& sight) {
  const double half_beam = radar.beam_width_rad / 2.0;
  const double sines =
      std::abs(sine_at_edge(radar, sight.away, half_beam) - sine_at_edge(radar, sight.away, -half_beam));
  return cells_of_width(radar) * wavelength_m(radar.frequency_hz) / (2.0 * sines);
}

/// Pulses know Doppler up to their repetition frequency, and a band that is wider has every part of it twice.
void check_band_is_known(const Radar& radar, double along_resolution_m) {
  const double repetition_hz = radar.waveform.pulse_repetition_hz;
  const double width_hz_m = cells_of_width(radar) * length(radar.velocity_mps);
  const double band_hz = width_hz_m / along_resolution_m;
  if (band_hz <= repetition_hz * (1.0 + 1e-9)) return;
  throw Error(
      title_of(radar),
      fmt::format("maps a strip to {:.3g} m along the flight{} from a Doppler band of {:.4g} Hz, wider than the "
                  "pulse repetition frequency of {:g} Hz, up to which pulses know Doppler",
                  along_resolution_m,
                  radar.processing.looks > 1 ? fmt::format(" with {} looks", radar.processing.looks) : "", band_hz,
                  repetition_hz),
      fmt::format("give mode.along_resolution_m of at least {:g}{} or waveform.pulse_repetition_hz of at least "
                  "{:g}",
                  rounded_up(width_hz_m / repetition_hz, advised_digits),
                  radar.processing.looks > 1 ? ", fewer mode.looks" : "", rounded_up(band_hz, advised_digits)));
}

void plan_strip(const Radar& radar, const CoherentSight& sight, CoherentPlan& plan) {
  if (!(sight.ground_range_m > 0.0) || beam_straddles_course(radar, sight))
    refuse_straight_ahead(radar, sight, "map ground farther to the side");
  const double finest_m = finest_of_strip_m(radar, sight);
  plan.along_resolution_m = radar.processing.along_resolution_m.value_or(std::max(finest_m, radar.range_resolution_m));
  if (plan.along_resolution_m < finest_m * (1.0 - 1e-9)) {
    throw Error(title_of(radar),
                fmt::format("cannot map a strip to {:g} m along the flight with {} looks of a beam of {:.3g}°",
                            plan.along_resolution_m, plan.looks, deg_from_radians(radar.beam_width_rad)),
                fmt::format("give mode.along_resolution_m of at least {:.3g}{} or a wider beam",
                            rounded_up(finest_m, advised_digits), plan.looks > 1 ? ", fewer looks" : ""));
  }
  check_band_is_known(radar, plan.along_resolution_m);
  // Band over Doppler rate, which the whole speed and the angle in space decide.
  const double sine = std::sin(plan.squint_rad);
  plan.interval_s = cells_of_width(radar) * wavelength_m(radar.frequency_hz) * sight.range_m /
                    (2.0 * length(radar.velocity_mps) * sine * sine * plan.along_resolution_m);
  check_has_pulses(radar, plan.along_resolution_m, plan.interval_s);
}

/// The angles off the course at which the Doppler of a range is so many half-power widths of a cell higher and lower
/// than at the place: cos φ changes by as much to either side, and on the course it ends. Beyond half a repetition
/// frequency Doppler comes back from the other side.
std::array<double, 2> off_course_of_widths(const Radar& radar, const CoherentSight& sight, double interval_s,
                                           double widths) {
  const double change_hz =
      std::min(widths * cells_of_width(radar) / interval_s, 0.5 * radar.waveform.pulse_repetition_hz);
  const double change = change_hz * wavelength_m(radar.frequency_hz) * sight.range_m /
                        (2.0 * sight.horizontal_speed_mps * sight.ground_range_m);
  const double cosine = std::cos(sight.off_course_rad);
  return {std::acos(std::min(1.0, cosine + change)), std::acos(std::max(-1.0, cosine - change))};
}

}  // namespace

CoherentPlan coherent_plan(const Radar& radar, Vec3d aim) {
  const double speed_mps = length(radar.velocity_mps);
  if (!(speed_mps > 0.0))
    throw Error(title_of(radar), "stands still",
                "give it a velocity, platform.speed_mps: coherent modes live from motion");
  check_processing(radar);
  aim = earth_of(radar).bent(aim, {radar.position.x, radar.position.y});
  const CoherentSight sight =
      coherent_sight(radar, radar.mode == Mode::Stripmap ? way_as_passed(radar, aim) : aim - radar.position);
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

Rectangle answering_ground(const Radar& radar, const CoherentPlan& plan, const Rectangle& area, double height_m) {
  constexpr double widths = 2.0;
  const Vec2d foot{radar.position.x, radar.position.y};
  const Vec2d course{radar.velocity_mps.x, radar.velocity_mps.y}, ahead = course * (1.0 / length(course));
  Rectangle ground = area;
  for (const Vec3d corner : corners_of(area, height_m)) {
    const CoherentSight sight = coherent_sight(radar, earth_of(radar).bent(corner, foot) - radar.position);
    if (!(sight.ground_range_m > 0.0)) continue;
    const Vec2d away = Vec2d{corner.x, corner.y} - foot;
    const Vec2d beside = Vec2d{-ahead.y, ahead.x} * (cross(ahead, away) < 0.0 ? -1.0 : 1.0);
    for (const double off_course : off_course_of_widths(radar, sight, plan.interval_s, widths)) {
      const Vec2d direction = ahead * std::cos(off_course) + beside * std::sin(off_course);
      ground = with_point(ground, foot + direction * length(away));
    }
  }
  return ground;
}

}  // namespace sigmascape::radar
