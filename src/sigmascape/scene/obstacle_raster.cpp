#include "sigmascape/scene/obstacle_raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "sigmascape/base/interruption.h"

namespace sigmascape::scene {
namespace {

using Corners = std::array<Vec3d, 3>;

/// Points along a cell's side at which it is asked whether a roof covers it, and how much of a crown.
constexpr std::size_t points_per_side = 5;

/// Twice the area of the triangle's shadow at noon, positive when it runs anticlockwise from above.
double twice_plan_area(Vec3d a, Vec3d b, Vec3d c) {
  return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

/// The points of cells.
radar::GroundGrid points_of(const radar::GroundGrid& cells) {
  return {cells.west_m, cells.north_m, cells.cell_m / static_cast<double>(points_per_side),
          cells.columns * points_per_side, cells.rows * points_per_side};
}

/// Calls `visit(column, row)` for those that a rectangle may cover.
template <typename Visit>
void for_points_under(const radar::Rectangle& rectangle, const radar::GroundGrid& points, const Visit& visit) {
  const auto index_from = [](double cells, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(std::floor(cells), 0.0, static_cast<double>(count)));
  };
  const Vec2d first = points.cells_from({rectangle.west_m, rectangle.north_m}),
              last = points.cells_from({rectangle.east_m, rectangle.south_m});
  for (std::size_t row = index_from(first.y, points.rows); row < index_from(last.y + 1.0, points.rows); ++row) {
    for (std::size_t column = index_from(first.x, points.columns); column < index_from(last.x + 1.0, points.columns);
         ++column)
      visit(column, row);
  }
}

/// Buildings seen from above on points finer than the cells.
class RoofRaster {
 public:
  explicit RoofRaster(const radar::GroundGrid& cells)
      : points_(points_of(cells)), height_m_(points_.columns, points_.rows) {}

  void add(const Corners& triangle, const terrain::HeightField& ground) {
    const auto [a, b, c] = triangle;
    const double whole = twice_plan_area(a, b, c);
    if (std::abs(whole) < 1e-9) return;  // a wall
    const auto [west, east] = std::minmax({a.x, b.x, c.x});
    const auto [south, north] = std::minmax({a.y, b.y, c.y});
    for_points_under({west, south, east, north}, points_, [&](std::size_t column, std::size_t row) {
      const Vec2d p = points_.centre_of(column, row);
      const Vec3d at{p.x, p.y, 0.0};
      const double of_b = twice_plan_area(a, at, c) / whole, of_c = twice_plan_area(a, b, at) / whole;
      if (of_b < 0.0 || of_c < 0.0 || of_b + of_c > 1.0) return;
      const double height = a.z + of_b * (b.z - a.z) + of_c * (c.z - a.z) - ground.height_at(p);
      height_m_(column, row) = std::max(height_m_(column, row), static_cast<float>(height));
    });
  }

  /// The highest roof over a cell that is at least half covered, else 0.
  [[nodiscard]] float solid_top_m(std::size_t column, std::size_t row) const {
    float highest = 0.0F;
    std::size_t covered = 0;
    for (std::size_t j = 0; j < points_per_side; ++j) {
      for (std::size_t i = 0; i < points_per_side; ++i) {
        const float height = height_m_(column * points_per_side + i, row * points_per_side + j);
        highest = std::max(highest, height);
        if (height > 0.0F) ++covered;
      }
    }
    return 2 * covered >= points_per_side * points_per_side ? highest : 0.0F;
  }

 private:
  radar::GroundGrid points_;
  Array2D<float> height_m_;
};

/// An instance of a crown that is a medium.
struct StandingCrown {
  Vec3d centre;   ///< in the scene's frame
  Vec3d radii_m;  ///< along its own axes, the third upright
  double cos_yaw = 1.0, sin_yaw = 0.0;
  double extinction_per_m = 0.0;

  /// Half the length of the upright line through it at a place; 0 beside it.
  [[nodiscard]] double half_chord_m(Vec2d place) const {
    const double x = place.x - centre.x, y = place.y - centre.y;
    const double u = (x * cos_yaw - y * sin_yaw) / radii_m.x, v = (x * sin_yaw + y * cos_yaw) / radii_m.y;
    return radii_m.z * std::sqrt(std::max(0.0, 1.0 - u * u - v * v));
  }
};

/// The surface that stands over one cell.
struct Foliage {
  double area_m2 = 0.0, base_m = 0.0, top_m = 0.0;
};

static_assert(points_per_side * points_per_side * sizeof(float) + sizeof(Foliage) + sizeof(radar::Obstacle) ==
              static_cast<std::size_t>(obstacle_raster_bytes_a_cell));

class FoliageRaster {
 public:
  explicit FoliageRaster(const radar::GroundGrid& cells) : cells_(cells), foliage_(cells.columns, cells.rows) {}

  /// Adds a triangle, cut until its pieces are small against the cells. What lies beside the grid is not cut: the work
  /// grows with the cells that a triangle covers, however large it is.
  void add(const Corners& triangle, const terrain::HeightField& ground) {
    if (lies_beside_grid(triangle)) return;
    const auto [a, b, c] = triangle;
    const std::array<double, 3> sides{plan_distance(a, b), plan_distance(b, c), plan_distance(c, a)};
    const auto longest = std::ranges::max_element(sides);
    if (*longest <= cells_.cell_m / 2.0) {
      add_piece(triangle, ground);
      return;
    }
    const auto first = static_cast<std::size_t>(longest - sides.begin());
    const Vec3d from = triangle[first], to = triangle[(first + 1) % 3], opposite = triangle[(first + 2) % 3];
    const Vec3d middle = (from + to) * 0.5;
    add({from, middle, opposite}, ground);
    add({middle, to, opposite}, ground);
  }

  /// Adds as much surface as even leaves of that extinction have: docs/physics/vegetation.md, Eq. (1).
  void add(const StandingCrown& crown, const terrain::HeightField& ground) {
    const double reach_m = std::max(crown.radii_m.x, crown.radii_m.y);
    const auto& [x, y, z] = crown.centre;
    const radar::GroundGrid points = points_of(cells_);
    for_points_under({x - reach_m, y - reach_m, x + reach_m, y + reach_m}, points,
                     [&](std::size_t column, std::size_t row) {
                       const Vec2d place = points.centre_of(column, row);
                       const double half_m = crown.half_chord_m(place);
                       if (half_m == 0.0) return;
                       const double middle_m = crown.centre.z - ground.height_at(place);
                       add_surface(foliage_(column / points_per_side, row / points_per_side),
                                   4.0 * crown.extinction_per_m * half_m * points.cell_area_m2(), middle_m - half_m,
                                   middle_m + half_m);
                     });
  }

  void write_to(radar::Obstacle& obstacle, std::size_t column, std::size_t row) const {
    const Foliage& foliage = foliage_(column, row);
    if (!(foliage.top_m > foliage.base_m)) return;
    obstacle.crown_base_m = static_cast<float>(foliage.base_m);
    obstacle.crown_top_m = static_cast<float>(foliage.top_m);
    obstacle.crown_extinction_per_m =
        static_cast<float>(foliage.area_m2 / (2.0 * cells_.cell_area_m2() * (foliage.top_m - foliage.base_m)));
  }

 private:
  static double plan_distance(Vec3d a, Vec3d b) {
    const double x = a.x - b.x, y = a.y - b.y;
    return std::sqrt(x * x + y * y);
  }

  [[nodiscard]] bool lies_beside_grid(const Corners& triangle) const {
    const auto [a, b, c] = triangle;
    const auto [west, east] = std::minmax({a.x, b.x, c.x});
    const auto [south, north] = std::minmax({a.y, b.y, c.y});
    const radar::Rectangle grid = cells_.extent();
    return east < grid.west_m || west > grid.east_m || north < grid.south_m || south > grid.north_m;
  }

  void add_piece(const Corners& piece, const terrain::HeightField& ground) {
    const auto [a, b, c] = piece;
    const Vec2d middle{(a.x + b.x + c.x) / 3.0, (a.y + b.y + c.y) / 3.0};
    const Vec2d cell = cells_.cells_from(middle);
    if (cell.x < 0.0 || cell.y < 0.0 || cell.x >= static_cast<double>(cells_.columns) ||
        cell.y >= static_cast<double>(cells_.rows)) {
      return;
    }
    const double ground_m = ground.height_at(middle);
    const auto [lowest, highest] = std::minmax({a.z, b.z, c.z});
    add_surface(foliage_(static_cast<std::size_t>(cell.x), static_cast<std::size_t>(cell.y)),
                length(cross(b - a, c - a)) / 2.0, lowest - ground_m, highest - ground_m);
  }

  static void add_surface(Foliage& foliage, double area_m2, double lowest_m, double highest_m) {
    const double base_m = std::max(0.0, lowest_m);
    foliage.base_m = foliage.area_m2 == 0.0 ? base_m : std::min(foliage.base_m, base_m);
    foliage.top_m = std::max(foliage.top_m, highest_m);
    foliage.area_m2 += area_m2;
  }

  radar::GroundGrid cells_;
  Array2D<Foliage> foliage_;
};

Corners corners_of(const std::array<std::uint32_t, 3>& triangle, const std::vector<Vec3d>& vertices) {
  return {vertices[triangle[0]], vertices[triangle[1]], vertices[triangle[2]]};
}

using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Point = std::array<float, 3>;

Point point_of(const Mesh& mesh, std::uint32_t index) {
  const Vec3f& vertex = mesh.vertices[index];
  return {vertex.x, vertex.y, vertex.z};
}

/// Each face once: meshes that are to be seen from both sides hold it twice.
Triangles faces_of(const Mesh& mesh) {
  std::set<std::array<Point, 3>> known;
  Triangles faces;
  for (const auto& triangle : mesh.triangles) {
    Interruption::heed();
    std::array<Point, 3> corners{};
    std::ranges::transform(triangle, corners.begin(), [&](std::uint32_t index) { return point_of(mesh, index); });
    std::ranges::sort(corners);
    if (known.insert(corners).second) faces.push_back(triangle);
  }
  return faces;
}

/// Whether a mesh of such faces stands for a body rather than for leaves, if it does not state which: at most half of
/// its edges are open, which belong to an odd number of faces. Houses and cars are often drawn without their underside
/// or with gaps; of a leaf, a card of one or two triangles, nearly all edges are open.
bool is_solid(const Mesh& mesh, const Triangles& faces) {
  if (mesh.is_solid) return *mesh.is_solid;
  std::map<std::pair<Point, Point>, std::size_t> triangles_of_edge;
  for (const auto& triangle : faces) {
    Interruption::heed();
    for (std::size_t i = 0; i < 3; ++i) {
      const Point a = point_of(mesh, triangle[i]), b = point_of(mesh, triangle[(i + 1) % 3]);
      ++triangles_of_edge[std::minmax(a, b)];
    }
  }
  const auto open = std::ranges::count_if(triangles_of_edge, [](const auto& edge) { return edge.second % 2 == 1; });
  return 2 * static_cast<std::size_t>(open) <= triangles_of_edge.size();
}

void add_buildings(const Scene& scene, RoofRaster& roofs) {
  std::vector<Vec3d> vertices;
  for (const Vec3f& vertex : scene.buildings.mesh.vertices) vertices.push_back(vertex.to<double>());
  for (const Building& building : scene.buildings.items) {
    for (std::uint32_t i = 0; i < building.vertex_count; ++i) {
      vertices[building.first_vertex + i].z += static_cast<double>(building.footing_m);
    }
  }
  for (const auto& triangle : scene.buildings.mesh.triangles) {
    Interruption::heed();
    roofs.add(corners_of(triangle, vertices), scene.terrain);
  }
}

/// Where an instance's prototype goes.
class Standing {
 public:
  Standing(const Instance& instance, const terrain::HeightField& terrain)
      : scale_(instance.scale.to<double>()),
        size_(instance.size()),
        origin_{static_cast<double>(instance.x_m), static_cast<double>(instance.y_m),
                terrain.height_at({instance.x_m, instance.y_m}) + static_cast<double>(instance.lift_m)},
        cos_yaw_(std::cos(static_cast<double>(instance.yaw_rad))),
        sin_yaw_(std::sin(static_cast<double>(instance.yaw_rad))) {}

  [[nodiscard]] Vec3d place_of(Vec3f point) const {
    const Vec3d scaled = scaled_by(point);
    return origin_ +
           Vec3d{scaled.x * cos_yaw_ + scaled.y * sin_yaw_, scaled.y * cos_yaw_ - scaled.x * sin_yaw_, scaled.z};
  }
  [[nodiscard]] StandingCrown crown_of(const Crown& crown, const scatter::CrownParameters& medium) const {
    return {place_of(crown.shape.centre), scaled_by(crown.shape.radii_m), cos_yaw_, sin_yaw_,
            medium.two_way_extinction_per_m() * static_cast<double>(crown.extinction_scale(size_))};
  }

 private:
  [[nodiscard]] Vec3d scaled_by(Vec3f point) const {
    return {static_cast<double>(point.x) * scale_.x, static_cast<double>(point.y) * scale_.y,
            static_cast<double>(point.z) * scale_.z};
  }

  Vec3d scale_;
  float size_;
  Vec3d origin_;
  double cos_yaw_, sin_yaw_;
};

/// What a prototype hides by.
struct Shape {
  Triangles faces;
  bool is_solid;

  explicit Shape(const Mesh& mesh) : faces(faces_of(mesh)), is_solid(scene::is_solid(mesh, faces)) {}
};

void add_instances(const Scene& scene, const radar::Rectangle& area, RoofRaster& roofs, FoliageRaster& foliage) {
  // Large meshes take long to look through, and most stand elsewhere.
  std::vector<std::optional<Shape>> shapes(scene.prototypes.size());
  const std::vector<float> reaches_m = prototype_radii_m(scene);
  std::vector<Vec3d> vertices;
  for (const Instance& instance : scene.instances) {
    Interruption::heed();
    const Mesh& mesh = scene.prototypes[instance.prototype];
    const auto reach =
        static_cast<double>(reaches_m[instance.prototype] * std::max(instance.scale.x, instance.scale.y));
    const radar::Rectangle near{area.west_m - reach, area.south_m - reach, area.east_m + reach, area.north_m + reach};
    if (!near.contains({instance.x_m, instance.y_m})) continue;
    auto& shape = shapes[instance.prototype];
    if (!shape) shape.emplace(mesh);
    const Standing standing(instance, scene.terrain);
    vertices.clear();
    for (const Vec3f& vertex : mesh.vertices) vertices.push_back(standing.place_of(vertex));
    for (const auto& triangle : shape->faces) {
      const Corners corners = corners_of(triangle, vertices);
      if (shape->is_solid) {
        roofs.add(corners, scene.terrain);
      } else {
        foliage.add(corners, scene.terrain);
      }
    }
    for (const Crown& crown : scene.crowns) {
      if (crown.prototype == instance.prototype)
        foliage.add(standing.crown_of(crown, std::get<scatter::CrownParameters>(scene.materials[crown.medium].model)),
                    scene.terrain);
    }
  }
}

}  // namespace

radar::ObstacleMap obstacles_of(const Scene& scene, const radar::GroundGrid& grid) {
  RoofRaster roofs(grid);
  add_buildings(scene, roofs);
  FoliageRaster foliage(grid);
  add_instances(scene, grid.extent(), roofs, foliage);
  radar::ObstacleMap map{grid, Array2D<radar::Obstacle>(grid.columns, grid.rows)};
  for (std::size_t row = 0; row < grid.rows; ++row) {
    Interruption::heed();
    for (std::size_t column = 0; column < grid.columns; ++column) {
      map.obstacles(column, row).solid_top_m = roofs.solid_top_m(column, row);
      foliage.write_to(map.obstacles(column, row), column, row);
    }
  }
  return map;
}

radar::ObstacleMap obstacles_of(const Scene& scene, double cell_m) {
  // The last cells may reach beyond the scene, but by no rounding.
  const auto cells = [cell_m](double length_m) {
    return static_cast<std::size_t>(std::ceil(length_m / cell_m - 1e-6));
  };
  return obstacles_of(scene, radar::GroundGrid{scene.extent.west_m, scene.extent.north_m, cell_m,
                                               cells(scene.extent.width_m()), cells(scene.extent.height_m())});
}

}  // namespace sigmascape::scene
