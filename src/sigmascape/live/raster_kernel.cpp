#include "sigmascape/live/raster_kernel.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sigmascape/live/terrain_raster.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sigmascape/live/raster_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sigmascape::live::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::CappedTag<float, 8>;
using Words = hn::RebindToUnsigned<Floats>;
using Float = hn::Vec<Floats>;
constexpr Floats floats;
constexpr Words words;

/// Corners of a triangle, in pixels from the tile's corner.
struct Corner {
  float x, y, nearness;
};

constexpr std::size_t side = TerrainRaster::tile_side;
/// A vector that begins in the tile may end beyond it.
constexpr std::size_t padded = side + 8;

struct Tile {
  alignas(64) float nearness[side * padded];
  alignas(64) std::uint32_t triangle[side * padded];
};

/// value = at_origin + x · per_column + y · per_row
struct Plane {
  float at_origin, per_column, per_row;
};

/// Twice the area between an edge and a place: positive to the left of it.
HWY_INLINE Plane edge(Corner from, Corner to) {
  const float per_column = from.y - to.y, per_row = to.x - from.x;
  return {-(from.x * per_column + from.y * per_row), per_column, per_row};
}

HWY_INLINE Float row_values(Plane plane, Float columns, float row) {
  return hn::Add(hn::Set(floats, plane.at_origin + row * plane.per_row),
                 hn::Mul(hn::Set(floats, plane.per_column), columns));
}

HWY_INLINE void draw(Tile& tile, Corner a, Corner b, Corner c, std::uint32_t triangle) {
  const float lowest_x = std::min({a.x, b.x, c.x}), highest_x = std::max({a.x, b.x, c.x});
  const float lowest_y = std::min({a.y, b.y, c.y}), highest_y = std::max({a.y, b.y, c.y});
  constexpr float last = static_cast<float>(side) - 0.5F;
  if (highest_x < 0.5F || highest_y < 0.5F || lowest_x > last || lowest_y > last) return;
  float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  // Ground that turns away is drawn as well: at the edge of the terrain a hill may be open towards the radar.
  if (area < 0.0F) {
    std::swap(b, c);
    area = -area;
  }
  if (!(area > 0.0F)) return;
  const float per_area = 1.0F / area;
  const Plane ab = edge(a, b), bc = edge(b, c), ca = edge(c, a);
  const float rise_b = (b.nearness - a.nearness) * per_area, rise_c = (c.nearness - a.nearness) * per_area;
  const Plane nearness{a.nearness + ca.at_origin * rise_b + ab.at_origin * rise_c,
                       ca.per_column * rise_b + ab.per_column * rise_c, ca.per_row * rise_b + ab.per_row * rise_c};

  const auto first_pixel = [](float lowest) {
    return static_cast<std::size_t>(std::max(std::ceil(lowest - 0.5F), 0.0F));
  };
  const auto end_pixel = [](float highest) {
    return static_cast<std::size_t>(std::min(std::floor(highest - 0.5F) + 1.0F, static_cast<float>(side)));
  };
  const std::size_t column_begin = first_pixel(lowest_x), column_end = end_pixel(highest_x);
  const Float zero = hn::Zero(floats);
  const auto id = hn::Set(words, triangle);
  for (std::size_t row = first_pixel(lowest_y); row < end_pixel(highest_y); ++row) {
    const float y = static_cast<float>(row) + 0.5F;
    for (std::size_t column = column_begin; column < column_end; column += hn::Lanes(floats)) {
      const Float x = hn::Iota(floats, static_cast<float>(column) + 0.5F);
      const auto inside = hn::And(hn::And(hn::Ge(row_values(ab, x, y), zero), hn::Ge(row_values(bc, x, y), zero)),
                                  hn::Ge(row_values(ca, x, y), zero));
      float* const drawn = tile.nearness + row * padded + column;
      std::uint32_t* const ids = tile.triangle + row * padded + column;
      const Float before = hn::LoadU(floats, drawn), now = row_values(nearness, x, y);
      const auto nearer = hn::And(inside, hn::Gt(now, before));
      hn::StoreU(hn::IfThenElse(nearer, now, before), floats, drawn);
      hn::StoreU(hn::IfThenElse(hn::RebindMask(words, nearer), id, hn::LoadU(words, ids)), words, ids);
    }
  }
}

void draw_blocks(const RasterMesh& mesh, std::span<const std::uint32_t> blocks, std::size_t left, std::size_t top,
                 std::uint32_t* triangles, std::size_t row_stride) {
  Tile tile;
  std::fill(std::begin(tile.nearness), std::end(tile.nearness), 0.0F);
  std::fill(std::begin(tile.triangle), std::end(tile.triangle), no_triangle);
  const auto left_px = static_cast<float>(left), top_px = static_cast<float>(top);
  const auto corner = [&](std::size_t node) {
    return Corner{mesh.x[node] - left_px, mesh.y[node] - top_px, mesh.nearness[node]};
  };
  for (const std::uint32_t block : blocks) {
    const std::size_t first_column = block % mesh.blocks_across() * RasterMesh::block_side;
    const std::size_t first_row = block / mesh.blocks_across() * RasterMesh::block_side;
    const std::size_t column_end = std::min(first_column + RasterMesh::block_side, mesh.columns - 1);
    const std::size_t row_end = std::min(first_row + RasterMesh::block_side, mesh.rows - 1);
    for (std::size_t row = first_row; row < row_end; ++row) {
      for (std::size_t column = first_column; column < column_end; ++column) {
        const std::size_t node = row * mesh.columns + column;
        const Corner nw = corner(node), ne = corner(node + 1), sw = corner(node + mesh.columns),
                     se = corner(node + mesh.columns + 1);
        if (!(std::min({nw.nearness, ne.nearness, sw.nearness, se.nearness}) > 0.0F)) continue;
        draw(tile, nw, sw, ne, static_cast<std::uint32_t>(2 * node));
        draw(tile, ne, sw, se, static_cast<std::uint32_t>(2 * node + 1));
      }
    }
  }
  for (std::size_t row = 0; row < side; ++row) {
    std::copy_n(tile.triangle + row * padded, side, triangles + row * row_stride);
  }
}

}  // namespace sigmascape::live::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sigmascape::live {

HWY_EXPORT(draw_blocks);

void draw_tile(const RasterMesh& mesh, std::span<const std::uint32_t> blocks, std::size_t left, std::size_t top,
               std::uint32_t* triangles, std::size_t row_stride) {
  HWY_DYNAMIC_DISPATCH(draw_blocks)(mesh, blocks, left, top, triangles, row_stride);
}

}  // namespace sigmascape::live
#endif
