#include "sigmascape/live/row_places.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/vector_targets.h"
#include "sigmascape/live/lesser_greater.h"
#include "sigmascape/live/small_arc.h"

namespace sigmascape::live {
namespace {

SIGMASCAPE_VECTOR_TARGETS
void find_ranges(LatticeRow& row, const RowGeometry& geometry) {
  const double* const east = row.east_m.data();
  const double* const north = row.north_m.data();
  const float* const height = row.height_m.data();
  double* const range_m = row.range_m.data();
  float* const range_bin = row.range_bin.data();
  float* const ground = row.ground_m.data();
  float* const below = row.below_m.data();
  const double radar_height = geometry.radar_height_m, drop = geometry.drop_per_square_m;
  // docs/physics/curved_earth.md, Eq. (4), with sin² x = x² (1 − x²/3): good to a millimetre at 200 km.
  const double curvature = 2.0 * drop, raised = 1.0 + radar_height * curvature, series = curvature * curvature / 12.0;
  const double first_range = geometry.first_range_m, ranges_per_m = geometry.ranges_per_m;
  const std::size_t count = row.whole_vectors();
  SIGMASCAPE_INDEPENDENT_TURNS
  for (std::size_t i = 0; i < count; ++i) {
    const double square = east[i] * east[i] + north[i] * north[i];
    const double under = radar_height - static_cast<double>(height[i]) + drop * square;
    const auto above = static_cast<double>(height[i]);
    const double difference = radar_height - above;
    const double stretched = square * raised * (1.0 + above * curvature) * (1.0 - square * series);
    const double range = std::sqrt(stretched + difference * difference);
    range_m[i] = range;
    range_bin[i] = static_cast<float>((range - first_range) * ranges_per_m);
    ground[i] = std::sqrt(static_cast<float>(square));
    below[i] = static_cast<float>(under);
  }
}

SIGMASCAPE_VECTOR_TARGETS
void find_angles(LatticeRow& row, const RowGeometry& geometry) {
  const double* const east = row.east_m.data();
  const double* const north = row.north_m.data();
  const auto s = static_cast<float>(geometry.sin_middle), c = static_cast<float>(geometry.cos_middle);
  const auto middle_beam = static_cast<float>(geometry.middle_beam);
  const auto beams_per_rad = static_cast<float>(geometry.beams_per_rad);
  const auto tilt = static_cast<float>(2.0 * geometry.drop_per_square_m);
  const std::size_t count = row.whole_vectors();
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<float>(east[i]), y = static_cast<float>(north[i]);
    row.beam[i] = middle_beam + small_arc((x * c - y * s) / (x * s + y * c)) * beams_per_rad;
    const float fall = row.below_m[i] / row.ground_m[i];
    row.slope[i] = -fall;
    // The horizontal at the texel is tilted away from the radar's by the angle between their verticals.
    const float dip = tilt * row.ground_m[i];
    const float across = 1.0F + fall * dip, down = greater(fall - dip, 1e-6F * across);
    row.cotangent[i] = across / down;
    row.sine[i] = down / std::sqrt(across * across + down * down);
  }
}

/// Where a place lies from the middle direction.
struct FromMiddle {
  double ahead_m, across_m;

  FromMiddle(const LatticeRow& row, std::size_t i, const RowGeometry& geometry)
      : ahead_m(row.east_m[i] * geometry.sin_middle + row.north_m[i] * geometry.cos_middle),
        across_m(row.east_m[i] * geometry.cos_middle - row.north_m[i] * geometry.sin_middle) {}

  /// How far within an eighth of a turn either way.
  [[nodiscard]] double within_m() const { return ahead_m - std::abs(across_m); }
};

/// Whether a texel may lie where the small arc is none. What both ends of a row lie within all of it does, but for how
/// far scatterers stand from the middles of their texels.
bool may_turn(const LatticeRow& row, const RowGeometry& geometry) {
  const double spare_m = 2.5 * geometry.cell_m;
  return FromMiddle(row, 0, geometry).within_m() < spare_m ||
         FromMiddle(row, row.count - 1, geometry).within_m() < spare_m;
}

/// The same texels whatever else is in the row: bytes of a beam do not depend on which others are filled with it.
void find_large_angles(LatticeRow& row, const RowGeometry& geometry) {
  for (std::size_t i = 0; i < row.count; ++i) {
    const FromMiddle place(row, i, geometry);
    if (place.within_m() > 0.0) continue;
    row.beam[i] =
        static_cast<float>(geometry.middle_beam + std::atan2(place.across_m, place.ahead_m) * geometry.beams_per_rad);
  }
}

void stand_one_on(LatticeRow& row, const PageHeights& heights, std::size_t i, float per_rows) {
  const std::size_t column = (heights.first_column + i) >> heights.levels_up;
  const std::size_t left = std::max<std::size_t>(column, 1) - 1, right = std::min(column + 1, heights.last_column);
  const float rise_east = (heights.row[right] - heights.row[left]) / static_cast<float>(right - left);
  const float rise_north = (heights.north_row[column] - heights.south_row[column]) * per_rows;
  const double middle_m = heights.west_m + (static_cast<double>(column) + 0.5) * heights.texel_m;
  const auto east = static_cast<float>((row.east_m[i] - middle_m) / heights.texel_m);
  const auto north = static_cast<float>((row.north_m[i] - heights.north_m) / heights.texel_m);
  row.height_m[i] = heights.row[column] + rise_east * east + rise_north * north;
}

/// Texels whose page is their own and that have neighbours on both sides.
SIGMASCAPE_VECTOR_TARGETS
void stand_many_on(LatticeRow& row, const PageHeights& heights, std::size_t first, std::size_t end, float per_rows) {
  const float* const here = heights.row + heights.first_column;
  const float* const north_of = heights.north_row + heights.first_column;
  const float* const south_of = heights.south_row + heights.first_column;
  const double per_texel = 1.0 / heights.texel_m;
  const double west = heights.west_m * per_texel + static_cast<double>(heights.first_column) + 0.5;
  const double north_m = heights.north_m * per_texel;
  for (std::size_t i = first; i < end; ++i) {
    const double middle = west + static_cast<double>(static_cast<std::int32_t>(i));
    const auto east = static_cast<float>(row.east_m[i] * per_texel - middle);
    const auto north = static_cast<float>(row.north_m[i] * per_texel - north_m);
    row.height_m[i] =
        here[i] + (here[i + 1] - here[i - 1]) * 0.5F * east + (north_of[i] - south_of[i]) * per_rows * north;
  }
}

void stand_all_on(LatticeRow& row, const PageHeights& heights) {
  const float per_rows = heights.north_row != heights.row && heights.south_row != heights.row ? 0.5F : 1.0F;
  // The row after next, for the two to come.
  for (std::size_t i = 0; i < row.count; i += 64 / sizeof(float)) {
    __builtin_prefetch(heights.south_row + heights.first_column + i + atlas::tile_side, 0, 2);
  }
  if (heights.levels_up > 0) {
    for (std::size_t i = 0; i < row.count; ++i) stand_one_on(row, heights, i, per_rows);
    return;
  }
  const std::size_t first = heights.first_column == 0 ? 1 : 0;
  const std::size_t end = heights.first_column + row.count > heights.last_column ? row.count - 1 : row.count;
  if (first == 1) stand_one_on(row, heights, 0, per_rows);
  if (first < end) stand_many_on(row, heights, first, end, per_rows);
  if (end < row.count) stand_one_on(row, heights, end, per_rows);
}

/// Steps may go on to the end of a vector.
void go_on_with_last_height(LatticeRow& row) {
  std::fill_n(row.height_m.begin() + static_cast<std::ptrdiff_t>(row.count), row.whole_vectors() - row.count,
              row.height_m[row.count - 1]);
}

}  // namespace

void stand_on(LatticeRow& row, const PageHeights& heights) {
  stand_all_on(row, heights);
  go_on_with_last_height(row);
}

void stand_on(LatticeRow& row, const terrain::TerrainView& terrain, Vec2d radar) {
  for (std::size_t i = 0; i < row.count; ++i) {
    row.height_m[i] = static_cast<float>(terrain::height_at(terrain, radar + Vec2d{row.east_m[i], row.north_m[i]}));
  }
  go_on_with_last_height(row);
}

void locate(LatticeRow& row, const RowGeometry& geometry) {
  find_ranges(row, geometry);
  find_angles(row, geometry);
  if (may_turn(row, geometry)) find_large_angles(row, geometry);
}

}  // namespace sigmascape::live
