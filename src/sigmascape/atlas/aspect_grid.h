#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/look.h"

namespace sigmascape::atlas {

/// Number of a look within an AspectGrid: azimuth runs fastest, then elevation, then frequency.
using LookIndex = std::uint32_t;

/// The looks that are baked: every azimuth with every elevation at every frequency. Each axis ascends.
struct AspectGrid {
  std::vector<double> azimuths_rad;    ///< in [0, 2π), clockwise from the frame's north; the axis closes on itself
  std::vector<double> elevations_rad;  ///< in (0, π/2]
  std::vector<double> frequencies_hz;

  friend bool operator==(const AspectGrid&, const AspectGrid&) = default;

  [[nodiscard]] std::size_t look_count() const {
    return azimuths_rad.size() * elevations_rad.size() * frequencies_hz.size();
  }
  [[nodiscard]] LookIndex index_of(std::size_t azimuth, std::size_t elevation, std::size_t frequency) const {
    return static_cast<LookIndex>((frequency * elevations_rad.size() + elevation) * azimuths_rad.size() + azimuth);
  }
  [[nodiscard]] radar::Look look(LookIndex index) const;
};

/// As many azimuths as an axis may have: one every tenth of a degree.
inline constexpr unsigned most_azimuths = 3600;

/// The azimuths axis of so many looks around, evenly spaced from north. Throws Error for none and for more than
/// `most_azimuths`.
[[nodiscard]] std::vector<double> even_azimuths(unsigned count);

/// The looks of the paper: azimuths 0°, 45° … 315°, elevations 5°, 13°, 21°, 29°, 37°, at 10 GHz.
[[nodiscard]] AspectGrid paper_aspect_grid();

/// A coarser grid within a finer one, as places on its axes, each list ascending; an empty list keeps the whole axis.
struct AspectSelection {
  std::vector<std::size_t> azimuths;
  std::vector<std::size_t> elevations;
};

/// The looks of `grid` that a selection keeps, in the order of the coarser grid. Throws Error when a place is not on
/// its axis or a list does not ascend.
[[nodiscard]] std::vector<LookIndex> selected_looks(const AspectGrid& grid, const AspectSelection& selection);

/// The grid that those looks make up. Errors as above.
[[nodiscard]] AspectGrid selected_grid(const AspectGrid& grid, const AspectSelection& selection);

/// Throws Error, naming `where`, when an axis is empty, does not ascend or leaves its range.
void check(const AspectGrid& grid, std::string_view where);

/// Throws Error when a frequency lies outside the baked ones by more than 1 %, saying which were baked.
void check_frequency(const AspectGrid& grid, double frequency_hz);

/// Over so much of azimuth, about the middle between two baked ones, their looks are blended; on either side of that
/// the nearer one is taken alone. Neighbours that are closer are blended all the way.
///
/// What objects return is another few degrees further on: faces flash and shadows lie elsewhere. So of two looks tens
/// of degrees apart neither tells more of what is between them than the other, and a blend of both fills the shadows of
/// each. docs/decisions/0147-azimuths-are-blended-in-the-middle.md.
inline constexpr double azimuth_blend_rad = radians_from_deg(12.0);

/// How many times more steeply than linearly from one azimuth to the next looks are blended in the middle of that gap.
[[nodiscard]] constexpr double azimuth_blend_steepness(double gap_rad) {
  return std::max(gap_rad / azimuth_blend_rad, 1.0);
}

/// The second azimuth's part in a look that lies `fraction` of a gap beyond the first.
[[nodiscard]] constexpr double part_of_second_azimuth(double fraction, double gap_rad) {
  return std::clamp(0.5 + azimuth_blend_steepness(gap_rad) * (fraction - 0.5), 0.0, 1.0);
}

/// Which baked looks make up one that was asked for, and in what parts: at most two neighbours on each of three axes.
struct AspectWeights {
  std::array<LookIndex, 8> look{};
  std::array<float, 8> weight{};
  std::size_t count = 0;
};

/// Weights that are to be applied to linear power.
///
/// Azimuth is periodic and linear over the middle of every gap (azimuth_blend_rad), frequency linear in its logarithm
/// and held beyond the ends. Over elevation ψ it is γ = σ0 / sin ψ, power over the area that the wave meets, that is
/// blended, linearly in cot ψ, in which the lengths of shadows are linear: natural ground, whose γ hardly changes, so
/// comes out right between nodes however far apart. γ is held below the lowest baked elevation, so that σ0 goes to
/// nothing at the horizon; σ0 is held above the highest. A baked look has the one weight 1.
/// docs/decisions/0005-blend-gamma.md.
[[nodiscard]] AspectWeights weights_for(const AspectGrid& grid, const radar::Aspect& aspect, double frequency_hz);

}  // namespace sigmascape::atlas
