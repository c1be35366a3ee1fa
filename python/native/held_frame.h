#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <pybind11/pybind11.h>

#include "origin_words.h"
#include "turns.h"

#include "sigmascape/render/live_renderer.h"

namespace sigmascape::python {

/// Beams that are drawn together, as far as there are beams.
struct BeamStep {
  std::size_t first = 0, count = std::numeric_limits<std::size_t>::max();
};

/// A frame and what made it, in whose memory it lies.
struct HeldFrame {
  render::Frame frame;
  render::Pose pose;  ///< without its targets, which may change with the next
  pybind11::object renderer;
  Turns* turns;                 ///< of the renderer
  std::uint64_t number;         ///< among all frames of the process
  std::uint64_t before;         ///< of the frame of which it has the beams that are not of its step; 0: none
  BeamStep step;                ///< that was drawn
  const std::uint64_t* newest;  ///< number of the one that the renderer's bins hold, for whoever has the turn
  Words words;                  ///< where it comes from, for files
  double frequency_hz;          ///< of its phases
};

}  // namespace sigmascape::python
