#pragma once

#include <limits>
#include <vector>

#include "sigmascape/base/array2d.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/obstacle.h"
#include "sigmascape/radar/vantage.h"
#include "sigmascape/render/sight_lines.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::render {

/// What rises before every place of an area, as a radar sees it: walked once along lines from it, for points at any
/// height above any of these places.
///
/// A line of sight is named by its slope at the radar, rise over distance, the Earth falling away: it passes over all
/// whose own is less.
class Skyline {
 public:
  /// The steepest lines of sight to what lies between the radar and a place.
  struct Slopes {
    float solid = -std::numeric_limits<float>::infinity();   ///< to terrain and solid tops
    float crowns = -std::numeric_limits<float>::infinity();  ///< to tops of crowns
  };

  Skyline(const radar::ObstacleMap& obstacles, const terrain::HeightField& terrain, const radar::Vantage& vantage,
          const radar::Rectangle& area, const radar::CurvedEarth& earth = radar::CurvedEarth::flat(),
          unsigned threads = 1);

  /// Those before a place of the area, on the line that passes nearest to it: what is less than a step nearer to the
  /// radar than the place may be left out.
  [[nodiscard]] Slopes before(Vec2d place) const;

  /// The slope of the line of sight to a point.
  [[nodiscard]] static double slope_to(Vec3d point, Vec3d radar, const radar::CurvedEarth& earth);

 private:
  struct Side {
    SightLines lines;
    SightLines::Steps steps;
    Array2D<Slopes> slopes;  // [step, line]
  };
  std::vector<Side> sides_;  // of a strip's track
};

}  // namespace sigmascape::render
