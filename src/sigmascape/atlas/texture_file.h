#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <system_error>

#include "sigmascape/atlas/half_texture.h"
#include "sigmascape/atlas/pyramid_tiles.h"
#include "sigmascape/atlas/stac_item.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::atlas {

/// A texture of a store as two files: a GeoTIFF and, beside it, the item that vouches for it. Paths of textures are
/// relative to the folder of the store.

/// What mends all that can be wrong with one of these files.
inline constexpr const char* bake_again =
    "start the bake again with the same settings and --verify, which makes anew what is missing or was altered";

/// Everything in a file; nothing, and why, when it is not there or cannot be read.
struct FileText {
  std::optional<std::string> text = {};
  std::error_code error = {};
};
[[nodiscard]] FileText text_of(const std::filesystem::path& file);

/// Whether the system said that there is nothing of a name, rather than that it may not be read.
[[nodiscard]] bool is_nothing_there(const std::error_code& error);
/// As faults say it of what is there: "cannot be read (Is a directory)".
[[nodiscard]] std::string cannot_be_read(const std::error_code& error);

/// The item beside a texture: the same name with the ending .json.
[[nodiscard]] std::filesystem::path item_path(std::filesystem::path texture);

/// A texture as it was found: what its item records, where that can be understood, and what is wrong, if anything.
struct FoundTexture {
  std::optional<TextureRecord> record;
  std::optional<StoreFault> fault;
};
[[nodiscard]] FoundTexture found_texture(const Store& store, const std::filesystem::path& texture, Scrutiny scrutiny);

/// What the item beside a texture records, or what is wrong with it; nothing when there is no item.
[[nodiscard]] std::optional<FoundItem> found_item(const Store& store, const std::filesystem::path& texture);

/// What is wrong with a texture, if anything.
[[nodiscard]] std::optional<StoreFault> texture_fault(const Store& store, const std::filesystem::path& texture,
                                                      Scrutiny scrutiny);

/// Whether a texture is there and as its record says. Of its standard errors nothing is asked.
[[nodiscard]] bool is_as_recorded(const std::filesystem::path& folder, const std::filesystem::path& texture,
                                  const TextureRecord& record, Scrutiny scrutiny);

/// What the item of a texture records; nothing when there is none or something is wrong with it.
[[nodiscard]] std::optional<TextureRecord> texture_record(const Store& store, const std::filesystem::path& texture);

/// The file of a texture whose level 0 lies on `grid`.
[[nodiscard]] std::string texture_bytes(const HalfTexture& halves, const BandNames& bands,
                                        const radar::GroundGrid& grid, const AtlasDescription& description);

/// Writes a texture of a patch (level 0) or of a place above, its standard errors beside it (as GeoTIFF; none when
/// empty), then the item that `item_for` makes of their record; before all of them the catalogs that lead to it.
void write_texture(const Store& store, const PyramidTile& tile, const std::filesystem::path& texture,
                   const HalfTexture& halves, const BandNames& bands,
                   const std::function<std::string(const TextureRecord&)>& item_for, const std::string& errors = {});

/// Reads a texture of so many levels, the first of so many texels a side. Throws Error when it is not there or not as
/// its item says, to the last bit; `remedy` is what would mend it.
[[nodiscard]] HalfTexture read_texture(const Store& store, const std::filesystem::path& texture, std::size_t side,
                                       std::size_t levels, const std::string& remedy);

}  // namespace sigmascape::atlas
