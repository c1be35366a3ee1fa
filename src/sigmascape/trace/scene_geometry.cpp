#include "sigmascape/trace/scene_geometry.h"

#include <algorithm>
#include <array>
#include <limits>
#include <xmmintrin.h>

#include "sigmascape/trace/ray_sorter.h"
#include "sigmascape/trace/scene_heights.h"
#include "sigmascape/trace/scene_structures.h"

namespace sigmascape::trace {
namespace {

/// Of lanes that have met nothing.
const Part no_part{};

constexpr float far_away = std::numeric_limits<float>::infinity();
/// How far a ray may go before single precision tells where it ends no better than to a quarter of a millimetre, an
/// eighth of what surfaces are left by. docs/decisions/0144-far-surfaces-are-met-twice.md.
constexpr float longest_exact_m = 2048.0F;
/// More than a ray may be wrong about its length, be it as flat as a thousandth.
constexpr double nearby_m = 16.0;
constexpr unsigned flush_to_zero = 0x8000U;
constexpr unsigned denormals_are_zero = 0x0040U;

RTCRayHit query_along(const Ray& ray, float length_m) {
  RTCRayHit query{};
  const Vec3f o = ray.origin, d = ray.direction;
  query.ray = {o.x, o.y, o.z, 0.0F, d.x, d.y, d.z, 0.0F, length_m, ~0U, 0, 0};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

/// The same ray, begun shortly before it ends.
Ray begun_nearby(const Ray& ray, float length_m) {
  const double ahead_m = static_cast<double>(length_m) - nearby_m;
  return {(ray.origin.to<double>() + ray.direction.to<double>() * ahead_m).to<float>(), ray.direction};
}

RayContext context_for(CrownCrossings* crowns, const SceneStructures& structures) {
  RayContext context{{}, crowns, structures.tree_sizes.data()};
  rtcInitIntersectContext(&context.embree);
  context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  return context;
}

Found found_by(const RTCRayHit& query) {
  const RTCHit& hit = query.hit;
  return {query.ray.tfar, {hit.Ng_x, hit.Ng_y, hit.Ng_z}, hit.geomID, hit.primID, hit.instID[0]};
}

Found found_by(const RayPacket& packet, std::size_t lane) {
  const RTCHit16& hit = packet.query.hit;
  return {packet.query.ray.tfar[lane],
          {hit.Ng_x[lane], hit.Ng_y[lane], hit.Ng_z[lane]},
          hit.geomID[lane],
          hit.primID[lane],
          hit.instID[0][lane]};
}

/// For each thread until it asks again.
std::span<const std::uint32_t> numbers_by_place(std::span<const Ray> rays) {
  thread_local RaySorter sorter;
  return sorter.sorted(rays);
}

/// Calls `trace(packet, lanes, first)` for packet after packet of `count` rays, `ray_at(i)` being the i-th. Rays in the
/// forest have little in common: Embree is told so, lest it follow sixteen where one goes.
template <typename RayAt, typename Trace>
void in_packets(std::size_t count, const RayAt& ray_at, const Trace& trace) {
  RayPacket packet;
  for (std::size_t first = 0; first < count; first += lane_count) {
    const std::size_t lanes = std::min(lane_count, count - first);
    packet.set_rays(lanes, [&](std::size_t lane) -> const Ray& { return ray_at(first + lane); });
    trace(packet, lanes, first);
  }
}

}  // namespace

SceneGeometry::SceneGeometry(const scene::Scene& scene, Footing footing)
    : SceneGeometry(scene, footing, Surroundings::everything()) {}

SceneGeometry::SceneGeometry(const scene::Scene& scene, Footing footing, const Surroundings& around)
    : SceneGeometry(scene, footing, around, heights_of(scene, footing)) {}

SceneGeometry::SceneGeometry(const scene::Scene& scene, Footing footing, const Surroundings& around,
                             const SceneHeights& heights)
    : structures_(std::make_unique<SceneStructures>()) {
  structures_->build(scene, footing, around, heights);
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
  return occluded(Ray{ray_origin, direction}, nullptr, far_away);
}
bool SceneGeometry::occluded(Vec3f ray_origin, Vec3f direction, CrownCrossings& crowns, float length_m) const {
  return occluded(Ray{ray_origin, direction}, &crowns, length_m);
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
    if (found.distance_m == far_away) return false;
    hit_plane(ray, found.distance_m, hit);
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
    hit.is_building = face.is_building;
    const FacePlane plane = part.placement.in_world({normal, face.inverse_area_per_m2});
    normal = plane.normal;
    hit.inverse_facet_area_per_m2 = plane.inverse_area_per_m2;
  }
  const float norm = length(normal);
  if (norm == 0.0F) return false;
  hit.normal = normal * ((dot(normal, ray.direction) < 0.0F ? 1.0F : -1.0F) / norm);
  return true;
}

template <typename NumberOf>
void SceneStructures::meet(const RayPacket& packet, std::size_t lanes, const NumberOf& number_of,
                           std::span<SurfaceHit> hits, std::span<std::uint8_t> meets) const {
  // Parts and faces lie all over memory: all are asked for before the first is waited for.
  std::array<const FaceTraits*, lane_count> faces{};
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const Found found = found_by(packet, lane);
    if (!found.nothing()) __builtin_prefetch(&parts[found.part()]);
  }
  PlacementLanes placements;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const Found found = found_by(packet, lane);
    const Part& part = found.nothing() ? no_part : parts[found.part()];
    placements.set(lane, part.placement);
    if (part.is_terrain()) continue;
    faces[lane] = &part.faces[found.primitive];
    __builtin_prefetch(faces[lane]);
  }
  for (std::size_t lane = 0; lane < lanes; ++lane)
    placements.inverse_area_per_m2[lane] = faces[lane] != nullptr ? faces[lane]->inverse_area_per_m2 : 0.0F;
  MetLanes met;
  bring_into_world(packet, placements, met);
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const std::size_t i = number_of(lane);
    if (faces[lane] == nullptr) {
      meets[i] = meet(packet.ray(lane), found_by(packet, lane), hits[i]) ? 1 : 0;
      continue;
    }
    hits[i] = {.position = met.position[lane],
               .normal = met.normal[lane],
               .inverse_facet_area_per_m2 = met.inverse_area_per_m2[lane],
               .material = faces[lane]->material,
               .is_building = faces[lane]->is_building};
    meets[i] = met.norm[lane] != 0.0F ? 1 : 0;
  }
}

void SceneStructures::meet_again_from_nearby(RayPacket& packet, RayContext& context) const {
  bool any = false;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    // Idle lanes may hold hits too: without sixteen-wide vectors Embree answers them with the others.
    const bool asked = packet.valid[lane] != 0;
    const bool is_far = asked && packet.has_met(lane) && packet.query.ray.tfar[lane] > longest_exact_m;
    packet.valid[lane] = is_far ? -1 : 0;
    any |= is_far;
  }
  if (!any) return;
  bool begins = true;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    if (packet.valid[lane] == 0) continue;
    const Ray rest = begun_nearby(packet.ray(lane), packet.query.ray.tfar[lane]);
    packet.set_ray(lane, rest);
    packet.query.ray.tfar[lane] = plane_distance_m(rest);
    packet.forget_hit(lane);
    if (log != nullptr) log->push_back({rest, packet.query.ray.tfar[lane], true, begins, true});
    begins = false;
  }
  rtcIntersect16(packet.valid, top, &context.embree, &packet.query);
}

bool SceneGeometry::intersect(const Ray& ray, SurfaceHit& hit, CrownCrossings* crowns) const {
  const SceneStructures& s = *structures_;
  const float length_m = s.plane_distance_m(ray);
  if (s.log != nullptr) s.log->push_back({.ray = ray, .length_m = length_m, .asks_first = true});
  RayContext context = context_for(crowns, *structures_);
  RTCRayHit query = query_along(ray, length_m);
  rtcIntersect1(s.top, &context.embree, &query);
  const Found found = found_by(query);
  if (found.nothing() || found.distance_m <= longest_exact_m) return s.meet(ray, found, hit);
  const Ray rest = begun_nearby(ray, found.distance_m);
  query = query_along(rest, s.plane_distance_m(rest));
  if (s.log != nullptr)
    s.log->push_back({.ray = rest, .length_m = query.ray.tfar, .asks_first = true, .asks_again = true});
  context.crowns = nullptr;  // they were noted on the whole way
  rtcIntersect1(s.top, &context.embree, &query);
  return s.meet(rest, found_by(query), hit);
}

bool SceneGeometry::occluded(const Ray& ray, CrownCrossings* crowns, float length_m) const {
  if (structures_->log != nullptr) structures_->log->push_back({.ray = ray, .length_m = length_m});
  RayContext context = context_for(crowns, *structures_);
  RTCRay query = query_along(ray, length_m).ray;
  rtcOccluded1(structures_->top, &context.embree, &query);
  return query.tfar < 0.0F;
}

void SceneGeometry::intersect(std::span<const Ray> rays, std::span<SurfaceHit> hits, std::span<std::uint8_t> meets,
                              RayOrder order) const {
  const SceneStructures& s = *structures_;
  const auto numbers = order == RayOrder::ByPlace ? numbers_by_place(rays) : std::span<const std::uint32_t>();
  const auto number_of = [&](std::size_t i) { return numbers.empty() ? i : numbers[i]; };
  if (s.log != nullptr) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Ray& ray = rays[number_of(i)];
      s.log->push_back({ray, s.plane_distance_m(ray), true, i == 0});
    }
  }
  RayContext context = context_for(nullptr, *structures_);
  in_packets(
      rays.size(), [&](std::size_t i) -> const Ray& { return rays[number_of(i)]; },
      [&](RayPacket& packet, std::size_t lanes, std::size_t first) {
        if (s.footing == Footing::LevelPlane)
          set_lengths_to(s.level_plane, packet);
        else
          packet.set_lengths(far_away);
        rtcIntersect16(packet.valid, s.top, &context.embree, &packet.query);
        s.meet_again_from_nearby(packet, context);
        s.meet(
            packet, lanes, [&](std::size_t lane) { return number_of(first + lane); }, hits, meets);
      });
}

void SceneGeometry::occluded(std::span<const Ray> rays, std::span<std::uint8_t> is_occluded) const {
  const SceneStructures& s = *structures_;
  const std::span<const std::uint32_t> numbers = numbers_by_place(rays);
  if (s.log != nullptr) {
    for (std::size_t i = 0; i < rays.size(); ++i) s.log->push_back({rays[numbers[i]], far_away, false, i == 0});
  }
  RayContext context = context_for(nullptr, *structures_);
  in_packets(
      rays.size(), [&](std::size_t i) -> const Ray& { return rays[numbers[i]]; },
      [&](RayPacket& packet, std::size_t lanes, std::size_t first) {
        packet.set_lengths(far_away);
        rtcOccluded16(packet.valid, s.top, &context.embree, &packet.query.ray);
        for (std::size_t lane = 0; lane < lanes; ++lane)
          is_occluded[numbers[first + lane]] = packet.query.ray.tfar[lane] < 0.0F;
      });
}

void SceneGeometry::log_to(RayLog* log) {
  structures_->log = log;
}

std::size_t SceneGeometry::replay(const RayLog& log) const {
  const FlushDenormals flush;
  RayContext context = context_for(nullptr, *structures_);
  std::size_t met = 0;
  for (auto begin = log.begin(); begin != log.end();) {
    const bool asks_first = begin->asks_first;
    const auto end =
        std::find_if(begin + 1, log.end(), [&](const LoggedRay& r) { return r.begins || r.asks_first != asks_first; });
    const std::span rays(begin, end);
    in_packets(
        rays.size(), [&](std::size_t i) -> const Ray& { return rays[i].ray; },
        [&](RayPacket& packet, std::size_t lanes, std::size_t first) {
          for (std::size_t lane = 0; lane < lane_count; ++lane)
            packet.query.ray.tfar[lane] = rays[first + std::min(lane, lanes - 1)].length_m;
          if (asks_first)
            rtcIntersect16(packet.valid, structures_->top, &context.embree, &packet.query);
          else
            rtcOccluded16(packet.valid, structures_->top, &context.embree, &packet.query.ray);
          for (std::size_t lane = 0; lane < lanes; ++lane) {
            met += asks_first ? packet.query.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID
                              : packet.query.ray.tfar[lane] < 0.0F;
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
