#pragma once

#include "sigmascape/base/vec.h"

namespace sigmascape::scatter {

/// The flat piece of surface that a wave meets.
struct Facet {
  Vec3f normal;                      ///< unit, on the side of the wave
  float inverse_area_per_m2 = 0.0F;  ///< of the whole face or skin, 0 for one without end, as ground is

  /// A face without end is known by its normal alone.
  Facet(Vec3f unit_normal, float inverse_area = 0.0F) : normal(unit_normal), inverse_area_per_m2(inverse_area) {}
  /// To models that do not ask for the size a face is its normal.
  operator Vec3f() const { return normal; }
};

}  // namespace sigmascape::scatter
