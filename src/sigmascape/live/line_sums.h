#pragma once

#include <span>

namespace sigmascape::live {

/// to[i] += from[i] · weight.
void add_weighted(const float* from, float weight, std::span<float> to);

/// to[i] = Σ_k weights[k] · from[i + k]: `from` is longer by all weights but one.
void weigh_neighbours(const float* from, std::span<const float> weights, std::span<float> to);

}  // namespace sigmascape::live
