#pragma once

#include <optional>

namespace sigmascape::radar {

enum class ScanKind { Fixed, Sector, Rotating };

/// How the antenna turns in azimuth. Azimuths are those of the beam's axis, clockwise from north: as read from a file
/// the north that Radar::north_rad tells of, and that of the frame once the radar is placed.
struct Scan {
  ScanKind kind = ScanKind::Rotating;
  /// Fixed: where it points. Sector: its middle. Rotating: where it points at time zero. Absent: at the middle of what
  /// is mapped.
  std::optional<double> azimuth_rad = {};
  double sector_width_rad = 0.0;  ///< Sector: from one end to the other
  double rate_rad_per_s = 0.0;    ///< Sector and Rotating; clockwise; 0 where it is not known
};

/// Where the beam points. A sector is swept to and fro, beginning in its middle towards its right.
[[nodiscard]] double beam_azimuth_rad(const Scan& scan, double time_s);
/// The time from one look at a direction to the next: a turn, or a sweep to and fro (twice within it, at its middle).
/// Infinite when fixed, as the next, and where the rate is not known.
[[nodiscard]] double revisit_s(const Scan& scan);
/// How long a point stays within the beam; infinite when fixed.
[[nodiscard]] double dwell_s(const Scan& scan, double beam_width_rad);
/// Whole pulses that meet a point while the beam goes over it: n = θ f_p / ω.
[[nodiscard]] int hits_per_dwell(const Scan& scan, double beam_width_rad, double pulse_repetition_hz);
/// Whether the beam's axis ever comes within `tolerance_rad` of this azimuth.
[[nodiscard]] bool reaches(const Scan& scan, double azimuth_rad, double tolerance_rad = 0.0);

}  // namespace sigmascape::radar
