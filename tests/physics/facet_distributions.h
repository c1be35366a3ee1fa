#pragma once

#include "sigmascape/scatter/material.h"

namespace sigmascape::physics_test {

inline constexpr auto Beckmann = scatter::MicrofacetDistribution::Beckmann;
inline constexpr auto Ggx = scatter::MicrofacetDistribution::Ggx;

inline const char* name_of(scatter::MicrofacetDistribution distribution) {
  return distribution == Beckmann ? "Beckmann" : "GGX";
}

}  // namespace sigmascape::physics_test
