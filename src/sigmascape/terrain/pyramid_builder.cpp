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
#include "sigmascape/terrain/pyramid_faults.h"
#include "sigmascape/terrain/pyramid_files.h"
#include "sigmascape/terrain/pyramid_levels.h"

namespace sigmascape::terrain {
namespace {

/// Rises when the same raster gives other heights, so that tiles of both are never mixed.
constexpr int revision_of_heights = 3;

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

bool holds_pyramid_of(const std::filesystem::path& folder, const HeightField& field, const geo::LocalFrame& frame) {
  return holds(folder, heading_name, heading_of(field, frame));
}

}  // namespace sigmascape::terrain
