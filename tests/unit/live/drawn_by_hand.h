#pragma once

#include <cstddef>

#include "sigmascape/base/vec.h"
#include "sigmascape/live/drawn_beams.h"
#include "sigmascape/live/frame.h"

namespace sigmascape::live {

/// Makes frames whose bins are made by hand look as though they had been drawn.
class DrawnByHand {
 public:
  explicit DrawnByHand(std::size_t beams) : beams_(beams) {}

  void draw(Frame& frame, Vec3d radar, std::size_t first_beam, std::size_t count) {
    beams_.begin(first_beam, count);
    frame.drawing = beams_.end(radar);
    frame.beams = beams_.all();
  }
  void draw(Frame& frame, Vec3d radar) { draw(frame, radar, 0, beams_.all().size()); }

 private:
  DrawnBeams beams_;
};

}  // namespace sigmascape::live
