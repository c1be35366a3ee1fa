#pragma once

#include "sigmascape/base/toml_reader.h"

/// What the numbers that describe a radar may be, whether a file states them or a program does.
namespace sigmascape::radar::bounds {

inline constexpr Interval frequencies_ghz{0.1, 300.0, "GHz"};
inline constexpr Interval range_resolutions_m{0.005, 10'000.0, "m"};
inline constexpr Interval beam_widths_deg{1e-5, 90.0, "degrees"};
inline constexpr Interval pulse_repetitions_hz{1.0, 1e6, "Hz"};
inline constexpr Interval intervals_s{1e-4, 1e3, "s"};
inline constexpr Interval along_resolutions_m{0.01, 10'000.0, "m"};
inline constexpr Interval sharpenings{1.0, 1e4, "times narrower than the beam"};
inline constexpr Interval looks{1.0, 1000.0, "looks"};
inline constexpr Interval moments_s{-1e6, 1e6, "s"};
inline constexpr Interval cells_m{0.05, 10'000.0, "m"};

}  // namespace sigmascape::radar::bounds
