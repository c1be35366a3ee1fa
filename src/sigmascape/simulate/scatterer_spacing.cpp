#include "sigmascape/simulate/scatterer_spacing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/coherent_plan.h"
#include "sigmascape/radar/doppler.h"
#include "sigmascape/radar/window_response.h"

namespace sigmascape::simulate {
namespace {

/// By so much finer pulses have scatterers of their own.
constexpr double noticeably_finer = 0.9;

/// Half-power width along the flight of the image of all pulses that the radar's mode makes of an area; nothing where
/// it makes none.
std::optional<double> resolution_of_mode_m(const radar::Radar& radar, Vec3d middle) {
  if (radar.mode == radar::Mode::RealBeam) return std::nullopt;
  try {
    const radar::CoherentPlan plan = radar::coherent_plan(radar, middle);
    return plan.along_resolution_m / plan.looks;
  } catch (const Error&) {
    // What cannot be mapped can be recorded.
    return std::nullopt;
  }
}

}  // namespace

double scatterer_spacing_m(const radar::Radar& radar, double across_resolution_m) {
  constexpr double rungs_a_halving = 8.0;
  constexpr double slack = 1e-6;  // what is on a rung but for rounding stays there
  const double halvings = std::log2(std::max(radar.range_resolution_m / across_resolution_m, 1.0));
  return radar.range_resolution_m / 2.0 * std::exp2(-std::ceil(rungs_a_halving * halvings - slack) / rungs_a_halving);
}

double resolution_of_interval_m(const radar::Radar& radar, Vec3d place, double interval_s) {
  const Vec3d away = radar::earth_of(radar).bent(place, {radar.position.x, radar.position.y}) - radar.position;
  const double speed_mps = length(Vec2d{radar.velocity_mps.x, radar.velocity_mps.y});
  const double off_course_rad = radar::off_course_rad(radar.velocity_mps, away);
  if (!(interval_s > 0.0 && speed_mps > 0.0 && off_course_rad > 0.0)) return std::numeric_limits<double>::infinity();
  const double wavelength = wavelength_m(radar.frequency_hz);
  const double cell_m =
      radar::cross_range_resolution_m(length(away), wavelength, speed_mps, interval_s, off_course_rad);
  // However long it flies past, no place is seen from more than all sides.
  return radar::WindowResponse(radar.waveform.window).half_power_width() * std::max(cell_m, wavelength / 4.0);
}

double pulse_scatterer_spacing_m(const radar::Radar& radar, const radar::Rectangle& area,
                                 const terrain::HeightField& terrain, double interval_s) {
  const Vec2d centre = area.centre();
  const Vec3d middle{centre.x, centre.y, terrain.height_at(centre)};
  const double of_pulses_m = resolution_of_interval_m(radar, middle, interval_s);
  const double of_mode_m = resolution_of_mode_m(radar, middle).value_or(std::numeric_limits<double>::infinity());
  const bool keeps_to_mode = radar.mode == radar::Mode::Stripmap || of_pulses_m >= noticeably_finer * of_mode_m;
  return scatterer_spacing_m(radar, keeps_to_mode ? of_mode_m : of_pulses_m);
}

}  // namespace sigmascape::simulate
