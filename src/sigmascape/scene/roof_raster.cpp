#include "sigmascape/scene/roof_raster.h"

#include <algorithm>
#include <cmath>

namespace sigmascape::scene {
namespace {

/// Twice the area of the triangle's shadow at noon, positive when it runs anticlockwise from above.
double twice_plan_area(Vec3d a, Vec3d b, Vec3d c) {
  return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

}  // namespace

RoofRaster::RoofRaster(const radar::GroundGrid& squares, std::size_t most_rows)
    : parts_{parts_of(squares, parts_per_side)}, height_m_(parts_.grid.columns, most_rows * parts_per_side) {}

void RoofRaster::move_to(std::size_t first_row, std::size_t rows) {
  parts_.first_row = first_row * parts_per_side;
  parts_.rows = rows * parts_per_side;
  std::ranges::fill(height_m_.values(), 0.0F);
}

void RoofRaster::add(const Corners& triangle, const terrain::HeightField& ground) {
  const Vec3d a = triangle[0], b = triangle[1], c = triangle[2];
  const double whole = twice_plan_area(a, b, c);
  if (std::abs(whole) < 1e-9) return;  // a wall
  parts_.for_cells_under(plan_of(triangle), [&](std::size_t column, std::size_t row) {
    const Vec2d p = parts_.grid.centre_of(column, row);
    const Vec3d at{p.x, p.y, 0.0};
    const double of_b = twice_plan_area(a, at, c) / whole, of_c = twice_plan_area(a, b, at) / whole;
    if (of_b < 0.0 || of_c < 0.0 || of_b + of_c > 1.0) return;
    const double height = a.z + of_b * (b.z - a.z) + of_c * (c.z - a.z) - ground.height_at(p);
    float& highest = height_m_(column, row - parts_.first_row);
    highest = std::max(highest, static_cast<float>(height));
  });
}

float RoofRaster::solid_top_m(std::size_t column, std::size_t row) const {
  float highest = 0.0F;
  std::size_t covered = 0;
  for (std::size_t j = 0; j < parts_per_side; ++j) {
    for (std::size_t i = 0; i < parts_per_side; ++i) {
      const float height = height_m_(column * parts_per_side + i, row * parts_per_side + j - parts_.first_row);
      highest = std::max(highest, height);
      if (height > 0.0F) ++covered;
    }
  }
  return 2 * covered >= parts_per_side * parts_per_side ? highest : 0.0F;
}

}  // namespace sigmascape::scene
