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
  alignas(64) Of<float> lit;              ///< 1 where the radar sees the texel, else 0; of objects a part
  alignas(64) Of<float> horizon;          ///< slope of the steepest line of sight to nearer ground

  // Where the ground is kept apart from what stands on it.
  alignas(64) Of<float> slope_east, slope_north;      ///< of the ground: rise over distance
  alignas(64) Of<float> top_m;                        ///< of what stands there, above the ground
  alignas(64) Of<float> ground_lit;                   ///< how much of the ground is seen, 0 to 1
  alignas(64) Of<float> local_cotangent, local_sine;  ///< of the grazing angle above the slope
  alignas(64) Of<float> ground_area_m2;               ///< true area of the slope that is seen

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

/// Heights of a page's texels about a row, and how its texels lie.
struct PageHeights {
  const float* row = nullptr;        ///< from column 0 of the page
  const float* north_row = nullptr;  ///< the neighbouring ones; at an edge of the page the row itself
  const float* south_row = nullptr;
  double texel_m = 1.0;
  double west_m = 0.0, north_m = 0.0;  ///< from the radar: west edge of column 0, middle of the row
  std::size_t first_column = 0;        ///< of the row's first texel, in the finer columns of `levels_up`
  std::size_t levels_up = 0;
};

/// Fills height_m at the scatterers' own places: that of the texel's centre and the slope between its neighbours.
/// Without the slope, scatterers on a hillside would stand below or above ground, and ground hide itself.
void stand_on(LatticeRow& row, const PageHeights& heights);

/// Fills everything from ground_m to range_bin out of east_m, north_m and height_m.
void locate(LatticeRow& row, const RowGeometry& geometry);

/// A horizon map as a row reads it: slopes [azimuth][distance], azimuth 0 at the left edge of beam 0 and one a beam.
struct Horizon {
  const float* slopes = nullptr;
  const float* solid_slopes = nullptr;  ///< of the tops of solid obstacles; null where none stand apart
  const float* through = nullptr;       ///< what comes through crowns
  std::size_t azimuths = 0, distances = 0;
  float first_beam = 0.0F;  ///< of the row's sector
  float near_m = 0.0F, per_step = 1.0F;
};

/// Fills `lit`: texels that do not lie below the steepest line of sight to nearer ground, which is interpolated between
/// azimuths. Returns how many there are.
std::size_t light(LatticeRow& row, const Horizon& horizon);

/// After `light`: fills `ground_lit` with what is seen of the ground behind obstacles, and sets `lit` to the part of
/// what stands on it (by height, `top_m`) that rises above the terrain's horizon.
void light_apart(LatticeRow& row, const Horizon& horizon);

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

/// Fills local_cotangent, local_sine and ground_area_m2: what bare ground is looked up and weighted with. Ground that
/// faces away has no area. Returns the extremes of local_cotangent where there is any.
[[nodiscard]] Extremes face(LatticeRow& row, const RowGeometry& geometry, float area_m2);

/// One elevation of bare ground among others: `cotangent` of the one below it, its own and the one above; where it has
/// no neighbour its own again.
struct GroundLook {
  const atlas::Half* planes = nullptr;  ///< [channel][column]
  float factor = 0.0F;                  ///< σ0 of a stored 1 times the part of its frequency
  float below = 0.0F, own = 0.0F, above = 0.0F;
  float sine = 1.0F;          ///< of its elevation
  float highest_sine = 1.0F;  ///< of the highest
};
/// Adds what the ground of all texels returns as seen by this elevation's part: γ is linear in the cotangent between
/// elevations and held below the lowest; above the highest σ0 is held.
void add_ground(LatticeRow& row, const GroundLook& look);
/// Last of all: a texel is lit when its ground or what stands on it is.
void join_lights(LatticeRow& row);

/// Cross-sections to amplitudes of scatterers with the travel phase: √P ξ exp(−j 4π r/λ), VV and HH drawn with their
/// stored correlation. `gaussians` are three complex numbers a texel, real and imaginary parts in arrays of their own.
void scatter(LatticeRow& row, const std::array<LatticeRow::Of<float>, 6>& gaussians, double turns_per_m);

/// Bins of a sector: [beam][range][number], numbers of a bin side by side. Only beams from the first up to the end are
/// added to.
struct SectorBins {
  float* bins = nullptr;
  std::size_t first_beam = 0, end_beam = 0, ranges = 0;
};

/// Adds the amplitudes, eight numbers a bin (VV, HH, HV, VH, real and imaginary), shared between the four nearest bins
/// by weights whose squares sum to one.
void deposit_amplitudes(LatticeRow& row, const SectorBins& sector);
/// Adds the powers, four numbers a bin, shared by weights that sum to one.
void deposit_powers(LatticeRow& row, const SectorBins& sector);

}  // namespace sigmascape::render
