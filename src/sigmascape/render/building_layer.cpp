#include "sigmascape/render/building_layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <utility>
#include <vector>

#include "sigmascape/atlas/texel_blend.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/parallel.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/rectangle_parts.h"
#include "sigmascape/receiver/ground_accumulator.h"
#include "sigmascape/render/face_sight.h"

namespace sigmascape::render {
namespace {

/// Parts of a face no longer than this are taken or left as they lie over into a map or not.
constexpr double longest_part_m = 32.0;

/// Beyond this many times its height above the ground nothing lies over to a radar: at 85°.
constexpr double farthest_layover = 11.4;
/// Nor does anything from farther away than this.
constexpr double widest_layover_m = 1000.0;

/// Of the squares of a level that meet an area, and one more all around.
radar::GroundGrid squares_over(const radar::Rectangle& area, double side_m) {
  const double west = std::floor(area.west_m / side_m) - 1.0, north = std::ceil(area.north_m / side_m) + 1.0;
  const double east = std::ceil(area.east_m / side_m) + 1.0, south = std::floor(area.south_m / side_m) - 1.0;
  return {west * side_m, north * side_m, side_m, static_cast<std::size_t>(east - west),
          static_cast<std::size_t>(north - south)};
}

using Corners = std::array<Vec3d, 3>;

Vec3d middle_of(const Corners& corners) {
  return (corners[0] + corners[1] + corners[2]) * (1.0 / 3.0);
}

/// Halves a triangle across its longest edge, and these again, until no edge is longer; calls `visit(corners, area_m2)`
/// for each piece.
template <typename Visit>
void for_each_piece(const Corners& corners, double area_m2, double longest_m, const Visit& visit) {
  std::size_t longest = 0;
  const auto edge_of = [&](std::size_t first) { return corners[(first + 1) % 3] - corners[first]; };
  for (const std::size_t other : {std::size_t{1}, std::size_t{2}}) {
    if (dot(edge_of(other), edge_of(other)) > dot(edge_of(longest), edge_of(longest))) longest = other;
  }
  if (dot(edge_of(longest), edge_of(longest)) <= longest_m * longest_m) return visit(corners, area_m2);
  const Vec3d from = corners[longest], to = corners[(longest + 1) % 3], apex = corners[(longest + 2) % 3];
  const Vec3d half_way = (from + to) * 0.5;
  for_each_piece({from, half_way, apex}, 0.5 * area_m2, longest_m, visit);
  for_each_piece({half_way, to, apex}, 0.5 * area_m2, longest_m, visit);
}

/// The least rectangle that holds three places.
radar::Rectangle rectangle_about(Vec2d first, Vec2d second, Vec2d third) {
  return radar::with_point(radar::with_point({first.x, first.y, first.x, first.y}, second), third);
}

radar::Rectangle plan_of(const Corners& corners) {
  const auto [a, b, c] = corners;
  return rectangle_about({a.x, a.y}, {b.x, b.y}, {c.x, c.y});
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

  Corners corners;
  Vec3d normal;
  double area_m2;
  std::uint8_t material;
};

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
  const auto bounded = [&](double wanted_m) { return std::clamp(wanted_m, -most_m, std::min(most_m, distance_m)); };
  double over_m = bounded(above_m * away.z / distance_m);  // over level ground, from afar
  constexpr int most_steps = 4;                            // of Newton's, with the slope of the ground
  constexpr double precise_m = 0.01;
  for (int step = 0; step < most_steps; ++step) {
    const Vec2d place = foot + towards * over_m;
    const Vec3d normal = terrain.normal_at(place);
    const double rise = -(normal.x * towards.x + normal.y * towards.y) / normal.z;
    const double left_m = distance_m - over_m, down_m = radar.z - terrain.height_at(place);
    const double there_m = std::hypot(left_m, down_m);
    // Ground that itself lies over, or lies at no such range under the radar.
    const double nearer = left_m + down_m * rise;
    if (nearer < 0.05 * there_m) break;
    const double before_m = std::exchange(over_m, bounded(over_m + (there_m - range_m) * there_m / nearer));
    if (std::abs(over_m - before_m) < precise_m) break;
  }
  return foot + towards * over_m;
}

/// Whether echoes of a part of a face may belong to a grid: where those of its corners do holds all between them, but
/// for what the ground rises and falls there.
bool may_land_in(const radar::GroundGrid& grid, const Corners& corners, Vec3d radar,
                 const terrain::HeightField& terrain) {
  const auto landing = [&](const Vec3d& corner) { return landing_of(corner, radar, terrain); };
  const radar::Rectangle box = rectangle_about(landing(corners[0]), landing(corners[1]), landing(corners[2]));
  return radar::meet(radar::widened(box, 2.0 * grid.cell_m + 0.25 * std::max(box.width_m(), box.height_m())),
                     grid.extent());
}

/// What of a face may answer in a map.
struct Part {
  Corners corners;
  double area_m2;
  Vec3d normal, radar;
  std::uint8_t material;
};

/// Of all faces that show themselves to the radar, what may land in a grid.
std::vector<Part> parts_in(const radar::GroundGrid& grid, const atlas::Buildings& buildings,
                           const radar::Vantage& vantage, const terrain::HeightField& terrain, unsigned threads) {
  constexpr std::size_t together = 4096;  // faces
  const radar::Rectangle about = radar::widened(grid.extent(), widest_layover_m);
  const std::size_t count = buildings.triangles.size();
  std::vector<std::vector<Part>> stretches((count + together - 1) / together);
  parallel_for(stretches.size(), thread_count(threads), [&](std::size_t stretch, unsigned) {
    for (std::size_t number = stretch * together; number < std::min(count, (stretch + 1) * together); ++number) {
      const Face face(buildings, number);
      if (!radar::meet(plan_of(face.corners), about)) continue;
      const Vec3d middle = middle_of(face.corners), radar = vantage.place_for({middle.x, middle.y});
      if (dot(face.normal, radar - middle) <= 0.0) continue;
      for_each_piece(face.corners, face.area_m2, longest_part_m, [&](const Corners& corners, double area_m2) {
        if (may_land_in(grid, corners, radar, terrain))
          stretches[stretch].push_back({corners, area_m2, face.normal, radar, face.material});
      });
    }
  });
  std::vector<Part> parts;
  for (const std::vector<Part>& some : stretches) parts.insert(parts.end(), some.begin(), some.end());
  return parts;
}

/// The least rectangle that holds them all; there is one at least.
radar::Rectangle plan_of(const std::vector<Part>& parts) {
  radar::Rectangle plan = plan_of(parts.front().corners);
  for (const Part& part : parts) plan = radar::joined(plan, plan_of(part.corners));
  return plan;
}

/// By blocks of the ground: what is known of all lines of sight to one fits into memory, however wide the map is.
std::vector<std::vector<Part>> in_blocks(const std::vector<Part>& parts) {
  if (parts.empty()) return {};
  constexpr double block_m = 2000.0;
  const auto blocks_in = [](double length_m) { return static_cast<std::size_t>(length_m / block_m); };
  const radar::Rectangle plan = plan_of(parts);
  const std::size_t columns = blocks_in(plan.width_m()) + 1, rows = blocks_in(plan.height_m()) + 1;
  std::vector<std::vector<Part>> blocks(columns * rows);
  for (const Part& part : parts) {
    const Vec3d middle = middle_of(part.corners);
    blocks[blocks_in(plan.north_m - middle.y) * columns + blocks_in(middle.x - plan.west_m)].push_back(part);
  }
  std::erase_if(blocks, [](const std::vector<Part>& block) { return block.empty(); });
  return blocks;
}

/// Where a point lies among the middles of squares.
struct AmongSquares {
  AmongSquares(Vec2d point, const radar::GroundGrid& grid) {
    const double across = (point.x - grid.west_m) / grid.cell_m - 0.5,
                 down = (grid.north_m - point.y) / grid.cell_m - 0.5;
    column = std::floor(across);
    row = std::floor(down);
    right = across - column;
    below = down - row;
  }

  double column, row;   ///< of the north-western one of four
  double right, below;  ///< how far on the way to the next, from 0 to 1
};

/// Gives what a piece returns to the squares that it lies on, as though it were as wide as one: its longest edge is.
void add(const radar::Channels& rcs_m2, Vec2d place, const radar::GroundGrid& grid, receiver::GroundAccumulator& sums) {
  const AmongSquares at(place, grid);
  for (const auto& [east, share_across] : {std::pair(0.0, 1.0 - at.right), {1.0, at.right}}) {
    for (const auto& [south, share_down] : {std::pair(0.0, 1.0 - at.below), {1.0, at.below}}) {
      const auto share = static_cast<float>(share_across * share_down);
      const Vec2d middle{grid.west_m + (at.column + east + 0.5) * grid.cell_m,
                         grid.north_m - (at.row + south + 0.5) * grid.cell_m};
      const auto square = sums.cell_at(middle);
      if (share > 0.0F && square) sums.add(*square, rcs_m2 * share, 0.0);
    }
  }
}

}  // namespace

BuildingLayer::BuildingLayer(const atlas::Atlas& atlas, const terrain::HeightField& terrain,
                             const LayerRequest& request) {
  const atlas::GroundLayers& layers = *atlas.ground_layers();
  const atlas::Buildings& buildings = *layers.buildings;
  grid_ = squares_over(request.area, atlas.patches().texel_m * std::exp2(std::floor(request.level)));
  receiver::GroundAccumulator sums(grid_);
  const auto reflectivity = reflectivity_at(buildings, atlas.aspects(), request.frequency_hz);
  // Pieces beside the grid have a share on its squares.
  const radar::Rectangle taken_from = radar::widened(grid_.extent(), 0.5 * grid_.cell_m);
  for (const std::vector<Part>& parts :
       in_blocks(parts_in(grid_, buildings, request.vantage, terrain, request.threads))) {
    const FaceSight sight(layers.obstacles, terrain, request.vantage, plan_of(parts), request.earth, request.threads);
    parallel_for(parts.size(), thread_count(request.threads), [&](std::size_t number, unsigned) {
      const Part& part = parts[number];
      for_each_piece(part.corners, part.area_m2, grid_.cell_m, [&](const Corners& piece, double area_m2) {
        const Vec3d point = middle_of(piece);
        Vec3d away = part.radar - point;
        away.z -= request.earth.drop_m(std::hypot(away.x, away.y));
        const radar::Channels returned = reflectivity[part.material].at(dot(part.normal, normalized(away)));
        if (returned == radar::Channels{}) return;
        const double passed = sight.part_passed(point, part.normal, part.radar);
        if (passed == 0.0) return;
        const Vec2d place = landing_of(point, part.radar, terrain);
        if (taken_from.contains(place)) add(returned * static_cast<float>(passed * area_m2), place, grid_, sums);
      });
    });
  }
  if (sums.bins().overflows() > 0) {
    throw Error("buildings kept apart",
                fmt::format("a square of {:g} m that they return to is brighter than the sums can hold", grid_.cell_m),
                "take a finer level of detail, or bake rougher materials");
  }
  sigma0_ = sums.sigma0();
}

std::shared_ptr<const BuildingLayer> building_layer(const atlas::Atlas& atlas, const terrain::HeightField& terrain,
                                                    const LayerRequest& request) {
  const atlas::GroundLayers* layers = atlas.ground_layers();
  if (layers == nullptr || !layers->buildings) return nullptr;
  return std::make_shared<const BuildingLayer>(atlas, terrain, request);
}

radar::Channels BuildingLayer::sigma0_at(Vec2d point) const {
  const AmongSquares at(point, grid_);
  if (!(at.column >= 0.0 && at.row >= 0.0 && at.column + 1.0 < static_cast<double>(grid_.columns) &&
        at.row + 1.0 < static_cast<double>(grid_.rows)))
    return {};
  const auto i = static_cast<std::size_t>(at.column), j = static_cast<std::size_t>(at.row);
  const float right = atlas::share_of_next(at.right), below = atlas::share_of_next(at.below);
  return (sigma0_(i, j) * (1.0F - right) + sigma0_(i + 1, j) * right) * (1.0F - below) +
         (sigma0_(i, j + 1) * (1.0F - right) + sigma0_(i + 1, j + 1) * right) * below;
}

}  // namespace sigmascape::render
