#pragma once

#include "sigmascape/scene/scene.h"

namespace sigmascape::scene {

enum class VehicleKind { Car, Van, Truck };

/// Outer size of a vehicle.
struct VehicleSize {
  float width_m = 0.0F, length_m = 0.0F, height_m = 0.0F;
};

[[nodiscard]] VehicleSize vehicle_size(VehicleKind kind);

/// A vehicle of flat panels on wheels, all of one material, with upright sides that make dihedrals with the ground. The
/// origin is on the ground under its centre, +y is forward, z up. Its parts are closed, with outward normals.
[[nodiscard]] Mesh vehicle_mesh(VehicleKind kind, MaterialIndex body);

}  // namespace sigmascape::scene
