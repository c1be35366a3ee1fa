#pragma once

#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/render/live_renderer.h"

namespace sigmascape::render {

/// A frame as the image that pictures, scopes and ground maps are made from: powers as they are, of amplitudes their
/// squares. `pose` is the frame's.
[[nodiscard]] radar::RangeAzimuthImage image_of(const Frame& frame, const Pose& pose);

}  // namespace sigmascape::render
