#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/ground_stretch.h"
#include "sigmascape/radar/obstacle.h"
#include "sigmascape/radar/rectangle_parts.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::terrain {

/// Evenly spaced places along a line over the ground: place k lies at the distance near_m + (k + ½)·step_m from the
/// origin.
struct GroundLine {
  Vec2d origin;
  Vec2d direction;  ///< unit vector
  double near_m = 0.0, step_m = 1.0;
  std::size_t count = 0;

  [[nodiscard]] double distance_m(std::size_t k) const { return near_m + (static_cast<double>(k) + 0.5) * step_m; }
};

/// What a walk along a line meets, place by place: the height of the ground, as HeightField::height_at has it, and what
/// stands there. Heights are reckoned for many places at a time.
class GroundProfile {
 public:
  /// Without `obstacles` nothing stands anywhere. Both must outlive this. Up to `beyond_m` outside its edges the
  /// terrain is taken to go on as high as they are.
  GroundProfile(const HeightField& terrain, const radar::ObstacleMap* obstacles, double beyond_m = 0.0)
      : terrain_(&terrain), obstacles_(obstacles), extent_(radar::widened(terrain.extent(), beyond_m)) {}

  /// Calls `visit(k, distance_m, point, obstacle)` for the places of a line that lie on the terrain, outwards.
  template <typename Visit>
  void walk(const GroundLine& line, const Visit& visit) {
    const radar::GroundStretch stretch = radar::stretch_within(extent_, line.origin, line.direction);
    if (stretch.empty()) return;
    // A place to spare at either end: whether it lies on the terrain is asked below.
    std::size_t k = place_before(line, stretch.begin_m);
    const std::size_t end = std::min(line.count, place_before(line, stretch.end_m) + 4);
    while (k < end) {
      const std::size_t count = std::min(capacity, end - k);
      read(line, k, count);
      for (std::size_t i = 0; i < count; ++i) {
        if (!extent_.contains({x_[i], y_[i]})) continue;
        visit(k + i, distance_m_[i], Vec3d{x_[i], y_[i], height_m_[i]}, obstacle_at(i));
      }
      k += count;
    }
  }

 private:
  static constexpr std::size_t capacity = 128;

  /// A place that is not beyond the distance, of which the next but two is.
  [[nodiscard]] static std::size_t place_before(const GroundLine& line, double distance_m) {
    const double place = (distance_m - line.near_m) / line.step_m - 1.5;
    return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(line.count)));
  }
  /// Fills the arrays with the places from `first` on.
  void read(const GroundLine& line, std::size_t first, std::size_t count);
  [[nodiscard]] radar::Obstacle obstacle_at(std::size_t i) const {
    if (obstacles_ == nullptr || obstacle_[i] < 0) return {};
    return obstacles_->obstacles.values()[static_cast<std::size_t>(obstacle_[i])];
  }

  const HeightField* terrain_;
  const radar::ObstacleMap* obstacles_;
  radar::Rectangle extent_;
  alignas(64) std::array<double, capacity> distance_m_, x_, y_, height_m_;
  alignas(64) std::array<std::int64_t, capacity> obstacle_;  // where it stands in the map, or −1
};

}  // namespace sigmascape::terrain
