#include "sigmascape/trace/scene_structures.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <exception>
#include <mutex>
#include <span>
#include <utility>

#include "sigmascape/base/error.h"
#include "sigmascape/base/interruption.h"
#include "sigmascape/base/machine_memory.h"
#include "sigmascape/trace/ground_room.h"
#include "sigmascape/trace/ground_within.h"

namespace sigmascape::trace {
namespace {

/// How far the ground goes on beyond the edge of the terrain, level outwards.
constexpr double rim_m = 300.0;
constexpr std::size_t most_grid_nodes = 32767;  // along a side of Embree's grids

/// Crowns are never hit: a ray that crosses one is told so and goes on. Embree gives it in the prototype's frame, where
/// distances along the ray are what they are outside; `number` tells apart those of one prototype.
void cross_crown(const scene::Crown& crown, unsigned number, const RTCRay& ray, RTCIntersectContext* context) {
  const auto& [embree, crowns, tree_sizes] = *reinterpret_cast<const RayContext*>(context);
  if (crowns == nullptr) return;
  const Vec3f r = crown.shape.radii_m, c = crown.shape.centre;
  const Vec3d o = Vec3f{(ray.org_x - c.x) / r.x, (ray.org_y - c.y) / r.y, (ray.org_z - c.z) / r.z}.to<double>();
  const Vec3d d = Vec3f{ray.dir_x / r.x, ray.dir_y / r.y, ray.dir_z / r.z}.to<double>();
  const double d2 = dot(d, d), nearest = -dot(o, d) / d2;
  const Vec3d closest = o + d * nearest;
  const double half2 = (1.0 - dot(closest, closest)) / d2;
  if (half2 <= 0.0) return;
  const double half = std::sqrt(half2);
  if (nearest + half <= 0.0) return;
  const unsigned tree = embree.instID[0];
  crowns->add({.enter_m = static_cast<float>(std::max(0.0, nearest - half)),
               .leave_m = static_cast<float>(nearest + half),
               .extinction_scale = crown.extinction_scale(tree_sizes[tree]),
               .medium = crown.medium,
               .tree = tree,
               .crown = number});
}

const scene::Crown& crown_of(void* user_data) {
  return *static_cast<const scene::Crown*>(user_data);
}

void bound_crown(const RTCBoundsFunctionArguments* arguments) {
  const scene::Ellipsoid& shape = crown_of(arguments->geometryUserPtr).shape;
  const Vec3f low = shape.centre - shape.radii_m, high = shape.centre + shape.radii_m;
  *arguments->bounds_o = {low.x, low.y, low.z, 0.0F, high.x, high.y, high.z, 0.0F};
}

/// The bits of a number apart from one another, with a place between each two.
std::uint64_t spread_in_two(std::uint32_t number) {
  std::uint64_t bits = number;
  for (const auto& [step, mask] : {std::pair{16U, 0x0000ffff0000ffffULL},
                                   {8U, 0x00ff00ff00ff00ffULL},
                                   {4U, 0x0f0f0f0f0f0f0f0fULL},
                                   {2U, 0x3333333333333333ULL},
                                   {1U, 0x5555555555555555ULL}}) {
    bits = (bits | bits << step) & mask;
  }
  return bits;
}

/// Where on a curve that keeps close together what stands close together.
std::uint64_t place_on_curve(const scene::Instance& instance) {
  const auto steps_m = [](float place_m) {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(place_m)) ^ 0x80000000U;
  };
  return spread_in_two(steps_m(instance.x_m)) | spread_in_two(steps_m(instance.y_m)) << 1U;
}

/// An instance that matters.
struct HeldInstance {
  std::uint64_t place;   // on that curve
  std::uint32_t number;  // in the scene
  float foot_m;          // height of its origin

  friend auto operator<=>(const HeldInstance&, const HeldInstance&) = default;
};

/// Neighbours in a row, be they listed in any order in the scene: so they are kept in memory as well.
std::vector<HeldInstance> instances_held(const scene::Scene& scene, Footing footing, const Surroundings& around,
                                         double highest_m) {
  const std::vector<float> tops = scene::prototype_tops_m(scene), radii = scene::prototype_radii_m(scene);
  std::vector<HeldInstance> held;
  for (std::uint32_t number = 0; number < scene.instances.size(); ++number) {
    const scene::Instance& instance = scene.instances[number];
    const Vec2d at{instance.x_m, instance.y_m};
    const Vec3f k = instance.scale;
    const auto radius_m = static_cast<double>(radii[instance.prototype] * std::max(k.x, k.y));
    // Of a large scene nearly all would not matter were they as high as anything: their ground need not be found.
    if (!around.hold(at, radius_m, highest_m)) continue;
    const double base_m = footing == Footing::Terrain ? scene.terrain.height_at(at) : 0.0;
    const float foot_m = static_cast<float>(base_m) + instance.lift_m;
    const float top_m = foot_m + tops[instance.prototype] * k.z;
    if (around.hold(at, radius_m, static_cast<double>(top_m)))
      held.push_back({place_on_curve(instance), number, foot_m});
  }
  std::ranges::sort(held);
  return held;
}

/// Numbers of the buildings that matter.
std::vector<std::uint32_t> buildings_held(const scene::Buildings& buildings, Footing footing,
                                          const Surroundings& around) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t number = 0; number < buildings.items.size(); ++number) {
    const scene::Building& building = buildings.items[number];
    const auto vertices = std::span(buildings.mesh.vertices).subspan(building.first_vertex, building.vertex_count);
    const Vec3f first = vertices.empty() ? Vec3f{} : vertices.front();
    float east_m = 0.0F, north_m = 0.0F, top_m = first.z;
    for (const Vec3f& vertex : vertices) {
      east_m = std::max(east_m, std::abs(vertex.x - first.x));
      north_m = std::max(north_m, std::abs(vertex.y - first.y));
      top_m = std::max(top_m, vertex.z);
    }
    const float base_m = footing == Footing::Terrain ? building.footing_m : 0.0F;
    const auto is_held = [&](float radius_m) {
      return around.hold({first.x, first.y}, static_cast<double>(radius_m), static_cast<double>(base_m + top_m));
    };
    // No vertex is farther than the corners of a box about the first: so most are known not to matter.
    if (!is_held(std::hypot(east_m, north_m))) continue;
    float radius_m = 0.0F;
    for (const Vec3f& vertex : vertices)
      radius_m = std::max(radius_m, std::hypot(vertex.x - first.x, vertex.y - first.y));
    if (is_held(radius_m)) numbers.push_back(number);
  }
  return numbers;
}

void add_to_sum(void* sum, ssize_t bytes) {
  static_cast<std::atomic<std::int64_t>*>(sum)->fetch_add(bytes);
}

/// Embree's question whether to go on, asked of any of its threads while it builds: until the work that the building
/// belongs to is told to stop.
class WantedEnd {
 public:
  static bool goes_on(void* wanted_end, double) { return static_cast<WantedEnd*>(wanted_end)->goes_on(); }

  /// Nothing may be thrown through Embree.
  void rethrow() {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  bool goes_on() {
    if (interruption_ == nullptr) return true;
    const std::scoped_lock lock(guard_);
    if (thrown_) return false;
    try {
      interruption_->poll();
    } catch (...) {
      thrown_ = std::current_exception();
    }
    return !thrown_;
  }

  Interruption* const interruption_ = Interruption::current();
  std::mutex guard_;
  std::exception_ptr thrown_;
};

}  // namespace

void SceneStructures::build(const scene::Scene& scene, Footing on, const Surroundings& around,
                            const SceneHeights& heights) {
  footing = on;
  crowns = scene.crowns;
  const radar::Rectangle within = around.reach(heights.highest_ground_m);
  if (on == Footing::Terrain) require_room(scene, within, machine_memory_bytes());
  ground = ground_within(scene.ground, within);
  lowest_m = heights.lowest_m;
  highest_m = heights.highest_m;
  const Vec2d centre = scene.extent.centre();
  origin = {centre.x, centre.y, 0.0};
  open_device();
  top = rtcNewScene(device);
  if (footing == Footing::Terrain) {
    rtcSetSceneFlags(top, RTC_SCENE_FLAG_ROBUST);
    add_terrain(ground_within(scene.terrain, within));
  } else {
    level_plane = plane_within(radar::widened(scene.terrain.extent(), rim_m));
  }
  add_buildings(scene.buildings, around);
  add_prototypes(scene.prototypes);
  add_instances(scene, around);
  commit(top);
  check();
}

SceneStructures::~SceneStructures() {
  for (RTCScene prototype : prototypes) rtcReleaseScene(prototype);
  for (RTCScene block : building_blocks) rtcReleaseScene(block);
  if (top != nullptr) rtcReleaseScene(top);
  if (device != nullptr) rtcReleaseDevice(device);
}

void SceneStructures::commit(RTCScene scene) {
  WantedEnd end;
  rtcSetSceneProgressMonitorFunction(scene, &WantedEnd::goes_on, &end);
  rtcCommitScene(scene);
  rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
  end.rethrow();
}

void SceneStructures::check() const {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_OUT_OF_MEMORY)
    throw Error("ray tracer", "ran out of memory", "use a smaller scene or a larger machine");
  if (error != RTC_ERROR_NONE)
    throw Error("ray tracer", "Embree error " + std::to_string(error), "report this with the scene file");
}

void SceneStructures::open_device() {
  // One build thread: the structures are small, and parallel builds are the only part of Embree that thread
  // sanitizers misread.
  device = rtcNewDevice("threads=1");
  if (device == nullptr) throw Error("ray tracer", "Embree could not be started", "check the libembree3 installation");
  rtcSetDeviceMemoryMonitorFunction(
      device,
      [](void* sum, ssize_t bytes, bool) {
        add_to_sum(sum, bytes);
        return true;
      },
      &memory);
}

LevelPlane SceneStructures::plane_within(const radar::Rectangle& part) const {
  return {.west_m = static_cast<float>(part.west_m - origin.x),
          .south_m = static_cast<float>(part.south_m - origin.y),
          .east_m = static_cast<float>(part.east_m - origin.x),
          .north_m = static_cast<float>(part.north_m - origin.y)};
}

RTCGeometry SceneStructures::quads(const std::vector<std::array<std::uint32_t, 4>>& corners,
                                   const std::vector<Vec3f>& vertices) const {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
  void* vertex_buffer =
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3f), vertices.size());
  void* index_buffer =
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, sizeof(corners[0]), corners.size());
  check();
  std::ranges::copy(vertices, static_cast<Vec3f*>(vertex_buffer));
  std::ranges::copy(corners, static_cast<std::array<std::uint32_t, 4>*>(index_buffer));
  rtcCommitGeometry(geometry);
  return geometry;
}

void SceneStructures::attach(RTCGeometry geometry, const Part& part) {
  rtcAttachGeometryByID(top, geometry, static_cast<unsigned>(parts.size()));
  rtcReleaseGeometry(geometry);
  parts.push_back(part);
}

void SceneStructures::add_terrain(const terrain::HeightField& field) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_GRID);
  // One ring of nodes more than the field has carries its edge outwards, so that walls there have ground before them.
  const std::size_t columns = field.height_m.columns() + 2, rows = field.height_m.rows() + 2;
  if (columns > most_grid_nodes || rows > most_grid_nodes) {
    throw Error("terrain", "has " + std::to_string(std::max(columns, rows) - 2) + " heights along a side",
                "use a larger spacing or a smaller extent, for at most " + std::to_string(most_grid_nodes - 2));
  }
  auto* vertices = static_cast<Vec3f*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3f), columns * rows));
  auto* grid = static_cast<RTCGrid*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID, sizeof(RTCGrid), 1));
  check();
  // How far the ring at either end lies beyond the field, in metres eastward or southward.
  const auto beyond = [](std::size_t index, std::size_t count) {
    return index == 0 ? -rim_m : index + 1 == count ? rim_m : 0.0;
  };
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const std::size_t from_column = std::clamp<std::size_t>(column, 1, columns - 2) - 1;
      const std::size_t from_row = std::clamp<std::size_t>(row, 1, rows - 2) - 1;
      const double x = field.west_m + static_cast<double>(from_column) * field.spacing_m + beyond(column, columns);
      const double y = field.north_m - static_cast<double>(from_row) * field.spacing_m - beyond(row, rows);
      vertices[row * columns + column] = {static_cast<float>(x - origin.x), static_cast<float>(y - origin.y),
                                          field.height_m(from_column, from_row)};
    }
  }
  *grid = {0, static_cast<unsigned>(columns), static_cast<unsigned short>(columns), static_cast<unsigned short>(rows)};
  rtcCommitGeometry(geometry);
  attach(geometry, {});
}

void SceneStructures::add_buildings(const scene::Buildings& source, const Surroundings& around) {
  const std::vector<std::uint32_t> held = buildings_held(source, footing, around);
  if (held.size() == source.items.size()) {
    add_buildings(source);
  } else {
    add_buildings(scene::part_of(source, held));
  }
}

void SceneStructures::add_buildings(const scene::Buildings& source) {
  if (source.mesh.triangles.empty()) return;
  std::vector<Vec3f> vertices = source.mesh.vertices;
  for (const scene::Building& building : source.items) {
    const float base = footing == Footing::Terrain ? building.footing_m : 0.0F;
    for (std::uint32_t i = 0; i < building.vertex_count; ++i) {
      Vec3f& vertex = vertices[building.first_vertex + i];
      vertex = {static_cast<float>(vertex.x - origin.x), static_cast<float>(vertex.y - origin.y), vertex.z + base};
    }
  }
  BuildingBlocks squares = trace::building_blocks(source, vertices);
  building_faces = std::move(squares.traits);
  for (const BuildingBlock& block : squares.blocks) add(block);
}

void SceneStructures::add(const BuildingBlock& block) {
  RTCScene own = rtcNewScene(device);
  building_blocks.push_back(own);
  if (footing == Footing::Terrain) rtcSetSceneFlags(own, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = quads(block.corners, block.vertices);
  rtcAttachGeometry(own, geometry);
  rtcReleaseGeometry(geometry);
  commit(own);
  const auto [x, y, z] = block.place;
  add_instance(own, {1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, x, y, z},
               {.faces = building_faces.data() + block.first_face});
}

void SceneStructures::add_instance(RTCScene prototype, const std::array<float, 12>& transform, const Part& part) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, prototype);
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, transform.data());
  rtcCommitGeometry(geometry);
  attach(geometry, part);
}

void SceneStructures::add_prototypes(const std::vector<scene::Mesh>& meshes) {
  for (const scene::Mesh& mesh : meshes) {
    RTCScene prototype = rtcNewScene(device);
    rtcSetSceneBuildQuality(prototype, RTC_BUILD_QUALITY_MEDIUM);
    FaceQuads faces = face_quads(mesh);
    RTCGeometry geometry = quads(faces.corners, mesh.vertices);
    rtcAttachGeometry(prototype, geometry);
    rtcReleaseGeometry(geometry);
    for (scene::Crown& crown : crowns) {
      if (crown.prototype == prototypes.size()) attach_crown(prototype, crown);
    }
    prototypes.push_back(prototype);
    commit(prototype);
    prototype_faces.push_back(std::move(faces.traits));
  }
}

void SceneStructures::attach_crown(RTCScene prototype, scene::Crown& crown) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, 1);
  rtcSetGeometryUserData(geometry, &crown);
  rtcSetGeometryBoundsFunction(geometry, bound_crown, nullptr);
  // Rays that can meet crowns come one by one, so that the packets that Embree speaks of hold one each.
  rtcSetGeometryIntersectFunction(geometry, [](const RTCIntersectFunctionNArguments* a) {
    if (a->valid[0] != 0)
      cross_crown(crown_of(a->geometryUserPtr), a->geomID, reinterpret_cast<RTCRayHit*>(a->rayhit)->ray, a->context);
  });
  rtcSetGeometryOccludedFunction(geometry, [](const RTCOccludedFunctionNArguments* a) {
    if (a->valid[0] != 0)
      cross_crown(crown_of(a->geometryUserPtr), a->geomID, *reinterpret_cast<RTCRay*>(a->ray), a->context);
  });
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(prototype, geometry);
  rtcReleaseGeometry(geometry);
}

void SceneStructures::add_instances(const scene::Scene& scene, const Surroundings& around) {
  for (const auto& [place, number, foot_m] : instances_held(scene, footing, around, highest_m)) {
    const scene::Instance& instance = scene.instances[number];
    const float c = std::cos(instance.yaw_rad), s = std::sin(instance.yaw_rad);
    const Vec3f k = instance.scale;
    // Yaw turns clockwise.
    const std::array<float, 12> transform{k.x * c,
                                          -k.x * s,
                                          0.0F,
                                          k.y * s,
                                          k.y * c,
                                          0.0F,
                                          0.0F,
                                          0.0F,
                                          k.z,
                                          static_cast<float>(instance.x_m - origin.x),
                                          static_cast<float>(instance.y_m - origin.y),
                                          foot_m};
    add_instance(prototypes[instance.prototype], transform,
                 {.faces = prototype_faces[instance.prototype].data(),
                  .placement = {.cos_yaw = c,
                                .sin_yaw = s,
                                .inverse_scale = {1.0F / k.x, 1.0F / k.y, 1.0F / k.z},
                                .inverse_volume_scale = 1.0F / (k.x * k.y * k.z)}});
    if (crowns.empty()) continue;
    tree_sizes.resize(parts.size(), 1.0F);
    tree_sizes.back() = instance.size();
  }
}

}  // namespace sigmascape::trace
