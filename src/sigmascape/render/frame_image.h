#pragma once

#include <functional>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/curved_earth.h"
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
/// than in one pulse. Throws Error for an antenna that tells elevations apart: bins alone do not say how far below the
/// radar their echoes are.
[[nodiscard]] radar::RangeAzimuthImage image_of(const Frame& frame, const Pose& pose, const radar::Radar& radar);

/// Height of the ground at a place of the local frame, above mean sea level.
using GroundHeight = std::function<double(Vec2d)>;

/// The same for any antenna: each bin has its two-way gain in elevation, relative to its peak, towards the ground in
/// the middle of the bin (docs/physics/receiver.md), over the frame's Earth (LiveSettings::refraction). All that is in
/// a bin has that gain: a target high in the air has the one of the ground that is as far away, not its own.
[[nodiscard]] radar::RangeAzimuthImage image_of(const Frame& frame, const Pose& pose, const radar::Radar& radar,
                                                const GroundHeight& ground, const radar::CurvedEarth& earth = {});

/// The ground that the bins of a frame lie on, as finely as they tell it apart and four million nodes hold it. Reads
/// tiles: nothing for the time between two frames.
[[nodiscard]] GroundHeight ground_below(const Frame& frame, const Pose& pose, const LiveGround& ground);

}  // namespace sigmascape::render
