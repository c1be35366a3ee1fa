#include "sigmascape/receiver/range_azimuth_receiver.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "sigmascape/base/units.h"

namespace sigmascape::receiver {
namespace {

/// Weights, summing to one, of a Gaussian power response of that half-power full width, in bins; odd in number,
/// centred.
std::vector<float> gaussian_response(double half_power_width_bins) {
  const double sigma = half_power_width_bins / (2.0 * std::sqrt(2.0 * std::numbers::ln2));
  const auto reach = static_cast<int>(std::ceil(4.0 * sigma));
  std::vector<double> weights;
  double sum = 0.0;
  for (int k = -reach; k <= reach; ++k) {
    weights.push_back(std::exp(-0.5 * (k / sigma) * (k / sigma)));
    sum += weights.back();
  }
  std::vector<float> normalised;
  for (const double weight : weights) normalised.push_back(static_cast<float>(weight / sum));
  return normalised;
}

enum class Axis { Columns, Rows };

/// Every bin spreads over its neighbours along one axis; what leaves the rectangle is lost, as it is to a receiver's
/// gate.
Array2D<radar::Channels> spread(const Array2D<radar::Channels>& bins, const std::vector<float>& weights, Axis axis) {
  const auto reach = static_cast<std::ptrdiff_t>(weights.size() / 2);
  const auto columns = static_cast<std::ptrdiff_t>(bins.columns()), rows = static_cast<std::ptrdiff_t>(bins.rows());
  Array2D<radar::Channels> out(bins.columns(), bins.rows());
  for (std::ptrdiff_t row = 0; row < rows; ++row) {
    for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
      const float weight = weights[static_cast<std::size_t>(k + reach)];
      if (axis == Axis::Rows) {
        if (row + k < 0 || row + k >= rows) continue;
        const auto from = bins.row(static_cast<std::size_t>(row + k));
        const auto to = out.row(static_cast<std::size_t>(row));
        for (std::size_t column = 0; column < from.size(); ++column) to[column] += from[column] * weight;
      } else {
        const auto from = bins.row(static_cast<std::size_t>(row));
        const auto to = out.row(static_cast<std::size_t>(row));
        for (std::ptrdiff_t column = std::max<std::ptrdiff_t>(0, -k); column < std::min(columns, columns - k);
             ++column) {
          to[static_cast<std::size_t>(column)] += from[static_cast<std::size_t>(column + k)] * weight;
        }
      }
    }
  }
  return out;
}

/// Two-way half-power width of a Gaussian beam: the gain counts twice.
double two_way_width_rad(const radar::Radar& radar) {
  return radar.beam_width_rad / std::numbers::sqrt2;
}

}  // namespace

radar::RangeAzimuthGrid grid_covering(const radar::Radar& radar, std::span<const Vec3d> points, double oversampling) {
  double nearest = 1e30, farthest = 0.0, leftmost = 1e30, rightmost = -1e30;
  const Vec3d first = points.front() - radar.position;
  const double middle = std::atan2(first.x, first.y);
  for (const Vec3d& point : points) {
    const Vec3d away = point - radar.position;
    // Azimuths are unwrapped about the first point's, so that a sector across south does not fall apart.
    const double azimuth = middle + std::remainder(std::atan2(away.x, away.y) - middle, 2.0 * pi);
    nearest = std::min(nearest, length(away));
    farthest = std::max(farthest, length(away));
    leftmost = std::min(leftmost, azimuth);
    rightmost = std::max(rightmost, azimuth);
  }
  const double range_step = radar.range_resolution_m / oversampling;
  const double azimuth_step = two_way_width_rad(radar) / oversampling;
  // Room for the responses at the edges.
  const double spare_range = 4.0 * radar.range_resolution_m, spare_azimuth = 4.0 * two_way_width_rad(radar);
  return {.first_range_m = nearest - spare_range,
          .range_step_m = range_step,
          .ranges = static_cast<std::size_t>(std::ceil((farthest - nearest + 2.0 * spare_range) / range_step)),
          .first_azimuth_rad = leftmost - spare_azimuth,
          .azimuth_step_rad = azimuth_step,
          .azimuths = static_cast<std::size_t>(std::ceil((rightmost - leftmost + 2.0 * spare_azimuth) / azimuth_step))};
}

RangeAzimuthReceiver::RangeAzimuthReceiver(const radar::Radar& radar, const radar::RangeAzimuthGrid& grid)
    : radar_(radar), grid_(grid), bins_(grid.azimuths, grid.ranges) {}

void RangeAzimuthReceiver::add(std::span<const radar::Echo> echoes) {
  const double middle = grid_.first_azimuth_rad + 0.5 * static_cast<double>(grid_.azimuths) * grid_.azimuth_step_rad;
  for (const radar::Echo& echo : echoes) {
    const double azimuth = middle + std::remainder(echo.cross - middle, 2.0 * pi);
    bins_.add_shared((azimuth - grid_.first_azimuth_rad) / grid_.azimuth_step_rad,
                     (echo.range_m - grid_.first_range_m) / grid_.range_step_m, echo.rcs_m2);
  }
}

radar::RangeAzimuthImage RangeAzimuthReceiver::image() const {
  const auto pulse = gaussian_response(radar_.range_resolution_m / grid_.range_step_m);
  const auto beam = gaussian_response(two_way_width_rad(radar_) / grid_.azimuth_step_rad);
  return {grid_, radar_.position, spread(spread(bins_.sums(), beam, Axis::Columns), pulse, Axis::Rows)};
}

}  // namespace sigmascape::receiver
