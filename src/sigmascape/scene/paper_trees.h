#pragma once

#include <vector>

#include "sigmascape/scene/paper_town.h"

namespace sigmascape::scene {

/// Which tree prototypes there are, by index into Scene::prototypes.
struct TreePrototypes {
  std::uint32_t first_broadleaf = 0, broadleaf_count = 1;
  std::uint32_t first_conifer = 0, conifer_count = 1;
};

/// Plants exactly as many trees as the layout asks for: in gardens and parks, along roads, hedges and the river, and,
/// by far the most, in the forests. None stands in water, on pavement or within two metres of a building.
[[nodiscard]] std::vector<Instance> paper_trees(const PaperLayout& layout, const PaperLandscape& landscape,
                                                const PaperTown& town, const TreePrototypes& prototypes);

}  // namespace sigmascape::scene
