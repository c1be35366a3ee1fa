#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/radar.h"

namespace sigmascape::radar {

/// The Doppler of a standing place, seen from the radar.
[[nodiscard]] double doppler_of_hz(const Radar& radar, Vec3d place);

/// From the least to the greatest Doppler of some places; 0 and 0 of none.
struct DopplerSpan {
  double least_hz = 0.0, most_hz = 0.0;
};
[[nodiscard]] DopplerSpan doppler_span(const Radar& radar, std::span<const Vec3d> places);

/// A sentence where that of `what`, "what is mapped", is more than pulses know, their repetition frequency; nothing
/// where it is not.
[[nodiscard]] std::optional<std::string> doppler_that_folds(const Radar& radar, const DopplerSpan& span,
                                                            std::string_view what);

}  // namespace sigmascape::radar
