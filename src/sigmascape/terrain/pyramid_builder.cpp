#include "sigmascape/terrain/pyramid_builder.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <system_error>
#include <utility>

#include "sigmascape/base/error.h"
#include "sigmascape/base/sha256.h"
#include "sigmascape/geo/is_absent.h"
#include "sigmascape/terrain/pyramid_files.h"

namespace sigmascape::terrain {
namespace {

constexpr auto cells_a_side = static_cast<std::int64_t>(HeightTile::cells);
/// Rises when the same raster gives other heights, so that tiles of both are never mixed.
constexpr int revision_of_heights = 3;

/// Nodes of one finished level, wherever they stand; remembers a few tiles.
class LevelNodes {
 public:
  LevelNodes(const PyramidLayout& layout, int level, const TerrainPyramid::Reader& read)
      : layout_(layout), level_(level), read_(read) {}

  /// Nodes of the level from (column, row) on; beyond the last tile its edge goes on.
  Array2D<float> block(std::int64_t column, std::int64_t row, std::size_t side) {
    Array2D<float> result(side, side);
    const std::int64_t last_column = cells_a_side * layout_.across(level_),
                       last_row = cells_a_side * layout_.down(level_);
    for (std::size_t j = 0; j < side; ++j) {
      const std::int64_t at_row = std::clamp<std::int64_t>(row + static_cast<std::int64_t>(j), 0, last_row);
      for (std::size_t i = 0; i < side; ++i) {
        const std::int64_t at_column = std::clamp<std::int64_t>(column + static_cast<std::int64_t>(i), 0, last_column);
        const auto tile_column = std::min<std::int64_t>(at_column / cells_a_side, layout_.across(level_) - 1);
        const auto tile_row = std::min<std::int64_t>(at_row / cells_a_side, layout_.down(level_) - 1);
        const HeightTile& held =
            tile({level_, static_cast<std::uint32_t>(tile_column), static_cast<std::uint32_t>(tile_row)});
        const auto within = static_cast<std::size_t>(at_row - cells_a_side * tile_row) * HeightTile::nodes +
                            static_cast<std::size_t>(at_column - cells_a_side * tile_column);
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
  const std::size_t first_column = std::size_t{2} * key.column, first_row = std::size_t{2} * key.row;
  for (std::size_t row = first_row; row < std::min(first_row + 2, finer.rows()); ++row) {
    for (std::size_t column = first_column; column < std::min(first_column + 2, finer.columns()); ++column) {
      const TileSummary& child = finer(column, row);
      joined = {std::min(joined.lowest_m, child.lowest_m), std::max(joined.highest_m, child.highest_m),
                std::max(joined.error_m, child.error_m)};
    }
  }
  return joined;
}

/// Whether a folder holds the pyramid of these heights, finished or begun by the name of its heading.
bool holds(const std::filesystem::path& folder, std::string_view name, const PyramidHeading& heading) {
  if (geo::is_absent(folder / name)) return false;
  try {
    return read_heading(folder / name).is_of_heights_of(heading);
  } catch (const Error&) {
    return false;
  }
}

/// First what makes it count, then what is left of it; nothing that others put there.
void remove_pyramid(const std::filesystem::path& folder) {
  if (geo::is_absent(folder)) return;
  std::filesystem::remove(folder / heading_name);
  std::filesystem::remove(folder / unfinished_heading_name);
  std::vector<std::filesystem::path> levels;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().filename().string().starts_with("level_")) levels.push_back(entry.path());
  }
  for (const auto& level : levels) std::filesystem::remove_all(level);
}

/// A tile that is there, as it was written and in its place.
std::shared_ptr<const HeightTile> whole_tile(const std::filesystem::path& folder, const PyramidLayout& layout,
                                             const std::string& crs, TileKey key) {
  if (geo::is_absent(tile_path(folder, key))) return nullptr;
  try {
    return read_whole_tile(folder, layout, crs, key);
  } catch (const Error&) {
    return nullptr;
  }
}

/// Where a pyramid is built: in its folder, or within that while it holds a finished one of other heights, which stays
/// until it can be replaced. Within, for the folder may be a link to another disk or the root of one. The name is
/// always the same, so that what was interrupted goes on, be it while the finished one takes the other's place.
std::filesystem::path building_site(const std::filesystem::path& folder, const PyramidHeading& heading) {
  if (holds(folder, heading_name, heading)) return folder;
  const auto within = folder / building_site_name;
  return holds(within, heading_name, heading) || !heading_fault(folder) ? within : folder;
}

/// Everything that is at `site` but its heading, and that last, so that the pyramid never counts for more than it is.
void move_pyramid(const std::filesystem::path& site, const std::filesystem::path& folder) {
  remove_pyramid(folder);
  std::vector<std::filesystem::path> names;
  for (const auto& entry : std::filesystem::directory_iterator(site)) {
    if (entry.path().filename() != heading_name) names.push_back(entry.path().filename());
  }
  for (const auto& name : names) std::filesystem::rename(site / name, folder / name);
  std::filesystem::rename(site / heading_name, folder / heading_name);
  std::filesystem::remove_all(site);
}

std::size_t build_tiles_on_disk(const std::filesystem::path& folder, const PyramidHeading& heading,
                                const geo::LocalFrame& frame, const FinestHeights& finest) {
  const bool finished = holds(folder, heading_name, heading);
  if (!finished && !holds(folder, unfinished_heading_name, heading)) {
    remove_pyramid(folder);
    write_heading(folder / unfinished_heading_name, heading);
  }
  const PyramidLayout& layout = heading.layout;
  const std::string crs = frame.proj();
  std::size_t written = 0;
  const auto keep = [&](TileKey key, const HeightTile& tile) {
    write_tile(folder, layout, crs, key, tile);
    ++written;
  };
  const auto summaries = build_tiles(
      layout, finest, keep, [&](TileKey key) { return read_tile(folder, key); },
      [&](TileKey key) { return whole_tile(folder, layout, crs, key); });
  PyramidHeading whole = heading;
  for (int level = 0; level < layout.levels(); ++level) {
    write_index(folder, layout, crs, level, summaries[static_cast<std::size_t>(level)]);
    whole.index_sha256.push_back(sha256_of_file(index_path(folder, level)));
  }
  const bool is_told = finished && read_heading(folder / heading_name) == whole;
  if (!is_told) write_heading(folder / heading_name, whole);
  std::filesystem::remove(folder / unfinished_heading_name);
  return written;
}

std::size_t build_on_disk(const std::filesystem::path& folder, const PyramidHeading& heading,
                          const geo::LocalFrame& frame, const FinestHeights& finest) {
  try {
    const std::filesystem::path site = building_site(folder, heading);
    const std::size_t written = build_tiles_on_disk(site, heading, frame, finest);
    if (site != folder) move_pyramid(site, folder);
    // Of heights that are no longer wanted.
    std::filesystem::remove_all(folder / building_site_name);
    return written;
  } catch (const std::filesystem::filesystem_error& failure) {
    throw Error(failure.path1().string(), fmt::format("cannot be replaced ({})", failure.code().message()),
                "let the terrain's tiles be in a folder that may be read and written to");
  }
}

PyramidHeading heading_of(const HeightField& field, const geo::LocalFrame& frame) {
  Sha256 hash;
  hash.add_values(field.height_m.values());
  hash.add(fmt::format("{} {} {} {}", field.west_m, field.north_m, field.spacing_m, frame.proj()));
  return {.layout = PyramidLayout::covering(field.extent(), field.spacing_m),
          .extent = field.extent(),
          .source_hash = hash.hex_digest(),
          .is_of_field = true};
}

/// What is wrong with one of the files of a folder, if anything; `read` throws Error when it is not as it was written.
template <typename Read>
std::optional<PyramidFault> fault_of(const std::filesystem::path& folder, const std::filesystem::path& file,
                                     const Read& read) {
  std::error_code error;
  const bool is_there = std::filesystem::exists(file, error);
  const std::filesystem::path name = file.lexically_relative(folder);
  if (error) return PyramidFault{name, fmt::format("cannot be read ({})", error.message())};
  if (!is_there) return PyramidFault{name, "is missing"};
  try {
    read();
    return std::nullopt;
  } catch (const Error&) {
    return PyramidFault{name, "is truncated or was altered"};
  }
}

/// Calls `on_file(file, read)` for every file that the heading speaks of; `read(crs)` reads it whole.
template <typename OnFile>
void for_each_file(const std::filesystem::path& folder, const OnFile& on_file) {
  const PyramidHeading heading = read_heading(folder / heading_name);
  for (int level = 0; level < heading.layout.levels(); ++level) {
    on_file(index_path(folder, level),
            [&](const std::string&) { static_cast<void>(read_index(folder, heading, level)); });
    for (std::uint32_t row = 0; row < heading.layout.down(level); ++row) {
      for (std::uint32_t column = 0; column < heading.layout.across(level); ++column) {
        const TileKey key{level, column, row};
        on_file(tile_path(folder, key),
                [&](const std::string& crs) { static_cast<void>(read_whole_tile(folder, heading.layout, crs, key)); });
      }
    }
  }
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

/// How many nodes of a tile lie in an extent and have no height; those that the next tile has as well are its own.
std::size_t holes_within(const Array2D<float>& heights, const geo::Lattice& tile, const radar::Rectangle& extent) {
  std::size_t holes = 0;
  for (std::size_t row = 0; row < HeightTile::cells; ++row) {
    const double y_m = tile.north_m - static_cast<double>(row) * tile.spacing_m;
    for (std::size_t column = 0; column < HeightTile::cells; ++column) {
      const double x_m = tile.west_m + static_cast<double>(column) * tile.spacing_m;
      holes += std::isnan(heights(column, row)) && extent.contains({x_m, y_m}) ? 1 : 0;
    }
  }
  return holes;
}

/// Beyond an extent, where the last tiles reach past it and the raster has no heights either, ground goes on as high as
/// at the extent's edge: a plain at another height would end it in a cliff.
void go_on_beyond(const radar::Rectangle& extent, const geo::Lattice& tile, Array2D<float>& heights) {
  const auto last_within = [&](double length_m, std::size_t count) {
    const auto steps = static_cast<std::size_t>(std::max(0.0, length_m / tile.spacing_m + 1e-6));
    return std::min(steps, count - 1);
  };
  const std::size_t last_column = last_within(extent.east_m - tile.west_m, heights.columns()),
                    last_row = last_within(tile.north_m - extent.south_m, heights.rows());
  for (std::size_t row = 0; row < heights.rows(); ++row) {
    for (std::size_t column = 0; column < heights.columns(); ++column) {
      if ((row > last_row || column > last_column) && std::isnan(heights(column, row)))
        heights(column, row) = heights(std::min(column, last_column), std::min(row, last_row));
    }
  }
}

}  // namespace

std::vector<Array2D<TileSummary>> build_tiles(const PyramidLayout& layout, const FinestHeights& finest,
                                              const std::function<void(TileKey, const HeightTile&)>& keep,
                                              const TerrainPyramid::Reader& read, const TerrainPyramid::Reader& there) {
  std::vector<Array2D<TileSummary>> summaries;
  for (int level = 0; level < layout.levels(); ++level) {
    Array2D<TileSummary> of_level(layout.across(level), layout.down(level));
    LevelNodes nodes(layout, level - 1, read);
    for (std::uint32_t row = 0; row < layout.down(level); ++row) {
      for (std::uint32_t column = 0; column < layout.across(level); ++column) {
        const TileKey key{level, column, row};
        if (const auto made = there ? there(key) : nullptr) {
          of_level(column, row) = made->summary;
          continue;
        }
        HeightTile tile;
        if (level == 0) {
          tile.height_m = finest(key);
          note_bounds(tile);
        } else {
          const auto finer =
              nodes.block(2 * cells_a_side * column - 1, 2 * cells_a_side * row - 1, 2 * HeightTile::cells + 3);
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
  return {layout, field.extent(), std::move(summaries), read, tiles->size() * HeightTile::bytes};
}

PyramidBuild build_pyramid(const std::filesystem::path& folder, const TerrainSource& source,
                           const geo::LocalFrame& frame, const radar::Rectangle& extent, double no_data_height_m) {
  const geo::Raster raster(source.raster);
  const double spacing_m = source.spacing_m.value_or(raster.cell_m(frame, extent.centre()));
  const auto layout = PyramidLayout::covering(extent, spacing_m);
  if (std::max(layout.tiles_across, layout.tiles_down) > most_tiles_a_side) {
    throw Error(source.raster.file.string(),
                fmt::format("would make {} × {} tiles of {} cells of {:g} m", layout.tiles_across, layout.tiles_down,
                            HeightTile::cells, spacing_m),
                fmt::format("choose a spacing that makes no more than {} a side", most_tiles_a_side));
  }
  Sha256 hash;
  for (const std::string& digest : raster.digests()) hash.add(digest);
  hash.add(fmt::format("{} {} {} {} {} {}", source.raster.band, source.raster.crs, source.plausible.lowest_m,
                       source.plausible.highest_m, no_data_height_m, frame.proj()));
  if (const double unit_m = raster.height_unit().metres; unit_m != 1.0) hash.add(fmt::format(" {}", unit_m));
  hash.add(fmt::format(" revision {}", revision_of_heights));
  if (layout.extent() != extent) hash.add(fmt::format(" goes on beyond {} {}", extent.east_m, extent.south_m));
  const PyramidHeading heading{layout, extent, hash.hex_digest()};
  std::size_t asked = 0, without_height = 0;
  bool holds_heights = false, is_empty = false;
  const auto nodes_of = [&](TileKey key) {
    const radar::Rectangle tile = layout.extent_of(key);
    const geo::Lattice lattice{tile.west_m, tile.north_m, spacing_m, HeightTile::nodes, HeightTile::nodes};
    Array2D<float> heights = raster.heights_on(lattice, frame, source.plausible);
    go_on_beyond(extent, lattice, heights);
    std::vector<float> nodes(heights.values().begin(), heights.values().end());
    holds_heights = holds_heights || std::ranges::any_of(nodes, [](float height) { return !std::isnan(height); });
    is_empty = ++asked == std::size_t{layout.tiles_across} * layout.tiles_down && !holds_heights;
    if (is_empty) {
      throw Error(source.raster.file.string(),
                  fmt::format("holds no heights from {:g} to {:g} m here", source.plausible.lowest_m,
                              source.plausible.highest_m),
                  "give a raster, or a band of it, of elevations in metres");
    }
    without_height += holes_within(heights, lattice, extent);
    for (float& height : nodes) height = std::isnan(height) ? static_cast<float>(no_data_height_m) : height;
    return nodes;
  };
  try {
    const std::size_t written = build_on_disk(folder, heading, frame, nodes_of);
    return {written, without_height};
  } catch (const Error&) {
    // Of nothing there is nothing to go on from.
    if (is_empty) {
      const std::filesystem::path site = building_site(folder, heading);
      remove_pyramid(site);
      std::error_code holds_more;
      std::filesystem::remove(site, holds_more);
    }
    throw;
  }
}

std::size_t build_pyramid(const std::filesystem::path& folder, const HeightField& field, const geo::LocalFrame& frame) {
  return build_on_disk(folder, heading_of(field, frame), frame,
                       [&](TileKey key) { return nodes_of_field(field, key); });
}

bool holds_pyramid(const std::filesystem::path& folder) {
  return !geo::is_absent(folder / heading_name);
}

bool holds_pyramid_of_a_field(const std::filesystem::path& folder) {
  return !heading_fault(folder) && read_heading(folder / heading_name).is_of_field;
}

bool holds_pyramid_of(const std::filesystem::path& folder, const HeightField& field, const geo::LocalFrame& frame) {
  return holds(folder, heading_name, heading_of(field, frame));
}

std::optional<PyramidFault> heading_fault(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / heading_name;
  return fault_of(folder, file, [&] { static_cast<void>(read_heading(file)); });
}

std::vector<PyramidFault> verify_pyramid(const std::filesystem::path& folder, const geo::LocalFrame& frame) {
  if (const auto fault = heading_fault(folder)) return {*fault};
  std::vector<PyramidFault> faults;
  const std::string crs = frame.proj();
  for_each_file(folder, [&](const std::filesystem::path& file, const auto& read) {
    if (auto fault = fault_of(folder, file, [&] { read(crs); })) faults.push_back(std::move(*fault));
  });
  return faults;
}

std::vector<PyramidFault> missing_files(const std::filesystem::path& folder) {
  if (const auto fault = heading_fault(folder)) return {*fault};
  std::vector<PyramidFault> faults;
  for_each_file(folder, [&](const std::filesystem::path& file, const auto&) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) faults.push_back({file.lexically_relative(folder), "is missing"});
  });
  return faults;
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
