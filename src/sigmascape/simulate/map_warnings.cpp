#include "sigmascape/simulate/map_warnings.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/azimuth_span.h"
#include "sigmascape/radar/doppler_span.h"
#include "sigmascape/radar/radar_warnings.h"
#include "sigmascape/radar/range_ambiguity.h"
#include "sigmascape/radar/rectangle_distances.h"
#include "sigmascape/radar/rectangle_parts.h"
#include "sigmascape/radar/strip_beam.h"
#include "sigmascape/simulate/placement.h"
#include "sigmascape/simulate/recorded_beam.h"
#include "sigmascape/simulate/recording_interval.h"
#include "sigmascape/simulate/simulate.h"
#include "sigmascape/simulate/targets_seen.h"

namespace sigmascape::simulate {
namespace {

/// "20 m in the east", for each side on which a cell or more of what is asked for is missing.
std::vector<std::string> cut_sides(const radar::Rectangle& asked, const radar::Rectangle& extent, double cell_m) {
  std::vector<std::string> sides;
  for (const auto& [beyond_m, side] : {std::pair(extent.west_m - asked.west_m, "west"),
                                       {asked.east_m - extent.east_m, "east"},
                                       {extent.south_m - asked.south_m, "south"},
                                       {asked.north_m - extent.north_m, "north"}}) {
    if (beyond_m >= cell_m) sides.push_back(fmt::format("{:.6g} m in the {}", beyond_m, side));
  }
  return sides;
}

/// The angles under which something is seen.
struct AngleSpan {
  double least_rad = std::numeric_limits<double>::infinity(), most_rad = -least_rad;

  void take_in(double angle_rad) {
    least_rad = std::min(least_rad, angle_rad);
    most_rad = std::max(most_rad, angle_rad);
  }
  /// The nearest of them to an angle.
  [[nodiscard]] double nearest(double angle_rad) const { return std::clamp(angle_rad, least_rad, most_rad); }
};

constexpr double least_two_way_power = 0.01;

/// Real-beam maps of what is never scanned are refused, spotlights are steered, and the beam of a strip passes.
std::optional<std::string> beam_beside(const radar::Radar& radar, const radar::Rectangle& area) {
  const bool keeps_azimuth = radar.mode == radar::Mode::DopplerBeamSharpening &&
                             radar.scan.kind == radar::ScanKind::Fixed && radar.scan.azimuth_rad;
  const Vec2d foot{radar.position.x, radar.position.y};
  if (!keeps_azimuth || area.contains(foot)) return std::nullopt;
  const radar::AzimuthSpan span = radar::azimuths_of(area, foot);
  const double middle_rad = turned_by_least(span.middle_rad - *radar.scan.azimuth_rad);
  const AngleSpan offsets{middle_rad + span.left_rad, middle_rad + span.right_rad};
  if (radar::antenna_pattern(radar).azimuth().two_way_power(offsets.nearest(0.0)) >= least_two_way_power)
    return std::nullopt;
  return fmt::format(
      "the beam points to {:.4g}° (scan.azimuth_deg), and what is mapped lies {:.3g}° to {:.3g}° beside it",
      deg_from_radians(wrapped_azimuth(*radar.scan.azimuth_rad - radar.north_rad)), deg_from_radians(offsets.least_rad),
      deg_from_radians(offsets.most_rad));
}

/// A strip is seen from where the platform is as its beam passes over it. Of one that passes over nothing others tell.
radar::Radar as_it_maps(const radar::Radar& radar, const radar::Rectangle& area, const terrain::HeightField& terrain) {
  const Vec2d middle = area.centre();
  try {
    return radar::as_it_passes(radar, {middle.x, middle.y, terrain.height_at(middle)});
  } catch (const Error&) {
    return radar;
  }
}

/// The Doppler at the range of an area's middle, from one side of it to the other or, in volts, of a beam about its
/// middle where that is narrower: that along range is told apart by range.
std::optional<std::string> doppler_that_folds(const radar::Radar& radar, const radar::Rectangle& area,
                                              const terrain::HeightField& terrain, bool within_beam) {
  constexpr int steps = 32;
  const radar::Radar mapping = as_it_maps(radar, area, terrain);
  const Vec2d foot{mapping.position.x, mapping.position.y}, middle = area.centre();
  const radar::AzimuthSpan span = radar::azimuths_of(area, foot);
  double left_rad = span.left_rad, right_rad = span.right_rad;
  const double half_beam_rad = 0.5 * radar::antenna_pattern(mapping).azimuth().two_way_width_rad();
  const bool is_of_beam = within_beam && right_rad - left_rad > 2.0 * half_beam_rad;
  if (is_of_beam) {
    left_rad = -half_beam_rad;
    right_rad = half_beam_rad;
  }
  std::vector<Vec3d> places;
  for (int step = 0; step <= steps; ++step) {
    const double azimuth = span.middle_rad + left_rad + (right_rad - left_rad) * step / steps;
    const Vec2d there = foot + Vec2d{std::sin(azimuth), std::cos(azimuth)} * length(middle - foot);
    places.push_back({there.x, there.y, terrain.height_at(middle)});
  }
  return radar::doppler_that_folds(mapping, radar::doppler_span(mapping, places),
                                   is_of_beam ? "what the beam sees at one range" : "what is mapped at one range");
}

/// Of targets whose echoes fall outside a range gate, however often they fold.
std::optional<std::string> targets_outside(const radar::Radar& radar, std::span<const radar::Target> targets,
                                           double opens_m, double closes_m) {
  const double unambiguous_m = radar::unambiguous_range_m(radar.waveform.pulse_repetition_hz);
  const double spare_m = 2.0 * radar.range_resolution_m;
  std::vector<const radar::Target*> outside;
  double first_m = 0.0;
  for (const radar::Target& target : targets) {
    const Vec3d place =
        radar::earth_of(radar).bent(target.track.position_at(0.0), {radar.position.x, radar.position.y});
    const double range_m = length(place - radar.position);
    const double beyond_m = std::remainder(range_m - 0.5 * (opens_m + closes_m), unambiguous_m);
    if (std::abs(beyond_m) <= 0.5 * (closes_m - opens_m) + spare_m) continue;
    if (outside.empty()) first_m = range_m;
    outside.push_back(&target);
  }
  if (outside.empty()) return std::nullopt;
  return fmt::format(
      "of {} targets {} ({}) answer{} from outside the range gate from {:.5g} to {:.5g} km, the first from {:.5g} km, "
      "and pulses hold nothing of them; receiver.first_range_km and last_range_km widen the gate",
      targets.size(), outside.size(), names_of(outside), outside.size() == 1 ? "s" : "", opens_m / 1e3, closes_m / 1e3,
      first_m / 1e3);
}

}  // namespace

std::optional<std::string> beam_above_or_below(const radar::Radar& radar, const radar::Rectangle& area,
                                               const terrain::HeightField& terrain) {
  const radar::AntennaPattern pattern = radar::antenna_pattern(radar);
  if (pattern.elevation().even()) return std::nullopt;
  const Vec2d foot{radar.position.x, radar.position.y};
  AngleSpan elevations;
  const auto take_in = [&](Vec2d place) {
    const Vec3d away = radar::earth_of(radar).bent({place.x, place.y, terrain.height_at(place)}, foot) - radar.position;
    elevations.take_in(std::atan2(away.z, std::hypot(away.x, away.y)));
  };
  std::ranges::for_each(radar::corners_of(area), take_in);
  take_in(area.centre());
  take_in(radar::nearest_point(area, foot));
  const double power = pattern.elevation().two_way_power(elevations.nearest(pattern.tilt_rad()) - pattern.tilt_rad());
  // A pattern with its peak left at the horizon is the usual reason.
  if (power >= least_two_way_power) return std::nullopt;
  return fmt::format(
      "the beam points to an elevation of {:.3g}° (antenna.tilt_deg), and what is mapped lies at {:.3g}° to {:.3g}°, "
      "where echoes are at least {:.0f} dB weaker than at its peak",
      deg_from_radians(pattern.tilt_rad()), deg_from_radians(elevations.least_rad),
      deg_from_radians(elevations.most_rad), -db_from_linear(std::max(power, 1e-30)));
}

radar::MappedGround mapped_ground(const radar::Radar& radar, const radar::Rectangle& area,
                                  const terrain::HeightField& terrain, const radar::CurvedEarth& earth) {
  const Vec2d foot{radar.position.x, radar.position.y}, centre = area.centre();
  const Vec3d middle = earth.bent({centre.x, centre.y, terrain.height_at(centre)}, foot);
  return {radar::nearest_m(area, foot), radar::farthest_m(area, foot), std::max(0.0, radar.position.z - middle.z)};
}

namespace {

/// Cells of nothing are narrower than everything.
std::vector<std::string> warnings_for_cells(const radar::Radar& radar, const radar::MapRequest& request,
                                            const terrain::HeightField& terrain, const radar::Rectangle& extent,
                                            double cell_m) {
  const radar::GroundGrid grid = map_grid(request, extent);
  const radar::Radar mapping = as_it_maps(radar, grid.extent(), terrain);
  const auto earth = radar.mode == radar::Mode::RealBeam ? radar::CurvedEarth::flat() : radar::earth_of(mapping);
  auto warnings = radar::radar_warnings(mapping, bins_for(mapping, grid.extent(), terrain, earth),
                                        mapped_ground(mapping, grid.extent(), terrain, earth), cell_m);
  const auto sides = cut_sides(request.area.value_or(extent), extent, request.cell_m);
  if (!sides.empty()) {
    warnings.push_back(
        fmt::format("the map's area reaches beyond the scene, {}, and is cut off there; {} x {} cells of it are left",
                    fmt::join(sides, " and "), grid.columns, grid.rows));
  }
  if (auto missed = beam_above_or_below(mapping, grid.extent(), terrain)) warnings.push_back(*std::move(missed));
  if (auto missed = beam_beside(radar, grid.extent())) warnings.push_back(*std::move(missed));
  return warnings;
}

}  // namespace

std::vector<std::string> map_warnings(const radar::Radar& radar, const radar::MapRequest& request,
                                      const terrain::HeightField& terrain, const radar::Rectangle& extent) {
  return warnings_for_cells(radar, request, terrain, extent, map_grid(request, extent).cell_m);
}

std::vector<std::string> area_warnings(const radar::Radar& radar, const radar::MapRequest& request,
                                       const terrain::HeightField& terrain, const radar::Rectangle& extent) {
  return warnings_for_cells(radar, request, terrain, extent, 0.0);
}

std::optional<std::string> scan_beside(const radar::Radar& radar, const radar::Rectangle& area, double interval_s,
                                       double moment_s) {
  const Vec2d foot{radar.position.x, radar.position.y};
  if (!scans_as_it_records(radar) || area.contains(foot)) return std::nullopt;
  const Vec2d middle = area.centre();
  const receiver::BeamAzimuth beam = recorded_beam(radar, {middle.x, middle.y, 0.0}, moment_s);
  const radar::AzimuthSpan span = radar::azimuths_of(area, foot);
  const radar::AntennaPattern pattern = radar::antenna_pattern(radar);
  // Steps of a quarter of the beam, or the pulses where those are fewer.
  const double steps = 1.0 + std::min(4.0 * radar.scan.rate_rad_per_s * interval_s / radar.beam_width_rad,
                                      radar.waveform.pulse_repetition_hz * interval_s);
  for (double step = 0.0; step <= steps; ++step) {
    const double time_s = interval_s * (step / steps - 0.5);
    const double middle_rad = turned_by_least(span.middle_rad - beam({.time_s = time_s, .platform = {}}));
    const AngleSpan offsets{middle_rad + span.left_rad, middle_rad + span.right_rad};
    if (pattern.azimuth().two_way_power(offsets.nearest(0.0)) >= least_two_way_power) return std::nullopt;
  }
  return fmt::format(
      "the beam scans elsewhere, {:.4g}° in the middle, while pulses are recorded for {:.3g} s, and what is mapped "
      "lies at {:.4g}°, where echoes are at least 20 dB weaker than at its peak; record at another moment or for "
      "longer, or leave out scan.azimuth_deg",
      deg_from_radians(wrapped_azimuth(beam({}) - radar.north_rad)), interval_s,
      deg_from_radians(wrapped_azimuth(span.middle_rad - radar.north_rad)));
}

std::vector<std::string> recording_warnings(const radar::Radar& radar, const radar::Rectangle& area,
                                            const terrain::HeightField& terrain, bool calibrated,
                                            std::span<const radar::Target> targets) {
  std::vector<std::string> warnings;
  const Vec2d foot{radar.position.x, radar.position.y}, away = area.centre() - foot;
  const double distance_m = length(away);
  const double beam_m = radar::antenna_pattern(radar).azimuth().two_way_width_rad() * distance_m;
  if (calibrated && distance_m > 0.0) {
    const double across_m = (std::abs(away.y) * area.width_m() + std::abs(away.x) * area.height_m()) / distance_m;
    if (across_m < beam_m) {
      warnings.push_back(fmt::format(
          "the beam is {:.4g} m wide where what is mapped is {:.4g} m across, and pulses hold the echoes of "
          "mapped ground alone; map all that the beam sees to record clutter of its full strength",
          beam_m, across_m));
    }
  }
  const radar::RangeAzimuthGrid bins = bins_for(radar, area, terrain, radar::earth_of(radar));
  const double near_m = bins.first_range_m,
               far_m = bins.first_range_m + static_cast<double>(bins.ranges) * bins.range_step_m;
  const double opens_m = radar.receiver.first_range_m.value_or(near_m),
               closes_m = radar.receiver.last_range_m.value_or(far_m);
  const double middle_m = 0.5 * (near_m + far_m), prf_hz = radar.waveform.pulse_repetition_hz;
  const double folds_by_m = radar::folded_near_m(middle_m, 0.5 * (opens_m + closes_m), prf_hz) - middle_m;
  const double spare_m = 0.1 * (far_m - near_m);
  if (opens_m < near_m + folds_by_m - spare_m || closes_m > far_m + folds_by_m + spare_m) {
    const std::string folded =
        std::abs(folds_by_m) > 0.5 * radar::unambiguous_range_m(prf_hz)
            ? fmt::format(" and folded to {:.5g} to {:.5g} km", (near_m + folds_by_m) / 1e3, (far_m + folds_by_m) / 1e3)
            : "";
    warnings.push_back(fmt::format(
        "the range gate from {:.5g} to {:.5g} km is wider than what is mapped, {:.5g} to {:.5g} km away{}, and "
        "pulses hold the echoes of mapped ground alone",
        opens_m / 1e3, closes_m / 1e3, near_m / 1e3, far_m / 1e3, folded));
  }
  if (auto missed = targets_outside(radar, targets, opens_m, closes_m)) warnings.push_back(*std::move(missed));
  if (auto folds = doppler_that_folds(radar, area, terrain, calibrated)) warnings.push_back(*std::move(folds));
  return warnings;
}

std::vector<std::string> pulse_warnings(const radar::Radar& radar, const radar::Rectangle& area,
                                        const terrain::HeightField& terrain, std::span<const radar::Target> targets,
                                        std::optional<double> asked_s, const CoherentSettings& settings) {
  std::vector<std::string> warnings = interval_warnings(asked_s, radar, area, terrain);
  std::ranges::move(recording_warnings(radar, area, terrain, settings.calibrated, targets),
                    std::back_inserter(warnings));
  if (!settings.calibrated) return warnings;
  if (auto missed = scan_beside(radar, area, settings.interval_s, settings.moment_s))
    warnings.push_back(*std::move(missed));
  return warnings;
}

}  // namespace sigmascape::simulate
