#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/echo.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/range_azimuth_image.h"

namespace sigmascape::simulate {

/// Sums over the passes of a map, bin by bin. Every pass is a whole map with the right mean, whatever decided on its
/// rays before it was drawn; passes may differ in their noise. With x_k the total power of a bin in pass k of n and x̄
/// the mean,
///
///     s² = Σ_k (x_k − x̄)² / (n (n − 1))
///
/// has the variance of x̄ for its mean.
class PassSums {
 public:
  /// The bins' ground, taken to be level at that height, lies in the area or does not.
  PassSums(const radar::RangeAzimuthGrid& grid, Vec3d radar_position, const radar::Rectangle& area,
           double ground_height_m);

  void add(const radar::RangeAzimuthImage& pass);
  [[nodiscard]] std::uint32_t passes() const { return passes_; }

  /// The bin that an echo falls into; nothing where that is outside the area.
  [[nodiscard]] std::optional<std::size_t> bin_in_area(const radar::Echo& echo) const;
  /// x̄, m².
  [[nodiscard]] double mean_power_m2(std::size_t bin) const { return power_.values()[bin] / passes_; }
  /// s / x̄ of a bin that answers.
  [[nodiscard]] double relative_error(std::size_t bin) const;
  /// 10 lg(1 + s / x̄) in the median over the bins of the area that answer, corrected for what the root of a variance
  /// that was estimated from so few passes is too small by in the median. From two passes on.
  [[nodiscard]] double median_error_db() const;

  /// The mean of the passes.
  [[nodiscard]] radar::RangeAzimuthImage mean() const;
  /// [azimuth, range]: s / x̄, 0 where nothing answers.
  [[nodiscard]] Array2D<float> relative_errors() const;

 private:
  [[nodiscard]] bool is_in_area(const radar::Rectangle& area, double below_m, std::size_t range,
                                std::size_t beam) const;

  radar::RangeAzimuthGrid grid_;
  Vec3d radar_position_;
  std::vector<double> sums_;         // [bin, channel]
  Array2D<double> power_, squares_;  // of the total power
  Array2D<std::uint8_t> is_in_area_;
  std::uint32_t passes_ = 0;
};

}  // namespace sigmascape::simulate
