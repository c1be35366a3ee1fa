#include "sigmascape/trace/scene_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <xmmintrin.h>

#include "sigmascape/trace/ray_sorter.h"
#include "sigmascape/trace/scene_structures.h"

namespace sigmascape::trace {
namespace {

constexpr float far_away = std::numeric_limits<float>::infinity();
constexpr unsigned flush_to_zero = 0x8000U;
constexpr unsigned denormals_are_zero = 0x0040U;

/// Rays in the forest have little in common: Embree is told so, lest it follow sixteen where one goes.
constexpr std::size_t packet_size = 16;
using Packet = RTCRayHit16;

RTCRayHit query_along(const Ray& ray, float length_m) {
  RTCRayHit query{};
  const Vec3f o = ray.origin, d = ray.direction;
  query.ray = {o.x, o.y, o.z, 0.0F, d.x, d.y, d.z, 0.0F, length_m, ~0U, 0, 0};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

RayContext context_for(CrownCrossings* crowns) {
  RayContext context{{}, crowns};
  rtcInitIntersectContext(&context.embree);
  context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return context;
}

void put(Packet& packet, std::size_t lane, const Ray& ray, float length_m) {
  packet.ray.org_x[lane] = ray.origin.x;
  packet.ray.org_y[lane] = ray.origin.y;
  packet.ray.org_z[lane] = ray.origin.z;
  packet.ray.dir_x[lane] = ray.direction.x;
  packet.ray.dir_y[lane] = ray.direction.y;
  packet.ray.dir_z[lane] = ray.direction.z;
  packet.ray.tnear[lane] = 0.0F;
  packet.ray.tfar[lane] = length_m;
  packet.ray.time[lane] = 0.0F;
  packet.ray.mask[lane] = ~0U;
  packet.ray.id[lane] = 0;
  packet.ray.flags[lane] = 0;
  packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
  packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
}

Found found_by(const RTCRayHit& query) {
  const RTCHit& hit = query.hit;
  return {query.ray.tfar, {hit.Ng_x, hit.Ng_y, hit.Ng_z}, hit.geomID, hit.primID, hit.instID[0]};
}

Found found_by(const Packet& packet, std::size_t lane) {
  const RTCHit16& hit = packet.hit;
  return {packet.ray.tfar[lane],
          {hit.Ng_x[lane], hit.Ng_y[lane], hit.Ng_z[lane]},
          hit.geomID[lane],
          hit.primID[lane],
          hit.instID[0][lane]};
}

/// Normals transform by the inverse transpose: divide by the scale, then turn. Areas grow by how much that shortens
/// them, times the growth of volumes.
void bring_into_world(const Part& part, Vec3f& normal, float& inverse_area) {
  const Vec3f n{normal.x * part.inverse_scale.x, normal.y * part.inverse_scale.y, normal.z * part.inverse_scale.z};
  inverse_area *= part.inverse_volume_scale * length(normal) / length(n);
  normal = {n.x * part.cos_yaw + n.y * part.sin_yaw, -n.x * part.sin_yaw + n.y * part.cos_yaw, n.z};
}

/// For each thread until it asks again.
std::span<const std::uint32_t> numbers_by_place(std::span<const Ray> rays) {
  thread_local RaySorter sorter;
  return sorter.sorted(rays);
}

/// Calls `trace(packet, lanes, valid, first)` for packet after packet of `count` rays, `ray_at(i)` and `length_at(i)`
/// being the i-th.
template <typename RayAt, typename LengthAt, typename Trace>
void in_packets(std::size_t count, const RayAt& ray_at, const LengthAt& length_at, const Trace& trace) {
  Packet packet;
  alignas(64) int valid[packet_size];
  for (std::size_t first = 0; first < count; first += packet_size) {
    const std::size_t lanes = std::min(packet_size, count - first);
    for (std::size_t lane = 0; lane < packet_size; ++lane) {
      valid[lane] = lane < lanes ? -1 : 0;
      const std::size_t i = first + std::min(lane, lanes - 1);
      put(packet, lane, ray_at(i), length_at(i));
    }
    trace(packet, lanes, valid, first);
  }
}

}  // namespace

SceneGeometry::SceneGeometry(const scene::Scene& scene, Footing footing)
    : structures_(std::make_unique<SceneStructures>()) {
  structures_->build(scene, footing);
}

SceneGeometry::~SceneGeometry() = default;
SceneGeometry::SceneGeometry(SceneGeometry&&) noexcept = default;
SceneGeometry& SceneGeometry::operator=(SceneGeometry&&) noexcept = default;

Footing SceneGeometry::footing() const {
  return structures_->footing;
}
Vec3d SceneGeometry::origin() const {
  return structures_->origin;
}
double SceneGeometry::lowest_m() const {
  return structures_->lowest_m;
}
double SceneGeometry::highest_m() const {
  return structures_->highest_m;
}
std::size_t SceneGeometry::memory_bytes() const {
  return static_cast<std::size_t>(structures_->memory.load());
}

bool SceneGeometry::has_crowns() const {
  return !structures_->crowns.empty();
}
bool SceneGeometry::intersect(Vec3f ray_origin, Vec3f direction, SurfaceHit& hit) const {
  return intersect(Ray{ray_origin, direction}, hit, nullptr);
}
bool SceneGeometry::intersect(Vec3f ray_origin, Vec3f direction, SurfaceHit& hit, CrownCrossings& crowns) const {
  return intersect(Ray{ray_origin, direction}, hit, &crowns);
}
bool SceneGeometry::occluded(Vec3f ray_origin, Vec3f direction) const {
  return occluded(Ray{ray_origin, direction}, nullptr);
}
bool SceneGeometry::occluded(Vec3f ray_origin, Vec3f direction, CrownCrossings& crowns) const {
  return occluded(Ray{ray_origin, direction}, &crowns);
}

float SceneStructures::plane_distance_m(const Ray& ray) const {
  const bool meets_plane = footing == Footing::LevelPlane && ray.direction.z < 0.0F && ray.origin.z > 0.0F;
  return meets_plane ? -ray.origin.z / ray.direction.z : far_away;
}

void SceneStructures::hit_plane(const Ray& ray, float distance_m, SurfaceHit& hit) const {
  hit.position = ray.origin + ray.direction * distance_m;
  hit.position.z = 0.0F;
  hit.normal = {0.0F, 0.0F, 1.0F};
  hit.inverse_facet_area_per_m2 = 0.0F;
  hit.material = ground_material(hit.position);
  hit.is_ground = true;
}

bool SceneStructures::meet(const Ray& ray, const Found& found, SurfaceHit& hit) const {
  hit = {};
  if (found.nothing()) {
    const float distance_m = plane_distance_m(ray);
    if (distance_m == far_away) return false;
    hit_plane(ray, distance_m, hit);
    return true;
  }
  const Part& part = parts[found.part()];
  Vec3f normal = found.normal;
  hit.position = ray.origin + ray.direction * found.distance_m;
  if (part.is_terrain()) {
    if (normal.z < 0.0F) normal = -normal;
    if (dot(normal, ray.direction) >= 0.0F) return false;  // entered below the edge of the terrain
    hit.material = ground_material(hit.position);
    hit.is_ground = true;
  } else {
    const FaceTraits& face = part.faces[found.primitive];
    hit.material = face.material;
    hit.inverse_facet_area_per_m2 = face.inverse_area_per_m2;
    if (found.instance != RTC_INVALID_GEOMETRY_ID) bring_into_world(part, normal, hit.inverse_facet_area_per_m2);
  }
  const float norm = length(normal);
  if (norm == 0.0F) return false;
  hit.normal = normal * ((dot(normal, ray.direction) < 0.0F ? 1.0F : -1.0F) / norm);
  return true;
}

bool SceneGeometry::intersect(const Ray& ray, SurfaceHit& hit, CrownCrossings* crowns) const {
  const SceneStructures& s = *structures_;
  const float length_m = s.plane_distance_m(ray);
  if (s.log != nullptr) s.log->push_back({.ray = ray, .length_m = length_m, .asks_first = true});
  RayContext context = context_for(crowns);
  RTCRayHit query = query_along(ray, length_m);
  rtcIntersect1(s.top, &context.embree, &query);
  return s.meet(ray, found_by(query), hit);
}

bool SceneGeometry::occluded(const Ray& ray, CrownCrossings* crowns) const {
  if (structures_->log != nullptr) structures_->log->push_back({.ray = ray, .length_m = far_away});
  RayContext context = context_for(crowns);
  RTCRay query = query_along(ray, far_away).ray;
  rtcOccluded1(structures_->top, &context.embree, &query);
  return query.tfar < 0.0F;
}

void SceneGeometry::intersect(std::span<const Ray> rays, std::span<SurfaceHit> hits, std::span<std::uint8_t> meets,
                              RayOrder order) const {
  const SceneStructures& s = *structures_;
  const auto numbers = order == RayOrder::ByPlace ? numbers_by_place(rays) : std::span<const std::uint32_t>();
  const auto number_of = [&](std::size_t i) { return numbers.empty() ? i : numbers[i]; };
  const auto ray_at = [&](std::size_t i) { return rays[number_of(i)]; };
  const auto length_at = [&](std::size_t i) { return s.plane_distance_m(ray_at(i)); };
  if (s.log != nullptr) {
    for (std::size_t i = 0; i < rays.size(); ++i) s.log->push_back({ray_at(i), length_at(i), true, i == 0});
  }
  RayContext context = context_for(nullptr);
  in_packets(rays.size(), ray_at, length_at,
             [&](Packet& packet, std::size_t lanes, const int* valid, std::size_t first) {
               rtcIntersect16(valid, s.top, &context.embree, &packet);
               // They lie all over memory: all are asked for before the first is waited for.
               for (std::size_t lane = 0; lane < lanes; ++lane) {
                 const Found found = found_by(packet, lane);
                 if (!found.nothing()) __builtin_prefetch(&s.parts[found.part()]);
               }
               for (std::size_t lane = 0; lane < lanes; ++lane) {
                 const Found found = found_by(packet, lane);
                 if (found.nothing()) continue;
                 const Part& part = s.parts[found.part()];
                 if (!part.is_terrain()) __builtin_prefetch(&part.faces[found.primitive]);
               }
               for (std::size_t lane = 0; lane < lanes; ++lane) {
                 const std::size_t i = number_of(first + lane);
                 meets[i] = s.meet(rays[i], found_by(packet, lane), hits[i]) ? 1 : 0;
               }
             });
}

void SceneGeometry::occluded(std::span<const Ray> rays, std::span<std::uint8_t> is_occluded) const {
  const SceneStructures& s = *structures_;
  const std::span<const std::uint32_t> numbers = numbers_by_place(rays);
  if (s.log != nullptr) {
    for (std::size_t i = 0; i < rays.size(); ++i) s.log->push_back({rays[numbers[i]], far_away, false, i == 0});
  }
  RayContext context = context_for(nullptr);
  in_packets(
      rays.size(), [&](std::size_t i) { return rays[numbers[i]]; }, [](std::size_t) { return far_away; },
      [&](Packet& packet, std::size_t lanes, const int* valid, std::size_t first) {
        rtcOccluded16(valid, s.top, &context.embree, &packet.ray);
        for (std::size_t lane = 0; lane < lanes; ++lane)
          is_occluded[numbers[first + lane]] = packet.ray.tfar[lane] < 0.0F;
      });
}

void SceneGeometry::log_to(RayLog* log) {
  structures_->log = log;
}

std::size_t SceneGeometry::replay(const RayLog& log) const {
  const FlushDenormals flush;
  RayContext context = context_for(nullptr);
  std::size_t met = 0;
  for (auto begin = log.begin(); begin != log.end();) {
    const bool asks_first = begin->asks_first;
    const auto end =
        std::find_if(begin + 1, log.end(), [&](const LoggedRay& r) { return r.begins || r.asks_first != asks_first; });
    const std::span rays(begin, end);
    in_packets(
        rays.size(), [&](std::size_t i) { return rays[i].ray; }, [&](std::size_t i) { return rays[i].length_m; },
        [&](Packet& packet, std::size_t lanes, const int* valid, std::size_t) {
          if (asks_first)
            rtcIntersect16(valid, structures_->top, &context.embree, &packet);
          else
            rtcOccluded16(valid, structures_->top, &context.embree, &packet.ray);
          for (std::size_t lane = 0; lane < lanes; ++lane) {
            met += asks_first ? packet.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID : packet.ray.tfar[lane] < 0.0F;
          }
        });
    begin = end;
  }
  return met;
}

FlushDenormals::FlushDenormals() : saved_(_mm_getcsr()) {
  _mm_setcsr(saved_ | flush_to_zero | denormals_are_zero);
}
FlushDenormals::~FlushDenormals() {
  _mm_setcsr(saved_);
}

}  // namespace sigmascape::trace
