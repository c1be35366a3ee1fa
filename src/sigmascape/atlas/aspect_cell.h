#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sigmascape/atlas/aspect_grid.h"

namespace sigmascape::atlas {

/// The looks between which an aspect lies: a pair of neighbouring azimuths and a pair of neighbouring elevations, named
/// by the first of each.
struct AspectCell {
  std::uint32_t azimuth = 0;
  std::uint32_t elevation = 0;

  friend constexpr bool operator==(const AspectCell&, const AspectCell&) = default;
  friend constexpr auto operator<=>(const AspectCell&, const AspectCell&) = default;
};

/// The aspect grid as a renderer of one frequency sees it: cells, the looks at their corners and what is needed to
/// weight them. The weights are those of weights_for, spelled for code that computes them for every texel.
class AspectCells {
 public:
  /// Looks of a cell, [frequency][elevation][azimuth], two of each; at a baked frequency four.
  static constexpr std::size_t most_looks = 8;

  AspectCells(const AspectGrid& grid, double frequency_hz);

  [[nodiscard]] std::size_t looks_a_cell() const { return frequency_count_ * 4; }
  [[nodiscard]] std::size_t azimuth_cells() const { return azimuths_rad_.size(); }
  [[nodiscard]] std::size_t elevation_count() const { return grid_.elevations_rad.size(); }
  [[nodiscard]] std::size_t elevation_cells() const { return cotangents_.size() - 1; }
  [[nodiscard]] std::array<LookIndex, most_looks> looks_of(AspectCell cell) const;

  [[nodiscard]] std::uint32_t azimuth_cell(double azimuth_rad) const;
  /// Held at the ends of the grid.
  [[nodiscard]] std::uint32_t elevation_cell(float cotangent) const {
    std::uint32_t cell = 0;
    for (std::size_t k = 1; k + 1 < cotangents_.size(); ++k) cell += cotangent <= cotangents_[k] ? 1U : 0U;
    return cell;
  }

  /// Start of a cell of azimuth and how far it goes, radians.
  [[nodiscard]] double azimuth_start(std::uint32_t cell) const { return azimuths_rad_[cell]; }
  [[nodiscard]] double azimuth_width(std::uint32_t cell) const;
  /// cot ψ of the baked elevations, falling; of a grid with one elevation twice the same.
  [[nodiscard]] const std::vector<float>& cotangents() const { return cotangents_; }
  [[nodiscard]] float sine(std::size_t elevation) const { return sines_[elevation]; }
  /// The part of each of the frequencies.
  [[nodiscard]] float frequency_part(std::size_t frequency) const { return frequency_parts_[frequency]; }

 private:
  AspectGrid grid_;
  std::vector<double> azimuths_rad_;
  std::vector<float> cotangents_, sines_;
  std::array<std::size_t, 2> frequencies_{};
  std::array<float, 2> frequency_parts_{1.0F, 0.0F};
  std::size_t frequency_count_ = 1;
};

}  // namespace sigmascape::atlas
