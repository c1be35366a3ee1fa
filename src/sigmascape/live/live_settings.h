#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "sigmascape/live/visible_ground.h"

namespace sigmascape::live {

/// What a frame is made of.
enum class FrameContent {
  Amplitudes,  ///< I/Q: one hashed complex Gaussian scatterer a lattice cell, with its travel phase
  Powers,      ///< what that is on average, without speckle
};

/// Of a bin: VV, HH, HV, VH, real and imaginary parts, or VV, HH, HV, Re VV·HH*.
[[nodiscard]] constexpr std::size_t numbers_a_bin(FrameContent content) {
  return content == FrameContent::Amplitudes ? 8 : 4;
}

struct LiveSettings {
  FrameContent content = FrameContent::Amplitudes;
  /// The bins: as many beams and ranges as `bins` says. Where they begin is said by each pose.
  std::size_t beams = 512, ranges = 512;
  double beam_step_rad = 2e-3;  ///< an eighth of a turn at most, all beams together a turn
  double range_step_m = 15.0;   ///< all ranges together 10⁷ m at most
  double cells_per_bin = 2.0;   ///< lattice cells along the smaller side of a bin on the ground
  std::uint64_t seed = 1;       ///< names the scatterers
  unsigned threads = 0;         ///< 0: one a hardware thread; has no effect on the result
  /// k of the k-Earth, by which ground at distance d lies d²/(2 k R) lower: for horizons, ranges and grazing angles
  /// alike. A great number makes it flat.
  double refraction = 4.0 / 3.0;
  /// How visible ground is found. Rasterization is the paper's way: slower, only over atlases whose textures hold the
  /// shadows of what stands on the ground, and only from above all terrain up to the last bin: other poses are refused.
  VisibleGroundSettings visibility = {};
};

/// Throws Error, naming `where`, for settings from which no frame can come.
void check(const LiveSettings& settings, const std::string& where);

}  // namespace sigmascape::live
