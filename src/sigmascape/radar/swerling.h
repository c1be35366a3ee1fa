#pragma once

#include <cstdint>

namespace sigmascape::radar {

/// How a target's cross-section fluctuates about its mean [Swerling 1954]. Case 0 is steady. Cases 1 and 2 are many
/// like scatterers: the power is exponential. Cases 3 and 4 are one that dominates: χ² of four degrees of freedom.
/// Cases 1 and 3 are drawn anew each dwell, 2 and 4 each pulse.
enum class Swerling { Case0, Case1, Case2, Case3, Case4 };

[[nodiscard]] constexpr bool changes_by_pulse(Swerling swerling) {
  return swerling == Swerling::Case2 || swerling == Swerling::Case4;
}

/// The factor, of mean one, by which the cross-section differs from its mean: a pure function of its arguments.
/// docs/physics/targets.md, Eqs. (1), (2).
[[nodiscard]] double fluctuation(Swerling swerling, std::uint64_t target_seed, std::uint64_t dwell,
                                 std::uint64_t pulse);

}  // namespace sigmascape::radar
