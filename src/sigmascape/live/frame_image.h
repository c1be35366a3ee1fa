#pragma once

#include "sigmascape/live/frame.h"
#include "sigmascape/live/ground_height.h"
#include "sigmascape/live/live_ground.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/range_azimuth_image.h"

namespace sigmascape::live {

/// A frame as the image that pictures, scopes and ground maps (product::ground_map, over Frame::earth) are made from:
/// powers as they are, of amplitudes their squares. Its radar is where the beam was drawn from that was drawn last.
/// Throws Error as `check_holds` does.
[[nodiscard]] radar::RangeAzimuthImage image_of(const Frame& frame);

/// The same as a radar hears it, with its compressed pulse and its beam laid over the bins, by the responses of offline
/// maps (receiver/bin_response.h): what receiver::received_power takes. A target has the watts of the radar equation
/// there, wherever in a bin it lies and however many bins a resolution cell has. Even ground has them too, whatever the
/// bins: in bins coarser than the pulse or the beam ground is taken to lie evenly over its bin, of which one pulse
/// hears a part. What lies where in such a bin is not known: a lone bright spot has the mean of what it would have at
/// all its places, not what it has at its own. Targets are added in power, also to frames of amplitudes. They are
/// weakened as far as bins share them with what lies outside the frame.
///
/// Bins in azimuths that the radar's scan never comes to and in ranges outside its gate, which closes an unambiguous
/// range after its opening at the latest, are NaN, as on offline maps; what the frame holds there folds into the gate,
/// or is lost beyond its end. A gate that the radar does not state opens with the frame's first range.
///
/// What lies outside the frame is not known: bins nearer to its edge than the response reaches lack what that would lay
/// over them, and nothing folds in from there. Beams that go round have no edges. Powers are spread, also those of
/// amplitudes, whose speckle is then weaker than in one pulse. Throws Error for a radar whose frequency is more than
/// a hundredth from the frame's, and for an antenna that tells elevations apart: bins alone do not say how far below
/// the radar their ground is.
[[nodiscard]] radar::RangeAzimuthImage image_of(const Frame& frame, const radar::Radar& radar);

/// The same for any antenna: each bin has its two-way gain in elevation, relative to its peak, towards the ground in
/// the middle of the bin (docs/physics/receiver.md), from where the beam was drawn (Frame::beams) and over the frame's
/// Earth (Frame::earth), and each target the one towards itself.
[[nodiscard]] radar::RangeAzimuthImage image_of(const Frame& frame, const radar::Radar& radar,
                                                const GroundHeight& ground);

/// The ground that the bins of a frame lie on, as finely as they tell it apart and four million nodes hold it. Reads
/// tiles: nothing for the time between two frames. Throws Error as `check_holds` does.
[[nodiscard]] GroundHeight ground_below(const Frame& frame, const LiveGround& ground);

}  // namespace sigmascape::live
