#pragma once

#include <cstddef>

#include "sigmascape/base/vec.h"
#include "sigmascape/live/lattice_row.h"
#include "sigmascape/terrain/terrain_view.h"

namespace sigmascape::live {

/// Heights of a page's texels about a row, and how its texels lie.
struct PageHeights {
  const float* row = nullptr;        ///< from column 0 of the page
  const float* north_row = nullptr;  ///< the neighbouring ones; at an edge of the page the row itself
  const float* south_row = nullptr;
  double texel_m = 1.0;
  double west_m = 0.0, north_m = 0.0;  ///< from the radar: west edge of column 0, middle of the row
  std::size_t first_column = 0;        ///< of the row's first texel, in the finer columns of `levels_up`
  std::size_t last_column = 0;         ///< of the page
  std::size_t levels_up = 0;
};

/// Fills height_m at the scatterers' own places: that of the texel's centre and the slope between its neighbours.
/// Without the slope, scatterers on a hillside would stand below or above ground, and ground hide itself.
void stand_on(LatticeRow& row, const PageHeights& heights);
/// The same on terrain: ground as coarse as a page that stands in would vanish behind finer ridges.
void stand_on(LatticeRow& row, const terrain::TerrainView& terrain, Vec2d radar);

/// Fills everything from ground_m to range_bin out of east_m, north_m and height_m. Beams are counted up to half a turn
/// from the middle direction.
void locate(LatticeRow& row, const RowGeometry& geometry);

}  // namespace sigmascape::live
