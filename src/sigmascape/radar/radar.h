#pragma once

#include <optional>
#include <string>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/antenna_pattern.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/receiver.h"
#include "sigmascape/radar/scan.h"
#include "sigmascape/radar/waveform.h"

namespace sigmascape::radar {

/// What is made of the echoes. RealBeam: a map as sharp across as the beam. The others use the platform's motion.
enum class Mode { RealBeam, DopplerBeamSharpening, Stripmap, Spotlight };

/// What a coherent mode makes of its pulses. What is left open follows from the mode, the radar and the geometry:
/// `coherent_plan`.
struct Processing {
  std::optional<double> interval_s;          ///< time over which pulses are added up, all looks together
  std::optional<double> along_resolution_m;  ///< half-power width across range on the finished map
  std::optional<double> sharpening;          ///< by what factor that is narrower than the real beam
  int looks = 1;                             ///< images whose powers are averaged, each of a part of the pulses
  bool ambiguities = true;                   ///< stripmap: what folds over azimuth is shown, where it is within 60 dB
  bool antenna_pattern = false;              ///< images keep what the beam's pattern does to them, relative to its peak
  bool thermal_noise = false;  ///< images have the receiver's noise, as the cross-section that would return as much

  friend bool operator==(const Processing&, const Processing&) = default;
};

/// A mapping radar as one value: where it is and how it goes, and all that shapes what it receives.
///
/// Widths are half-power widths: `range_resolution_m` and the waveform's window give the bandwidth (`bandwidth_of`),
/// `beam_width_rad` and the antenna's shapes give the pattern (`antenna_pattern`). Neither changes the antenna's gain
/// nor the pulse's length: in a Radar that is filled in by hand these are constants until they are set, and powers go
/// by them. `read_radar_file` has them follow (radar_file.h).
struct Radar {
  std::string name = "radar";
  Vec3d position = {};  ///< local frame, height above mean sea level
  double frequency_hz = 10e9;
  Polarization polarization = Polarization::VV;  ///< what pictures and power products show; maps hold all
  double range_resolution_m = 2.0;               ///< half-power width of the pulse after compression
  double beam_width_rad = 0.01;                  ///< one-way half-power width of the real beam in azimuth
  Vec3d velocity_mps = {};                       ///< local frame
  double heading_rad = 0.0;  ///< where the platform's nose points, clockwise from north, as `scan` has it
  Antenna antenna = {};
  Scan scan = {};
  Waveform waveform = {};
  Receiver receiver = {};
  Mode mode = Mode::RealBeam;
  Processing processing = {};
  /// k of the k-Earth that falls away under pulses and coherent images; without it they are of a flat one.
  std::optional<double> earth_refraction = {};
  double wind_mps = 0.0;          ///< that moves leaves, as pulses and images with Doppler see; 0: none
  double atmosphere_per_m = 0.0;  ///< what air and rain take on the way, one way: power falls as exp(−α r)
  /// The azimuth in the frame of the north from which the radar's file states azimuths: of true north where it is, if
  /// it stands on the globe.
  double north_rad = 0.0;
};

[[nodiscard]] AntennaPattern antenna_pattern(const Radar& radar);

/// What `earth_refraction` says.
[[nodiscard]] CurvedEarth earth_of(const Radar& radar);

/// Where a radar stands that sees `target` from `azimuth_rad`, `elevation_rad` above the horizontal at the target, at
/// `slant_range_m`: over a round Earth so that slant range and grazing angle of that Earth are these
/// (docs/physics/curved_earth.md, Eq. (7)).
[[nodiscard]] Vec3d position_seeing(Vec3d target, double azimuth_rad, double elevation_rad, double slant_range_m,
                                    const CurvedEarth& earth = CurvedEarth::flat());

}  // namespace sigmascape::radar
