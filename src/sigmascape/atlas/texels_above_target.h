#pragma once

#include <cstdint>
#include <optional>

namespace sigmascape::atlas {

/// How many texels of a patch have standard errors above the target of their bake.
struct TexelsAboveTarget {
  std::uint64_t lit = 0;  ///< texels that return anything
  std::uint64_t above = 0;

  /// Nothing when no texel returns anything.
  [[nodiscard]] std::optional<double> part() const {
    if (lit == 0) return std::nullopt;
    return static_cast<double>(above) / static_cast<double>(lit);
  }
  TexelsAboveTarget& operator+=(const TexelsAboveTarget& other) {
    lit += other.lit;
    above += other.above;
    return *this;
  }
};

}  // namespace sigmascape::atlas
