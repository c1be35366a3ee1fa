#pragma once

#include <vector>

#include "sigmascape/scene/painted_ground.h"
#include "sigmascape/scene/paper_layout.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::scene {

/// The paper scene before anyone built a town there.
struct PaperLandscape {
  terrain::HeightField terrain;
  PaintedGround ground;
  std::vector<ConvexPolygon> fields;  ///< outlines of all parcels, some of which are forest
};

/// Hills that fall to a flat river and lakes, parcels of meadow and ploughed earth, forests with ragged borders,
/// highway and main roads.
[[nodiscard]] PaperLandscape paper_landscape(const PaperLayout& layout);

}  // namespace sigmascape::scene
