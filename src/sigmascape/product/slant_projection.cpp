#include "sigmascape/product/slant_projection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "sigmascape/base/parallel.h"

namespace sigmascape::product {
namespace {

/// Half the distance over which places are compared, in metres: small beside ranges, large beside rounding.
constexpr double half_step_m = 0.5;

/// Whether the image's first axis begins anew after its last bin: Doppler does, for it is known up to the pulse
/// repetition frequency.
constexpr bool begins_anew(const radar::RangeDopplerImage&) {
  return true;
}
constexpr bool begins_anew(const radar::StripmapImage&) {
  return false;
}

/// From one place to another in bins, the shorter way round where the first axis begins anew.
template <typename Image>
Vec2d way_between(const Image& image, Vec2d from, Vec2d to) {
  Vec2d way = to - from;
  if (begins_anew(image)) way.x = std::remainder(way.x, static_cast<double>(image.amplitude_m.columns()));
  return way;
}

/// Horizontal area that bins of one by one cover at a point, with the surface's slope left out: map area is area over
/// level ground, as in the power mode.
template <typename Image>
double bin_area_m2(const Image& image, Vec3d point) {
  const Vec3d to_east{half_step_m, 0.0, 0.0}, to_north{0.0, half_step_m, 0.0};
  const Vec2d eastward = way_between(image, image.place_of(point - to_east), image.place_of(point + to_east));
  const Vec2d northward = way_between(image, image.place_of(point - to_north), image.place_of(point + to_north));
  return 1.0 / std::abs(cross(eastward, northward));
}

/// Bins a resolution cell.
double cell_of(const radar::RangeDopplerImage& image) {
  return image.range_cell_m / image.range_m.step * (image.doppler_cell_hz / image.doppler_hz.step);
}
double cell_of(const radar::StripmapImage& image) {
  return image.closest_range_cell_m / image.closest_range_m.step * (image.along_cell_m / image.along_m.step);
}

/// The samples that have a say at a place along one axis, and what they say. Where the axis begins anew they are in two
/// pieces about its end, or in more where it has fewer bins than samples have a say.
class Stencil {
 public:
  /// Consecutive bins.
  struct Piece {
    std::size_t first = 0, count = 0;
    const float* weights = nullptr;  // of the first
  };

  /// Beyond the ends there is nothing.
  static Stencil between_ends(double place, std::size_t bins, const BandInterpolation& interpolation) {
    const double before = std::floor(place);
    const std::ptrdiff_t begin = begin_of(before);
    const std::ptrdiff_t first = std::max<std::ptrdiff_t>(begin, 0);
    const std::ptrdiff_t end = std::min<std::ptrdiff_t>(begin + taps, static_cast<std::ptrdiff_t>(bins));
    Stencil stencil;
    stencil.add({static_cast<std::size_t>(first), static_cast<std::size_t>(end - first),
                 interpolation.weights(place - before).data() + (first - begin)});
    return stencil;
  }

  /// Beyond the last bin lies the first.
  static Stencil round(double place, std::size_t bins, const BandInterpolation& interpolation) {
    const double before = std::floor(place);
    const auto period = static_cast<std::ptrdiff_t>(bins);
    const float* const weights = interpolation.weights(place - before).data();
    const std::ptrdiff_t begin = begin_of(before) % period;
    auto first = static_cast<std::size_t>(begin < 0 ? begin + period : begin);
    Stencil stencil;
    for (std::size_t tap = 0; tap < BandInterpolation::taps;) {
      const std::size_t count = std::min(BandInterpolation::taps - tap, bins - first);
      stencil.add({first, count, weights + tap});
      tap += count;
      first = 0;
    }
    return stencil;
  }

  [[nodiscard]] std::span<const Piece> pieces() const { return {pieces_.data(), count_}; }

 private:
  static constexpr auto taps = static_cast<std::ptrdiff_t>(BandInterpolation::taps);
  static std::ptrdiff_t begin_of(double before) { return static_cast<std::ptrdiff_t>(before) - (taps / 2 - 1); }
  void add(const Piece& piece) { pieces_[count_++] = piece; }

  std::array<Piece, BandInterpolation::taps> pieces_;
  std::size_t count_ = 0;
};

radar::ComplexChannels amplitude_at(const Array2D<radar::ComplexChannels>& bins, const Stencil& across,
                                    const Stencil& down) {
  radar::ComplexChannels amplitude;
  for (const Stencil::Piece& rows : down.pieces()) {
    for (std::size_t r = 0; r < rows.count; ++r) {
      radar::ComplexChannels of_row;
      for (const Stencil::Piece& columns : across.pieces()) {
        const radar::ComplexChannels* const row = &bins(columns.first, rows.first + r);
        for (std::size_t c = 0; c < columns.count; ++c) of_row += row[c] * columns.weights[c];
      }
      amplitude += of_row * rows.weights[r];
    }
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
      const bool is_across = begins_anew(look) ? std::isfinite(place.x) : place.x >= 0.0 && place.x < columns - 1.0;
      if (!(is_across && place.y >= 0.0 && place.y < rows - 1.0)) {
        sum = {nan, nan, nan, nan};
        continue;
      }
      const auto across = begins_anew(look) ? Stencil::round(place.x, bins.columns(), interpolation_)
                                            : Stencil::between_ends(place.x, bins.columns(), interpolation_);
      const auto amplitude = amplitude_at(bins, across, Stencil::between_ends(place.y, bins.rows(), interpolation_));
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
