#include "sigmascape/product/slant_projection.h"

#include <algorithm>
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

/// Bins a resolution cell.
double cell_of(const radar::RangeDopplerImage& image) {
  return image.range_cell_m / image.range_m.step * (image.doppler_cell_hz / image.doppler_hz.step);
}
double cell_of(const radar::StripmapImage& image) {
  return image.closest_range_cell_m / image.closest_range_m.step * (image.along_cell_m / image.along_m.step);
}

/// The samples along one axis that have a say at a place, and what they say.
struct Stencil {
  std::size_t first = 0, count = 0;
  const float* weights = nullptr;  // of the first
};

/// Beyond the ends there is nothing.
Stencil stencil_at(double place, std::size_t bins, const BandInterpolation& interpolation) {
  constexpr auto taps = static_cast<std::ptrdiff_t>(BandInterpolation::taps);
  const double before = std::floor(place);
  const std::ptrdiff_t begin = static_cast<std::ptrdiff_t>(before) - (taps / 2 - 1);
  const std::ptrdiff_t first = std::max<std::ptrdiff_t>(begin, 0);
  const std::ptrdiff_t end = std::min<std::ptrdiff_t>(begin + taps, static_cast<std::ptrdiff_t>(bins));
  return {static_cast<std::size_t>(first), static_cast<std::size_t>(end - first),
          interpolation.weights(place - before).data() + (first - begin)};
}

radar::ComplexChannels amplitude_at(const Array2D<radar::ComplexChannels>& bins, const Stencil& across,
                                    const Stencil& down) {
  radar::ComplexChannels amplitude;
  for (std::size_t r = 0; r < down.count; ++r) {
    const radar::ComplexChannels* const row = &bins(across.first, down.first + r);
    radar::ComplexChannels of_row;
    for (std::size_t c = 0; c < across.count; ++c) of_row += row[c] * across.weights[c];
    amplitude += of_row * down.weights[r];
  }
  return amplitude;
}

template <typename Image>
radar::GroundMap of_one_look(const Image& image, const terrain::HeightField& terrain, const radar::GroundGrid& grid) {
  LooksOnGround looks(terrain, grid);
  looks.add(image);
  return looks.map();
}

}  // namespace

LooksOnGround::LooksOnGround(const terrain::HeightField& terrain, const radar::GroundGrid& grid, unsigned threads)
    : terrain_(terrain), grid_(grid), threads_(thread_count(threads)), sums_(grid.columns, grid.rows) {}

void LooksOnGround::add(const radar::RangeDopplerImage& look) {
  add_look(look);
}
void LooksOnGround::add(const radar::StripmapImage& look) {
  add_look(look);
}

template <typename Image>
void LooksOnGround::find_places(const Image& image) {
  found_ = Array2D<Found>(grid_.columns, grid_.rows);
  const double bins_a_cell = cell_of(image);
  parallel_for(grid_.rows, threads_, [&](std::size_t row, unsigned) {
    for (std::size_t column = 0; column < grid_.columns; ++column) {
      const Vec2d centre = grid_.centre_of(column, row);
      const Vec3d point{centre.x, centre.y, terrain_.height_at(centre)};
      found_(column, row) = {image.place_of(point) - Vec2d{0.5, 0.5}, 1.0 / (bin_area_m2(image, point) * bins_a_cell)};
    }
  });
}

template <typename Image>
void LooksOnGround::add_look(const Image& look) {
  if (looks_++ == 0) find_places(look);
  const Array2D<radar::ComplexChannels>& bins = look.amplitude_m;
  const auto columns = static_cast<double>(bins.columns()), rows = static_cast<double>(bins.rows());
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  parallel_for(grid_.rows, threads_, [&](std::size_t row, unsigned) {
    for (std::size_t column = 0; column < grid_.columns; ++column) {
      const auto& [place, cells_per_m2] = found_(column, row);
      radar::Channels& sum = sums_(column, row);
      if (!(place.x >= 0.0 && place.y >= 0.0 && place.x < columns - 1.0 && place.y < rows - 1.0)) {
        sum = {nan, nan, nan, nan};
        continue;
      }
      const auto amplitude = amplitude_at(bins, stencil_at(place.x, bins.columns(), interpolation_),
                                          stencil_at(place.y, bins.rows(), interpolation_));
      sum += radar::power_of(amplitude) * static_cast<float>(cells_per_m2);
    }
  });
}

radar::GroundMap LooksOnGround::map() const {
  radar::GroundMap map{.grid = grid_, .sigma0 = sums_, .crs = {}, .metadata = {}};
  const float share = 1.0F / static_cast<float>(std::max<std::size_t>(looks_, 1));
  for (radar::Channels& cell : map.sigma0.values()) cell = cell * share;
  return map;
}

radar::GroundMap projected_to_ground(const radar::RangeDopplerImage& image, const terrain::HeightField& terrain,
                                     const radar::GroundGrid& grid) {
  return of_one_look(image, terrain, grid);
}

radar::GroundMap projected_to_ground(const radar::StripmapImage& image, const terrain::HeightField& terrain,
                                     const radar::GroundGrid& grid) {
  return of_one_look(image, terrain, grid);
}

}  // namespace sigmascape::product
