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
#include "sigmascape/radar/rectangle_parts.h"
#include "sigmascape/scene/buildings_within.h"
#include "sigmascape/scene/foliage_raster.h"
#include "sigmascape/scene/roof_raster.h"

namespace sigmascape::scene {
namespace {

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

/// Where an instance's prototype goes.
class Placement {
 public:
  Placement(const Instance& instance, const terrain::HeightField& terrain)
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

/// The rows of a grid, so many at a time.
struct Strips {
  radar::GroundGrid grid;
  std::size_t rows_each;

  /// Broad enough that few trees stand on the edge between two, and no broader, for memory's sake.
  explicit Strips(const radar::GroundGrid& of) : grid(of) {
    constexpr double broad_enough_m = 64.0, least_m = 10.0;
    const double rows =
        std::max(std::clamp(broad_enough_m / grid.cell_m, 4.0, 128.0), std::ceil(least_m / grid.cell_m));
    rows_each = rows < static_cast<double>(grid.rows) ? static_cast<std::size_t>(rows) : grid.rows;
  }

  [[nodiscard]] std::size_t count() const { return rows_each == 0 ? 0 : (grid.rows - 1) / rows_each + 1; }
  [[nodiscard]] std::size_t first_row(std::size_t strip) const { return strip * rows_each; }
  [[nodiscard]] std::size_t rows(std::size_t strip) const { return std::min(rows_each, grid.rows - first_row(strip)); }

  /// Where what lies counts for any: on them, or on the squares next to them.
  [[nodiscard]] radar::Rectangle place() const { return radar::widened(grid.extent(), grid.cell_m); }

  /// Calls `visit(strip)` for those for which what lies there counts.
  template <typename Visit>
  void for_each_with(const radar::Rectangle& part, const Visit& visit) const {
    if (!radar::meet(part, place())) return;
    const auto strip_from = [&](double rows, std::size_t most) {
      return static_cast<std::size_t>(
          std::clamp(std::floor(rows / static_cast<double>(rows_each)), 0.0, static_cast<double>(most)));
    };
    const double north = grid.cells_from({part.west_m, part.north_m}).y - 1.0,
                 south = grid.cells_from({part.west_m, part.south_m}).y + 1.0;
    const std::size_t end = std::min(strip_from(south, count()) + 1, count());
    for (std::size_t strip = strip_from(north, count()); strip < end; ++strip) visit(strip);
  }
};

/// What stands on each strip of a grid.
class Standing {
 public:
  Standing(const Scene& scene, const Strips& strips)
      : scene_(scene), building_faces_(strips.count()), instances_(strips.count()), shapes_(scene.prototypes.size()) {
    const std::vector<std::uint32_t> near = buildings_within(scene.buildings, strips.place());
    if (near.size() == scene.buildings.items.size()) {
      add_buildings(scene.buildings, strips);
    } else {
      add_buildings(part_of(scene.buildings, near), strips);
    }
    const std::vector<float> reaches_m = prototype_radii_m(scene);
    for (const Instance& instance : scene.instances) {
      Interruption::heed();
      const auto reach_m =
          static_cast<double>(reaches_m[instance.prototype] * std::max(instance.scale.x, instance.scale.y));
      const Vec2d at{instance.x_m, instance.y_m};
      strips.for_each_with(radar::widened({at.x, at.y, at.x, at.y}, reach_m), [&](std::size_t strip) {
        instances_[strip].push_back(&instance);
        // Large meshes take long to look through, and most stand elsewhere.
        auto& shape = shapes_[instance.prototype];
        if (!shape) shape.emplace(scene.prototypes[instance.prototype]);
      });
    }
  }

  void add_to(RoofRaster& roofs, FoliageRaster& foliage, std::size_t strip) const {
    for (const auto& triangle : building_faces_[strip]) {
      Interruption::heed();
      roofs.add(corners_of(triangle, building_vertices_), scene_.terrain);
    }
    std::vector<Vec3d> vertices;
    for (const Instance* instance : instances_[strip]) {
      Interruption::heed();
      const Placement placement(*instance, scene_.terrain);
      const Shape& shape = *shapes_[instance->prototype];
      vertices.clear();
      for (const Vec3f& vertex : scene_.prototypes[instance->prototype].vertices)
        vertices.push_back(placement.place_of(vertex));
      for (const auto& triangle : shape.faces) {
        const Corners corners = corners_of(triangle, vertices);
        if (shape.is_solid) {
          roofs.add(corners, scene_.terrain);
        } else {
          foliage.add(corners, scene_.terrain);
        }
      }
      for (const Crown& crown : scene_.crowns) {
        if (crown.prototype == instance->prototype)
          foliage.add(
              placement.crown_of(crown, std::get<scatter::CrownParameters>(scene_.materials[crown.medium].model)),
              scene_.terrain);
      }
    }
  }

 private:
  void add_buildings(const Buildings& buildings, const Strips& strips) {
    for (const Vec3f& vertex : buildings.mesh.vertices) building_vertices_.push_back(vertex.to<double>());
    for (const Building& building : buildings.items) {
      for (std::uint32_t i = 0; i < building.vertex_count; ++i)
        building_vertices_[building.first_vertex + i].z += static_cast<double>(building.footing_m);
    }
    for (const auto& triangle : buildings.mesh.triangles) {
      Interruption::heed();
      strips.for_each_with(plan_of(corners_of(triangle, building_vertices_)),
                           [&](std::size_t strip) { building_faces_[strip].push_back(triangle); });
    }
  }

  const Scene& scene_;
  std::vector<Vec3d> building_vertices_;
  std::vector<Triangles> building_faces_;
  std::vector<std::vector<const Instance*>> instances_;
  std::vector<std::optional<Shape>> shapes_;
};

/// Into how many along a side squares are cut for foliage. Parts of large ones would be too large to find the gaps
/// between trees.
std::size_t cuts_of(double square_m) {
  constexpr double small_enough_m = FoliageRaster::part_m * static_cast<double>(FoliageRaster::most_parts_per_side);
  constexpr std::size_t most = 4;  // for memory's sake
  std::size_t cuts = 1;
  while (cuts < most && square_m / static_cast<double>(cuts) > 1.001 * small_enough_m) cuts *= 2;
  return cuts;
}

/// The crowns over so many rows of squares, `cuts` by `cuts` of the foliage's each.
radar::ObstacleMap crowns_of(const FoliageRaster& foliage, const radar::GroundGrid& grid, std::size_t first_row,
                             std::size_t rows, std::size_t cuts) {
  radar::ObstacleMap crowns{parts_of({grid.west_m, grid.north_m, grid.cell_m, grid.columns, rows}, cuts), {}};
  crowns.obstacles = Array2D<radar::Obstacle>(crowns.grid.columns, crowns.grid.rows);
  for (std::size_t row = 0; row < crowns.grid.rows; ++row) {
    Interruption::heed();
    for (std::size_t column = 0; column < crowns.grid.columns; ++column)
      foliage.write_to(crowns.obstacles(column, row), column, first_row * cuts + row);
  }
  for (; cuts > 1; cuts /= 2) crowns = radar::halved(crowns);
  return crowns;
}

}  // namespace

radar::ObstacleMap obstacles_of(const Scene& scene, const radar::GroundGrid& grid) {
  radar::ObstacleMap map{grid, Array2D<radar::Obstacle>(grid.columns, grid.rows)};
  const Strips strips(grid);
  const Standing standing(scene, strips);
  const std::size_t cuts = cuts_of(grid.cell_m);
  RoofRaster roofs(grid, strips.rows_each);
  FoliageRaster foliage(parts_of(grid, cuts), cuts * strips.rows_each);
  for (std::size_t strip = 0; strip < strips.count(); ++strip) {
    const std::size_t first = strips.first_row(strip), rows = strips.rows(strip);
    roofs.move_to(first, rows);
    foliage.move_to(first * cuts, rows * cuts);
    standing.add_to(roofs, foliage, strip);
    const radar::ObstacleMap crowns = crowns_of(foliage, grid, first, rows, cuts);
    for (std::size_t row = first; row < first + rows; ++row) {
      std::ranges::copy(crowns.obstacles.row(row - first), map.obstacles.row(row).begin());
      for (std::size_t column = 0; column < grid.columns; ++column)
        map.obstacles(column, row).solid_top_m = roofs.solid_top_m(column, row);
    }
  }
  return map;
}

double obstacle_raster_bytes(const radar::GroundGrid& grid) {
  const std::size_t rows = Strips(grid).rows_each, cuts = cuts_of(grid.cell_m);
  const std::size_t of_map = grid.columns * grid.rows * sizeof(radar::Obstacle),
                    of_crowns = 2 * cuts * cuts * grid.columns * rows * sizeof(radar::Obstacle),
                    of_roofs = grid.columns * rows * RoofRaster::bytes_a_square;
  return static_cast<double>(of_map + of_crowns + of_roofs + FoliageRaster::bytes(parts_of(grid, cuts), cuts * rows));
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
