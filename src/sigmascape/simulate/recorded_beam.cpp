#include "sigmascape/simulate/recorded_beam.h"

#include <optional>

namespace sigmascape::simulate {
namespace {

/// Where the antenna points that the radar file fixes, if it does. Spotlights are steered whatever the scan.
std::optional<double> fixed_azimuth_rad(const radar::Radar& radar) {
  const bool fixed = radar.scan.kind == radar::ScanKind::Fixed && radar.mode != radar::Mode::Spotlight;
  return fixed ? radar.scan.azimuth_rad : std::nullopt;
}

}  // namespace

receiver::BeamAzimuth steered_beam(const radar::Radar& radar, Vec3d aim) {
  if (const auto azimuth_rad = fixed_azimuth_rad(radar)) return receiver::fixed_at(*azimuth_rad);
  if (radar.mode != radar::Mode::Stripmap) return receiver::towards(aim);
  const Vec3d away = aim - radar.position;
  return receiver::abeam(azimuth_of(away) - azimuth_of(radar.velocity_mps));
}

bool scans_as_it_records(const radar::Radar& radar) {
  return radar.mode == radar::Mode::RealBeam && radar.scan.kind != radar::ScanKind::Fixed &&
         radar.scan.rate_rad_per_s > 0.0;
}

receiver::BeamAzimuth recorded_beam(const radar::Radar& radar, Vec3d aim, double moment_s) {
  if (!scans_as_it_records(radar)) return steered_beam(radar, aim);
  const Vec3d away = aim - radar.position;
  radar::Scan scan = radar.scan;
  if (!scan.azimuth_rad) {
    scan.azimuth_rad = azimuth_of(away);
    moment_s = 0.0;
  }
  return [scan, moment_s](const radar::Pulse& pulse) { return radar::beam_azimuth_rad(scan, moment_s + pulse.time_s); };
}

}  // namespace sigmascape::simulate
