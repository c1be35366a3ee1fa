#pragma once

#include <algorithm>
#include <cstddef>

#include "sigmascape/base/units.h"

namespace sigmascape::live {

/// The parts of a frame's beams that have a window of terrain of their own: as many as make none wider than a quarter
/// turn, but for beams that are filled together. The rectangle about a whole turn has as many nodes as those about its
/// quarters together, but in one window, which may not be so large.
class TerrainSectors {
 public:
  static constexpr std::size_t most = 4;

  TerrainSectors() = default;
  /// Of beams that are filled `group` by group.
  TerrainSectors(std::size_t beams, double beam_step_rad, std::size_t group)
      : beams_(beams),
        group_(group),
        count_(std::clamp<std::size_t>(
            static_cast<std::size_t>(static_cast<double>(beams) * beam_step_rad / (0.5 * pi) + whole), 1,
            std::min(most, beams))) {}
  /// One of all beams, however wide.
  [[nodiscard]] static TerrainSectors undivided(std::size_t beams) { return {beams, 0.0, 1}; }

  [[nodiscard]] std::size_t count() const { return count_; }
  /// Edges of beams, of which there is one more than beams, from first_edge(s) up to first_edge(s + 1) lie in sector s;
  /// the ground that it looks at reaches to the latter.
  [[nodiscard]] std::size_t first_edge(std::size_t sector) const {
    return sector < count_ ? sector * beams_ / count_ / group_ * group_ : beams_;
  }
  /// The sector that an edge lies in.
  [[nodiscard]] std::size_t of_edge(std::size_t edge) const {
    std::size_t sector = count_ - 1;
    while (edge < first_edge(sector)) --sector;
    return sector;
  }

 private:
  /// All but a rounding error more than a number of quarters takes one more.
  static constexpr double whole = 1.0 - 1e-9;

  std::size_t beams_ = 1, group_ = 1, count_ = 1;
};

}  // namespace sigmascape::live
