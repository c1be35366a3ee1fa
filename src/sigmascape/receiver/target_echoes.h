#pragma once

#include <span>
#include <vector>

#include "sigmascape/radar/echo.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/radar/target.h"

namespace sigmascape::receiver {

/// What targets return to a radar at one moment, for the power mode: an echo each, at its own range, azimuth and
/// height, whatever the level of detail of the ground around it. None is left out for being small, far or many.
/// Whether something stands between is not asked here.
[[nodiscard]] std::vector<radar::Echo> target_echoes(std::span<const radar::Target> targets, const radar::Radar& radar,
                                                     const radar::Moment& moment);

/// Adds echoes to an image of the radar's bins, however bright they are, each with the responses of pulse and beam
/// about its own place: a bin has what the radar equation gives at the offset of its middle from the point. The sums of
/// what RangeAzimuthReceiver shares between bins first are the same, its responses a little wider.
void add_echoes(radar::RangeAzimuthImage& image, const radar::Radar& radar, std::span<const radar::Echo> echoes);

}  // namespace sigmascape::receiver
