#pragma once

#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape::trace {

/// Between which heights everything lies that stands in or near a place: in squares, quickly made, and never too
/// narrow.
class CoarseHeights {
 public:
  /// Over a region of the scene, in squares of that side.
  CoarseHeights(const scene::Scene& scene, Footing footing, radar::Rectangle region, double square_m);

  struct Interval {
    float lowest_m, highest_m;
  };
  /// Of all within one square's side of a point; null outside the region.
  [[nodiscard]] const Interval* around(Vec2d point) const;

  [[nodiscard]] double square_m() const { return grid_.cell_m; }
  [[nodiscard]] float highest_m() const { return highest_m_; }

 private:
  [[nodiscard]] Interval ground_in(const terrain::HeightField& field, std::size_t column, std::size_t row) const;
  void add_instances(const scene::Scene& scene, Footing footing);
  void add_buildings(const scene::Buildings& buildings, Footing footing);
  /// Of a box that meets the region.
  void add_box(const radar::Rectangle& box, Interval heights);
  /// Every square takes over what its neighbours hold.
  void grow();

  radar::GroundGrid grid_;
  Array2D<Interval> heights_;
  float highest_m_;
};

}  // namespace sigmascape::trace
