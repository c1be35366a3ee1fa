#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sigmascape/bake/patch_sums.h"
#include "sigmascape/bake/sample_pairs.h"
#include "sigmascape/radar/channels.h"

namespace sigmascape::bake {

/// An echo where it stands in the patch, by the sample that brought it.
struct Landed {
  std::uint32_t texel = 0;
  std::uint32_t sample = 0;
  bool several = false;    ///< came over several surfaces
  bool apart = false;      ///< came directly from a building that is kept apart
  radar::Channels rcs_m2;  ///< as though its sample stood for the whole launch cell
};

/// Adds what launch cells return to a patch, with its variance. One a thread: it keeps scratch space.
///
/// With T_i what sample i of n brings of total power to a texel, the cell's part of the texel is Σ_i T_i / n, and the
/// variance of that
///
///     Σ_pairs (T_i − T_j)² / n²                                        docs/physics/estimator.md, Eq. (14)
///
/// over the pairs of samples that lie beside one another (SamplePairs).
class CellSum {
 public:
  /// Adds the echoes of one cell's samples, and reorders them.
  void add(std::span<Landed> echoes, const SamplePairs& pairs, PatchSums& patch);

 private:
  /// The part of a texel that a cell returned, and the variance of its total power.
  struct Part {
    radar::Channels rcs_m2;
    double variance_m4 = 0.0;
  };

  using Sums = receiver::GroundAccumulator;
  /// All of a kind. `several`, if not null, gets what of them came over several surfaces.
  void add_to(Sums& all, Sums* several, std::span<Landed> echoes, const SamplePairs& pairs);
  /// The echoes of one cell in one texel, in the order of their samples.
  void add_texel(Sums& all, Sums* several, std::span<const Landed> echoes, const SamplePairs& pairs);
  template <typename Counts>
  [[nodiscard]] Part part_of(std::span<const Landed> echoes, const SamplePairs& pairs, const Counts& counts);
  [[nodiscard]] double squared_differences(std::span<const Landed> echoes, const SamplePairs& pairs) const;

  std::vector<double> power_m2_;  // [sample], zero but for the texel that is added
};

}  // namespace sigmascape::bake
