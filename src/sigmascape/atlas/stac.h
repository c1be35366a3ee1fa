#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "sigmascape/atlas/pyramid_tiles.h"
#include "sigmascape/atlas/store.h"

namespace sigmascape::atlas {

/// The JSON side of the store: SpatioTemporal Asset Catalog (STAC 1.0.0) documents, which browsers of satellite images
/// read, and in them, under "sigmascape:", what this library needs back. Equal input gives equal text; no clock goes
/// in.

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
  double relative_standard_error = 0.0;     ///< of a patch, as in BakeFacts; read only
  std::optional<ErrorsRecord> errors = {};  ///< where there is such a file
  /// Of obstacles: no texel of the file or of those that it was made from is higher. Files of a former kind, which hold
  /// no coarser levels, have an item without it.
  std::optional<float> tallest_m = {};
};

/// The collection.json of an atlas.
[[nodiscard]] std::string collection_text(const AtlasDescription& description);

/// What collection_text was made from. Throws Error, naming `file`, when it is not a collection of ours.
[[nodiscard]] AtlasDescription description_from(const std::string& text, const std::filesystem::path& file);

/// The first thing in which two descriptions differ, "texel_m is 1.0 there and 2.0 here", if any. The name may differ.
[[nodiscard]] std::optional<std::string> difference(const AtlasDescription& there, const AtlasDescription& here);

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

/// What an item records of its file; nothing when the text is not an item of ours.
[[nodiscard]] std::optional<TextureRecord> record_from(const std::string& text);

}  // namespace sigmascape::atlas
