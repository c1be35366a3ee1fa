#pragma once

#include <vector>

#include "sigmascape/scene/paper_landscape.h"
#include "sigmascape/scene/roofed_building.h"

namespace sigmascape::scene {

enum class BlockUse { Centre, Houses, Apartments, Halls, Park };

/// A piece of town between streets.
struct TownBlock {
  ConvexPolygon outline;   ///< along the middle of the streets
  ConvexPolygon interior;  ///< what the streets leave
  BlockUse use = BlockUse::Houses;
};

struct WallAndRoof {
  MaterialIndex walls = 0, roof = 0;
};

struct TownMaterials {
  WallAndRoof house, block, hall;
};

struct PaperTown {
  std::vector<TownBlock> blocks;
  std::vector<RoofedBuilding> buildings;
};

inline constexpr double street_half_width_m = 5.0;   ///< with pavements
inline constexpr double roadway_half_width_m = 3.5;  ///< without

/// Builds farms and a town of exactly as many buildings as the layout asks for, and paints their streets and yards. The
/// town grows block by block from its centre, over neither water nor highway.
[[nodiscard]] PaperTown paper_town(const PaperLayout& layout, PaperLandscape& landscape,
                                   const TownMaterials& materials);

}  // namespace sigmascape::scene
