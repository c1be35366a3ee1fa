#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace sigmascape::live {

/// No triangle was drawn here.
inline constexpr std::uint32_t no_triangle = 0xffffffffU;

/// Terrain as it lies in the picture: its nodes, in blocks of cells, two triangles a cell.
struct RasterMesh {
  static constexpr std::size_t block_side = 16;
  const float* x = nullptr;         ///< pixel columns
  const float* y = nullptr;         ///< pixel rows
  const float* nearness = nullptr;  ///< 1 / (radar height − height); not above zero: cannot be drawn
  std::size_t columns = 0, rows = 0;

  [[nodiscard]] std::size_t blocks_across() const { return (columns - 1 + block_side - 1) / block_side; }
  [[nodiscard]] std::size_t blocks_down() const { return (rows - 1 + block_side - 1) / block_side; }
};

/// Nodes of a triangle, counter-clockwise from above. Triangles 2·n and 2·n + 1 halve the cell whose north-western node
/// is n, from north-east to south-west, as the path tracer's terrain is.
struct TriangleNodes {
  std::size_t a, b, c;
};
[[nodiscard]] constexpr TriangleNodes nodes_of(std::uint32_t triangle, std::size_t columns) {
  const std::size_t north_west = triangle / 2, north_east = north_west + 1, south_west = north_west + columns;
  return triangle % 2 == 0 ? TriangleNodes{north_west, south_west, north_east}
                           : TriangleNodes{north_east, south_west, south_west + 1};
}

/// Draws the listed blocks into one tile of `side` pixels whose first pixel is (left, top): the nearest triangle of
/// every pixel centre, rows of `row_stride` apart.
void draw_tile(const RasterMesh& mesh, std::span<const std::uint32_t> blocks, std::size_t left, std::size_t top,
               std::uint32_t* triangles, std::size_t row_stride);

}  // namespace sigmascape::live
