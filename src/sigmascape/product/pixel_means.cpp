#include "sigmascape/product/pixel_means.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "sigmascape/base/vec.h"

namespace sigmascape::product {
namespace {

using radar::Channels;

/// Lines of one azimuth across a pixel at the far end, where they are furthest apart. Lengths along them are exact, so
/// that a pixel's area is at most half a line out, 0.3 dB.
constexpr double lines_a_pixel = 8.0;
/// What covers less of a pixel only rounding sees.
constexpr double least_cover = 1e-6;

/// Of channels, and at last the area that was seen: over a pixel a float would be too coarse for them beside a bright
/// point.
using Sums = std::array<double, Channels::count + 1>;
constexpr std::size_t area = Channels::count;

/// Where the radar did not look or listen.
bool is_unseen(const Channels& bin) {
  return std::isnan(bin.vv) && std::isnan(bin.hh) && std::isnan(bin.hv);
}

void add(Sums& sums, const Sums& more, double times) {
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += times * more[i];
}

/// σ0 times range, the cross-section per metre and radian, of the bins of one azimuth: linear between their centres,
/// σ0 held beside bins that were not seen, and integrated over range from the near edge on. Of area that is the range.
class AlongRange {
 public:
  AlongRange(const radar::RangeAzimuthImage& image, std::size_t azimuth)
      : near_m_(image.grid.first_range_m), step_m_(image.grid.range_step_m) {
    const double per_bin = 1.0 / (step_m_ * image.grid.azimuth_step_rad);
    density_.reserve(image.grid.ranges);
    before_centre_.reserve(image.grid.ranges);
    for (std::size_t range = 0; range < image.grid.ranges; ++range) {
      const Channels& bin = image.rcs_m2(azimuth, range);
      Sums& density = density_.emplace_back();
      if (!is_unseen(bin)) {
        add(density, {bin.vv, bin.hh, bin.hv, bin.re_vvhh}, per_bin);
        density[area] = centre_m(range);
      }
      Sums& before = before_centre_.emplace_back();
      if (range == 0) {
        add(before, density, held(near_m_, centre_m(0), centre_m(0)));
      } else {
        before = before_centre_[range - 1];
        add_between(before, range - 1, centre_m(range));
      }
    }
  }

  [[nodiscard]] bool sees_nothing() const { return std::ranges::none_of(density_, is_of_seen); }

  [[nodiscard]] Sums up_to(double range_m) const {
    const std::size_t last = density_.size() - 1;
    if (range_m <= centre_m(0)) {
      Sums held_alone{};
      add(held_alone, density_[0], held(near_m_, range_m, centre_m(0)));
      return held_alone;
    }
    const double centres = (range_m - near_m_) / step_m_ - 0.5;
    const auto index = std::min(static_cast<std::size_t>(centres), last);
    Sums sums = before_centre_[index];
    if (index == last) {
      add(sums, density_[last], held(centre_m(last), range_m, centre_m(last)));
      return sums;
    }
    add_between(sums, index, range_m);
    return sums;
  }

 private:
  static bool is_of_seen(const Sums& density) { return density[area] > 0.0; }

  /// From the centre of a bin to a range before that of the next.
  void add_between(Sums& sums, std::size_t index, double range_m) const {
    const Sums &near = density_[index], &far = density_[index + 1];
    if (is_of_seen(near) && is_of_seen(far)) {
      const double part = (range_m - centre_m(index)) / step_m_;
      add(sums, near, step_m_ * part * (1.0 - 0.5 * part));
      add(sums, far, step_m_ * 0.5 * part * part);
      return;
    }
    // What was not seen brings nothing, whatever the length.
    const double edge_m = centre_m(index) + 0.5 * step_m_;
    add(sums, near, held(centre_m(index), std::min(range_m, edge_m), centre_m(index)));
    if (range_m > edge_m) add(sums, far, held(edge_m, range_m, centre_m(index + 1)));
  }

  [[nodiscard]] double centre_m(std::size_t range) const {
    return near_m_ + (static_cast<double>(range) + 0.5) * step_m_;
  }
  /// Of σ0 that is held from a centre, where the density is 1.
  static double held(double from_m, double to_m, double centre_m) {
    return (to_m * to_m - from_m * from_m) / (2.0 * centre_m);
  }

  double near_m_, step_m_;
  std::vector<Sums> density_, before_centre_;
};

/// Where a line from the radar goes from one column of pixels to the next, or from one row to the next.
class Crossings {
 public:
  /// The line is at `radar + range_m * slope`, in pixels.
  Crossings(double radar, double slope, double first_range_m) : radar_(radar), slope_(slope) {
    const double first = radar + slope * first_range_m;
    edge_ = slope > 0.0 ? std::floor(first) + 1.0 : std::ceil(first) - 1.0;
  }

  [[nodiscard]] double next_m() const {
    return slope_ == 0.0 ? std::numeric_limits<double>::infinity() : (edge_ - radar_) / slope_;
  }
  void pass(double range_m) {
    if (next_m() <= range_m) edge_ += slope_ > 0.0 ? 1.0 : -1.0;
  }
  [[nodiscard]] std::size_t pixel_at(double range_m, std::size_t pixels) const {
    return static_cast<std::size_t>(std::clamp(radar_ + slope_ * range_m, 0.0, static_cast<double>(pixels - 1)));
  }

 private:
  double radar_, slope_, edge_;
};

/// What lines leave in the pixels that they cross.
class PixelSums {
 public:
  explicit PixelSums(const radar::GroundGrid& pixels) : pixels_(pixels), sums_(pixels.columns, pixels.rows, Sums{}) {}

  /// Of a line that stands for a wedge of `width_rad`; `up_to` integrates over range, from anywhere on.
  template <typename UpTo>
  void add_line(double azimuth_rad, double width_rad, double near_m, double far_m, const UpTo& up_to) {
    const Vec2d radar = pixels_.cells_from({0.0, 0.0});
    Crossings columns(radar.x, std::sin(azimuth_rad) / pixels_.cell_m, near_m);
    Crossings rows(radar.y, -std::cos(azimuth_rad) / pixels_.cell_m, near_m);
    Sums before = up_to(near_m);
    for (double from_m = near_m; from_m < far_m;) {
      const double to_m = std::min({far_m, columns.next_m(), rows.next_m()});
      columns.pass(to_m);
      rows.pass(to_m);
      if (to_m <= from_m) continue;
      const double middle_m = 0.5 * (from_m + to_m);
      const std::size_t column = columns.pixel_at(middle_m, pixels_.columns),
                        row = rows.pixel_at(middle_m, pixels_.rows);
      const Sums after = up_to(to_m);
      add(sums_(column, row), after, width_rad);
      add(sums_(column, row), before, -width_rad);
      before = after;
      from_m = to_m;
    }
  }

  [[nodiscard]] Array2D<Channels> means() const {
    constexpr float unseen = std::numeric_limits<float>::quiet_NaN();
    Array2D<Channels> means(pixels_.columns, pixels_.rows, {unseen, unseen, unseen, unseen});
    for (std::size_t i = 0; i < means.size(); ++i) {
      const Sums& sums = sums_.values()[i];
      if (sums[area] < least_cover * pixels_.cell_area_m2()) continue;
      const auto mean = [&](std::size_t channel) { return static_cast<float>(sums[channel] / sums[area]); };
      means.values()[i] = {mean(0), mean(1), mean(2), mean(3)};
    }
    return means;
  }

 private:
  radar::GroundGrid pixels_;
  Array2D<Sums> sums_;
};

/// The azimuth beside one, on the other side of the end of a whole turn; the same at the end of a sector.
std::size_t beside(const radar::RangeAzimuthGrid& bins, std::size_t azimuth, bool after) {
  if (azimuth == (after ? bins.azimuths - 1 : 0)) {
    if (!bins.goes_round()) return azimuth;
    return after ? 0 : bins.azimuths - 1;
  }
  return after ? azimuth + 1 : azimuth - 1;
}

}  // namespace

Array2D<radar::Channels> pixel_means(const radar::RangeAzimuthImage& image, const radar::GroundGrid& pixels,
                                     double up_rad) {
  const radar::RangeAzimuthGrid& bins = image.grid;
  const double near_m = bins.first_range_m, far_m = near_m + static_cast<double>(bins.ranges) * bins.range_step_m;
  const auto lines = std::max<std::size_t>(
      1, static_cast<std::size_t>(std::ceil(lines_a_pixel * far_m * bins.azimuth_step_rad / pixels.cell_m)));
  const double width_rad = bins.azimuth_step_rad / static_cast<double>(lines);
  PixelSums sums(pixels);
  AlongRange before(image, beside(bins, 0, false)), here(image, 0);
  for (std::size_t azimuth = 0; azimuth < bins.azimuths; ++azimuth) {
    AlongRange after(image, beside(bins, azimuth, true));
    const std::size_t seen_lines = here.sees_nothing() ? 0 : lines;
    for (std::size_t line = 0; line < seen_lines; ++line) {
      const double place = (static_cast<double>(line) + 0.5) / static_cast<double>(lines) - 0.5;
      const double line_rad =
          bins.first_azimuth_rad + (static_cast<double>(azimuth) + 0.5 + place) * bins.azimuth_step_rad - up_rad;
      sums.add_line(line_rad, width_rad, near_m, far_m, [&](double range_m) {
        Sums blended{};
        add(blended, here.up_to(range_m), 1.0 - std::abs(place));
        if (place != 0.0) add(blended, (place < 0.0 ? before : after).up_to(range_m), std::abs(place));
        return blended;
      });
    }
    before = std::exchange(here, std::move(after));
  }
  return sums.means();
}

}  // namespace sigmascape::product
