#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "sigmascape/atlas/pyramid_tiles.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::atlas {

/// The items of a store: STAC documents that stand beside its files and say of each where it lies, what went into it,
/// and what its content must be.

/// What an item records of the file of standard errors beside its texture.
struct ErrorsRecord {
  std::uint64_t size_bytes = 0;
  std::string sha256;
};

/// What an item records of its file.
struct TextureRecord {
  std::uint64_t size_bytes = 0;
  std::string sha256;
  double scale = 1.0;
  std::string made_from = {};               ///< of a file of the pyramid: names the content of those below; else empty
  std::optional<ErrorsRecord> errors = {};  ///< where there is such a file
  /// Of a patch, as in BakeFacts; read only. Items of a former kind do not tell it.
  std::optional<PowerError> error = {};
  /// Of obstacles: no texel of the file or of those that it was made from is higher. Files of a former kind, which hold
  /// no coarser levels, have an item without it.
  std::optional<float> tallest_m = {};
};

/// The item of one texture, to stand beside `texture_file`.
[[nodiscard]] std::string item_text(const AtlasDescription& description, const Unit& unit,
                                    const std::filesystem::path& texture_file, const TextureRecord& record,
                                    const BakeFacts& facts);

/// The item of one texture of the pyramid.
[[nodiscard]] std::string pyramid_item_text(const AtlasDescription& description, const PyramidTile& tile,
                                            LookIndex look, const std::filesystem::path& texture_file,
                                            const TextureRecord& record);

/// The item of the obstacles of a patch (level 0) or of a place above, to stand beside `file`.
[[nodiscard]] std::string obstacles_item_text(const AtlasDescription& description, const PyramidTile& tile,
                                              const std::filesystem::path& file, const TextureRecord& record);

/// The item of the heights of the whole scene, to stand beside them in the folder of the store (atlas/terrain_file.h).
/// Their cells lie as the scene's terrain does, and need not be those of patches.
[[nodiscard]] std::string terrain_item_text(const AtlasDescription& description, const radar::GroundGrid& cells,
                                            const TextureRecord& record);

/// The item of the buildings of the whole scene, where they are kept apart (atlas/building_file.h).
[[nodiscard]] std::string buildings_item_text(const AtlasDescription& description, const TextureRecord& record);

/// What an item that was read records of its file, or what is wrong with it, "was altered: …".
struct FoundItem {
  std::optional<TextureRecord> record;  ///< nothing when something is wrong
  std::string fault;                    ///< empty when nothing is
};

/// Of the text of the item beside `file` (relative to the store) in a store of this description. An item vouches for
/// itself as well: it records the SHA-256 of its text without these digits. Those of atlases whose format is older than
/// 2 need not. One that is right in itself but of another place, look or texel than stand there is at fault.
[[nodiscard]] FoundItem item_from(const std::string& text, const AtlasDescription& description,
                                  const std::filesystem::path& file);

}  // namespace sigmascape::atlas
