#include "sigmascape/live/terrain_raster.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "sigmascape/base/units.h"
#include "sigmascape/live/raster_kernel.h"
#include "sigmascape/radar/look.h"

namespace sigmascape::live {
namespace {

/// Terrain must stay this far below the radar to be drawn, as a share of the radar's height above the plane.
constexpr double least_clearance = 0.01;

/// By how much nearer, as a share, another triangle must be to hide a point: what rounding leaves.
constexpr float nearness_tolerance = 1e-6F;

struct Bounds {
  double lowest_x = std::numeric_limits<double>::max(), highest_x = std::numeric_limits<double>::lowest();
  double lowest_y = std::numeric_limits<double>::max(), highest_y = std::numeric_limits<double>::lowest();

  void include(Vec2d p) {
    lowest_x = std::min(lowest_x, p.x), highest_x = std::max(highest_x, p.x);
    lowest_y = std::min(lowest_y, p.y), highest_y = std::max(highest_y, p.y);
  }
};

/// Which of the two triangles of a cell a place belongs to, and the height of that triangle there.
struct OnTriangle {
  std::uint32_t triangle;
  float height_m;
};

OnTriangle on_triangle(const terrain::TerrainView& view, const terrain::PlaceInCell& place) {
  const float* const nw = view.height_m.data() + place.north_west;
  const auto u = static_cast<float>(place.u), v = static_cast<float>(place.v);
  const float north_west = nw[0], north_east = nw[1], south_west = nw[view.columns], south_east = nw[view.columns + 1];
  const auto first = static_cast<std::uint32_t>(2 * place.north_west);
  if (u + v < 1.0F) return {first, north_west + u * (north_east - north_west) + v * (south_west - north_west)};
  return {first + 1, south_east + (1.0F - u) * (south_west - south_east) + (1.0F - v) * (north_east - south_east)};
}

/// The drawn triangles.
struct Nodes {
  const float *x, *y, *nearness;
  std::size_t columns;

  [[nodiscard]] bool turns_away(std::uint32_t triangle) const {
    const auto [a, b, c] = nodes_of(triangle, columns);
    return (x[b] - x[a]) * (y[c] - y[a]) - (y[b] - y[a]) * (x[c] - x[a]) <= 0.0F;
  }

  /// Nearness of the triangle's plane on a line of sight, and whether that meets the triangle itself.
  [[nodiscard]] float nearness_at(std::uint32_t triangle, float px, float py, bool& inside) const {
    const auto [a, b, c] = nodes_of(triangle, columns);
    const float ax = x[a] - px, ay = y[a] - py, bx = x[b] - px, by = y[b] - py, cx = x[c] - px, cy = y[c] - py;
    const float of_a = bx * cy - by * cx, of_b = cx * ay - cy * ax, of_c = ax * by - ay * bx;
    inside = (of_a >= 0.0F && of_b >= 0.0F && of_c >= 0.0F) || (of_a <= 0.0F && of_b <= 0.0F && of_c <= 0.0F);
    return (of_a * nearness[a] + of_b * nearness[b] + of_c * nearness[c]) / (of_a + of_b + of_c);
  }
};

}  // namespace

TerrainRaster::Projected TerrainRaster::project(Vec2d point, double height_m) const {
  const Vec2d from_foot = point - Vec2d{radar_.x, radar_.y};
  const double clearance_m = radar_.z + drop_per_square_m_ * dot(from_foot, from_foot) - height_m;
  const double above_plane_m = radar_.z - picture_.plane_m;
  if (clearance_m < least_clearance * above_plane_m) return {0.0F, 0.0F, -1.0F};
  const double scale = above_plane_m / clearance_m;
  return {static_cast<float>((dot(from_foot, picture_.rightwards) * scale - picture_.left_m) * picture_.pixels_per_m),
          static_cast<float>((dot(from_foot, picture_.outwards) * scale - picture_.near_m) * picture_.pixels_per_m),
          static_cast<float>(above_plane_m / clearance_m)};
}

void TerrainRaster::place_picture(const HorizonGrid& grid, const RasterSettings& settings) {
  const auto azimuth_rad = [&grid](std::size_t azimuth) {
    return grid.first_azimuth_rad + static_cast<double>(azimuth) * grid.azimuth_step_rad;
  };
  const double middle_rad = azimuth_rad(grid.azimuths / 2);
  picture_ = {.outwards = radar::horizontal_direction(middle_rad),
              .rightwards = radar::horizontal_direction(middle_rad + 0.5 * pi)};
  picture_.plane_m = 0.5 * static_cast<double>(view_.lowest_m + view_.highest_m);
  // The sector's corners at the lowest and the highest terrain hold all its points between them.
  Bounds bounds;
  constexpr std::size_t azimuths = 257;
  for (std::size_t i = 0; i < azimuths; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(azimuths - 1);
    const double turned_rad =
        azimuth_rad(0) - middle_rad + part * grid.azimuth_step_rad * static_cast<double>(grid.azimuths - 1);
    for (const double distance_m : {grid.near_m, grid.near_m + grid.step_m * static_cast<double>(grid.distances - 1)}) {
      for (const double height_m : {static_cast<double>(view_.lowest_m), static_cast<double>(view_.highest_m)}) {
        const double above_plane_m = radar_.z - picture_.plane_m;
        const double clearance_m = std::max(radar_.z + drop_per_square_m_ * distance_m * distance_m - height_m,
                                            least_clearance * above_plane_m);
        const double drawn_m = distance_m * above_plane_m / clearance_m;
        bounds.include({drawn_m * std::sin(turned_rad), drawn_m * std::cos(turned_rad)});
      }
    }
  }
  const double width_m = bounds.highest_x - bounds.lowest_x, depth_m = bounds.highest_y - bounds.lowest_y;
  const double finest_px_per_m = std::sqrt(2.0 * settings.pixels_per_triangle) / view_.spacing_m;
  const double room_px = static_cast<double>(settings.longest_side) - 4.0;
  picture_.pixels_per_m = std::min(finest_px_per_m, room_px / std::max(width_m, depth_m));
  picture_.left_m = bounds.lowest_x - 2.0 / picture_.pixels_per_m;
  picture_.near_m = bounds.lowest_y - 2.0 / picture_.pixels_per_m;
  const auto tiles = [&](double size_m) {
    return static_cast<std::size_t>((size_m * picture_.pixels_per_m + 4.0) / static_cast<double>(tile_side)) + 1;
  };
  tiles_across_ = tiles(width_m);
  tiles_down_ = tiles(depth_m);
}

void TerrainRaster::sort_blocks() {
  const RasterMesh mesh{x_.data(), y_.data(), nearness_.data(), view_.columns, view_.rows};
  const std::size_t tiles = tiles_across_ * tiles_down_;
  tile_begin_.assign(tiles + 1, 0);
  // Twice over the blocks: to count what falls into each tile, and to put it there.
  const auto for_each_touch = [&](const auto& touch) {
    for (std::size_t block = 0; block < mesh.blocks_across() * mesh.blocks_down(); ++block) {
      const std::size_t first_column = block % mesh.blocks_across() * RasterMesh::block_side;
      const std::size_t first_row = block / mesh.blocks_across() * RasterMesh::block_side;
      float lowest_x = 1e30F, highest_x = -1e30F, lowest_y = 1e30F, highest_y = -1e30F;
      for (std::size_t row = first_row; row < std::min(first_row + RasterMesh::block_side + 1, view_.rows); ++row) {
        const std::size_t end = std::min(first_column + RasterMesh::block_side + 1, view_.columns);
        for (std::size_t node = row * view_.columns + first_column; node < row * view_.columns + end; ++node) {
          if (nearness_[node] <= 0.0F) continue;
          lowest_x = std::min(lowest_x, x_[node]), highest_x = std::max(highest_x, x_[node]);
          lowest_y = std::min(lowest_y, y_[node]), highest_y = std::max(highest_y, y_[node]);
        }
      }
      const auto side = static_cast<float>(tile_side);
      const auto last_x = static_cast<float>(columns()) - 0.5F, last_y = static_cast<float>(rows()) - 0.5F;
      if (lowest_x > last_x || lowest_y > last_y || highest_x < 0.0F || highest_y < 0.0F) continue;
      const auto tile_of = [&](float at, float last) {
        return static_cast<std::size_t>(std::clamp(at, 0.0F, last) / side);
      };
      for (std::size_t row = tile_of(lowest_y, last_y); row <= tile_of(highest_y, last_y); ++row) {
        for (std::size_t column = tile_of(lowest_x, last_x); column <= tile_of(highest_x, last_x); ++column) {
          touch(row * tiles_across_ + column, static_cast<std::uint32_t>(block));
        }
      }
    }
  };
  for_each_touch([&](std::size_t tile, std::uint32_t) { ++tile_begin_[tile]; });
  std::uint32_t total = 0;
  for (std::uint32_t& begin : tile_begin_) {
    total += begin;
    begin = total;
  }
  tile_blocks_.resize(std::max<std::size_t>(tile_blocks_.size(), total));
  // Filled from the back of each tile's share, which leaves every begin where it belongs.
  for_each_touch([&](std::size_t tile, std::uint32_t block) { tile_blocks_[--tile_begin_[tile]] = block; });
}

std::size_t TerrainRaster::draw(const Vec3d& radar, const HorizonGrid& grid, const terrain::TerrainView& view,
                                const RasterSettings& settings, WorkerTeam& team) {
  radar_ = radar;
  view_ = view;
  drop_per_square_m_ = grid.drop_per_square_m;
  place_picture(grid, settings);
  const std::size_t nodes = view.columns * view.rows;
  for (auto* layer : {&x_, &y_, &nearness_}) layer->resize(std::max(layer->size(), nodes));
  std::atomic<std::size_t> left_out{0};
  team.run(view.rows, [&](std::size_t row, unsigned) {
    std::size_t too_high = 0;
    for (std::size_t column = 0; column < view.columns; ++column) {
      const std::size_t node = row * view.columns + column;
      const Projected projected = project(view.node(column, row), static_cast<double>(view.height_m[node]));
      x_[node] = projected.x;
      y_[node] = projected.y;
      nearness_[node] = projected.nearness;
      too_high += projected.nearness < 0.0F ? 2 : 0;
    }
    left_out += too_high;
  });
  sort_blocks();
  triangle_.resize(std::max(triangle_.size(), columns() * rows()));
  const RasterMesh mesh{x_.data(), y_.data(), nearness_.data(), view.columns, view.rows};
  team.run(tiles_across_ * tiles_down_, [&](std::size_t tile, unsigned) {
    const std::size_t left = tile % tiles_across_ * tile_side, top = tile / tiles_across_ * tile_side;
    draw_tile(mesh, std::span(tile_blocks_).subspan(tile_begin_[tile], tile_begin_[tile + 1] - tile_begin_[tile]), left,
              top, triangle_.data() + top * columns() + left, columns());
  });
  return left_out;
}

bool TerrainRaster::sees(Vec2d point) const {
  if (!view_.extent().contains(point)) return false;
  const Nodes nodes{x_.data(), y_.data(), nearness_.data(), view_.columns};
  const OnTriangle own = on_triangle(view_, terrain::place_in_cell(view_, point));
  const Projected at = project(point, static_cast<double>(own.height_m));
  const double last_x = static_cast<double>(columns()) - 2.0, last_y = static_cast<double>(rows()) - 2.0;
  if (at.nearness <= 0.0F || at.x < 1.0F || at.y < 1.0F || static_cast<double>(at.x) >= last_x ||
      static_cast<double>(at.y) >= last_y) {
    return false;
  }
  if (nodes.turns_away(own.triangle)) return false;
  const std::uint32_t nearest = drawn_at(at.x, at.y);
  if (nearest == own.triangle) return true;
  const float limit = at.nearness * (1.0F + nearness_tolerance);
  bool known = nearest == no_triangle, all_over_it = true;
  for (const float dx : {-1.0F, 0.0F, 1.0F}) {
    for (const float dy : {-1.0F, 0.0F, 1.0F}) {
      const std::uint32_t other = drawn_at(at.x + dx, at.y + dy);
      if (other == no_triangle) continue;
      bool inside = other == own.triangle;
      const bool over_it = !inside && nodes.nearness_at(other, at.x, at.y, inside) > limit;
      if (inside && over_it) return false;
      known = known || inside;
      all_over_it = all_over_it && over_it;
    }
  }
  // Where all triangles about are too small to hold the point, it is hidden when it lies below the planes of all.
  return known || !all_over_it;
}

}  // namespace sigmascape::live
