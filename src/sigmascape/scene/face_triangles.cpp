#include "sigmascape/scene/face_triangles.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/error.h"
#include "sigmascape/geo/polygon_triangulation.h"

namespace sigmascape::scene {
namespace {

/// Twice the vector area, along the normal about which the corners run counter-clockwise.
Vec3d twice_vector_area(std::span<const Vec3d> corners) {
  Vec3d sum{};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    sum += cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  return sum;
}

/// The corners, counter-clockwise, as seen along the axis that the face lies most across.
geo::Ring flattened(std::span<const Vec3d> corners, Vec3d normal) {
  const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
  geo::Ring ring;
  for (const Vec3d& corner : corners) {
    const Vec3d p = corner - corners[0];
    ring.push_back(z >= x && z >= y ? Vec2d{p.x, p.y} : y >= x ? Vec2d{p.z, p.x} : Vec2d{p.y, p.z});
  }
  if (geo::signed_area_m2(ring) < 0.0) {
    for (Vec2d& point : ring) point = {point.y, point.x};
  }
  return ring;
}

double twice_area(Vec2d a, Vec2d b, Vec2d c) {
  return cross(b - a, c - a);
}

/// Triangles from the first corner to each edge.
std::vector<FaceTriangle> fan_of(std::size_t corners) {
  std::vector<FaceTriangle> fan;
  for (std::uint32_t i = 1; i + 1 < corners; ++i) fan.push_back({0, i, i + 1});
  return fan;
}

/// Whether the first corner sees every edge from its inner side.
bool sees_all_edges(const geo::Ring& ring) {
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    if (twice_area(ring[0], ring[i], ring[i + 1]) < 0.0) return false;
  }
  return true;
}

std::uint32_t corner_at(const geo::Ring& ring, Vec2d point) {
  const auto nearest = std::ranges::min_element(ring, {}, [&](Vec2d corner) { return length(corner - point); });
  return static_cast<std::uint32_t>(nearest - ring.begin());
}

}  // namespace

std::optional<std::vector<FaceTriangle>> triangles_of_face(std::span<const Vec3d> corners) {
  const Vec3d area = twice_vector_area(corners);
  if (corners.size() <= 3 || !(length(area) > 0.0)) return fan_of(corners.size());
  const geo::Ring ring = flattened(corners, area);
  if (sees_all_edges(ring)) return fan_of(corners.size());

  std::vector<FaceTriangle> triangles;
  try {
    for (const auto& [a, b, c] : geo::triangulated({ring, {}}))
      triangles.push_back({corner_at(ring, a), corner_at(ring, b), corner_at(ring, c)});
  } catch (const Error&) {
    return std::nullopt;
  }
  return triangles;
}

}  // namespace sigmascape::scene
