#include "sigmascape/product/scope_layout.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/units.h"
#include "sigmascape/product/pixel_means.h"

namespace sigmascape::product {
namespace {

using radar::Channels;

/// Horizontal area of a bin of range row `range` on level ground, as docs/physics/receiver.md, Eq. (2) has it.
double bin_area_m2(const radar::RangeAzimuthGrid& grid, double range) {
  return (grid.first_range_m + range * grid.range_step_m) * grid.range_step_m * grid.azimuth_step_rad;
}

Channels sigma0_of(const radar::RangeAzimuthImage& image, std::size_t azimuth, std::size_t range) {
  const double area_m2 = bin_area_m2(image.grid, static_cast<double>(range) + 0.5);
  return image.rcs_m2(azimuth, range) * static_cast<float>(1.0 / area_m2);
}

/// The smallest box about the sector, x to the right and y upwards when `up_rad` is at the top.
radar::Rectangle box_about(const radar::RangeAzimuthGrid& grid, double up_rad) {
  const double near_m = grid.first_range_m;
  const double far_m = near_m + static_cast<double>(grid.ranges) * grid.range_step_m;
  const double first = grid.first_azimuth_rad - up_rad;
  const double last = first + static_cast<double>(grid.azimuths) * grid.azimuth_step_rad;
  radar::Rectangle box{1e300, 1e300, -1e300, -1e300};
  const auto include = [&box](double azimuth, double range_m) {
    const double x = range_m * std::sin(azimuth), y = range_m * std::cos(azimuth);
    box = {std::min(box.west_m, x), std::min(box.south_m, y), std::max(box.east_m, x), std::max(box.north_m, y)};
  };
  for (const double edge : {first, last}) {
    include(edge, near_m);
    include(edge, far_m);
  }
  for (double crossing = std::ceil(first / (pi / 2.0)) * (pi / 2.0); crossing < last; crossing += pi / 2.0) {
    include(crossing, far_m);
  }
  return box;
}

}  // namespace

radar::GroundMap ppi(const radar::RangeAzimuthImage& image, const PpiOptions& options) {
  const radar::RangeAzimuthGrid& bins = image.grid;
  const radar::Rectangle box = box_about(bins, options.up_rad);
  radar::GroundMap map;
  const double cell_m = std::max(box.width_m(), box.height_m()) / static_cast<double>(options.longer_side);
  map.grid = {box.west_m, box.north_m, cell_m, static_cast<std::size_t>(std::ceil(box.width_m() / cell_m)),
              static_cast<std::size_t>(std::ceil(box.height_m() / cell_m))};
  map.sigma0 = pixel_means(image, map.grid, options.up_rad);
  return map;
}

radar::GroundMap b_scope(const radar::RangeAzimuthImage& image) {
  const radar::RangeAzimuthGrid& bins = image.grid;
  radar::GroundMap map;
  map.grid = {0.0, static_cast<double>(bins.ranges) * bins.range_step_m, bins.range_step_m, bins.azimuths, bins.ranges};
  map.sigma0 = Array2D<Channels>(bins.azimuths, bins.ranges);
  for (std::size_t range = 0; range < bins.ranges; ++range) {
    for (std::size_t azimuth = 0; azimuth < bins.azimuths; ++azimuth) {
      map.sigma0(azimuth, bins.ranges - 1 - range) = sigma0_of(image, azimuth, range);
    }
  }
  return map;
}

}  // namespace sigmascape::product
