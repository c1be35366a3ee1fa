#pragma once

#include "sigmascape/base/toml_reader.h"

/// What the numbers that describe a radar may be, whether a file states them or a program does.
namespace sigmascape::radar::bounds {

inline constexpr Interval frequencies_ghz{0.1, 300.0, "GHz"};
inline constexpr Interval range_resolutions_m{0.005, 10'000.0, "m"};
inline constexpr Interval beam_widths_deg{1e-5, 90.0, "degrees"};
inline constexpr Interval refractions{0.1, 1e3, ": k of the k-Earth, 4/3 as a rule"};
inline constexpr Interval winds_mps{0.0, 40.0, "m/s"};
inline constexpr Interval atmospheres_db_per_km{0.0, 50.0, "dB/km, one way"};
inline constexpr Interval tilts_deg{-90.0, 90.0, "degrees above the horizontal"};
inline constexpr Interval gains_dbi{-10.0, 80.0, "dB over isotropic"};
inline constexpr Interval peak_powers_w{1e-6, 1e9, "W"};
inline constexpr Interval pulse_lengths_us{1e-4, 1e5, "µs"};
inline constexpr Interval losses_db{0.0, 60.0, "dB"};
inline constexpr Interval noise_figures_db{0.0, 40.0, "dB"};
inline constexpr Interval receiver_gains_db{-60.0, 200.0, "dB"};
inline constexpr Interval gate_ranges_km{0.0, 10'000.0, "km"};
inline constexpr Interval pulse_repetitions_hz{1.0, 1e6, "Hz"};
inline constexpr Interval intervals_s{1e-4, 1e3, "s"};
inline constexpr Interval along_resolutions_m{0.01, 10'000.0, "m"};
inline constexpr Interval sharpenings{1.0, 1e4, "times narrower than the beam"};
inline constexpr Interval looks{1.0, 1000.0, "looks"};
inline constexpr Interval moments_s{-1e6, 1e6, "s"};
inline constexpr Interval cells_m{0.05, 10'000.0, "m"};

}  // namespace sigmascape::radar::bounds
