#pragma once

#include <algorithm>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "sigmascape/live/frame.h"
#include "sigmascape/live/live_settings.h"
#include "sigmascape/receiver/target_frame.h"

namespace sigmascape::live {

/// The memory of a frame's bins, [beam][range][number], whatever the frame is made of.
class FrameBins {
 public:
  /// All zero.
  explicit FrameBins(const LiveSettings& settings)
      : content_(settings.content),
        numbers_a_beam_(settings.ranges * numbers_a_bin(settings.content)),
        numbers_(settings.beams * numbers_a_beam_) {}

  [[nodiscard]] std::span<float> numbers() { return numbers_; }
  /// The same two by two, as real and imaginary parts.
  [[nodiscard]] std::span<std::complex<float>> amplitudes() {
    return {reinterpret_cast<std::complex<float>*>(numbers_.data()), numbers_.size() / 2};
  }

  /// Has a frame look at these bins.
  void show_in(Frame& frame) {
    if (content_ == FrameContent::Amplitudes) {
      frame.amplitudes_m = amplitudes();
    } else {
      frame.powers_m2 = numbers_;
    }
  }

  void clear(std::size_t first_beam, std::size_t count) {
    std::ranges::fill(numbers().subspan(first_beam * numbers_a_beam_, count * numbers_a_beam_), 0.0F);
  }

  /// Adds what was looked at to those beams. May be called at once for beams that differ.
  void add(receiver::TargetFrame& targets, std::size_t first_beam, std::size_t count) {
    if (targets.seen() == 0) return;
    if (content_ == FrameContent::Amplitudes) {
      targets.add_amplitudes(first_beam, count, amplitudes());
    } else {
      targets.add_powers(first_beam, count, numbers_);
    }
  }

 private:
  FrameContent content_;
  std::size_t numbers_a_beam_;
  std::vector<float> numbers_;
};

}  // namespace sigmascape::live
