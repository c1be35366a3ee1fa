#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sigmascape/base/parallel.h"
#include "sigmascape/radar/target_shadows.h"
#include "sigmascape/radar/vantage.h"
#include "sigmascape/simulate/ground_met.h"
#include "sigmascape/simulate/layer_place.h"
#include "sigmascape/simulate/layers.h"
#include "sigmascape/trace/path_tracer.h"

namespace sigmascape::simulate {
namespace {

/// Arcs and rays from above reach this far over the highest thing.
constexpr double arc_clearance_m = 1.0;
/// Pieces of an arc bulge from their chords by no more than this part of a cell.
constexpr double bulge_cells = 0.05;
/// Arcs a cell: what lies over a sixteenth of it is found as a rule.
constexpr std::size_t arcs_per_cell = 16;

/// Places spread over a square of side 1 about the origin, so that no two share a row, a column or nearly a diagonal: a
/// lattice of the golden ratio.
Vec2d spread_place(std::size_t index) {
  const double i = static_cast<double>(index) + 0.5;
  return {i / static_cast<double>(arcs_per_cell) - 0.5, std::fmod(i * std::numbers::phi, 1.0) - 0.5};
}

/// Asks rays about one cell after the other; one a thread.
class CellProbe {
 public:
  CellProbe(const scene::Scene& scene, const trace::SceneGeometry& geometry, const radar::Vantage& vantage,
            double cell_m, const std::vector<scatter::SurfaceModel>& surfaces, const radar::TargetShadows& shadows)
      : scene_(scene),
        geometry_(geometry),
        vantage_(vantage),
        cell_m_(cell_m),
        surfaces_(surfaces),
        shadows_(shadows) {}

  float value(LayerKind kind, Vec2d point) {
    const LayerPlace place = place_at(point);
    switch (kind) {
      case LayerKind::Shadow:
        return is_seen(ground_met_at(geometry_, place.ground), place.seen_from) ? 0.0F : 1.0F;
      case LayerKind::Layover:
        return is_lain_over(point) ? 1.0F : 0.0F;
      case LayerKind::Incidence:
        return place.incidence_rad(scene_.terrain);
      case LayerKind::Range:
        return static_cast<float>(place.range_m);
      case LayerKind::Class:
        return seen_from_above(place).material;
      case LayerKind::Height:
        return seen_from_above(place).height_m;
    }
    return 0.0F;
  }

 private:
  struct Top {
    float height_m, material;
  };

  [[nodiscard]] LayerPlace place_at(Vec2d point) const { return {scene_.terrain, vantage_.place_for(point), point}; }

  /// Where a ray meets a surface or is more than half intercepted by crowns.
  bool meets(Vec3d from, Vec3d direction, double depth, double& distance_m, scene::MaterialIndex& material) {
    trace::SurfaceHit hit;
    crowns_.begin(surfaces_);
    const Vec3f start = (from - geometry_.origin()).to<float>();
    const bool is_hit = geometry_.intersect(start, direction.to<float>(), hit, crowns_);
    distance_m = is_hit ? static_cast<double>(length(hit.position - start)) : std::numeric_limits<double>::infinity();
    material = hit.material;
    if (const auto crown = crowns_.interception(static_cast<float>(depth), static_cast<float>(distance_m), 0.5F)) {
      distance_m = static_cast<double>(crown->distance_m);
      material = crown->medium;
      return true;
    }
    return is_hit;
  }

  bool is_seen(Vec3d point, Vec3d radar) {
    if (shadows_.hide(point)) return false;
    const Vec3d to_radar = normalized(radar - point);
    const Vec3f start = (point + to_radar * ray_lift_m - geometry_.origin()).to<float>();
    // What stands behind a low radar, or above it, hides nothing.
    const auto way_m = static_cast<float>(length(radar - point) - ray_lift_m);
    crowns_.begin(surfaces_);
    return !geometry_.occluded(start, to_radar.to<float>(), crowns_, way_m) &&
           std::exp(-crowns_.optical_depth(way_m) - crowns_.return_depth(way_m)) >=
               static_cast<float>(crown_hides_below);
  }

  Top seen_from_above(const LayerPlace& place) {
    const double top_m = geometry_.highest_m() + arc_clearance_m;
    double distance_m = 0.0;
    scene::MaterialIndex material = 0;
    const Vec3d from{place.ground.x, place.ground.y, top_m};
    if (!meets(from, {0.0, 0.0, -1.0}, -std::log(crown_hides_below), distance_m, material)) {
      return {static_cast<float>(place.ground.z), 0.0F};
    }
    return {static_cast<float>(top_m - distance_m), static_cast<float>(material)};
  }

  /// Whether something lies over any part of a cell, whose echoes are gathered from all of it.
  bool is_lain_over(Vec2d centre) {
    for (std::size_t arc = 0; arc < arcs_per_cell; ++arc) {
      if (is_lain_over(place_at(centre + spread_place(arc) * cell_m_))) return true;
    }
    return false;
  }

  /// Follows the arc of equal range and azimuth from the ground to the height of the highest thing.
  bool is_lain_over(const LayerPlace& place) {
    const Vec3d radar = place.seen_from;
    const Vec3d ground = ground_met_at(geometry_, place.ground);
    const Vec2d away{ground.x - radar.x, ground.y - radar.y};
    const double distance_m = length(away), range_m = length(ground - radar);
    if (distance_m == 0.0) return false;
    const Vec2d outwards = away * (1.0 / distance_m);
    // Of a low radar the arc may end overhead, below the highest thing.
    const double lowest =
        std::asin(std::clamp((radar.z - geometry_.highest_m() - arc_clearance_m) / range_m, -1.0, 1.0));
    const double first = std::atan2(radar.z - ground.z, distance_m) - own_m / range_m;
    const double step = std::sqrt(8.0 * bulge_cells * cell_m_ / range_m);
    const auto at = [&](double depression) {
      return Vec3d{radar.x + outwards.x * range_m * std::cos(depression),
                   radar.y + outwards.y * range_m * std::cos(depression), radar.z - range_m * std::sin(depression)};
    };
    Vec3d from = at(first);
    for (double depression = first; depression > lowest;) {
      depression = std::max(lowest, depression - step);
      const Vec3d to = at(depression);
      if (is_visible_between(from, to, radar) || is_visible_between(to, from, radar)) return true;
      from = to;
    }
    return false;
  }

  /// Whether a piece of the arc, followed one way, meets something that the radar sees. Terrain is met from outside
  /// alone: whoever comes up from within a hill does not notice its far side, and learns nothing of what is behind.
  bool is_visible_between(Vec3d from, Vec3d to, Vec3d radar) {
    const double whole_m = length(to - from);
    if (whole_m == 0.0) return false;
    const Vec3d direction = (to - from) * (1.0 / whole_m);
    double travelled_m = 0.0;
    while (travelled_m < whole_m) {
      double distance_m = 0.0;
      scene::MaterialIndex material = 0;
      if (!meets(from + direction * travelled_m, direction, crown_edge_depth, distance_m, material)) return false;
      travelled_m += distance_m;
      if (travelled_m > whole_m) return false;
      if (is_seen(from + direction * travelled_m, radar)) return true;
      travelled_m += onward_m;
    }
    return false;
  }

  /// Of a wave along the arc, not towards the radar: where the arc has entered a crown.
  static constexpr double crown_edge_depth = 1e-4;
  /// Behind a surface that the radar does not see the arc is taken up again this much further.
  static constexpr double onward_m = 0.25;
  /// What the arc meets nearer to its ground than this is that ground itself.
  static constexpr double own_m = 0.1;

  const scene::Scene& scene_;
  const trace::SceneGeometry& geometry_;
  const radar::Vantage& vantage_;
  double cell_m_;
  const std::vector<scatter::SurfaceModel>& surfaces_;
  const radar::TargetShadows& shadows_;
  trace::CrownCrossings crowns_;
};

}  // namespace

radar::LayerStack traced_layers(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                                const radar::Radar& radar, const radar::GroundGrid& grid,
                                std::span<const LayerKind> kinds, unsigned threads,
                                std::span<const radar::Target> targets) {
  radar::LayerStack stack = empty_layers(grid, kinds);
  const radar::Vantage vantage = radar::vantage_of(radar, grid.extent().centre());
  const radar::TargetShadows shadows(targets, vantage);
  const auto surfaces = trace::surface_models(scene, radar.frequency_hz);
  parallel_for(grid.rows, threads, [&](std::size_t row, unsigned) {
    const trace::FlushDenormals flush;
    CellProbe probe(scene, geometry, vantage, grid.cell_m, surfaces, shadows);
    for (std::size_t layer = 0; layer < kinds.size(); ++layer) {
      for (std::size_t column = 0; column < grid.columns; ++column) {
        stack.layers[layer].values(column, row) = probe.value(kinds[layer], grid.centre_of(column, row));
      }
    }
  });
  return stack;
}

}  // namespace sigmascape::simulate
