#pragma once

#include <array>

#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/vantage.h"
#include "sigmascape/render/reflecting_ground.h"
#include "sigmascape/render/sight_grid.h"

namespace sigmascape::render {

/// What of every place of an area the radar of a strip sees as its beam passes over it: the same as SightMap, along
/// parallel lines that each begin at the place of the platform from which they are seen.
class StripSightMap {
 public:
  /// Lines and the steps along them are `step_m` apart. `vantage`: one that has beams.
  StripSightMap(const ReflectingGround& ground, const radar::Vantage& vantage, const radar::Rectangle& terrain_extent,
                const radar::Rectangle& area, double step_m, unsigned threads);

  /// That of the nearest place that was reckoned.
  [[nodiscard]] terrain::Sight at(Vec2d point) const;

 private:
  /// What one of the two beams sees; nothing where the area does not lie on its side.
  struct Side {
    radar::PassingBeam beam;
    double first_across_m = 0.0, near_m = 0.0;
    SightGrid sights;
  };
  [[nodiscard]] Side side_of(const ReflectingGround& ground, const radar::PassingBeam& beam,
                             const radar::Rectangle& terrain_extent, const radar::Rectangle& area,
                             unsigned threads) const;

  double step_m_;
  std::array<Side, 2> sides_;
};

}  // namespace sigmascape::render
