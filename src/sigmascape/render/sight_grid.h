#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "sigmascape/base/array2d.h"
#include "sigmascape/terrain/obstacle_sweep.h"

namespace sigmascape::render {

/// What a sweep along many lines sees, kept of some of its steps, in half the memory.
class SightGrid {
 public:
  SightGrid() = default;
  /// Steps before the first are not kept.
  SightGrid(std::size_t first_step, std::size_t steps, std::size_t lines)
      : first_step_(first_step), parts_(steps, lines) {}

  /// One thread a line.
  void put(std::size_t step, std::size_t line, const terrain::Sight& sight) {
    if (step < first_step_ || step - first_step_ >= parts_.columns()) return;
    parts_(step - first_step_, line) = {static_cast<float>(sight.ground), static_cast<float>(sight.hidden_m)};
  }
  /// The nearest to a place in steps, counted from the first that is kept, and in lines.
  [[nodiscard]] terrain::Sight at(double step, double line) const {
    const auto index_of = [](double place, std::size_t count) {
      return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(count - 1)));
    };
    const Parts& parts = parts_(index_of(step, parts_.columns()), index_of(line, parts_.rows()));
    return {static_cast<double>(parts.ground), static_cast<double>(parts.hidden_m)};
  }

 private:
  struct Parts {
    float ground = 0.0F, hidden_m = std::numeric_limits<float>::infinity();
  };
  std::size_t first_step_ = 0;
  Array2D<Parts> parts_;  // [step, line]
};

}  // namespace sigmascape::render
