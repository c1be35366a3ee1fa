#pragma once

#include <cstddef>

#include "sigmascape/base/vec.h"

namespace sigmascape {

/// Numbers of sixteen things that are worked on at once, beside one another as vector units like them: two or four of
/// their registers, one of the widest. Loops over lanes are plain loops that the compiler turns into vector code, see
/// vector_targets.h.
inline constexpr std::size_t lane_count = 16;

struct alignas(64) FloatLanes {
  float lane[lane_count]{};

  [[nodiscard]] float operator[](std::size_t i) const { return lane[i]; }
  float& operator[](std::size_t i) { return lane[i]; }
};

struct PairLanes {
  FloatLanes x, y;

  [[nodiscard]] Vec2f operator[](std::size_t i) const { return {x[i], y[i]}; }
  void set(std::size_t i, Vec2f v) {
    x[i] = v.x;
    y[i] = v.y;
  }
};

struct VectorLanes {
  FloatLanes x, y, z;

  [[nodiscard]] Vec3f operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  void set(std::size_t i, Vec3f v) {
    x[i] = v.x;
    y[i] = v.y;
    z[i] = v.z;
  }
};

}  // namespace sigmascape
