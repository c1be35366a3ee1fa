#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

#include "sigmascape/atlas/pyramid_tiles.h"
#include "sigmascape/atlas/store.h"

namespace sigmascape::atlas {

/// The catalogs of a store at rest (atlas/stac_catalog.h). Those of a place and of all above it are there before its
/// first file is, so that whatever is baked is reached from the collection, at any moment of a bake.

/// Writes those of a place and of all above it that are absent. Any number of processes may do so at once, and come to
/// the same bytes.
void make_catalogs_over(const std::filesystem::path& folder, const AtlasDescription& description,
                        const PyramidTile& tile);

/// What is wrong with the collection and with the catalogs over everything that was begun to be baked.
[[nodiscard]] std::vector<StoreFault> catalog_faults(const Store& store, Scrutiny scrutiny);

/// Writes anew those that catalog_faults names: the collection, which in atlases of a former kind linked every item,
/// and of the catalogs, numbered in an order that any process comes to, the share for which `has` is true. Returns what
/// was wrong with those that were written. Throws Error when the collection has become that of another atlas.
std::vector<StoreFault> mend_catalogs(
    const Store& store, Scrutiny scrutiny,
    const std::function<bool(std::size_t number)>& has = [](std::size_t) { return true; });

}  // namespace sigmascape::atlas
