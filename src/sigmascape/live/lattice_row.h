#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sigmascape/atlas/patch_grid.h"
#include "sigmascape/live/ground_page.h"

namespace sigmascape::live {

/// Between which bins texels are shared, and in what parts.
struct BinShares {
  template <typename T>
  using Of = std::array<T, atlas::tile_side + GroundPage::vector>;
  alignas(64) Of<std::int32_t> beam, range;  ///< the first of the two
  alignas(64) Of<std::int32_t> first;        ///< bin of both, where all four lie in the sector and the texel is lit
  alignas(64) Of<float> here_here, here_next, next_here, next_next;  ///< parts by beam and by range
  // Of a texel that is wider than a beam, whose parts by range are the first two of the above.
  alignas(64) Of<std::int32_t> last_beam;
  alignas(64) Of<float> first_part, whole_part, last_part;  ///< of the first beam, each between, and the last
};

/// Up to a tile's row of neighbouring texels on their way through a frame: what is known of each, a plain array a
/// quantity, so that every step is a loop over numbers that stand side by side.
///
/// Steps may go on to the end of a vector: what they leave beyond the last texel means nothing.
struct LatticeRow {
  static constexpr std::size_t most = atlas::tile_side;
  template <typename T>
  using Of = std::array<T, most + GroundPage::vector>;

  std::size_t count = 0;
  [[nodiscard]] std::size_t whole_vectors() const { return whole_vectors(count); }
  /// A number of texels rounded up.
  [[nodiscard]] static constexpr std::size_t whole_vectors(std::size_t texels) {
    return (texels + GroundPage::vector - 1) / GroundPage::vector * GroundPage::vector;
  }

  // Where: from the radar, each texel's scatterer at its own place within it.
  alignas(64) Of<double> east_m, north_m;
  alignas(64) Of<float> height_m;
  alignas(64) Of<float> ground_m;         ///< distance over the ground
  alignas(64) Of<double> range_m;         ///< slant range
  alignas(64) Of<float> below_m;          ///< how far below the radar, the Earth's curvature included
  alignas(64) Of<float> slope;            ///< of the line of sight: rise over ground distance, negative downwards
  alignas(64) Of<float> cotangent, sine;  ///< of the grazing angle above the curved horizontal
  alignas(64) Of<float> beam;             ///< azimuth in units of bins, 0.5 in the middle of the first of the sector
  alignas(64) Of<float> range_bin;        ///< slant range in units of bins
  alignas(64) Of<float> lit;      ///< 1 where the radar sees the texel, else 0; of objects and across the border of the
                                  ///< extent a part
  alignas(64) Of<float> horizon;  ///< slope of the steepest line of sight to nearer ground

  // Where texels are wider than beams.
  double first_middle_east_m = 0.0, middle_north_m = 0.0;  ///< of the first texel, from the radar
  bool may_span_beams = false;                             ///< whether some may be: only then is the rest filled
  alignas(64) Of<float> beams_wide;                        ///< over how many beams a texel is spread, one at least
  alignas(64) Of<float> middle_beam;                       ///< of those

  // Where the ground is kept apart from what stands on it.
  alignas(64) Of<float> slope_east, slope_north;      ///< of the ground: rise over distance
  alignas(64) Of<float> top_m;                        ///< up to which something answers from there, above the ground
  alignas(64) Of<float> ground_lit;                   ///< how much of the ground is seen, 0 to 1
  alignas(64) Of<float> local_cotangent, local_sine;  ///< of the grazing angle above the slope
  alignas(64) Of<float> ground_area_m2;               ///< true area of the slope that is seen

  // What comes back: σ0, later cross-section, in the order of radar::Channels.
  alignas(64) std::array<Of<float>, GroundPage::channels> returned;
  /// And as amplitudes, [texel][VV, HH, HV, VH] by real and imaginary parts: as bins hold them.
  alignas(64) std::array<float, 8 * (most + GroundPage::vector)> amplitudes;
  alignas(64) std::array<Of<float>, 2> phasor;  ///< of the way out and back
  BinShares shares;
};

/// Where a frame's radar is and how its bins lie, in the terms of a row.
struct RowGeometry {
  double radar_height_m = 0.0;
  double drop_per_square_m = 0.0;  ///< 1/(2 k R): how the ground falls away with the square of distance
  // The sector's middle direction, its azimuth, and the bins.
  double sin_middle = 0.0, cos_middle = 1.0;
  double middle_beam = 0.0;  ///< of the middle direction, in units of bins
  double beams_per_rad = 1.0;
  double first_range_m = 0.0, ranges_per_m = 1.0;
  double cell_m = 0.0;  ///< texels stand so far apart, and each scatterer up to half a diagonal from its texel's middle
};

}  // namespace sigmascape::live
