#include "sigmascape/terrain/pyramid_files.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include "sigmascape/base/error.h"
#include "sigmascape/base/sha256.h"
#include "sigmascape/base/toml_reader.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/geo/coordinate_reference_system.h"
#include "sigmascape/geo/geo_raster.h"

namespace sigmascape::terrain {
namespace {

/// What headings say of pyramids that were made from a field in memory.
constexpr std::string_view from_field = "height field";

/// Of a tile and its place, so that one tile does not pass for another.
std::string digest_of(TileKey key, const std::vector<float>& heights) {
  Sha256 digest;
  digest.add(fmt::format("{} {} {} ", key.level, key.column, key.row));
  digest.add_values(std::span(heights));
  return digest.hex_digest();
}

using Metadata = std::map<std::string, std::string>;

/// Of a tile's heights and what it says of them and of those below; none of these may be absent.
std::string digest_of(const Metadata& tile) {
  Sha256 digest;
  for (const char* name : {"heights_sha256", "lowest_m", "highest_m", "error_m"}) digest.add(tile.at(name) + " ");
  return digest.hex_digest();
}

constexpr std::size_t sha256_digits = 64;

/// Under this name a tile records the SHA-256 of the bytes of its file without these digits, and under the other it
/// tells so: a tile that lost one of the two does not pass for one of a former kind, which has neither.
constexpr const char* file_hash = "file_sha256";
constexpr const char* file_hash_is_of = "file_sha256_is_of";

/// Where in the bytes of a tile's file those digits begin; nothing when it has none.
std::optional<std::size_t> place_of_file_hash(std::string_view bytes) {
  const std::string before = fmt::format("name=\"{}\">", file_hash);
  const std::size_t found = bytes.find(before);
  if (found == std::string_view::npos || bytes.size() < found + before.size() + sha256_digits) return std::nullopt;
  return found + before.size();
}

std::string hash_without_digits(std::string_view bytes, std::size_t digits) {
  Sha256 hash;
  hash.add(bytes.substr(0, digits));
  hash.add(bytes.substr(digits + sha256_digits));
  return hash.hex_digest();
}

/// Whether the file of a tile is, byte for byte, as it was written.
bool is_as_written(std::string_view bytes, const Metadata& tile) {
  const auto recorded = tile.find(file_hash);
  if ((recorded != tile.end()) != tile.contains(file_hash_is_of)) return false;
  if (recorded == tile.end()) return true;
  const auto digits = place_of_file_hash(bytes);
  return digits && hash_without_digits(bytes, *digits) == recorded->second;
}

constexpr std::string_view own_hash = "heading_sha256 = \"";

/// A heading with the SHA-256 of its own text at the end.
std::string sealed(std::string text) {
  text += fmt::format("{}\"\n", own_hash);
  const std::string digits = sha256_of(text);
  return text.insert(text.size() - std::string_view("\"\n").size(), digits);
}

std::string bytes_of(const std::filesystem::path& file_name) {
  std::ifstream file(file_name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Whether a heading is not what its own hash says.
bool is_altered(const std::filesystem::path& file_name, const std::string& recorded) {
  std::string text = bytes_of(file_name);
  const std::size_t found = text.find(own_hash);
  if (found == std::string::npos || recorded.size() != sha256_digits) return true;
  text.erase(found + own_hash.size(), sha256_digits);
  return sha256_of(text) != recorded;
}

Error altered(const std::filesystem::path& file) {
  return {file.string(), "has been altered since it was written", "build the pyramid again"};
}

/// Where a tile's file lies: its cells have the nodes in their middles.
geo::RasterPlacement placement_of(const PyramidLayout& layout, const std::string& crs, TileKey key) {
  const radar::Rectangle extent = layout.extent_of(key);
  const double spacing_m = layout.spacing_at(key.level);
  return {extent.west_m - 0.5 * spacing_m, extent.north_m + 0.5 * spacing_m, spacing_m, crs};
}

/// But for what rounding may do.
bool is_same_place(const geo::RasterPlacement& a, const geo::RasterPlacement& b) {
  const double least_m = 1e-6 * b.cell_m;
  return std::abs(a.west_m - b.west_m) <= least_m && std::abs(a.north_m - b.north_m) <= least_m &&
         std::abs(a.cell_m - b.cell_m) <= least_m && geo::is_same_crs(a.crs, b.crs);
}

std::shared_ptr<const HeightTile> tile_in(const geo::GeoRaster& raster, const std::filesystem::path& path,
                                          TileKey key) {
  const Array2D<float>& heights = raster.bands.at(0).values;
  if (heights.columns() != HeightTile::nodes || heights.rows() != HeightTile::nodes) {
    throw Error(path.string(), "is not a terrain tile of 257 × 257 nodes", "build the pyramid again");
  }
  HeightTile tile{.height_m = {heights.values().begin(), heights.values().end()}};
  const auto digest = raster.metadata.find("heights_sha256");
  if (digest == raster.metadata.end() || digest->second != digest_of(key, tile.height_m)) throw altered(path);
  const auto number = [&](const char* name) {
    const auto found = raster.metadata.find(name);
    float value = 0.0F;
    if (found == raster.metadata.end() ||
        std::from_chars(found->second.data(), found->second.data() + found->second.size(), value).ec != std::errc()) {
      throw Error(path.string(), fmt::format("does not say its {}", name), "build the pyramid again");
    }
    return value;
  };
  tile.summary = {number("lowest_m"), number("highest_m"), number("error_m")};
  // Tiles of a former kind vouch for their heights alone.
  const auto whole = raster.metadata.find("tile_sha256");
  if (whole != raster.metadata.end() && whole->second != digest_of(raster.metadata)) throw altered(path);
  return std::make_shared<const HeightTile>(std::move(tile));
}

}  // namespace

std::filesystem::path tile_path(const std::filesystem::path& folder, TileKey key) {
  return folder / fmt::format("level_{}", key.level) / fmt::format("{}_{}.tif", key.column, key.row);
}

std::filesystem::path index_path(const std::filesystem::path& folder, int level) {
  return folder / fmt::format("level_{}.tif", level);
}

void write_tile(const std::filesystem::path& folder, const PyramidLayout& layout, const std::string& crs, TileKey key,
                const HeightTile& tile) {
  geo::GeoRaster raster{.placement = placement_of(layout, crs, key),
                        .bands = {{"height_m", Array2D<float>(HeightTile::nodes, HeightTile::nodes)}},
                        .nodata = std::nullopt,
                        .metadata = {{"lowest_m", fmt::format("{}", tile.summary.lowest_m)},
                                     {"highest_m", fmt::format("{}", tile.summary.highest_m)},
                                     {"error_m", fmt::format("{}", tile.summary.error_m)},
                                     {"heights_sha256", digest_of(key, tile.height_m)}}};
  raster.metadata["tile_sha256"] = digest_of(raster.metadata);
  raster.metadata[file_hash] = std::string(sha256_digits, '0');
  raster.metadata[file_hash_is_of] = "all bytes of this file but these 64 digits";
  std::ranges::copy(tile.height_m, raster.bands[0].values.values().begin());
  const std::filesystem::path path = tile_path(folder, key);
  std::string bytes = geo::geotiff_bytes(path, raster);
  const std::size_t digits = place_of_file_hash(bytes).value();
  bytes.replace(digits, sha256_digits, hash_without_digits(bytes, digits));
  geo::write_geotiff_bytes(path, bytes);
}

std::shared_ptr<const HeightTile> read_tile(const std::filesystem::path& folder, TileKey key) {
  const std::filesystem::path path = tile_path(folder, key);
  return tile_in(geo::read_geotiff(path), path, key);
}

std::shared_ptr<const HeightTile> read_whole_tile(const std::filesystem::path& folder, const PyramidLayout& layout,
                                                  const std::string& crs, TileKey key) {
  const std::filesystem::path path = tile_path(folder, key);
  const geo::GeoRaster raster = geo::read_geotiff(path);
  if (!is_same_place(raster.placement, placement_of(layout, crs, key))) throw altered(path);
  if (!is_as_written(bytes_of(path), raster.metadata)) throw altered(path);
  return tile_in(raster, path, key);
}

void write_index(const std::filesystem::path& folder, const PyramidLayout& layout, const std::string& crs, int level,
                 const Array2D<TileSummary>& summaries) {
  Array2D<float> lowest(summaries.columns(), summaries.rows()), highest = lowest, error = lowest;
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    lowest.values()[i] = summaries.values()[i].lowest_m;
    highest.values()[i] = summaries.values()[i].highest_m;
    error.values()[i] = summaries.values()[i].error_m;
  }
  const double side_m = layout.spacing_at(level) * static_cast<double>(HeightTile::cells);
  geo::write_geotiff(
      index_path(folder, level),
      {.placement = {layout.west_m, layout.north_m, side_m, crs},
       .bands = {{"lowest_m", std::move(lowest)}, {"highest_m", std::move(highest)}, {"error_m", std::move(error)}},
       .nodata = std::nullopt,
       .metadata = {}});
}

Array2D<TileSummary> read_index(const std::filesystem::path& folder, const PyramidHeading& heading, int level) {
  const geo::GeoRaster raster = geo::read_geotiff(index_path(folder, level));
  const std::vector<std::string>& recorded = heading.index_sha256;
  if (!recorded.empty() && sha256_of_file(index_path(folder, level)) != recorded[static_cast<std::size_t>(level)])
    throw altered(index_path(folder, level));
  Array2D<TileSummary> summaries(heading.layout.across(level), heading.layout.down(level));
  if (raster.bands.size() != 3 || raster.bands[0].values.size() != summaries.size()) {
    throw Error(index_path(folder, level).string(), "does not belong to this pyramid", "build the pyramid again");
  }
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    summaries.values()[i] = {raster.bands[0].values.values()[i], raster.bands[1].values.values()[i],
                             raster.bands[2].values.values()[i]};
  }
  return summaries;
}

PyramidHeading read_heading(const std::filesystem::path& file_name) {
  const auto file = TomlSection::read_file(file_name);
  constexpr Interval place{-1e9, 1e9, "m"}, count{1, most_tiles_a_side, "tiles"};
  PyramidHeading heading{.layout = {file.number("west_m", place), file.number("north_m", place),
                                    file.number("spacing_m", {1e-3, 1e6, "m"}),
                                    static_cast<std::uint32_t>(file.number("tiles_across", count)),
                                    static_cast<std::uint32_t>(file.number("tiles_down", count))},
                         .source_hash = file.text("source_hash"),
                         .index_sha256 = file.texts("index_sha256")};
  const radar::Rectangle tiles = heading.layout.extent();
  // By rounding it may reach a hair's breadth beyond them.
  const double hair_m = 1e-6 * heading.layout.spacing_m;
  heading.extent = {tiles.west_m,
                    file.number_or("south_m", {tiles.south_m - hair_m, tiles.north_m, "m"}, tiles.south_m),
                    file.number_or("east_m", {tiles.west_m, tiles.east_m + hair_m, "m"}, tiles.east_m), tiles.north_m};
  heading.is_of_field = file.optional_text("made_from") == from_field;
  const auto recorded = file.optional_text("heading_sha256");
  file.refuse_unknown_keys();
  const std::size_t indexes = heading.index_sha256.size();
  if (indexes != 0 && indexes != static_cast<std::size_t>(heading.layout.levels())) throw altered(file_name);
  if (recorded && is_altered(file_name, *recorded)) throw altered(file_name);
  return heading;
}

void write_heading(const std::filesystem::path& file_name, const PyramidHeading& heading) {
  const PyramidLayout& layout = heading.layout;
  std::string text = fmt::format(
      "west_m = {:.17g}\nnorth_m = {:.17g}\neast_m = {:.17g}\nsouth_m = {:.17g}\nspacing_m = {:.17g}\n"
      "tiles_across = {}\ntiles_down = {}\nsource_hash = \"{}\"\n",
      layout.west_m, layout.north_m, heading.extent.east_m, heading.extent.south_m, layout.spacing_m,
      layout.tiles_across, layout.tiles_down, heading.source_hash);
  if (heading.is_of_field) text += fmt::format("made_from = \"{}\"\n", from_field);
  if (!heading.index_sha256.empty())
    text += fmt::format("index_sha256 = [\n  \"{}\",\n]\n", fmt::join(heading.index_sha256, "\",\n  \""));
  geo::write_atomically(file_name, sealed(std::move(text)));
}

TerrainPyramid open_pyramid(const std::filesystem::path& folder, std::size_t budget_bytes) {
  const PyramidHeading heading = read_heading(folder / heading_name);
  std::vector<Array2D<TileSummary>> summaries;
  for (int level = 0; level < heading.layout.levels(); ++level) {
    summaries.push_back(read_index(folder, heading, level));
  }
  return {heading.layout, heading.extent, std::move(summaries),
          [folder = std::filesystem::absolute(folder)](TileKey key) { return read_tile(folder, key); }, budget_bytes};
}

}  // namespace sigmascape::terrain
