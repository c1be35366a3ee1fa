#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sigmascape/base/toml_reader.h"
#include "sigmascape/geo/vector_source.h"
#include "sigmascape/scene/flaw_tally.h"
#include "sigmascape/scene/land_cover_reader.h"
#include "sigmascape/scene/material_reader.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/scene/tree_mesh.h"

namespace sigmascape::scene {

/// What the crowns of trees are made of.
enum class CrownKind {
  Leaves,  ///< triangles
  Medium,  ///< an ellipsoid that weakens and scatters, about the same branches
};

/// Tree positions in a file and what grows there.
struct TreeSource {
  geo::VectorSource vector;
  std::string where;  ///< the section, as errors name it
  std::optional<std::string> height_attribute, crown_radius_attribute;
  double metres_per_plain_number = 1.0;           ///< of heights and crown radii without a unit of their own
  std::optional<double> default_height_m;         ///< of those without; when absent they are left out
  std::optional<double> crown_radius_per_height;  ///< of those without a crown radius; when absent, the usual
  CrownKind kind = CrownKind::Leaves;
  std::vector<TreeForm> forms;
  std::size_t variants = 4;  ///< different trees of each form
  std::uint64_t seed = 1;
  scatter::Material leaf, bark;
  std::optional<scatter::Material> crown;  ///< of crowns that are media; when absent, what follows from the leaves
  FlawLimit limit;
};

/// Reads one [[trees]].
[[nodiscard]] TreeSource read_tree_source(const TomlSection& section, const MaterialTable& materials,
                                          const FlawLimit& limit);

/// Plants the trees of a file as instances that stand on the terrain, whatever ground height the file may state. Trees
/// in water are left out. Which variant grows where and how it is turned follows from the seed and the tree's number in
/// the file. Throws Error for a negative height, an attribute that no feature has, or too many flaws.
void add_trees(Scene& scene, const TreeSource& source, const WaterMask& water);

}  // namespace sigmascape::scene
