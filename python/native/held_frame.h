#pragma once

#include <array>
#include <cstdint>
#include <pybind11/pybind11.h>
#include <string>

#include "sigmascape/base/error.h"
#include "sigmascape/render/live_renderer.h"

namespace sigmascape::python {

using Triple = std::array<double, 3>;

/// A frame and what made it, in whose memory it lies.
struct HeldFrame {
  render::Frame frame;
  render::Pose pose;
  pybind11::object renderer;
};

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
