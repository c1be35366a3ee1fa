#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sigmascape/base/array2d.h"
#include "sigmascape/terrain/height_tile.h"
#include "sigmascape/terrain/terrain_pyramid.h"

namespace sigmascape::terrain {

/// How a pyramid's tiles lie, where in them there is ground, and a hash of all that their heights were made from.
struct PyramidHeading {
  PyramidLayout layout;
  radar::Rectangle extent = {};  ///< of those heights; those of a former kind do not tell, and have that of all tiles
  std::string source_hash;
  /// SHA-256 of the index of each level; none while the pyramid is unfinished, nor in those of a former kind.
  std::vector<std::string> index_sha256 = {};
  bool is_of_field = false;  ///< made from a field in memory, not from a raster; those of a former kind do not tell

  friend bool operator==(const PyramidHeading&, const PyramidHeading&) = default;
  /// Whether it is of the same heights, from which the indexes follow.
  [[nodiscard]] bool is_of_heights_of(const PyramidHeading& other) const {
    return layout == other.layout && source_hash == other.source_hash;
  }
};

/// The files of a pyramid's folder: `level_<k>/<column>_<row>.tif` a tile, `level_<k>.tif` lowest, highest and error of
/// a level's tiles, and the heading, under this name once the pyramid is finished and under the other until then.
inline constexpr std::string_view heading_name = "pyramid.toml", unfinished_heading_name = "unfinished.toml";
/// In the folder of a finished pyramid, that of another which is to replace it.
inline constexpr std::string_view building_site_name = ".unfinished";

inline constexpr std::uint32_t most_tiles_a_side = 1'000'000;

[[nodiscard]] std::filesystem::path tile_path(const std::filesystem::path& folder, TileKey key);
[[nodiscard]] std::filesystem::path index_path(const std::filesystem::path& folder, int level);

/// Each file appears under its name only when it is whole. Throws Error when it cannot be written.
void write_tile(const std::filesystem::path& folder, const PyramidLayout& layout, const std::string& crs, TileKey key,
                const HeightTile& tile);
/// Throws Error when the tile is missing, or its heights or what it says of them were altered. What else is in its file
/// is not asked: the layout tells where it lies.
[[nodiscard]] std::shared_ptr<const HeightTile> read_tile(const std::filesystem::path& folder, TileKey key);
/// The same, and throws Error too when any byte of the file was altered, or when it says that it lies elsewhere than
/// the layout has the tile in `crs`: other programs go by that and by its overviews. Tiles of a former kind do not
/// record the SHA-256 of their file; of these all but heights, what is said of them and place is taken as it is.
[[nodiscard]] std::shared_ptr<const HeightTile> read_whole_tile(const std::filesystem::path& folder,
                                                                const PyramidLayout& layout, const std::string& crs,
                                                                TileKey key);

void write_index(const std::filesystem::path& folder, const PyramidLayout& layout, const std::string& crs, int level,
                 const Array2D<TileSummary>& summaries);
/// Throws Error when the index is missing, truncated or not as the heading says.
[[nodiscard]] Array2D<TileSummary> read_index(const std::filesystem::path& folder, const PyramidHeading& heading,
                                              int level);

void write_heading(const std::filesystem::path& file_name, const PyramidHeading& heading);
/// Throws Error when the heading is missing, truncated or was altered: it records the SHA-256 of its own text, without
/// these digits. Those of a former kind do not, and are taken as they are.
[[nodiscard]] PyramidHeading read_heading(const std::filesystem::path& file_name);

/// Opens a pyramid on disk. Throws Error when it is not there, not finished, or lacks its coarsest tile.
[[nodiscard]] TerrainPyramid open_pyramid(const std::filesystem::path& folder, std::size_t budget_bytes);

}  // namespace sigmascape::terrain
