#include "sigmascape/terrain/ground_profile.h"

#include "sigmascape/base/vector_targets.h"

namespace sigmascape::terrain {
namespace {

double lesser(double a, double b) {
  return a < b ? a : b;
}
double greater(double a, double b) {
  return a > b ? a : b;
}

SIGMASCAPE_VECTOR_TARGETS
void find_places(const GroundLine& line, std::size_t first, std::size_t count, double* __restrict distance_m,
                 double* __restrict x, double* __restrict y) {
  const Vec2d origin = line.origin, direction = line.direction;
  const double near_m = line.near_m, step_m = line.step_m, first_place = static_cast<double>(first);
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(count); ++i) {
    const double distance = near_m + (first_place + static_cast<double>(i) + 0.5) * step_m;
    distance_m[i] = distance;
    x[i] = origin.x + direction.x * distance;
    y[i] = origin.y + direction.y * distance;
  }
}

/// HeightField::height_at of many places.
SIGMASCAPE_VECTOR_TARGETS
void find_heights(const HeightField& field, const double* __restrict x, const double* __restrict y, std::size_t count,
                  double* __restrict height_m) {
  const double west_m = field.west_m, north_m = field.north_m, spacing_m = field.spacing_m;
  const double last_column = static_cast<double>(field.height_m.columns() - 1),
               last_row = static_cast<double>(field.height_m.rows() - 1);
  const auto columns = static_cast<std::uint32_t>(field.height_m.columns());
  const float* __restrict heights = field.height_m.values().data();
  for (std::size_t i = 0; i < count; ++i) {
    const double across = lesser(greater((x[i] - west_m) / spacing_m, 0.0), last_column);
    const double down = lesser(greater((north_m - y[i]) / spacing_m, 0.0), last_row);
    const auto column = static_cast<std::int32_t>(lesser(across, last_column - 1.0));
    const auto row = static_cast<std::int32_t>(lesser(down, last_row - 1.0));
    const double u = across - static_cast<double>(column), v = down - static_cast<double>(row);
    const std::uint64_t node =
        static_cast<std::uint64_t>(static_cast<std::uint32_t>(row)) * columns + static_cast<std::uint32_t>(column);
    const double north = (1.0 - u) * static_cast<double>(heights[node]) + u * static_cast<double>(heights[node + 1]);
    const double south =
        (1.0 - u) * static_cast<double>(heights[node + columns]) + u * static_cast<double>(heights[node + columns + 1]);
    height_m[i] = (1.0 - v) * north + v * south;
  }
}

/// Where in a map places lie, −1 outside it.
SIGMASCAPE_VECTOR_TARGETS
void find_cells(const radar::GroundGrid& grid, const double* __restrict x, const double* __restrict y,
                std::size_t count, std::int64_t* __restrict cell) {
  const double west_m = grid.west_m, north_m = grid.north_m, cell_m = grid.cell_m;
  const auto columns = static_cast<double>(grid.columns), rows = static_cast<double>(grid.rows);
  const auto stride = static_cast<std::uint32_t>(grid.columns);
  for (std::size_t i = 0; i < count; ++i) {
    const double across = (x[i] - west_m) / cell_m, down = (north_m - y[i]) / cell_m;
    const bool is_inside = (across >= 0.0) & (down >= 0.0) & (across < columns) & (down < rows);
    const auto column = static_cast<std::int32_t>(is_inside ? across : 0.0);
    const auto row = static_cast<std::int32_t>(is_inside ? down : 0.0);
    const auto at = static_cast<std::int64_t>(static_cast<std::uint64_t>(static_cast<std::uint32_t>(row)) * stride +
                                              static_cast<std::uint32_t>(column));
    cell[i] = is_inside ? at : -1;
  }
}

}  // namespace

void GroundProfile::read(const GroundLine& line, std::size_t first, std::size_t count) {
  find_places(line, first, count, distance_m_.data(), x_.data(), y_.data());
  find_heights(*terrain_, x_.data(), y_.data(), count, height_m_.data());
  if (obstacles_ != nullptr) find_cells(obstacles_->grid, x_.data(), y_.data(), count, obstacle_.data());
}

}  // namespace sigmascape::terrain
