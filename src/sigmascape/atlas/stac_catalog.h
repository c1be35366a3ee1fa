#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sigmascape/atlas/pyramid_tiles.h"
#include "sigmascape/atlas/store.h"

namespace sigmascape::atlas {

/// The documents through which browsers of STAC find the items of a store: its collection links the catalogs of the
/// coarsest level of the pyramid, each catalog those one level below and the items in its own folder. The collection of
/// an atlas links the terrain's item as well, and where the ground is kept apart the collection of that, which with all
/// under it has the atlas' for a root. All link what is planned, baked or not, so that they follow from the description
/// alone, and each is small whatever the area.

inline constexpr const char* collection_name = "collection.json";
inline constexpr const char* catalog_name = "catalog.json";

/// Of a patch (level 0) or a place above; relative to the store.
[[nodiscard]] std::filesystem::path catalog_path(const PyramidTile& tile);

/// Under this name a collection records the SHA-256 of its own text, without these digits.
inline constexpr const char* collection_hash = "sigmascape:collection_sha256";

/// The collection at the root of all, relative to a store: its own, or of the ground of an atlas that of this.
[[nodiscard]] std::filesystem::path root_of(const AtlasDescription& description);

/// The collection.json of a store.
[[nodiscard]] std::string collection_text(const AtlasDescription& description);
/// As former versions wrote it: without links to terrain and ground, before that without its own hash too.
[[nodiscard]] std::vector<std::string> former_collection_texts(const AtlasDescription& description);

/// The catalog of a patch or a place above.
[[nodiscard]] std::string catalog_text(const AtlasDescription& description, const PyramidTile& tile);
/// As former versions wrote it: in the ground of an atlas with the ground's collection for a root.
[[nodiscard]] std::string former_catalog_text(const AtlasDescription& description, const PyramidTile& tile);

}  // namespace sigmascape::atlas
