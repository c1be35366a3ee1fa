#include "sigmascape/terrain/terrain_window.h"

#include <algorithm>
#include <cmath>

namespace sigmascape::terrain {
namespace {

std::int16_t packed(float slope) {
  constexpr float most = 32767.0F;
  return static_cast<std::int16_t>(std::lround(std::clamp(slope * PackedSlope::steps_per_unit, -most, most)));
}

/// A bilinear surface is nowhere steeper along its lattice than its edges are.
float steepest_of(std::span<const float> height_m, std::size_t columns, double spacing_m) {
  float eastward_m = 0.0F, southward_m = 0.0F;
  for (std::size_t first = 0; first < height_m.size(); first += columns) {
    for (std::size_t i = first + 1; i < first + columns; ++i)
      eastward_m = std::max(eastward_m, std::abs(height_m[i] - height_m[i - 1]));
    for (std::size_t i = first; first > 0 && i < first + columns; ++i)
      southward_m = std::max(southward_m, std::abs(height_m[i] - height_m[i - columns]));
  }
  return std::hypot(eastward_m, southward_m) / static_cast<float>(spacing_m);
}

/// The tiles of a level that an area touches; beyond the edge the nearest.
std::vector<TileKey> tiles_over(const PyramidLayout& layout, const radar::Rectangle& area, int level) {
  const double side_m = layout.spacing_at(level) * static_cast<double>(HeightTile::cells);
  const auto within = [](double tile, std::uint32_t count) {
    return static_cast<std::uint32_t>(std::clamp(tile, 0.0, static_cast<double>(count - 1)));
  };
  const std::uint32_t across = layout.across(level), down = layout.down(level);
  const std::uint32_t first_column = within(std::floor((area.west_m - layout.west_m) / side_m), across);
  const std::uint32_t last_column = within(std::ceil((area.east_m - layout.west_m) / side_m) - 1.0, across);
  const std::uint32_t first_row = within(std::floor((layout.north_m - area.north_m) / side_m), down);
  const std::uint32_t last_row = within(std::ceil((layout.north_m - area.south_m) / side_m) - 1.0, down);
  std::vector<TileKey> tiles;
  for (std::uint32_t row = first_row; row <= last_row; ++row) {
    for (std::uint32_t column = first_column; column <= last_column; ++column) tiles.push_back({level, column, row});
  }
  return tiles;
}

}  // namespace

TerrainWindow::TerrainWindow(std::size_t most_nodes_per_side, WindowSlopes slopes)
    : most_nodes_(most_nodes_per_side * most_nodes_per_side), slopes_(slopes) {}

std::optional<TerrainView> TerrainWindow::placed(const PyramidLayout& layout, const radar::Rectangle& area,
                                                 int level) const {
  const double spacing_m = layout.spacing_at(level);
  const auto nodes_across = static_cast<double>(layout.across(level) * HeightTile::cells);
  const auto nodes_down = static_cast<double>(layout.down(level) * HeightTile::cells);
  const double west = std::clamp(std::floor((area.west_m - layout.west_m) / spacing_m), 0.0, nodes_across - 1.0);
  const double east = std::clamp(std::ceil((area.east_m - layout.west_m) / spacing_m), west + 1.0, nodes_across);
  const double north = std::clamp(std::floor((layout.north_m - area.north_m) / spacing_m), 0.0, nodes_down - 1.0);
  const double south = std::clamp(std::ceil((layout.north_m - area.south_m) / spacing_m), north + 1.0, nodes_down);
  const auto columns = static_cast<std::size_t>(east - west) + 1, rows = static_cast<std::size_t>(south - north) + 1;
  if (columns * rows > most_nodes_) return std::nullopt;
  return TerrainView{.lattice_west_m = layout.west_m,
                     .lattice_north_m = layout.north_m,
                     .spacing_m = spacing_m,
                     .first_column = static_cast<std::int64_t>(west),
                     .first_row = static_cast<std::int64_t>(north),
                     .columns = columns,
                     .rows = rows};
}

void TerrainWindow::copy(int level, TileKey part, TileKey source, const HeightTile& tile) {
  // In nodes of the window's level: where the part lies, and where the tile begins.
  const auto cells = static_cast<std::int64_t>(HeightTile::cells);
  const std::int64_t part_side = cells << (part.level - level), source_side = cells << (source.level - level);
  const std::int64_t part_column = part_side * part.column, part_row = part_side * part.row;
  const auto begin = [](std::int64_t from, std::int64_t first) { return std::max<std::int64_t>(from - first, 0); };
  const auto end = [](std::int64_t to, std::int64_t first, std::size_t count) {
    return std::min<std::int64_t>(to - first + 1, static_cast<std::int64_t>(count));
  };
  const std::int64_t first_column = begin(part_column, placement_.first_column);
  const std::int64_t column_end = end(part_column + part_side, placement_.first_column, placement_.columns);
  const double scale = 1.0 / static_cast<double>(std::int64_t{1} << (source.level - level));
  for (std::int64_t row = begin(part_row, placement_.first_row);
       row < end(part_row + part_side, placement_.first_row, placement_.rows); ++row) {
    const std::int64_t row_in_tile = placement_.first_row + row - source_side * source.row;
    const std::int64_t column_in_tile = placement_.first_column + first_column - source_side * source.column;
    float* const to = height_m_.data() + static_cast<std::size_t>(row) * placement_.columns + first_column;
    if (source.level == level) {
      const auto from =
          static_cast<std::size_t>(row_in_tile) * HeightTile::nodes + static_cast<std::size_t>(column_in_tile);
      std::copy_n(tile.height_m.data() + from, std::max<std::int64_t>(column_end - first_column, 0), to);
      continue;
    }
    for (std::int64_t i = 0; i < column_end - first_column; ++i) {
      to[i] = tile.at(scale * static_cast<double>(column_in_tile + i), scale * static_cast<double>(row_in_tile));
    }
  }
}

void TerrainWindow::form_slopes() {
  const std::size_t columns = placement_.columns, rows = placement_.rows;
  const auto spacing_m = static_cast<float>(placement_.spacing_m);
  for (std::size_t row = 0; row < rows; ++row) {
    const std::size_t north = row > 0 ? row - 1 : row, south = std::min(row + 1, rows - 1);
    for (std::size_t column = 0; column < columns; ++column) {
      const std::size_t west = column > 0 ? column - 1 : column, east = std::min(column + 1, columns - 1);
      const float eastward = (height_m_[row * columns + east] - height_m_[row * columns + west]) /
                             (spacing_m * static_cast<float>(east - west));
      const float northward = (height_m_[north * columns + column] - height_m_[south * columns + column]) /
                              (spacing_m * static_cast<float>(south - north));
      slope_[row * columns + column] = {packed(eastward), packed(northward)};
    }
  }
}

WindowReport TerrainWindow::fill(TerrainPyramid& pyramid, const radar::Rectangle& area, int level) {
  const PyramidLayout& layout = pyramid.layout();
  const int last = layout.levels() - 1;
  WindowReport report{.level = std::clamp(level, 0, last)};
  std::optional<TerrainView> placement = placed(layout, area, report.level);
  while (!placement && report.level < last) placement = placed(layout, area, ++report.level);
  if (!placement) return report;
  placement_ = *placement;
  const std::size_t nodes = placement_.columns * placement_.rows;
  if (height_m_.size() < nodes) height_m_.resize(nodes);
  if (slopes_ == WindowSlopes::Formed && slope_.size() < nodes) slope_.resize(nodes);

  const std::vector<TileKey> wanted = tiles_over(layout, area, report.level);
  report.tiles = wanted.size();
  for (const TileKey& key : wanted) {
    TileKey source = key;
    auto tile = pyramid.load(source);
    while (!tile && source.level < last) {
      source = source.parent();
      tile = pyramid.load(source);
    }
    if (tile) copy(report.level, key, source, *tile);
    if (source == key) continue;
    report.lacking.push_back(key);
    report.standing_in.push_back(source);
    report.error_m = std::max(report.error_m, pyramid.summary(source).error_m);
  }
  const auto filled = std::span(height_m_).first(nodes);
  const auto [lowest, highest] = std::ranges::minmax_element(filled);
  placement_.lowest_m = *lowest;
  placement_.highest_m = *highest;
  placement_.steepest = steepest_of(filled, placement_.columns, placement_.spacing_m);
  if (slopes_ == WindowSlopes::Formed) form_slopes();
  return report;
}

TerrainView TerrainWindow::view() const {
  const std::size_t count = placement_.columns * placement_.rows;
  TerrainView view = placement_;
  view.height_m = std::span(height_m_).first(count);
  if (slopes_ == WindowSlopes::Formed) view.slope = std::span(slope_).first(count);
  return view;
}

}  // namespace sigmascape::terrain
