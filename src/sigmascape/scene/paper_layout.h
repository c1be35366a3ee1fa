#pragma once

#include <cstdint>
#include <vector>

#include "sigmascape/scene/convex_polygon.h"
#include "sigmascape/scene/paper_scene.h"
#include "sigmascape/scene/smooth_line.h"

namespace sigmascape::scene {

struct Lake {
  Vec2d centre;
  double radius_m = 0.0;
};

/// Where the large things of the paper scene are. Places follow the side of the map, widths are real.
struct PaperLayout {
  PaperSceneSize size;
  std::uint64_t seed = 0;
  SmoothLine river;
  double river_half_width_m = 0.0;
  std::vector<Lake> lakes;
  SmoothLine highway;
  std::vector<SmoothLine> main_roads;
  Vec2d town_centre;
  double town_radius_m = 0.0;  ///< of a round town of that many houses, roughly

  [[nodiscard]] ConvexPolygon square() const;
};

inline constexpr double highway_half_width_m = 12.5;
inline constexpr double highway_median_half_width_m = 1.5;
inline constexpr double main_road_half_width_m = 5.0;

[[nodiscard]] PaperLayout paper_layout(const PaperSceneOptions& options);

}  // namespace sigmascape::scene
