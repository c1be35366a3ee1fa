#pragma once

namespace sigmascape::radar {

/// The range whose echo comes back just as the next pulse leaves, c/(2 f_p). docs/physics/waveform.md, Eq. (6).
[[nodiscard]] double unambiguous_range_m(double pulse_repetition_hz);
/// Where an echo from `range_m` appears to a receiver that takes every echo for one between `first_range_m` and an
/// unambiguous range beyond it.
[[nodiscard]] double apparent_range_m(double range_m, double first_range_m, double pulse_repetition_hz);
/// Where pulses show an echo from `range_m` nearest to `about_m`: a multiple of the unambiguous range beside where it
/// comes from.
[[nodiscard]] double folded_near_m(double range_m, double about_m, double pulse_repetition_hz);
/// How many unambiguous ranges lie between where the echo comes from and where it appears: 1 is second time around.
[[nodiscard]] int times_around(double range_m, double first_range_m, double pulse_repetition_hz);
/// The longest pulse that may be sent so often: it leaves the receiver half of the time between pulses.
[[nodiscard]] double longest_pulse_s(double pulse_repetition_hz);
/// Part of an echo's pulse, 0 to 1, that meets a receiver which is deaf while its own transmitter sends: the amplitude
/// after compression scales with it. docs/physics/waveform.md, Eq. (7).
[[nodiscard]] double uneclipsed_part(double range_m, double pulse_length_s, double pulse_repetition_hz);

}  // namespace sigmascape::radar
