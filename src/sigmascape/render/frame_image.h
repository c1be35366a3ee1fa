#pragma once

#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/render/live_renderer.h"

namespace sigmascape::render {

/// A frame as the image that pictures, scopes and ground maps are made from: powers as they are, of amplitudes their
/// squares. `pose` is the frame's.
[[nodiscard]] radar::RangeAzimuthImage image_of(const Frame& frame, const Pose& pose);

/// The same with the compressed pulse and the beam of a radar laid over the bins, by the responses of offline maps
/// (receiver/bin_response.h): what receiver::received_power takes. A point in the middle of a bin then has the watts of
/// the radar equation there, however many bins a resolution cell has; even ground has them in either image.
///
/// What lies outside the frame is not known: bins nearer to its edge than the response reaches lack what that would lay
/// over them. Beams that go round have none. Powers are spread, also those of amplitudes, whose speckle is then weaker
/// than in one pulse.
[[nodiscard]] radar::RangeAzimuthImage image_of(const Frame& frame, const Pose& pose, const radar::Radar& radar);

}  // namespace sigmascape::render
