#pragma once

#include <string>
#include <vector>

#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/radar.h"

namespace sigmascape::radar {

/// How a coherent mode maps an area: what the radar file leaves open is filled in.
struct CoherentPlan {
  int looks = 1;
  double interval_s = 0.0;          ///< of all looks together; with stripmap that for which a point is processed
  double along_resolution_m = 0.0;  ///< half-power width across range in the middle of the area, on the finished map
  double squint_rad = 0.0;          ///< of the middle of the area, off the direction of flight
  double blind_wedge_rad = 0.0;     ///< half-angle about the nose within which it is no sharper than the real beam
};

/// By how much Doppler beam sharpening narrows the beam when the radar file does not say.
inline constexpr double usual_sharpening = 16.0;

/// The plan for an area whose middle lies at `aim`. With w the half-power width of the window over the pulses in cells,
/// n looks and θ_b the beam:
///
///   - Doppler beam sharpening by N: θ_b/N = w n λ/(2 v T sin θ);
///   - spotlight to δ: δ = w n λ r/(2 v T sin θ), δ the range resolution when left open;
///   - stripmap to δ ≥ n λ w/(4 sin(θ_b/2)), what the beam's Doppler band gives; the coarser of that and the range
///     resolution when left open.                                        docs/physics/doppler.md, Eqs. (3), (4)
///
/// Throws Error when the radar stands still, when the middle lies so near the nose or the tail that the beam straddles
/// it and no interval is stated, and when stripmap is asked for more than the beam gives.
[[nodiscard]] CoherentPlan coherent_plan(const Radar& radar, Vec3d aim);

/// What a radar engineer would object to before this plan maps an area at this height, one sentence each: ground in the
/// blind wedge, ground on both sides of the track, Doppler that folds.
[[nodiscard]] std::vector<std::string> plan_warnings(const Radar& radar, const CoherentPlan& plan,
                                                     const Rectangle& area, double height_m);

}  // namespace sigmascape::radar
