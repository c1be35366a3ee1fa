#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sigmascape/atlas/aspect_cell.h"
#include "sigmascape/atlas/patch_grid.h"
#include "sigmascape/render/ground_page.h"

namespace sigmascape::render {

/// Between which bins texels are shared, and in what parts.
struct BinShares {
  template <typename T>
  using Of = std::array<T, atlas::tile_side>;
  alignas(64) Of<std::int32_t> beam, range;  ///< the first of the two
  alignas(64) Of<float> beam_here, beam_next, range_here, range_next;
};

/// Up to a tile's row of neighbouring texels on their way through a frame: what is known of each, a plain array a
/// quantity, so that every step is a loop over numbers that stand side by side.
struct LatticeRow {
  static constexpr std::size_t most = atlas::tile_side;
  template <typename T>
  using Of = std::array<T, most>;

  std::size_t count = 0;

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
  alignas(64) Of<float> lit;              ///< 1 where the radar sees the texel, else 0

  // What comes back: σ0, later cross-section, in the order of radar::Channels.
  alignas(64) std::array<Of<float>, GroundPage::channels> returned;
  // And as amplitudes: VV, HH, HV, real and imaginary parts in turn.
  alignas(64) std::array<Of<float>, 6> amplitude;
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
};

/// Fills everything from ground_m to range_bin out of east_m, north_m and height_m.
void locate(LatticeRow& row, const RowGeometry& geometry);

/// A horizon map as a row reads it: slopes [azimuth][distance], azimuth 0 at the left edge of beam 0 and one a beam.
struct Horizon {
  const float* slopes = nullptr;
  std::size_t azimuths = 0, distances = 0;
  float first_beam = 0.0F;  ///< of the row's sector
  float near_m = 0.0F, per_step = 1.0F;
};

/// Fills `lit`: texels that do not lie below the steepest line of sight to nearer ground, which is interpolated between
/// azimuths. Returns how many there are.
std::size_t light(LatticeRow& row, const Horizon& horizon);

struct Extremes {
  float least, greatest;
};
[[nodiscard]] Extremes cotangent_extremes(const LatticeRow& row);

/// Adds σ0 to the texels from `first` on, `count` of them, which lie in one aspect cell: the looks of `planes`
/// ([look][channel][column], the first texel's column first), blended as atlas::weights_for says.
struct BlendOf {
  const atlas::Half* planes = nullptr;
  const float* scale = nullptr;
  std::size_t looks = 4;
  float azimuth_offset = 0.0F;     ///< part of the cell of azimuth at beam 0
  float azimuth_per_beam = 0.0F;   ///< and its growth with beams
  std::array<float, 2> cotangent;  ///< of the two elevations
  std::array<float, 2> sine;
  std::array<float, 2> frequency_part;
};
void blend(LatticeRow& row, std::size_t first, std::size_t count, const BlendOf& looks);

/// σ0 to mean cross-section: times the area of a texel and whether it is seen.
void weigh(LatticeRow& row, float area_m2);

/// Cross-sections to amplitudes of scatterers with the travel phase: √P ξ exp(−j 4π r/λ), VV and HH drawn with their
/// stored correlation. `gaussians` are three complex numbers a texel, real and imaginary parts in arrays of their own.
void scatter(LatticeRow& row, const std::array<LatticeRow::Of<float>, 6>& gaussians, double turns_per_m);

/// Bins of a sector: [beam][range][number], numbers of a bin side by side.
struct SectorBins {
  float* bins = nullptr;
  std::size_t beams = 0, ranges = 0;
};

/// Adds the amplitudes, eight numbers a bin (VV, HH, HV, VH, real and imaginary), shared between the four nearest bins
/// by weights whose squares sum to one.
void deposit_amplitudes(LatticeRow& row, const SectorBins& sector);
/// Adds the powers, four numbers a bin, shared by weights that sum to one.
void deposit_powers(LatticeRow& row, const SectorBins& sector);

}  // namespace sigmascape::render
