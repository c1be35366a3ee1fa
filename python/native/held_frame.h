#pragma once

#include <pybind11/pybind11.h>

#include "origin_words.h"
#include "turns.h"

#include "sigmascape/live/frame.h"
#include "sigmascape/live/live_renderer.h"

namespace sigmascape::python {

/// A frame and what made it, in whose memory it lies.
struct HeldFrame {
  live::Frame frame;
  live::Pose pose;  ///< without its targets, which may change with the next
  pybind11::object renderer;
  Turns* turns;  ///< of the renderer, for whoever looks whether the bins still hold the frame
  Words words;   ///< where it comes from, for files
};

}  // namespace sigmascape::python
