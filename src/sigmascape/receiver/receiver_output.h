#pragma once

#include <string>
#include <vector>

#include "sigmascape/radar/phase_history.h"
#include "sigmascape/radar/radar.h"

namespace sigmascape::receiver {

/// Brings pulses in volts, noise and all, to the receiver's output: through its sensitivity time control, by the range
/// of each sample, and then through its converter, I and Q of every polarization apart, where `radar.receiver` has
/// them. The record says which, and how many samples were clipped; without either it keeps every byte. Same numbers for
/// any number of threads. docs/physics/radar_equation.md, Eqs. (5), (6). Throws Error when the record is not in volts.
void bring_to_output(radar::PhaseHistory& history, const radar::Radar& radar, unsigned threads = 0);

/// What a radar engineer would object to in pulses at the receiver's output, one sentence each: samples that the
/// converter clips, or that are all so far below its step that nothing is left of them.
[[nodiscard]] std::vector<std::string> output_warnings(const radar::PhaseHistory& history);

}  // namespace sigmascape::receiver
