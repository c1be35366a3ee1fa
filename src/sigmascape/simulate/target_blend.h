#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sigmascape/live/live_renderer.h"
#include "sigmascape/receiver/targets_by_beam.h"

namespace sigmascape::simulate {

/// The targets of two frames of the same bins as those of one, told apart in it as they are in each: what
/// simulate/frame_blend.h makes of bins without targets is what the blended bins held before them.
class TargetBlend {
 public:
  /// Of beams first … first + count − 1, the second frame with that share of the power, in place of what `blended` has
  /// of them.
  void blend(const live::Frame& first, const live::Frame& second, double second_share, std::size_t first_beam,
             std::size_t count, receiver::TargetsByBeam& blended);

 private:
  /// Bins in order, each once, as a frame has them without targets.
  using Bins = std::vector<receiver::BinBefore>;
  void put_in_order(const receiver::TargetsApart& targets, Bins& bins);

  Bins first_, second_;
  std::vector<std::uint64_t> order_;
};

}  // namespace sigmascape::simulate
