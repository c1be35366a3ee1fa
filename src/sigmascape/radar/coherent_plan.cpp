#include "sigmascape/radar/coherent_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/doppler.h"
#include "sigmascape/radar/radar_title.h"
#include "sigmascape/radar/window_response.h"

namespace sigmascape::radar {
namespace {

/// Half-power width across range for an interval of one second, all looks together.
double resolution_in_a_second_m(const Radar& radar, double range_m, double squint_rad) {
  const double width = WindowResponse(radar.waveform.window).half_power_width();
  return width * radar.processing.looks *
         cross_range_resolution_m(range_m, wavelength_m(radar.frequency_hz), length(radar.velocity_mps), 1.0,
                                  squint_rad);
}

void plan_interval(const Radar& radar, double range_m, CoherentPlan& plan) {
  const Processing& asked = radar.processing;
  const double in_a_second_m = resolution_in_a_second_m(radar, range_m, plan.squint_rad);
  if (!asked.interval_s && std::sin(plan.squint_rad) < std::sin(radar.beam_width_rad / 2.0)) {
    throw Error(
        title_of(radar),
        fmt::format("flies straight towards or away from what it maps, {:.2g}° off its course, where Doppler does "
                    "not tell places apart",
                    deg_from_radians(plan.squint_rad)),
        "map ground farther to the side, or state mode.interval_s");
  }
  const double wanted_m = radar.mode == Mode::DopplerBeamSharpening
                              ? radar.beam_width_rad * range_m / asked.sharpening.value_or(usual_sharpening)
                              : asked.along_resolution_m.value_or(radar.range_resolution_m);
  plan.interval_s = asked.interval_s.value_or(in_a_second_m / wanted_m);
  plan.along_resolution_m = in_a_second_m / plan.interval_s;
}

void plan_strip(const Radar& radar, double range_m, CoherentPlan& plan) {
  const double width = WindowResponse(radar.waveform.window).half_power_width();
  const double sine = std::sin(plan.squint_rad);
  const double finest_m =
      plan.looks * width * wavelength_m(radar.frequency_hz) / (4.0 * std::sin(radar.beam_width_rad / 2.0) * sine);
  plan.along_resolution_m = radar.processing.along_resolution_m.value_or(std::max(finest_m, radar.range_resolution_m));
  if (plan.along_resolution_m < finest_m * (1.0 - 1e-9)) {
    throw Error(title_of(radar),
                fmt::format("cannot map a strip to {:g} m along the flight with {} looks of a beam of {:.3g}°",
                            plan.along_resolution_m, plan.looks, deg_from_radians(radar.beam_width_rad)),
                fmt::format("give mode.along_resolution_m of at least {:.3g}, fewer looks or a wider beam", finest_m));
  }
  plan.interval_s = resolution_in_a_second_m(radar, range_m, plan.squint_rad) / sine / plan.along_resolution_m;
}

std::array<Vec3d, 4> corners_of(const Rectangle& area, double height_m) {
  return {Vec3d{area.west_m, area.south_m, height_m},
          {area.west_m, area.north_m, height_m},
          {area.east_m, area.south_m, height_m},
          {area.east_m, area.north_m, height_m}};
}

}  // namespace

CoherentPlan coherent_plan(const Radar& radar, Vec3d aim) {
  const double speed_mps = length(radar.velocity_mps);
  if (!(speed_mps > 0.0))
    throw Error(title_of(radar), "stands still", "give platform.speed_mps: coherent modes live from motion");
  const Vec3d away = aim - radar.position;
  const double range_m = length(away);
  CoherentPlan plan{
      .looks = radar.processing.looks,
      .squint_rad = std::acos(std::clamp(dot(away, radar.velocity_mps) / (range_m * speed_mps), -1.0, 1.0))};
  if (radar.mode == Mode::Stripmap) {
    plan_strip(radar, range_m, plan);
  } else {
    plan_interval(radar, range_m, plan);
  }
  plan.blind_wedge_rad =
      blind_wedge_rad(wavelength_m(radar.frequency_hz), speed_mps, plan.interval_s / plan.looks, radar.beam_width_rad);
  return plan;
}

std::vector<std::string> plan_warnings(const Radar& radar, const CoherentPlan& plan, const Rectangle& area,
                                       double height_m) {
  std::vector<std::string> warnings;
  const Vec3d ahead = normalized(radar.velocity_mps);
  double nearest_nose_rad = pi, least_side = 0.0, most_side = 0.0, least_hz = 1e300, most_hz = -1e300;
  for (const Vec3d corner : corners_of(area, height_m)) {
    const Vec3d away = corner - radar.position;
    const double along = dot(away, ahead) / length(away);
    nearest_nose_rad = std::min(nearest_nose_rad, std::acos(std::clamp(along, -1.0, 1.0)));
    const double side = ahead.x * away.y - ahead.y * away.x;
    least_side = std::min(least_side, side);
    most_side = std::max(most_side, side);
    const double frequency_hz =
        doppler_hz(range_rate_mps({radar.position, radar.velocity_mps}, {corner}), wavelength_m(radar.frequency_hz));
    least_hz = std::min(least_hz, frequency_hz);
    most_hz = std::max(most_hz, frequency_hz);
  }
  if (radar.mode == Mode::DopplerBeamSharpening && nearest_nose_rad < plan.blind_wedge_rad) {
    warnings.push_back(fmt::format(
        "part of what is mapped lies in the blind wedge ahead, within {:.3g}° of the course, where it is no "
        "sharper than the real beam; map ground farther to the side or use a longer mode.interval_s",
        deg_from_radians(plan.blind_wedge_rad)));
  }
  if (least_side < 0.0 && most_side > 0.0) {
    warnings.push_back(
        "what is mapped lies on both sides of the course, and left and right have the same Doppler and fall onto one "
        "another; map one side");
  }
  const double prf_hz = radar.waveform.pulse_repetition_hz;
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
  }
  return warnings;
}

}  // namespace sigmascape::radar
