#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sigmascape::render {

/// The points of ground that a frame asks about: every azimuth at every distance. Distances lie along sea level from
/// the radar's foot.
struct GroundSector {
  double first_azimuth_rad = 0.0;  ///< of the direction from the radar, clockwise from north; not wrapped
  double azimuth_step_rad = 1e-3;
  std::size_t azimuths = 0;
  double first_distance_m = 0.0;  ///< greater than zero
  double distance_step_m = 1.0;
  std::size_t distances = 0;

  [[nodiscard]] double azimuth_rad(std::size_t index) const {
    return first_azimuth_rad + static_cast<double>(index) * azimuth_step_rad;
  }
  [[nodiscard]] double distance_m(std::size_t index) const {
    return first_distance_m + static_cast<double>(index) * distance_step_m;
  }
};

/// What was found at the points of a sector: one array a quantity, [distance][azimuth], rows `stride` apart.
///
/// Each row is padded to whole vectors; what lies beyond the last azimuth of a row means nothing. Memory is only taken
/// when a sector needs more than any before.
class GroundSamples {
 public:
  /// Azimuths that are worked on together; a row holds a multiple of them.
  static constexpr std::size_t azimuths_together = 16;

  void fit(const GroundSector& sector);

  [[nodiscard]] std::size_t azimuths() const { return azimuths_; }
  [[nodiscard]] std::size_t distances() const { return distances_; }
  [[nodiscard]] std::size_t stride() const { return stride_; }
  [[nodiscard]] std::size_t index(std::size_t azimuth, std::size_t distance) const {
    return distance * stride_ + azimuth;
  }

  /// 1 where the ground is seen, 0 where it is hidden or there is none.
  [[nodiscard]] std::span<std::uint8_t> visible() { return visible_; }
  [[nodiscard]] std::span<const std::uint8_t> visible() const { return visible_; }
  /// Height of the ground above sea level, m.
  [[nodiscard]] std::span<float> height_m() { return height_m_; }
  [[nodiscard]] std::span<const float> height_m() const { return height_m_; }
  /// By how much the slant range exceeds that of the sea below the point, which `sea_range_m` holds in double precision
  /// (docs/physics/curved_earth.md, Eq. (6)). The sum is good to a fraction of a millimetre: to a phase.
  [[nodiscard]] std::span<float> range_excess_m() { return range_excess_m_; }
  [[nodiscard]] std::span<const float> range_excess_m() const { return range_excess_m_; }
  /// Sine of the grazing angle above the horizontal at the point.
  [[nodiscard]] std::span<float> sin_grazing() { return sin_grazing_; }
  [[nodiscard]] std::span<const float> sin_grazing() const { return sin_grazing_; }
  /// Sine of the grazing angle above the slope of the ground; negative on slopes that face away.
  [[nodiscard]] std::span<float> sin_local_grazing() { return sin_local_grazing_; }
  [[nodiscard]] std::span<const float> sin_local_grazing() const { return sin_local_grazing_; }
  /// True area of the slope over its area on the map, 1 or more.
  [[nodiscard]] std::span<float> slope_area() { return slope_area_; }
  [[nodiscard]] std::span<const float> slope_area() const { return slope_area_; }

  /// Slant range of the sea, one a distance.
  [[nodiscard]] std::span<double> sea_range_m() { return sea_range_m_; }
  [[nodiscard]] std::span<const double> sea_range_m() const { return sea_range_m_; }

  [[nodiscard]] double slant_range_m(std::size_t azimuth, std::size_t distance) const {
    return sea_range_m_[distance] + static_cast<double>(range_excess_m_[index(azimuth, distance)]);
  }

 private:
  std::size_t azimuths_ = 0, distances_ = 0, stride_ = 0;
  std::vector<std::uint8_t> visible_;
  std::vector<float> height_m_, range_excess_m_, sin_grazing_, sin_local_grazing_, slope_area_;
  std::vector<double> sea_range_m_;
};

}  // namespace sigmascape::render
