#include "sigmascape/product/ground_projection.h"

#include <cmath>
#include <limits>

#include "sigmascape/base/parallel.h"
#include "sigmascape/base/units.h"

namespace sigmascape::product {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// Bilinear between the four nearest bins, which may lie at both ends where they go round; NaN where one of them is
/// missing.
radar::Channels bins_at(const Array2D<radar::Channels>& bins, bool goes_round, double column, double row) {
  const double left = std::floor(column - 0.5), top = std::floor(row - 0.5);
  const auto columns = static_cast<double>(bins.columns());
  const bool is_between = left >= 0.0 && left + 1.0 < columns;
  if (!(is_between || (goes_round && left >= -1.0 && left < columns)) || top < 0.0 ||
      top + 1.0 >= static_cast<double>(bins.rows())) {
    return {nan, nan, nan, nan};
  }
  const std::size_t c = left < 0.0 ? bins.columns() - 1 : static_cast<std::size_t>(left);
  const std::size_t next = (c + 1) % bins.columns(), r = static_cast<std::size_t>(top);
  const auto u = static_cast<float>(column - 0.5 - left), v = static_cast<float>(row - 0.5 - top);
  return bins(c, r) * ((1.0F - u) * (1.0F - v)) + bins(next, r) * (u * (1.0F - v)) + bins(c, r + 1) * ((1.0F - u) * v) +
         bins(next, r + 1) * (u * v);
}

/// Bins and where the radar stood.
struct SeenBins {
  const radar::RangeAzimuthGrid& grid;
  Vec3d radar_position;
  radar::CurvedEarth earth;
  const Array2D<radar::Channels>& bins;
};

/// Every cell takes the bins at its slant range and azimuth, times `factor_at` of that range.
template <typename FactorAt>
Array2D<radar::Channels> laid_on_cells(const SeenBins& seen, const terrain::HeightField& terrain,
                                       const radar::GroundGrid& grid, unsigned threads, const FactorAt& factor_at) {
  const radar::RangeAzimuthGrid& bins = seen.grid;
  const bool goes_round = bins.goes_round();
  const double middle = bins.first_azimuth_rad + 0.5 * static_cast<double>(bins.azimuths) * bins.azimuth_step_rad;
  Array2D<radar::Channels> cells(grid.columns, grid.rows);
  parallel_for(grid.rows, threads, [&](std::size_t row, unsigned) {
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const Vec2d point = grid.centre_of(column, row);
      const Vec2d foot{seen.radar_position.x, seen.radar_position.y};
      const Vec3d away = seen.earth.bent({point.x, point.y, terrain.height_at(point)}, foot) - seen.radar_position;
      const double range_m = length(away);
      const double azimuth = middle + turned_by_least(azimuth_of(away) - middle);
      const radar::Channels here =
          bins_at(seen.bins, goes_round, (azimuth - bins.first_azimuth_rad) / bins.azimuth_step_rad,
                  (range_m - bins.first_range_m) / bins.range_step_m);
      cells(column, row) = here * static_cast<float>(factor_at(range_m));
    }
  });
  return cells;
}

}  // namespace

radar::GroundMap ground_map(const radar::RangeAzimuthImage& image, const terrain::HeightField& terrain,
                            const radar::GroundGrid& grid, unsigned threads, const radar::CurvedEarth& earth) {
  const auto over_area = [&](double range_m) {
    return 1.0 / (range_m * image.grid.range_step_m * image.grid.azimuth_step_rad);
  };
  return {.grid = grid,
          .sigma0 =
              laid_on_cells({image.grid, image.radar_position, earth, image.rcs_m2}, terrain, grid, threads, over_area),
          .crs = {},
          .metadata = {}};
}

radar::PowerMap power_map(const radar::ReceivedImage& image, const terrain::HeightField& terrain,
                          const radar::GroundGrid& grid, unsigned threads, const radar::CurvedEarth& earth) {
  const auto as_it_is = [](double) { return 1.0; };
  return {.grid = grid,
          .power_w =
              laid_on_cells({image.grid, image.radar_position, earth, image.power_w}, terrain, grid, threads, as_it_is),
          .noise_w = image.noise_w,
          .crs = {},
          .metadata = {}};
}

}  // namespace sigmascape::product
