#include "sigmascape/terrain/pyramid_builder.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <utility>

#include "sigmascape/base/error.h"
#include "sigmascape/base/sha256.h"
#include "sigmascape/base/toml_reader.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/geo/geotiff.h"

namespace sigmascape::terrain {
namespace {

constexpr auto cells = static_cast<std::int64_t>(HeightTile::cells);

/// Nodes of one finished level, wherever they stand; remembers a few tiles.
class LevelNodes {
 public:
  LevelNodes(const PyramidLayout& layout, int level, const TerrainPyramid::Reader& read)
      : layout_(layout), level_(level), read_(read) {}

  /// Nodes of the level from (column, row) on; beyond the last tile its edge goes on.
  Array2D<float> block(std::int64_t column, std::int64_t row, std::size_t side) {
    Array2D<float> result(side, side);
    const std::int64_t last_column = cells * layout_.across(level_), last_row = cells * layout_.down(level_);
    for (std::size_t j = 0; j < side; ++j) {
      const std::int64_t at_row = std::clamp<std::int64_t>(row + static_cast<std::int64_t>(j), 0, last_row);
      for (std::size_t i = 0; i < side; ++i) {
        const std::int64_t at_column = std::clamp<std::int64_t>(column + static_cast<std::int64_t>(i), 0, last_column);
        const auto tile_column = std::min<std::int64_t>(at_column / cells, layout_.across(level_) - 1);
        const auto tile_row = std::min<std::int64_t>(at_row / cells, layout_.down(level_) - 1);
        const HeightTile& held =
            tile({level_, static_cast<std::uint32_t>(tile_column), static_cast<std::uint32_t>(tile_row)});
        const auto within = static_cast<std::size_t>(at_row - cells * tile_row) * HeightTile::nodes +
                            static_cast<std::size_t>(at_column - cells * tile_column);
        result(i, j) = held.height_m[within];
      }
    }
    return result;
  }

 private:
  const HeightTile& tile(TileKey key) {
    if (latest_ != nullptr && key == latest_key_) return *latest_;
    constexpr std::size_t most = 24;
    auto found = tiles_.find(key);
    if (found == tiles_.end()) {
      if (tiles_.size() >= most) tiles_.clear();
      found = tiles_.emplace(key, read_(key)).first;
    }
    latest_key_ = key;
    latest_ = found->second.get();
    return *latest_;
  }

  const PyramidLayout& layout_;
  int level_;
  const TerrainPyramid::Reader& read_;
  std::map<TileKey, std::shared_ptr<const HeightTile>> tiles_;
  TileKey latest_key_;
  const HeightTile* latest_ = nullptr;
};

void note_bounds(HeightTile& tile) {
  const auto [lowest, highest] = std::ranges::minmax_element(tile.height_m);
  tile.summary.lowest_m = *lowest;
  tile.summary.highest_m = *highest;
}

/// A tile from a block of the finer level that begins one node before it.
HeightTile coarser(const Array2D<float>& finer) {
  HeightTile tile{.height_m = std::vector<float>(HeightTile::nodes * HeightTile::nodes)};
  for (std::size_t row = 0; row < HeightTile::nodes; ++row) {
    for (std::size_t column = 0; column < HeightTile::nodes; ++column) {
      float sum = 0.0F;
      for (std::size_t j = 0; j < 3; ++j) {
        for (std::size_t i = 0; i < 3; ++i) {
          const float weight = (i == 1 ? 2.0F : 1.0F) * (j == 1 ? 2.0F : 1.0F);
          sum += weight * finer(2 * column + i, 2 * row + j);
        }
      }
      tile.height_m[row * HeightTile::nodes + column] = sum / 16.0F;
    }
  }
  note_bounds(tile);
  return tile;
}

/// The furthest that a node of the finer level lies from the tile's surface. No point between nodes lies further: the
/// difference of two bilinear surfaces is bilinear within each finer cell.
float distance_between(const HeightTile& tile, const Array2D<float>& finer) {
  float furthest = 0.0F;
  for (std::size_t row = 0; row <= 2 * HeightTile::cells; ++row) {
    for (std::size_t column = 0; column <= 2 * HeightTile::cells; ++column) {
      const float surface = tile.at(0.5 * static_cast<double>(column), 0.5 * static_cast<double>(row));
      furthest = std::max(furthest, std::abs(surface - finer(column + 1, row + 1)));
    }
  }
  return furthest;
}

/// Bounds and greatest error of a tile's children, and its own bounds.
TileSummary joined_with_children(TileKey key, TileSummary joined, const Array2D<TileSummary>& finer) {
  for (std::size_t row = 2 * key.row; row < std::min<std::size_t>(2 * key.row + 2, finer.rows()); ++row) {
    for (std::size_t column = 2 * key.column; column < std::min<std::size_t>(2 * key.column + 2, finer.columns());
         ++column) {
      const TileSummary& child = finer(column, row);
      joined = {std::min(joined.lowest_m, child.lowest_m), std::max(joined.highest_m, child.highest_m),
                std::max(joined.error_m, child.error_m)};
    }
  }
  return joined;
}

std::filesystem::path tile_path(const std::filesystem::path& folder, TileKey key) {
  return folder / fmt::format("level_{}", key.level) / fmt::format("{}_{}.tif", key.column, key.row);
}
std::filesystem::path index_path(const std::filesystem::path& folder, int level) {
  return folder / fmt::format("level_{}.tif", level);
}

/// Of a tile and its place, so that one tile does not pass for another.
std::string digest_of(TileKey key, const std::vector<float>& heights) {
  Sha256 digest;
  digest.add(fmt::format("{} {} {} ", key.level, key.column, key.row));
  digest.add_values(std::span(heights));
  return digest.hex_digest();
}

void write_tile(const std::filesystem::path& folder, const PyramidLayout& layout, const std::string& crs, TileKey key,
                const HeightTile& tile) {
  const radar::Rectangle extent = layout.extent_of(key);
  const double spacing_m = layout.spacing_at(key.level);
  geo::GeoRaster raster{
      .placement = {extent.west_m - 0.5 * spacing_m, extent.north_m + 0.5 * spacing_m, spacing_m, crs},
      .bands = {{"height_m", Array2D<float>(HeightTile::nodes, HeightTile::nodes)}},
      .nodata = std::nullopt,
      .metadata = {{"lowest_m", fmt::format("{}", tile.summary.lowest_m)},
                   {"highest_m", fmt::format("{}", tile.summary.highest_m)},
                   {"error_m", fmt::format("{}", tile.summary.error_m)},
                   {"heights_sha256", digest_of(key, tile.height_m)}}};
  std::ranges::copy(tile.height_m, raster.bands[0].values.values().begin());
  geo::write_geotiff(tile_path(folder, key), raster);
}

std::shared_ptr<const HeightTile> read_tile(const std::filesystem::path& folder, TileKey key) {
  const std::filesystem::path path = tile_path(folder, key);
  const geo::GeoRaster raster = geo::read_geotiff(path);
  const Array2D<float>& heights = raster.bands.at(0).values;
  if (heights.columns() != HeightTile::nodes || heights.rows() != HeightTile::nodes) {
    throw Error(path.string(), "is not a terrain tile of 257 × 257 nodes", "build the pyramid again");
  }
  HeightTile tile{.height_m = {heights.values().begin(), heights.values().end()}};
  const auto digest = raster.metadata.find("heights_sha256");
  if (digest == raster.metadata.end() || digest->second != digest_of(key, tile.height_m)) {
    throw Error(path.string(), "has been altered since it was written", "build the pyramid again");
  }
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
  return std::make_shared<const HeightTile>(std::move(tile));
}

void write_index(const std::filesystem::path& folder, const PyramidLayout& layout, const std::string& crs, int level,
                 const Array2D<TileSummary>& summaries) {
  Array2D<float> lowest(summaries.columns(), summaries.rows()), highest = lowest, error = lowest;
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    lowest.values()[i] = summaries.values()[i].lowest_m;
    highest.values()[i] = summaries.values()[i].highest_m;
    error.values()[i] = summaries.values()[i].error_m;
  }
  const double side_m = layout.spacing_at(level) * static_cast<double>(cells);
  geo::write_geotiff(
      index_path(folder, level),
      {.placement = {layout.west_m, layout.north_m, side_m, crs},
       .bands = {{"lowest_m", std::move(lowest)}, {"highest_m", std::move(highest)}, {"error_m", std::move(error)}},
       .nodata = std::nullopt,
       .metadata = {}});
}

Array2D<TileSummary> read_index(const std::filesystem::path& folder, const PyramidLayout& layout, int level) {
  const geo::GeoRaster raster = geo::read_geotiff(index_path(folder, level));
  Array2D<TileSummary> summaries(layout.across(level), layout.down(level));
  if (raster.bands.size() != 3 || raster.bands[0].values.size() != summaries.size()) {
    throw Error(index_path(folder, level).string(), "does not belong to this pyramid", "build the pyramid again");
  }
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    summaries.values()[i] = {raster.bands[0].values.values()[i], raster.bands[1].values.values()[i],
                             raster.bands[2].values.values()[i]};
  }
  return summaries;
}

struct Heading {
  PyramidLayout layout;
  std::string source_hash;
};

Heading read_heading(const std::filesystem::path& folder) {
  const auto file = TomlSection::read_file(folder / "pyramid.toml");
  constexpr Interval place{-1e9, 1e9, "m"}, count{1, 1e6, "tiles"};
  Heading heading{.layout = {file.number("west_m", place), file.number("north_m", place),
                             file.number("spacing_m", {1e-3, 1e6, "m"}),
                             static_cast<std::uint32_t>(file.number("tiles_across", count)),
                             static_cast<std::uint32_t>(file.number("tiles_down", count))},
                  .source_hash = file.text("source_hash")};
  file.refuse_unknown_keys();
  return heading;
}

void build_on_disk(const std::filesystem::path& folder, const PyramidLayout& layout, const geo::LocalFrame& frame,
                   const std::string& source_hash, const FinestHeights& finest) {
  if (std::filesystem::exists(folder / "pyramid.toml")) {
    const Heading there = read_heading(folder);
    if (there.layout == layout && there.source_hash == source_hash) return;
    // First what makes it count, then what is left of it.
    std::filesystem::remove(folder / "pyramid.toml");
    std::filesystem::remove_all(folder);
  }
  const std::string crs = frame.proj();
  const auto summaries = build_tiles(
      layout, finest, [&](TileKey key, const HeightTile& tile) { write_tile(folder, layout, crs, key, tile); },
      [&](TileKey key) { return read_tile(folder, key); });
  for (int level = 0; level < layout.levels(); ++level) {
    write_index(folder, layout, crs, level, summaries[static_cast<std::size_t>(level)]);
  }
  geo::write_atomically(folder / "pyramid.toml",
                        fmt::format("west_m = {:.17g}\nnorth_m = {:.17g}\nspacing_m = {:.17g}\ntiles_across = {}\n"
                                    "tiles_down = {}\nsource_hash = \"{}\"\n",
                                    layout.west_m, layout.north_m, layout.spacing_m, layout.tiles_across,
                                    layout.tiles_down, source_hash));
}

/// Nodes of a tile from a field, whose edge goes on beyond it.
std::vector<float> nodes_of_field(const HeightField& field, TileKey key) {
  std::vector<float> nodes(HeightTile::nodes * HeightTile::nodes);
  for (std::size_t j = 0; j < HeightTile::nodes; ++j) {
    const std::size_t row = std::min(HeightTile::cells * key.row + j, field.height_m.rows() - 1);
    for (std::size_t i = 0; i < HeightTile::nodes; ++i) {
      const std::size_t column = std::min(HeightTile::cells * key.column + i, field.height_m.columns() - 1);
      nodes[j * HeightTile::nodes + i] = field.height_m(column, row);
    }
  }
  return nodes;
}

}  // namespace

std::vector<Array2D<TileSummary>> build_tiles(const PyramidLayout& layout, const FinestHeights& finest,
                                              const std::function<void(TileKey, const HeightTile&)>& keep,
                                              const TerrainPyramid::Reader& read) {
  std::vector<Array2D<TileSummary>> summaries;
  for (int level = 0; level < layout.levels(); ++level) {
    Array2D<TileSummary> of_level(layout.across(level), layout.down(level));
    LevelNodes nodes(layout, level - 1, read);
    for (std::uint32_t row = 0; row < layout.down(level); ++row) {
      for (std::uint32_t column = 0; column < layout.across(level); ++column) {
        const TileKey key{level, column, row};
        HeightTile tile;
        if (level == 0) {
          tile.height_m = finest(key);
          note_bounds(tile);
        } else {
          const auto finer = nodes.block(2 * cells * column - 1, 2 * cells * row - 1, 2 * HeightTile::cells + 3);
          tile = coarser(finer);
          tile.summary = joined_with_children(key, tile.summary, summaries.back());
          tile.summary.error_m += distance_between(tile, finer);
        }
        keep(key, tile);
        of_level(column, row) = tile.summary;
      }
    }
    summaries.push_back(std::move(of_level));
  }
  return summaries;
}

TerrainPyramid pyramid_in_memory(const HeightField& field) {
  const auto layout = PyramidLayout::covering(field.extent(), field.spacing_m);
  const auto tiles = std::make_shared<std::map<TileKey, std::shared_ptr<const HeightTile>>>();
  const TerrainPyramid::Reader read = [tiles](TileKey key) { return tiles->at(key); };
  auto summaries = build_tiles(
      layout, [&](TileKey key) { return nodes_of_field(field, key); },
      [&](TileKey key, const HeightTile& tile) { tiles->emplace(key, std::make_shared<const HeightTile>(tile)); },
      read);
  return {layout, std::move(summaries), read, tiles->size() * HeightTile::bytes};
}

void build_pyramid(const std::filesystem::path& folder, const TerrainSource& source, const geo::LocalFrame& frame,
                   const radar::Rectangle& extent, double no_data_height_m) {
  const geo::Raster raster(source.raster);
  const double spacing_m = source.spacing_m.value_or(raster.cell_m());
  const auto layout = PyramidLayout::covering(extent, spacing_m);
  Sha256 hash;
  hash.add(sha256_of_file(source.raster.file));
  hash.add(fmt::format("{} {} {} {} {} {}", source.raster.band, source.raster.crs, source.plausible.lowest_m,
                       source.plausible.highest_m, no_data_height_m, frame.proj()));
  build_on_disk(folder, layout, frame, hash.hex_digest(), [&](TileKey key) {
    const radar::Rectangle tile = layout.extent_of(key);
    const Array2D<float> heights = raster.heights_on(
        {tile.west_m, tile.north_m, spacing_m, HeightTile::nodes, HeightTile::nodes}, frame, source.plausible);
    std::vector<float> nodes(heights.values().begin(), heights.values().end());
    for (float& height : nodes) height = std::isnan(height) ? static_cast<float>(no_data_height_m) : height;
    return nodes;
  });
}

void build_pyramid(const std::filesystem::path& folder, const HeightField& field, const geo::LocalFrame& frame) {
  Sha256 hash;
  hash.add_values(field.height_m.values());
  hash.add(fmt::format("{} {} {} {}", field.west_m, field.north_m, field.spacing_m, frame.proj()));
  build_on_disk(folder, PyramidLayout::covering(field.extent(), field.spacing_m), frame, hash.hex_digest(),
                [&](TileKey key) { return nodes_of_field(field, key); });
}

bool holds_pyramid(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / "pyramid.toml");
}

TerrainPyramid open_pyramid(const std::filesystem::path& folder, std::size_t budget_bytes) {
  const Heading heading = read_heading(folder);
  std::vector<Array2D<TileSummary>> summaries;
  for (int level = 0; level < heading.layout.levels(); ++level) {
    summaries.push_back(read_index(folder, heading.layout, level));
  }
  return {heading.layout, std::move(summaries), [folder](TileKey key) { return read_tile(folder, key); }, budget_bytes};
}

}  // namespace sigmascape::terrain
