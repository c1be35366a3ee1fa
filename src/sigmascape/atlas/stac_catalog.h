#pragma once

#include <filesystem>
#include <string>

#include "sigmascape/atlas/pyramid_tiles.h"
#include "sigmascape/atlas/store.h"

namespace sigmascape::atlas {

/// The documents through which browsers of STAC find the items of a store: its collection links the catalogs of the
/// coarsest level of the pyramid, each catalog those one level below and the items in its own folder. All link what is
/// planned, baked or not, so that they follow from the description alone, and each is small whatever the area.

inline constexpr const char* collection_name = "collection.json";
inline constexpr const char* catalog_name = "catalog.json";

/// Of a patch (level 0) or a place above; relative to the store.
[[nodiscard]] std::filesystem::path catalog_path(const PyramidTile& tile);

/// Under this name a collection records the SHA-256 of its own text, without these digits.
inline constexpr const char* collection_hash = "sigmascape:collection_sha256";

/// The collection.json of an atlas.
[[nodiscard]] std::string collection_text(const AtlasDescription& description);
/// As it was before collections vouched for themselves.
[[nodiscard]] std::string unsealed_collection_text(const AtlasDescription& description);

/// The catalog of a patch or a place above.
[[nodiscard]] std::string catalog_text(const AtlasDescription& description, const PyramidTile& tile);

}  // namespace sigmascape::atlas
