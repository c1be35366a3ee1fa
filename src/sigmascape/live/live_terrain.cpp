#include "sigmascape/live/live_terrain.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sigmascape/render/level_of_detail.h"

namespace sigmascape::live {
namespace {

/// Nodes under the 256 × 256 texels of a page, which stand no closer than its texels but on the finest level.
constexpr std::size_t most_nodes_under_page = 300;

std::int16_t packed(double rise) {
  const double steps = rise * static_cast<double>(terrain::PackedSlope::steps_per_unit);
  return static_cast<std::int16_t>(std::lround(std::clamp(steps, -32767.0, 32767.0)));
}

}  // namespace

LiveTerrain::LiveTerrain(std::shared_ptr<terrain::TerrainPyramid> pyramid, std::size_t budget_bytes)
    : pyramid_(std::move(pyramid)),
      coarsest_(pyramid_->load({pyramid_->levels() - 1, 0, 0})),
      windows_(pyramid_, budget_bytes) {}

int LiveTerrain::level_for(double texel_m) const {
  return render::terrain_level_for(texel_m, pyramid_->layout().spacing_m, pyramid_->levels());
}

LiveTerrain::Window LiveTerrain::window_over(const radar::Rectangle& area, double texel_m,
                                             std::size_t most_nodes_a_side) const {
  terrain::TerrainWindow nodes(most_nodes_a_side, terrain::WindowSlopes::None);
  const terrain::WindowReport report = nodes.fill(*pyramid_, area, level_for(texel_m));
  return {std::move(nodes), shortage_of(report)};
}

LiveTerrain::Window LiveTerrain::ground_under(const radar::GroundGrid& cells) const {
  const int level = level_for(cells.cell_m);
  // Between nodes that stand wide apart the ground is rounder than the facets that they span.
  terrain::TerrainWindow window(most_nodes_under_page,
                                level == 0 ? terrain::WindowSlopes::None : terrain::WindowSlopes::Formed);
  // A node more on all sides, for slopes at the edge to be those of the neighbouring page.
  const double spacing_m = pyramid_->layout().spacing_at(level);
  const radar::Rectangle whole = pyramid_->layout().extent();
  const auto inside = [](double position, double least, double most) { return std::clamp(position, least, most); };
  const radar::Rectangle here = cells.extent();
  const radar::Rectangle area{inside(here.west_m - spacing_m, whole.west_m, whole.east_m - spacing_m),
                              inside(here.south_m - spacing_m, whole.south_m, whole.north_m - spacing_m),
                              inside(here.east_m + spacing_m, whole.west_m + spacing_m, whole.east_m),
                              inside(here.north_m + spacing_m, whole.south_m + spacing_m, whole.north_m)};
  const terrain::WindowReport report = window.fill(*pyramid_, area, level);
  return {std::move(window), shortage_of(report)};
}

Shortage LiveTerrain::shortage_of(const terrain::WindowReport& report) const {
  if (report.lacking.empty()) return {};
  return [pyramid = pyramid_, lacking = report.lacking, standing_in = report.standing_in] {
    for (std::size_t i = 0; i < lacking.size(); ++i) {
      for (terrain::TileKey key = lacking[i]; key.level < standing_in[i].level; key = key.parent()) {
        if (pyramid->load(key) != nullptr) return true;
      }
    }
    return false;
  };
}

double LiveTerrain::height_at(Vec2d point) const {
  const double cell_m = pyramid_->layout().spacing_m / 2.0;
  float height_m = 0.0F;
  fill_heights(
      {.west_m = point.x - cell_m / 2.0, .north_m = point.y + cell_m / 2.0, .cell_m = cell_m, .columns = 1, .rows = 1},
      {&height_m, 1});
  return static_cast<double>(height_m);
}

Shortage LiveTerrain::fill_heights(const radar::GroundGrid& cells, std::span<float> height_m) const {
  auto [window, shortage] = ground_under(cells);
  const terrain::TerrainView ground = window.view();
  for (std::size_t row = 0; row < cells.rows; ++row) {
    for (std::size_t column = 0; column < cells.columns; ++column) {
      height_m[row * cells.columns + column] =
          static_cast<float>(terrain::height_at(ground, cells.centre_of(column, row)));
    }
  }
  return std::move(shortage);
}

Shortage LiveTerrain::fill_slopes(const radar::GroundGrid& cells, std::span<terrain::PackedSlope> slope) const {
  auto [window, shortage] = ground_under(cells);
  const terrain::TerrainView ground = window.view();
  for (std::size_t row = 0; row < cells.rows; ++row) {
    for (std::size_t column = 0; column < cells.columns; ++column) {
      const Vec2d rise = terrain::slope_at(ground, cells.centre_of(column, row));
      slope[row * cells.columns + column] = {packed(rise.x), packed(rise.y)};
    }
  }
  return std::move(shortage);
}

LiveTerrain::Surface LiveTerrain::surface(const TerrainWindows::View& there, int level, const radar::Rectangle& area,
                                          std::vector<WindowWish>& wanted) const {
  const WindowWish wish = windows_.wish_for(level, area);
  const GroundWindow* const window = there.find(wish);
  const bool is_wanting = window == nullptr || window->level != wish.level || window->is_worth_another_try();
  if (is_wanting && wanted.size() < wanted.capacity()) wanted.push_back(wish);
  if (window == nullptr) {
    const int last = pyramid_->levels() - 1;
    const terrain::PyramidLayout& layout = pyramid_->layout();
    return {.view = {.lattice_west_m = layout.west_m,
                     .lattice_north_m = layout.north_m,
                     .spacing_m = layout.spacing_at(last),
                     .columns = terrain::HeightTile::nodes,
                     .rows = terrain::HeightTile::nodes,
                     .height_m = coarsest_->height_m,
                     .lowest_m = coarsest_->summary.lowest_m,
                     .highest_m = coarsest_->summary.highest_m},
            .error_m = last == level ? 0.0F : coarsest_->summary.error_m,
            .above_pages_m = last == level ? 0.0F : coarsest_->summary.error_m};
  }
  // A level's error is that of all finer ones together.
  const int coarser = std::max(window->level, level);
  const float of_level = window->level == level ? 0.0F : pyramid_->summary_over(wish.area, coarser).error_m;
  Surface surface{
      .view = window->nodes.view(), .error_m = std::max(of_level, window->error_m), .above_pages_m = of_level};
  // How far a frame looks for what hides must not depend on how far the window reaches beyond the area.
  const terrain::TileSummary bounds = pyramid_->summary_over(area, window->level);
  surface.view.lowest_m = bounds.lowest_m - window->error_m;
  surface.view.highest_m = bounds.highest_m + window->error_m;
  return surface;
}

double LiveTerrain::depth_below(const Surface& surface, int level, Vec3d point) const {
  const Vec2d foot{point.x, point.y};
  if (!pyramid_->extent().contains(foot)) return 0.0;
  const float of_level = pyramid_->summary_over({foot.x, foot.y, foot.x, foot.y}, level).error_m;
  const double lowest_m =
      terrain::height_at(surface.view, foot) - static_cast<double>(std::max(surface.error_m, of_level));
  return std::max(lowest_m - point.z, 0.0);
}

}  // namespace sigmascape::live
