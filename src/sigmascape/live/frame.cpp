#include "sigmascape/live/frame.h"

#include "sigmascape/base/error.h"

namespace sigmascape::live {

void check_holds(const Frame& frame, const std::string& who) {
  if (frame.drawing == 0 || frame.beams.empty() || frame.beams.size() != frame.grid.azimuths)
    throw Error(who, "wants the bins of a frame that nothing has been drawn into", "draw it first");
  if (drawn_last(frame.beams).drawing != frame.drawing) {
    throw Error(who, "wants the bins of a frame after which its renderer has drawn into them again",
                "take what each frame holds before the next is drawn");
  }
}

}  // namespace sigmascape::live
