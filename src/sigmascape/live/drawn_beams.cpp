#include "sigmascape/live/drawn_beams.h"

#include <atomic>

namespace sigmascape::live {

void DrawnBeams::begin(std::size_t first, std::size_t count) {
  first_ = first;
  count_ = count;
  for (DrawnBeam& beam : std::span(beams_).subspan(first_, count_)) beam.drawing = DrawnBeam::unfinished;
}

std::uint64_t DrawnBeams::end(Vec3d radar, Vec3d velocity_mps) {
  static std::atomic<std::uint64_t> drawings{0};
  const std::uint64_t drawing = ++drawings;
  std::ranges::fill(std::span(beams_).subspan(first_, count_), DrawnBeam{radar, drawing, velocity_mps});
  return drawing;
}

void DrawnBeams::end_as_in(std::span<const DrawnBeam> other) {
  std::ranges::copy(other.subspan(first_, count_), std::span(beams_).subspan(first_, count_).begin());
}

}  // namespace sigmascape::live
