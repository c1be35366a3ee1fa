#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sigmascape/base/vec.h"

namespace sigmascape::scene {

/// A triangle of a face, by the places of its corners among the face's own.
using FaceTriangle = std::array<std::uint32_t, 3>;

/// The triangles that fill a face of a mesh, which need be neither convex nor quite flat, turned as it is. Nothing
/// where none do, since its outline crosses or meets itself. A face without area is cut like a convex one.
[[nodiscard]] std::optional<std::vector<FaceTriangle>> triangles_of_face(std::span<const Vec3d> corners);

}  // namespace sigmascape::scene
