#pragma once

#include <cstddef>
#include <cstdint>

#include "sigmascape/scene/scene.h"

namespace sigmascape::scene {

/// Which constants the surfaces of the paper's scene get: those that the paper states, or those of real building
/// materials and plants.
enum class PaperMaterials { Paper, Itu };

struct PaperSceneOptions {
  double scale = 1.0;  ///< side over the paper's 2 km, 0.1 to 5
  std::uint64_t seed = 1;
  PaperMaterials materials = PaperMaterials::Paper;
};

/// What a paper scene of some scale consists of. Counts grow with the area; the two rasters keep the paper's spacing as
/// nearly as a power of two of cells allows.
struct PaperSceneSize {
  double side_m = 2000.0;
  std::size_t height_nodes = 513;  ///< along a side
  std::size_t material_cells = 4096;
  std::size_t trees = 70'928;
  std::size_t buildings = 2082;
};

[[nodiscard]] PaperSceneSize paper_scene_size(double scale);

/// The paper's example landscape, made up: a town by a winding river, a highway, fields, forests and hills, whose
/// south-western corner is the origin.
///
/// The layout follows the side, so that small scenes have some of everything; houses, streets, trees and vehicles keep
/// their real size. The same options give the same scene. Throws Error when the scale is out of range.
[[nodiscard]] Scene paper_scene(const PaperSceneOptions& options = {});

}  // namespace sigmascape::scene
