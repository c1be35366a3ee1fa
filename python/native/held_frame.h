#pragma once

#include <array>
#include <cstdint>
#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <string>
#include <utility>

#include "held.h"
#include "long_call.h"
#include "origin_words.h"

#include "sigmascape/base/error.h"
#include "sigmascape/render/live_renderer.h"

namespace sigmascape::python {

using Triple = std::array<double, 3>;

/// A frame and what made it, in whose memory it lies.
struct HeldFrame {
  render::Frame frame;
  render::Pose pose;
  pybind11::object renderer;
  Turns* turns;  ///< of the renderer
  Words words;   ///< where it comes from, for files
};

/// What `draw` does with the Live behind `self`, for which others wait their turn.
template <typename Live, typename Draw>
HeldFrame drawn(const pybind11::object& self, const render::Pose& pose, const Draw& draw) {
  const auto& held = self.cast<const Held<Live>&>();
  // A copy of what is told about the bins, taken before the next caller's frame is.
  const auto [frame, words] = long_call([&] {
    return held.in_turn([&](Live& live) { return std::pair<render::Frame, Words>(draw(live), live.words); });
  });
  return {frame, pose, self, &held.turns(), words};
}

/// Throws Error for a step of a scan that begins behind the last beam or is of none; beams behind the last are left
/// out.
inline void check_step(std::size_t first_beam, std::size_t count, std::size_t beams) {
  if (first_beam >= beams) {
    throw Error("first_beam", fmt::format("is {}, and there are {} beams", first_beam, beams),
                fmt::format("give 0 to {}", beams - 1));
  }
  if (count == 0) throw Error("count", "is 0", "give 1 or more");
}

inline render::Pose pose_from(const Triple& position_m, double first_azimuth_rad, double first_range_m,
                              const Triple& velocity_mps = {}) {
  return {.position = {position_m[0], position_m[1], position_m[2]},
          .first_azimuth_rad = first_azimuth_rad,
          .first_range_m = first_range_m,
          .velocity_mps = {velocity_mps[0], velocity_mps[1], velocity_mps[2]}};
}

inline render::LiveSettings settings_from(const std::string& content, std::size_t beams, std::size_t ranges,
                                          double beam_step_rad, double range_step_m, double cells_per_bin,
                                          std::uint64_t seed, unsigned threads, double refraction) {
  if (content != "amplitudes" && content != "powers")
    throw Error("content", "is '" + content + "'", "give 'amplitudes' or 'powers'");
  return {.content = content == "powers" ? render::FrameContent::Powers : render::FrameContent::Amplitudes,
          .beams = beams,
          .ranges = ranges,
          .beam_step_rad = beam_step_rad,
          .range_step_m = range_step_m,
          .cells_per_bin = cells_per_bin,
          .seed = seed,
          .threads = threads,
          .refraction = refraction};
}

}  // namespace sigmascape::python
