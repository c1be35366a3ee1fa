#include "sigmascape/scene/roofed_building.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <span>
#include <vector>

#include "sigmascape/scene/convex_polygon.h"
#include "sigmascape/scene/solid_mesh.h"

namespace sigmascape::scene {
namespace {

/// Builds in the building's own axes: u along, v across, both in half lengths from the centre.
struct Mason {
  Mesh& mesh;
  const RoofedBuilding& building;

  [[nodiscard]] Vec3f corner(double u, double v, double z) const {
    const Vec2d across{-building.along.y, building.along.x};
    const Vec2d p =
        building.centre + building.along * (u * building.length_m / 2.0) + across * (v * building.depth_m / 2.0);
    return Vec3d{p.x, p.y, z}.to<float>();
  }
  [[nodiscard]] double ridge_m() const { return building.eaves_m + building.roof_rise_m; }

  void facet(std::initializer_list<Vec3f> corners, MaterialIndex material) const {
    append_facet(mesh, std::span(corners.begin(), corners.size()), material);
  }

  /// The upright wall from one corner to another, seen from outside left to right.
  void wall(Vec2d from, Vec2d to, double low, double high) const {
    facet(
        {corner(from.x, from.y, low), corner(to.x, to.y, low), corner(to.x, to.y, high), corner(from.x, from.y, high)},
        building.walls);
  }

  void floor() const {
    facet({corner(-1, -1, 0), corner(-1, 1, 0), corner(1, 1, 0), corner(1, -1, 0)}, building.walls);
  }

  void long_walls() const {
    wall({-1, -1}, {1, -1}, 0, building.eaves_m);
    wall({1, 1}, {-1, 1}, 0, building.eaves_m);
  }

  void short_walls() const {
    wall({1, -1}, {1, 1}, 0, building.eaves_m);
    wall({-1, 1}, {-1, -1}, 0, building.eaves_m);
  }

  void gable_walls() const {
    const double top = building.eaves_m;
    facet({corner(1, -1, 0), corner(1, 1, 0), corner(1, 1, top), corner(1, 0, ridge_m()), corner(1, -1, top)},
          building.walls);
    facet({corner(-1, 1, 0), corner(-1, -1, 0), corner(-1, -1, top), corner(-1, 0, ridge_m()), corner(-1, 1, top)},
          building.walls);
  }

  /// Two slopes that meet in a ridge from −`ridge_end` to `ridge_end`.
  void slopes(double ridge_end) const {
    const double top = building.eaves_m;
    facet({corner(-1, -1, top), corner(1, -1, top), corner(ridge_end, 0, ridge_m()), corner(-ridge_end, 0, ridge_m())},
          building.roofing);
    facet({corner(1, 1, top), corner(-1, 1, top), corner(-ridge_end, 0, ridge_m()), corner(ridge_end, 0, ridge_m())},
          building.roofing);
  }

  void hip_ends(double ridge_end) const {
    const double top = building.eaves_m;
    facet({corner(1, -1, top), corner(1, 1, top), corner(ridge_end, 0, ridge_m())}, building.roofing);
    facet({corner(-1, 1, top), corner(-1, -1, top), corner(-ridge_end, 0, ridge_m())}, building.roofing);
  }

  void flat_roof(double half_u, double half_v, double z) const {
    facet({corner(-half_u, -half_v, z), corner(half_u, -half_v, z), corner(half_u, half_v, z),
           corner(-half_u, half_v, z)},
          building.roofing);
  }

  void stair_head() const {
    constexpr double u = 0.2, v = 0.35, height_m = 2.6;
    const double low = building.eaves_m, high = building.eaves_m + height_m;
    wall({-u, -v}, {u, -v}, low, high);
    wall({u, -v}, {u, v}, low, high);
    wall({u, v}, {-u, v}, low, high);
    wall({-u, v}, {-u, -v}, low, high);
    flat_roof(u, v, high);
  }

  void l_shape() const {
    // The outline starts at the inner corner, from which all of it is visible.
    std::vector<Vec2f> outline;
    for (const Vec2d p : {Vec2d{0.1, 0.0}, {0.1, 1.0}, {-1.0, 1.0}, {-1.0, -1.0}, {1.0, -1.0}, {1.0, 0.0}}) {
      const Vec3f at = corner(p.x, p.y, 0.0);
      outline.push_back({at.x, at.y});
    }
    append_prism(mesh, outline, 0.0F, static_cast<float>(building.eaves_m), building.walls);
  }
};

void build(const Mason& mason) {
  const RoofedBuilding& building = mason.building;
  if (building.roof == RoofForm::FlatLShaped) return mason.l_shape();
  mason.floor();
  mason.long_walls();
  if (building.roof == RoofForm::Gabled) {
    mason.gable_walls();
    return mason.slopes(1.0);
  }
  mason.short_walls();
  if (building.roof == RoofForm::Hipped) {
    const double ridge_end = 1.0 - std::min(0.9, building.depth_m / building.length_m);
    mason.slopes(ridge_end);
    return mason.hip_ends(ridge_end);
  }
  mason.flat_roof(1.0, 1.0, building.eaves_m);
  if (building.roof == RoofForm::FlatWithHouse) mason.stair_head();
}

}  // namespace

void append_roofed_building(Buildings& buildings, const RoofedBuilding& building, double footing_m) {
  const std::size_t first = buildings.mesh.vertices.size();
  build({buildings.mesh, building});
  buildings.items.push_back({.first_vertex = static_cast<std::uint32_t>(first),
                             .vertex_count = static_cast<std::uint32_t>(buildings.mesh.vertices.size() - first),
                             .footing_m = static_cast<float>(footing_m)});
}

double footing_m(const terrain::HeightField& terrain, const RoofedBuilding& building) {
  constexpr double sample_spacing_m = 2.0;
  const ConvexPolygon outline =
      oriented_rectangle(building.centre, building.along, building.length_m, building.depth_m);
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2d from = outline[i], side = outline[(i + 1) % outline.size()] - from;
    const auto samples = static_cast<int>(std::ceil(length(side) / sample_spacing_m));
    for (int n = 0; n < samples; ++n) {
      lowest = std::min(lowest, terrain.height_at(from + side * (static_cast<double>(n) / samples)));
    }
  }
  return lowest;
}

}  // namespace sigmascape::scene
