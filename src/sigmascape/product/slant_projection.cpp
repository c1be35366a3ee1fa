#include "sigmascape/product/slant_projection.h"

#include <cmath>
#include <limits>

#include "sigmascape/base/parallel.h"

namespace sigmascape::product {
namespace {

/// Half the distance over which places are compared, in metres: small beside ranges, large beside rounding.
constexpr double half_step_m = 0.5;

/// Horizontal area that bins of one by one cover at a point, with the surface's slope left out: map area is area over
/// level ground, as in the power mode.
template <typename Image>
double bin_area_m2(const Image& image, Vec3d point) {
  const Vec2d east = image.place_of(point + Vec3d{half_step_m, 0.0, 0.0}),
              west = image.place_of(point - Vec3d{half_step_m, 0.0, 0.0});
  const Vec2d north = image.place_of(point + Vec3d{0.0, half_step_m, 0.0}),
              south = image.place_of(point - Vec3d{0.0, half_step_m, 0.0});
  return 1.0 / std::abs(cross(east - west, north - south));
}

radar::Channels power(const radar::ComplexChannels& bin) {
  return radar::power_of(bin);
}
radar::Channels power(const radar::Channels& bin) {
  return bin;
}

template <typename Bin>
radar::Channels power_at(const Array2D<Bin>& bins, Vec2d place) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const double column = place.x - 0.5, row = place.y - 0.5;
  if (!(column >= 0.0 && row >= 0.0 && column < static_cast<double>(bins.columns()) - 1.0 &&
        row < static_cast<double>(bins.rows()) - 1.0)) {
    return {nan, nan, nan, nan};
  }
  const auto left = static_cast<std::size_t>(column), top = static_cast<std::size_t>(row);
  const auto right_share = static_cast<float>(column - static_cast<double>(left));
  const auto lower_share = static_cast<float>(row - static_cast<double>(top));
  radar::Channels sum;
  for (const std::size_t down : {0U, 1U}) {
    for (const std::size_t across : {0U, 1U}) {
      const float share =
          (across == 1 ? right_share : 1.0F - right_share) * (down == 1 ? lower_share : 1.0F - lower_share);
      sum += power(bins(left + across, top + down)) * share;
    }
  }
  return sum;
}

/// Bins a resolution cell.
double cell_of(const radar::RangeDopplerImage& image) {
  return image.range_cell_m / image.range_m.step * (image.doppler_cell_hz / image.doppler_hz.step);
}
double cell_of(const radar::StripmapImage& image) {
  return image.closest_range_cell_m / image.closest_range_m.step * (image.along_cell_m / image.along_m.step);
}

template <typename Image, typename Bin>
radar::GroundMap projected(const Image& image, const Array2D<Bin>& bins, const terrain::HeightField& terrain,
                           const radar::GroundGrid& grid) {
  radar::GroundMap map{
      .grid = grid, .sigma0 = Array2D<radar::Channels>(grid.columns, grid.rows), .crs = {}, .metadata = {}};
  const double bins_a_cell = cell_of(image);
  parallel_for(grid.rows, 1, [&](std::size_t row, unsigned) {
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const Vec2d centre = grid.centre_of(column, row);
      const Vec3d point{centre.x, centre.y, terrain.height_at(centre)};
      const double area_m2 = bin_area_m2(image, point) * bins_a_cell;
      map.sigma0(column, row) = power_at(bins, image.place_of(point)) * static_cast<float>(1.0 / area_m2);
    }
  });
  return map;
}

}  // namespace

radar::GroundMap projected_to_ground(const radar::RangeDopplerImage& image, const terrain::HeightField& terrain,
                                     const radar::GroundGrid& grid) {
  return projected(image, image.amplitude_m, terrain, grid);
}

radar::GroundMap projected_to_ground(const radar::StripmapImage& image, const terrain::HeightField& terrain,
                                     const radar::GroundGrid& grid) {
  return projected(image, image.amplitude_m, terrain, grid);
}

radar::GroundMap projected_to_ground(const radar::PowerImage<radar::RangeDopplerImage>& image,
                                     const terrain::HeightField& terrain, const radar::GroundGrid& grid) {
  return projected(image.frame, image.power_m2, terrain, grid);
}

radar::GroundMap projected_to_ground(const radar::PowerImage<radar::StripmapImage>& image,
                                     const terrain::HeightField& terrain, const radar::GroundGrid& grid) {
  return projected(image.frame, image.power_m2, terrain, grid);
}

}  // namespace sigmascape::product
