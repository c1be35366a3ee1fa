#pragma once

#include <cmath>
#include <string_view>

#include "sigmascape/radar/layer_stack.h"
#include "sigmascape/simulate/layers.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::simulate {

/// Where the ground of a map's cell is, and how the radar sees it.
struct LayerPlace {
  Vec3d ground, seen_from;
  double range_m = 0.0;
  Vec3d to_radar;  ///< unit

  LayerPlace(const terrain::HeightField& terrain, Vec3d from, Vec2d point)
      : ground{point.x, point.y, terrain.height_at(point)}, seen_from(from) {
    const Vec3d away = seen_from - ground;
    range_m = length(away);
    to_radar = away * (1.0 / range_m);
  }

  [[nodiscard]] float incidence_rad(const terrain::HeightField& terrain) const {
    const double cosine = dot(terrain.normal_at({ground.x, ground.y}), to_radar);
    return static_cast<float>(std::acos(cosine < -1.0 ? -1.0 : cosine > 1.0 ? 1.0 : cosine));
  }
};

[[nodiscard]] constexpr std::string_view unit_of(LayerKind kind) {
  switch (kind) {
    case LayerKind::Incidence:
      return "rad";
    case LayerKind::Range:
    case LayerKind::Height:
      return "m";
    default:
      return "";
  }
}

/// Layers of those kinds, yet without values.
[[nodiscard]] inline radar::LayerStack empty_layers(const radar::GroundGrid& grid, std::span<const LayerKind> kinds) {
  radar::LayerStack stack{.grid = grid, .layers = {}, .crs = {}, .metadata = {}};
  for (const LayerKind kind : kinds) {
    stack.layers.push_back({std::string(name_of(kind)), std::string(unit_of(kind)),
                            Array2D<float>(grid.columns, grid.rows), kind == LayerKind::Class});
  }
  return stack;
}

}  // namespace sigmascape::simulate
