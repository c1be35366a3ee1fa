#include "sigmascape/render/building_layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "sigmascape/base/parallel.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/rectangle_parts.h"
#include "sigmascape/receiver/ground_accumulator.h"
#include "sigmascape/render/face_sight.h"

namespace sigmascape::render {
namespace {

/// Points that a face has for each square of its own area.
constexpr double points_a_square = 4.0;

/// Faces that are near together ask once what hides them from afar.
constexpr double cluster_m = 32.0;

/// Beyond this many times its height above the ground nothing lies over to a radar: at 85°.
constexpr double farthest_layover = 11.4;

/// Of the squares of a level that meet an area, and one more all around.
radar::GroundGrid squares_over(const radar::Rectangle& area, double side_m) {
  const double west = std::floor(area.west_m / side_m) - 1.0, north = std::ceil(area.north_m / side_m) + 1.0;
  const double east = std::ceil(area.east_m / side_m) + 1.0, south = std::floor(area.south_m / side_m) - 1.0;
  return {west * side_m, north * side_m, side_m, static_cast<std::size_t>(east - west),
          static_cast<std::size_t>(north - south)};
}

/// A face as it stands.
struct Face {
  Face(const atlas::Buildings& buildings, std::size_t number) {
    for (std::size_t i = 0; i < 3; ++i) corners[i] = buildings.vertices[buildings.triangles[number][i]].to<double>();
    const Vec3d twice = cross(corners[1] - corners[0], corners[2] - corners[0]);
    area_m2 = 0.5 * length(twice);
    normal = area_m2 > 0.0 ? twice * (0.5 / area_m2) : Vec3d{};
    material = buildings.material_of[number];
  }
  [[nodiscard]] Vec3d middle() const { return (corners[0] + corners[1] + corners[2]) * (1.0 / 3.0); }
  /// One of `count` points that lie evenly over it: a square root along one side, a low-discrepancy sequence across.
  [[nodiscard]] Vec3d point(std::size_t index, std::size_t count) const {
    constexpr double plastic = 0.7548776662466927;  // one over the plastic number
    const double along = std::sqrt((static_cast<double>(index) + 0.5) / static_cast<double>(count));
    const double turn = 0.5 + plastic * static_cast<double>(index), across = turn - std::floor(turn);
    return corners[0] * (1.0 - along) + corners[1] * (along * (1.0 - across)) + corners[2] * (along * across);
  }

  std::array<Vec3d, 3> corners;
  Vec3d normal;
  double area_m2;
  std::uint8_t material;
};

/// Numbers of faces by the square of `cluster_m` that they stand in, of those whose echoes may lie in an area.
std::vector<std::vector<std::uint32_t>> clusters_of(const atlas::Buildings& buildings, const radar::Rectangle& about) {
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::uint32_t>> by_square;
  for (std::size_t number = 0; number < buildings.triangles.size(); ++number) {
    const Vec3d middle = Face(buildings, number).middle();
    if (!about.contains({middle.x, middle.y})) continue;
    by_square[{static_cast<std::int64_t>(std::floor(middle.x / cluster_m)),
               static_cast<std::int64_t>(std::floor(middle.y / cluster_m))}]
        .push_back(static_cast<std::uint32_t>(number));
  }
  std::vector<std::vector<std::uint32_t>> clusters;
  for (auto& [square, faces] : by_square) clusters.push_back(std::move(faces));
  return clusters;
}

/// What every material returns at one frequency.
std::vector<radar::FaceReflectivity> reflectivity_at(const atlas::Buildings& buildings, const atlas::AspectGrid& grid,
                                                     double frequency_hz) {
  // Of a look that was baked, only frequencies are left to be blended.
  const atlas::AspectWeights weights =
      atlas::weights_for(grid, {grid.azimuths_rad.front(), grid.elevations_rad.front()}, frequency_hz);
  std::vector<radar::FaceReflectivity> all;
  for (const atlas::FaceMaterial& material : buildings.materials) {
    radar::FaceReflectivity& blended = all.emplace_back();
    blended.at_node.resize(radar::FaceReflectivity::node_count);
    for (std::size_t i = 0; i < weights.count; ++i) {
      const std::size_t frequency = weights.look[i] / (grid.azimuths_rad.size() * grid.elevations_rad.size());
      for (std::size_t node = 0; node < radar::FaceReflectivity::node_count; ++node)
        blended.at_node[node] += material.reflectivity[frequency].at_node[node] * weights.weight[i];
    }
  }
  return all;
}

/// Where on the ground an echo of a point belongs: towards the radar, where its range meets the terrain.
Vec2d landing_of(Vec3d point, Vec3d radar, const terrain::HeightField& terrain) {
  const Vec2d foot{point.x, point.y};
  const Vec3d away = radar - point;
  const double distance_m = std::hypot(away.x, away.y), range_m = length(away);
  if (distance_m == 0.0) return foot;
  const Vec2d towards{away.x / distance_m, away.y / distance_m};
  const double above_m = point.z - terrain.height_at(foot);
  const double most_m = farthest_layover * std::max(std::abs(above_m), 1.0);
  double over_m = 0.0;
  constexpr int steps = 6;  // each leaves of the error what the slope is to the line of sight
  for (int step = 0; step < steps; ++step) {
    const Vec2d place = foot + towards * over_m;
    const double left_m = distance_m - over_m, down_m = radar.z - terrain.height_at(place);
    const double there_m = std::hypot(left_m, down_m);
    over_m = std::clamp(over_m + (there_m - range_m) * there_m / std::max(left_m, 0.05 * there_m), -most_m, most_m);
  }
  return foot + towards * over_m;
}

/// Whether echoes of a face may belong to a grid: where those of its corners do holds all between them, but for what
/// the ground rises and falls there.
bool may_land_in(const radar::GroundGrid& grid, const Face& face, Vec3d radar, const terrain::HeightField& terrain) {
  const Vec2d first = landing_of(face.corners[0], radar, terrain);
  radar::Rectangle box{first.x, first.y, first.x, first.y};
  for (const Vec3d& corner : {face.corners[1], face.corners[2]})
    box = radar::with_point(box, landing_of(corner, radar, terrain));
  return radar::meet(radar::widened(box, 2.0 * grid.cell_m + 0.25 * std::max(box.width_m(), box.height_m())),
                     grid.extent());
}

/// Share of the next square in a point so far on the way from one's middle to its: as atlas::Atlas blends texels.
float share_of_next(double way) {
  return std::clamp(2.0F * static_cast<float>(way) - 0.5F, 0.0F, 1.0F);
}

}  // namespace

BuildingLayer::BuildingLayer(const atlas::Atlas& atlas, const terrain::HeightField& terrain,
                             const LayerRequest& request) {
  const atlas::GroundLayers& layers = *atlas.ground_layers();
  const atlas::Buildings& buildings = *layers.buildings;
  grid_ = squares_over(request.area, atlas.patches().texel_m * std::exp2(std::floor(request.level)));
  const FaceSight sight(layers.obstacles, terrain, request.earth);
  const auto reflectivity = reflectivity_at(buildings, atlas.aspects(), request.frequency_hz);
  const auto clusters = clusters_of(buildings, radar::widened(grid_.extent(), farthest_layover * sight.tallest_m()));
  receiver::GroundAccumulator sums(grid_);
  parallel_for(clusters.size(), thread_count(request.threads), [&](std::size_t cluster, unsigned) {
    std::optional<double> clear_above_m;
    for (const std::uint32_t number : clusters[cluster]) {
      const Face face(buildings, number);
      const Vec3d middle = face.middle();
      const Vec3d radar = request.vantage.place_for({middle.x, middle.y});
      const bool looks_away = dot(face.normal, radar - middle) <= 0.0;
      if (looks_away || !may_land_in(grid_, face, radar, terrain)) continue;
      if (!clear_above_m) clear_above_m = sight.clear_above_m({middle.x, middle.y}, radar);
      const auto count =
          static_cast<std::size_t>(std::ceil(points_a_square * face.area_m2 / (grid_.cell_m * grid_.cell_m)));
      for (std::size_t i = 0; i < count; ++i) {
        const Vec3d point = face.point(i, count);
        Vec3d away = radar - point;
        away.z -= request.earth.drop_m(std::hypot(away.x, away.y));
        const radar::Channels returned = reflectivity[face.material].at(dot(face.normal, normalized(away)));
        if (returned == radar::Channels{}) continue;
        const auto square = sums.cell_at(landing_of(point, radar, terrain));
        if (!square) continue;
        const double passed = sight.part_passed(point, face.normal, radar, *clear_above_m);
        if (passed > 0.0)
          sums.add(*square, returned * static_cast<float>(passed * face.area_m2 / static_cast<double>(count)), 0.0);
      }
    }
  });
  sigma0_ = sums.sigma0();
}

std::shared_ptr<const BuildingLayer> building_layer(const atlas::Atlas& atlas, const terrain::HeightField& terrain,
                                                    const LayerRequest& request) {
  const atlas::GroundLayers* layers = atlas.ground_layers();
  if (layers == nullptr || !layers->buildings) return nullptr;
  return std::make_shared<const BuildingLayer>(atlas, terrain, request);
}

radar::Channels BuildingLayer::sigma0_at(Vec2d point) const {
  const double across = (point.x - grid_.west_m) / grid_.cell_m - 0.5;
  const double down = (grid_.north_m - point.y) / grid_.cell_m - 0.5;
  const double column = std::floor(across), row = std::floor(down);
  if (!(column >= 0.0 && row >= 0.0 && column + 1.0 < static_cast<double>(grid_.columns) &&
        row + 1.0 < static_cast<double>(grid_.rows)))
    return {};
  const auto i = static_cast<std::size_t>(column), j = static_cast<std::size_t>(row);
  const float u = share_of_next(across - column), v = share_of_next(down - row);
  return (sigma0_(i, j) * (1.0F - u) + sigma0_(i + 1, j) * u) * (1.0F - v) +
         (sigma0_(i, j + 1) * (1.0F - u) + sigma0_(i + 1, j + 1) * u) * v;
}

}  // namespace sigmascape::render
