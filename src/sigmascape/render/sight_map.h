#pragma once

#include <vector>

#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/vantage.h"
#include "sigmascape/render/reflecting_ground.h"
#include "sigmascape/render/sight_grid.h"
#include "sigmascape/render/sight_lines.h"

namespace sigmascape::render {

/// What of every place of an area a radar sees, reckoned once along lines from it (SightLines) for places in any order.
class SightMap {
 public:
  /// Lines, at the far end of the area, and steps along them are `step_m` apart.
  SightMap(const ReflectingGround& ground, const radar::Vantage& vantage, const radar::Rectangle& terrain_extent,
           const radar::Rectangle& area, double step_m, unsigned threads);

  /// That of the nearest place that was reckoned; nothing where none was.
  [[nodiscard]] terrain::Sight at(Vec2d point) const;

 private:
  struct Side {
    SightLines lines;
    SightLines::Steps steps;
    SightGrid sights;
  };
  std::vector<Side> sides_;  // of a strip's track
};

}  // namespace sigmascape::render
