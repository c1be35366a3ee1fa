#include "sigmascape/scene/vehicle_mesh.h"

#include <cmath>
#include <span>
#include <vector>

#include "sigmascape/base/units.h"
#include "sigmascape/scene/solid_mesh.h"

namespace sigmascape::scene {
namespace {

/// A point of a side view: y forward, z up.
struct ProfilePoint {
  float y_m, z_m;
};

/// A closed solid with this side view and upright flanks. The profile goes counter-clockwise seen from the right-hand
/// side (forward to the right); all of it must be visible from its first point.
void append_extrusion(Mesh& mesh, std::span<const ProfilePoint> profile, float left_m, float right_m,
                      MaterialIndex body) {
  std::vector<Vec3f> left, right;
  const std::size_t count = profile.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto [y, z] = profile[i];
    const auto [next_y, next_z] = profile[(i + 1) % count];
    const Vec3f panel[] = {{right_m, y, z}, {left_m, y, z}, {left_m, next_y, next_z}, {right_m, next_y, next_z}};
    append_facet(mesh, panel, body);
    right.push_back({right_m, y, z});
    const auto [mirrored_y, mirrored_z] = profile[(count - i) % count];
    left.push_back({left_m, mirrored_y, mirrored_z});
  }
  append_facet(mesh, right, body);
  append_facet(mesh, left, body);
}

/// Wheels on both sides at each axle, flush with the body.
void append_axle(Mesh& mesh, float y_m, float radius_m, float half_width_m, MaterialIndex body) {
  constexpr int corners = 8;
  constexpr float tyre_m = 0.2F;
  std::vector<ProfilePoint> tyre;
  for (int corner = 0; corner < corners; ++corner) {
    const double angle = 2.0 * pi * (corner + 0.5) / corners;
    tyre.push_back({y_m + radius_m * static_cast<float>(std::cos(angle)),
                    radius_m * (1.0F + static_cast<float>(std::sin(angle)))});
  }
  append_extrusion(mesh, tyre, -half_width_m, tyre_m - half_width_m, body);
  append_extrusion(mesh, tyre, half_width_m - tyre_m, half_width_m, body);
}

Mesh car(VehicleSize size, MaterialIndex body) {
  const float half = size.length_m / 2.0F, side = size.width_m / 2.0F;
  const ProfilePoint profile[] = {{0.0F, 0.2F},    {half, 0.25F},          {half, 0.68F},
                                  {0.75F, 0.92F},  {0.05F, size.height_m}, {-1.1F, size.height_m},
                                  {-1.65F, 0.98F}, {-half, 0.92F},         {-half, 0.25F}};
  Mesh mesh{.name = "car", .vertices = {}, .triangles = {}, .materials = {}};
  append_extrusion(mesh, profile, -side, side, body);
  for (const float axle : {-1.35F, 1.35F}) append_axle(mesh, axle, 0.3F, side, body);
  return mesh;
}

Mesh van(VehicleSize size, MaterialIndex body) {
  const float half = size.length_m / 2.0F, side = size.width_m / 2.0F;
  const ProfilePoint profile[] = {{0.0F, 0.25F},         {half, 0.3F},           {half, 0.9F}, {1.9F, 1.2F},
                                  {1.2F, size.height_m}, {-half, size.height_m}, {-half, 0.3F}};
  Mesh mesh{.name = "van", .vertices = {}, .triangles = {}, .materials = {}};
  append_extrusion(mesh, profile, -side, side, body);
  for (const float axle : {-1.7F, 1.7F}) append_axle(mesh, axle, 0.33F, side, body);
  return mesh;
}

Mesh truck(VehicleSize size, MaterialIndex body) {
  const float half = size.length_m / 2.0F, side = size.width_m / 2.0F;
  const float cab_rear = half - 2.0F, box_front = cab_rear - 0.5F;
  const ProfilePoint cab[] = {{cab_rear, 0.95F}, {cab_rear + 0.1F, 0.45F}, {half, 0.45F},
                              {half, 1.4F},      {half - 0.3F, 2.9F},      {cab_rear, 2.9F}};
  const ProfilePoint frame[] = {{-half, 0.7F}, {cab_rear, 0.7F}, {cab_rear, 0.94F}, {-half, 0.94F}};
  const ProfilePoint box[] = {{-half, 0.95F}, {box_front, 0.95F}, {box_front, size.height_m}, {-half, size.height_m}};
  Mesh mesh{.name = "truck", .vertices = {}, .triangles = {}, .materials = {}};
  append_extrusion(mesh, cab, -side, side, body);
  append_extrusion(mesh, frame, -0.5F, 0.5F, body);
  append_extrusion(mesh, box, -side, side, body);
  for (const float axle : {1.3F - half, 2.6F - half, half - 1.3F}) append_axle(mesh, axle, 0.45F, side - 0.02F, body);
  return mesh;
}

}  // namespace

VehicleSize vehicle_size(VehicleKind kind) {
  switch (kind) {
    case VehicleKind::Car:
      return {.width_m = 1.8F, .length_m = 4.5F, .height_m = 1.48F};
    case VehicleKind::Van:
      return {.width_m = 2.0F, .length_m = 5.6F, .height_m = 2.4F};
    case VehicleKind::Truck:
      break;
  }
  return {.width_m = 2.5F, .length_m = 10.0F, .height_m = 3.8F};
}

Mesh vehicle_mesh(VehicleKind kind, MaterialIndex body) {
  const VehicleSize size = vehicle_size(kind);
  switch (kind) {
    case VehicleKind::Car:
      return car(size, body);
    case VehicleKind::Van:
      return van(size, body);
    case VehicleKind::Truck:
      break;
  }
  return truck(size, body);
}

}  // namespace sigmascape::scene
