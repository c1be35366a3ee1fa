#include "sigmascape/terrain/height_difference.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sigmascape/radar/rectangle_parts.h"

namespace sigmascape::terrain {
namespace {

/// Columns or rows of nodes that lie within a stretch.
struct Within {
  std::size_t first = 0, end = 0;

  /// Both from where node 0 stands.
  Within(double from_m, double to_m, double spacing_m, std::size_t nodes) {
    const auto last = static_cast<double>(nodes) - 1.0;
    const double least = std::max(std::ceil(from_m / spacing_m), 0.0);
    const double greatest = std::min(std::floor(to_m / spacing_m), last);
    if (greatest < least) return;
    first = static_cast<std::size_t>(least);
    end = static_cast<std::size_t>(greatest) + 1;
  }
};

std::size_t stride_for(const HeightField& field, const radar::Rectangle& area) {
  constexpr double most_a_side = 1000.0;
  const double longer_m = std::max(area.width_m(), area.height_m());
  return static_cast<std::size_t>(std::max(std::ceil(longer_m / field.spacing_m / most_a_side), 1.0));
}

/// The first of every so many, from one on.
std::size_t next_of(std::size_t number, std::size_t stride) {
  return (number + stride - 1) / stride * stride;
}

}  // namespace

std::optional<HeightDifference> height_difference(TerrainPyramid& pyramid, const HeightField& field,
                                                  const radar::Rectangle& area) {
  const PyramidLayout& layout = pyramid.layout();
  const radar::Rectangle shared = radar::common_part(area, radar::common_part(field.extent(), pyramid.extent()));
  const std::size_t stride = stride_for(field, shared);
  std::vector<float> apart_m;
  for (std::uint32_t row = 0; row < layout.tiles_down; ++row) {
    for (std::uint32_t column = 0; column < layout.tiles_across; ++column) {
      const TileKey key{0, column, row};
      const radar::Rectangle under = layout.extent_of(key), part = radar::common_part(under, shared);
      const Within columns(part.west_m - field.west_m, part.east_m - field.west_m, field.spacing_m,
                           field.height_m.columns());
      const Within rows(field.north_m - part.north_m, field.north_m - part.south_m, field.spacing_m,
                        field.height_m.rows());
      if (columns.first == columns.end || rows.first == rows.end) continue;
      const auto tile = pyramid.load(key);
      if (tile == nullptr) continue;
      for (std::size_t j = next_of(rows.first, stride); j < rows.end; j += stride) {
        for (std::size_t i = next_of(columns.first, stride); i < columns.end; i += stride) {
          const double east_m = field.west_m + static_cast<double>(i) * field.spacing_m - under.west_m;
          const double south_m = under.north_m - field.north_m + static_cast<double>(j) * field.spacing_m;
          const float there_m = tile->at(east_m / layout.spacing_m, south_m / layout.spacing_m);
          apart_m.push_back(std::abs(there_m - field.height_m(i, j)));
        }
      }
    }
  }
  if (apart_m.empty()) return std::nullopt;
  std::ranges::sort(apart_m);
  return HeightDifference{static_cast<double>(apart_m[apart_m.size() / 2]),
                          static_cast<double>(apart_m[apart_m.size() * 99 / 100]), static_cast<double>(apart_m.back())};
}

}  // namespace sigmascape::terrain
