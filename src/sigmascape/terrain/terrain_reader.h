#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "sigmascape/geo/lattice.h"
#include "sigmascape/geo/local_frame.h"
#include "sigmascape/geo/raster.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::terrain {

/// Where heights come from and what is done with them on the way.
struct TerrainSource {
  geo::RasterBand raster;
  std::string where{};              ///< the section, as errors name it; empty: they name the raster
  std::optional<double> spacing_m;  ///< of the height field; by default the raster's own cell
  double smooth_within_m = 0.0;     ///< see smooth_within; 0 leaves heights alone
  geo::PlausibleHeights plausible;
  double largest_hole_share = 0.5;  ///< of nodes without data, beyond which the terrain is refused
};

/// Which nodes of a height field are of some kind, [column, row]; 0 of those that are not.
using NodeMask = Array2D<std::uint8_t>;

/// Why a node had no height: a hole of the raster, or that it lies outside, by no more than a cell or farther.
inline constexpr std::uint8_t in_a_hole = 1, at_the_edge = 2, beyond_the_raster = 3;

struct ReadTerrain {
  HeightField field;
  std::size_t filled_nodes = 0;  ///< had no data, or no plausible ones, and were interpolated
  NodeMask filled;               ///< which those are: in_a_hole, at_the_edge, beyond_the_raster
  bool unit_is_guess = false;    ///< as geo::HeightUnit has it
  /// Of the raster, what lies outside the rectangle that was chosen; 0 where one was asked for.
  double left_out_share = 0.0;
};

/// Reads heights over a rectangle of the frame, or, without one, over the largest that lies within the raster. Throws
/// Error when the rectangle and the raster do not overlap, more than the stated share of nodes has no data, or reading
/// so many heights takes more memory than this machine has; of those nothing is allocated.
[[nodiscard]] ReadTerrain read_terrain(const TerrainSource& source, const geo::LocalFrame& frame,
                                       std::optional<radar::Rectangle> wanted);

/// Gives nodes that are NaN the values of a smooth surface through the edge of their hole; returns how many there were.
std::size_t fill_holes(Array2D<float>& heights);

/// Removes the terraces of heights that were rounded: the smoothest surface (least squared slope) of which no node lies
/// further than `tolerance_m` from where it was.
void smooth_within(Array2D<float>& heights, double tolerance_m);

}  // namespace sigmascape::terrain
