#pragma once

#include <string>

#include "sigmascape/radar/radar.h"

namespace sigmascape::radar {

/// What a message advises of the key that states how finely a coherent mode maps: the interval where it is stated, else
/// the sharpening or the resolution. Numbers are in so many digits, rounded so that they are not refused in turn.
inline constexpr int advised_digits = 3;

/// How to map no more finely than `finest_m`, where `width_m` is asked for and takes `interval_s`.
[[nodiscard]] std::string advice_for_coarser(const Radar& radar, double width_m, double interval_s, double finest_m);

/// How to have `more` times the pulses. Looks that are given up make way for others only where the interval is stated:
/// else it goes with them.
[[nodiscard]] std::string advice_for_longer(const Radar& radar, double width_m, double interval_s, double more);

/// By which keys the resolution becomes finer.
[[nodiscard]] const char* keys_of_resolution(const Radar& radar);

}  // namespace sigmascape::radar
