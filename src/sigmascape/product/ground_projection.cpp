#include "sigmascape/product/ground_projection.h"

#include <cmath>
#include <limits>

#include "sigmascape/base/parallel.h"
#include "sigmascape/base/units.h"

namespace sigmascape::product {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// Bilinear between the four nearest bins; NaN where one of them is missing.
radar::Channels bins_at(const Array2D<radar::Channels>& bins, double column, double row) {
  const double left = std::floor(column - 0.5), top = std::floor(row - 0.5);
  if (left < 0.0 || top < 0.0 || left + 1.0 >= static_cast<double>(bins.columns()) ||
      top + 1.0 >= static_cast<double>(bins.rows())) {
    return {nan, nan, nan, nan};
  }
  const auto c = static_cast<std::size_t>(left), r = static_cast<std::size_t>(top);
  const auto u = static_cast<float>(column - 0.5 - left), v = static_cast<float>(row - 0.5 - top);
  return bins(c, r) * ((1.0F - u) * (1.0F - v)) + bins(c + 1, r) * (u * (1.0F - v)) +
         bins(c, r + 1) * ((1.0F - u) * v) + bins(c + 1, r + 1) * (u * v);
}

}  // namespace

radar::GroundMap ground_map(const radar::RangeAzimuthImage& image, const terrain::HeightField& terrain,
                            const radar::GroundGrid& grid, unsigned threads) {
  const radar::RangeAzimuthGrid& bins = image.grid;
  const double middle = bins.first_azimuth_rad + 0.5 * static_cast<double>(bins.azimuths) * bins.azimuth_step_rad;
  radar::GroundMap map{
      .grid = grid, .sigma0 = Array2D<radar::Channels>(grid.columns, grid.rows), .crs = {}, .metadata = {}};
  parallel_for(grid.rows, threads, [&](std::size_t row, unsigned) {
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const Vec2d point = grid.centre_of(column, row);
      const Vec3d away = Vec3d{point.x, point.y, terrain.height_at(point)} - image.radar_position;
      const double range_m = length(away);
      const double azimuth = middle + turned_by_least(std::atan2(away.x, away.y) - middle);
      const radar::Channels rcs = bins_at(image.rcs_m2, (azimuth - bins.first_azimuth_rad) / bins.azimuth_step_rad,
                                          (range_m - bins.first_range_m) / bins.range_step_m);
      map.sigma0(column, row) = rcs * static_cast<float>(1.0 / (range_m * bins.range_step_m * bins.azimuth_step_rad));
    }
  });
  return map;
}

}  // namespace sigmascape::product
