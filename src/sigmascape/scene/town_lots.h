#pragma once

#include <cstdint>

#include "sigmascape/scene/building_site.h"
#include "sigmascape/scene/paper_town.h"

namespace sigmascape::scene {

/// Paints the yards of a block and lines its streets with the buildings of its use.
void build_block(BuildingSite& site, const TownBlock& block, const TownMaterials& materials, std::uint64_t key);

/// A farmhouse and barns around a yard; returns without building where there is no room.
void build_farm(BuildingSite& site, Vec2d place, const TownMaterials& materials, std::uint64_t key);

/// One small house at a place, if there is room.
void build_cottage(BuildingSite& site, Vec2d place, const TownMaterials& materials, std::uint64_t key);

}  // namespace sigmascape::scene
