#pragma once

#include <optional>

#include "sigmascape/terrain/height_field.h"
#include "sigmascape/terrain/terrain_pyramid.h"

namespace sigmascape::terrain {

/// How far one terrain lies above or below another, whichever it is.
struct HeightDifference {
  double median_m = 0.0;
  double nearly_all_m = 0.0;  ///< no more than that at 99 of 100 places
  double greatest_m = 0.0;
};

/// Of the finest level of a pyramid from a field, at nodes of the field within an area: all of them up to a million,
/// of more evenly some. Reads tiles; nothing where no node lies over one that can be had.
[[nodiscard]] std::optional<HeightDifference> height_difference(TerrainPyramid& pyramid, const HeightField& field,
                                                                const radar::Rectangle& area);

}  // namespace sigmascape::terrain
