#pragma once

#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/radar.h"

namespace sigmascape::radar {

/// How a coherent mode maps an area: what the radar file leaves open is filled in.
struct CoherentPlan {
  int looks = 1;
  /// Of all looks together, as many whole pulses in each; with stripmap that for which a point is processed.
  double interval_s = 0.0;
  double along_resolution_m = 0.0;  ///< half-power width across range in the middle of the area, on the finished map
  /// Of the middle of the area, off the direction of flight, in space: at time zero or, of a strip, as its beam passes.
  double squint_rad = 0.0;
  double blind_wedge_rad = 0.0;  ///< on the map, about the course: within it is no sharper than the real beam
};

/// By how much Doppler beam sharpening narrows the beam when the radar file does not say.
inline constexpr double usual_sharpening = 16.0;

/// The plan for an area whose middle lies at `aim`, on level ground at slant range r and ground range g. With w the
/// half-power width of the window over the pulses in cells, n looks, θ_b the beam, v the horizontal speed and φ the
/// horizontal angle off the course:
///
///   - Doppler beam sharpening by N: g θ_b/N = w n λ r/(2 v T sin φ);
///   - spotlight to δ: δ = w n λ r/(2 v T sin φ), δ the range resolution when left open;
///   - stripmap to δ ≥ w n λ/(2 |sin φ₁ − sin φ₂|), what the Doppler band between the edges of the beam gives; the
///     coarser of that and the range resolution when left open.       docs/physics/doppler.md, Eqs. (3), (4), (5a)
///
/// T is taken to the nearest that gives every look the same number of pulses, and δ is what that T resolves.
///
/// Throws Error when the radar stands still, when the middle lies so near the course, ahead or behind, that the beam
/// straddles it and no interval is stated, when it lies straight below, when a strip's fixed beam never passes over it
/// (radar/strip_beam.h), when stripmap is asked for more than the beam gives or for a Doppler band wider than the pulse
/// repetition frequency, and when the others are for w n λ/4 or less, which no flight resolves (Eq. 3b), take more than
/// 10000 s, or have less than two pulses or one a look.
[[nodiscard]] CoherentPlan coherent_plan(const Radar& radar, Vec3d aim);

/// The least rectangle that holds an area at this height and the ground across range from its corners that answers in
/// its outermost cells of range and Doppler: what is within two half-power widths of them. Towards the course, where
/// cells widen, that is farther than in the middle, and it ends on the course.
[[nodiscard]] Rectangle answering_ground(const Radar& radar, const CoherentPlan& plan, const Rectangle& area,
                                         double height_m);

}  // namespace sigmascape::radar
