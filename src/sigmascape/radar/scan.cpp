#include "sigmascape/radar/scan.h"

#include <cmath>
#include <limits>

#include "sigmascape/base/units.h"

namespace sigmascape::radar {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// Where in its sweep to and fro a sector scan is: −1 at the left end, 1 at the right, 0 at time zero.
double triangle(double sweeps) {
  const double phase = sweeps + 0.5 - 2.0 * std::floor(0.5 * (sweeps + 0.5));
  return phase < 1.0 ? 2.0 * phase - 1.0 : 3.0 - 2.0 * phase;
}

}  // namespace

double beam_azimuth_rad(const Scan& scan, double time_s) {
  const double start = scan.azimuth_rad.value_or(0.0);
  switch (scan.kind) {
    case ScanKind::Fixed:
      return start;
    case ScanKind::Sector:
      return start + 0.5 * scan.sector_width_rad * triangle(scan.rate_rad_per_s * time_s / scan.sector_width_rad);
    case ScanKind::Rotating:
      return wrapped_azimuth(start + scan.rate_rad_per_s * time_s);
  }
  return start;
}

double revisit_s(const Scan& scan) {
  switch (scan.kind) {
    case ScanKind::Fixed:
      return never;
    case ScanKind::Sector:
      return 2.0 * scan.sector_width_rad / scan.rate_rad_per_s;
    case ScanKind::Rotating:
      return 2.0 * pi / scan.rate_rad_per_s;
  }
  return never;
}

double dwell_s(const Scan& scan, double beam_width_rad) {
  return scan.kind == ScanKind::Fixed ? never : beam_width_rad / scan.rate_rad_per_s;
}

int hits_per_dwell(const Scan& scan, double beam_width_rad, double pulse_repetition_hz) {
  const double hits = dwell_s(scan, beam_width_rad) * pulse_repetition_hz;
  constexpr double most = 1e9;
  // A hair's breadth, so that a ratio that is whole in decimals is not rounded down.
  return static_cast<int>(std::min(hits * (1.0 + 1e-12), most));
}

bool reaches(const Scan& scan, double azimuth_rad) {
  if (scan.kind == ScanKind::Rotating) return true;
  const double half_width = scan.kind == ScanKind::Sector ? 0.5 * scan.sector_width_rad : 0.0;
  return !scan.azimuth_rad || std::abs(std::remainder(azimuth_rad - *scan.azimuth_rad, 2.0 * pi)) <= half_width + 1e-12;
}

}  // namespace sigmascape::radar
