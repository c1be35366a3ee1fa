#include "sigmascape/radar/radar_warnings.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/range_ambiguity.h"

namespace sigmascape::radar {
namespace {

struct Swath {
  double near_m, far_m;
};

void check_unambiguous(const Radar& radar, Swath swath, std::vector<std::string>& warnings) {
  const double prf_hz = radar.waveform.pulse_repetition_hz;
  const double unambiguous_m = unambiguous_range_m(prf_hz), length_m = swath.far_m - swath.near_m;
  if (length_m > unambiguous_m) {
    warnings.push_back(
        fmt::format("the swath of {:.4g} km is longer than the unambiguous range of {:.4g} km at a pulse repetition "
                    "frequency of {:g} Hz, {}; use at most {:.4g} Hz",
                    length_m / 1e3, unambiguous_m / 1e3, prf_hz,
                    radar.mode == Mode::RealBeam               ? "and folds over"
                    : radar.receiver.first_range_m.has_value() ? "which pulses show and maps of this mode do not"
                                                               : "which maps of this mode do not show",
                    speed_of_light_mps / (2.0 * length_m)));
  }
}

void check_gate(const Radar& radar, Swath swath, std::vector<std::string>& warnings) {
  const double opens_m = radar.receiver.first_range_m.value_or(swath.near_m);
  const double until_next_pulse_m = opens_m + unambiguous_range_m(radar.waveform.pulse_repetition_hz);
  const double closes_m = std::min(radar.receiver.last_range_m.value_or(until_next_pulse_m), until_next_pulse_m);
  if (opens_m <= swath.far_m && closes_m >= swath.near_m) return;
  // Maps know echoes by where they come from, pulses by where they fold to.
  const double gate_m = 0.5 * (opens_m + closes_m), swath_m = 0.5 * (swath.near_m + swath.far_m);
  const double folds_by_m = folded_near_m(swath_m, gate_m, radar.waveform.pulse_repetition_hz) - swath_m;
  const bool folds_in = opens_m <= swath.far_m + folds_by_m && closes_m >= swath.near_m + folds_by_m;
  const std::string but_folded = folds_in
                                     ? fmt::format(", but in pulses, where it folds to {:.4g} to {:.4g} km",
                                                   (swath.near_m + folds_by_m) / 1e3, (swath.far_m + folds_by_m) / 1e3)
                                     : "";
  warnings.push_back(
      fmt::format("the range gate from {:.4g} to {:.4g} km holds nothing of what is mapped, {:.4g} to {:.4g} km away{}",
                  opens_m / 1e3, closes_m / 1e3, swath.near_m / 1e3, swath.far_m / 1e3, but_folded));
}

void check_eclipsing(const Radar& radar, Swath swath, std::vector<std::string>& warnings) {
  constexpr int places = 400;
  const double own_pulse_m = 0.5 * speed_of_light_mps * radar.waveform.pulse_length_s;
  int deaf = 0, deaf_by_own = 0;
  for (int k = 0; k < places; ++k) {
    const double range_m = swath.near_m + (swath.far_m - swath.near_m) * (k + 0.5) / places;
    if (uneclipsed_part(range_m, radar.waveform.pulse_length_s, radar.waveform.pulse_repetition_hz) >= 0.5) continue;
    ++(range_m < own_pulse_m ? deaf_by_own : deaf);
  }
  const auto warn = [&](int of_places, const char* cause) {
    if (of_places == 0) return;
    const double percent = 100.0 * of_places / places;
    warnings.push_back(fmt::format("over {} % of the swath the receiver is deaf for more than half of the echo {}",
                                   percent < 1.0 ? "less than 1" : fmt::format("{:.0f}", percent), cause));
  };
  warn(deaf_by_own, "while the pulse itself is sent; use a shorter pulse");
  warn(deaf, "while the next pulse is sent; use another pulse repetition frequency or a shorter pulse");
}

/// The narrowest response over the side of a map's cells of which no power is lost between them. Cells read the bins at
/// their centres. By Poisson's sum a lone point whose response has the half-power width ρ cells then gives the map its
/// power times 1 + 2 P(ρ) cos 2πx, x the place of the point within a cell, with
///
///     P(ρ) = exp(−π² ρ²/(4 ln 2)) · sinc⁴(ρ/2)
///
/// for a Gaussian beam (pulses have less beyond their band), sinc² for the sharing among bins of half the width and
/// sinc² for reading between them. Over all x that strays by √2 P: 1 % at 0.96 and 38 % at a half. That the bins sample
/// the response adds exp(−π² (2 − ρ)²/(4 ln 2)) to the first factor, which wider responses have as well: 1.6 % at 0.96,
/// 1.3 % at 1, 1 % at 1.2.
constexpr double least_cells = 0.96;

void check_cells(const Radar& radar, const MappedGround& ground, double cell_m, std::vector<std::string>& warnings) {
  // Right below the radar any beam is narrow, and the pulse is nowhere as narrow as at the far edge.
  const double nearest_m = std::max(ground.nearest_m, 0.5 * ground.farthest_m);
  const double beam_m = radar.mode == Mode::RealBeam ? antenna_pattern(radar).azimuth().two_way_width_rad() * nearest_m
                                                     : std::numeric_limits<double>::infinity();
  const double pulse_m = radar.range_resolution_m * std::hypot(ground.farthest_m, ground.below_m) /
                         std::max(ground.farthest_m, radar.range_resolution_m);
  const bool is_beam = beam_m < pulse_m;
  if (auto warning = narrower_than_cells(is_beam ? "the beam" : "the pulse", std::min(beam_m, pulse_m), cell_m))
    warnings.push_back(*std::move(warning));
}

}  // namespace

void check_earth(const Radar& radar, const std::string& file) {
  if (radar.mode != Mode::RealBeam || !radar.earth_refraction) return;
  throw Error(file + ": radar.earth_refraction", "is given, and real-beam maps are made over a flat Earth",
              "leave it out, or choose another [mode]");
}

std::vector<std::string> radar_warnings(const Radar& radar, const RangeAzimuthGrid& bins, const MappedGround& ground,
                                        double cell_m) {
  const Swath swath{std::max(0.0, bins.first_range_m),
                    bins.first_range_m + static_cast<double>(bins.ranges) * bins.range_step_m};
  std::vector<std::string> warnings;
  check_unambiguous(radar, swath, warnings);
  check_gate(radar, swath, warnings);
  check_eclipsing(radar, swath, warnings);
  check_cells(radar, ground, cell_m, warnings);
  return warnings;
}

std::optional<std::string> narrower_than_cells(std::string_view what, double width_m, double cell_m) {
  if (width_m >= least_cells * cell_m) return std::nullopt;
  return fmt::format(
      "{} of {:.3g} m is narrower than the map's cells of {:g} m, and part of what stands between their "
      "centres is lost or counted twice; use cells of at most {:.3g} m",
      what, width_m, cell_m, width_m);
}

}  // namespace sigmascape::radar
