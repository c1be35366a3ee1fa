#pragma once

#include <span>

#include "sigmascape/base/progress.h"
#include "sigmascape/radar/phase_history.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/scatterer.h"
#include "sigmascape/radar/target.h"
#include "sigmascape/radar/track.h"
#include "sigmascape/receiver/range_gate.h"
#include "sigmascape/receiver/spreading_kernel.h"
#include "sigmascape/receiver/voltage_gain.h"

namespace sigmascape::receiver {

/// The pulses of a coherent interval: `count` of them, evenly from `first_time_s` on.
struct PulseTrain {
  double first_time_s = 0.0;
  std::size_t count = 1;
  double repetition_hz = 1000.0;
  std::uint64_t dwell = 0;  ///< number of the interval, by which fluctuating targets are drawn
};

/// Makes the phase history of points: every pulse sees every point at its exact range, with the carrier's exact phase
/// and the band's exact response, at twice the band spread and transformed. Stop and go: the platform stands still
/// while a pulse is under way. Echoes repeat with the pulses, once every unambiguous range: what answers from beyond it
/// folds into the gate, and what folds beside the gate has its side lobes there, from the next 64 resolution cells.
class PulseReceiver {
 public:
  /// Throws Error when the gate is empty or sampled too thinly.
  PulseReceiver(const radar::Radar& radar, const RangeGate& gate);

  /// Of each pulse.
  [[nodiscard]] std::size_t samples() const { return range_.samples; }

  /// Throws Error when the gate is wider than the unambiguous range of these pulses, or when their samples take more
  /// than so much memory. receive() asks the first itself; this is for who has much to make before it.
  void check(const PulseTrain& train, double memory_bytes) const;

  /// The record of pulses from a platform on a track. Same numbers for any number of threads. Amplitudes are metres,
  /// the square root of cross-sections, or, with a gain, volts. `progress` hears of pulses as they are done.
  [[nodiscard]] radar::PhaseHistory receive(const radar::Track& platform, const PulseTrain& train,
                                            std::span<const radar::Scatterer> ground,
                                            std::span<const radar::Target> targets, const VoltageGain& gain = {},
                                            unsigned threads = 0, ProgressListener* progress = nullptr) const;

 private:
  struct Line;
  void add(Line& line, const radar::Pulse& pulse, Vec3d position, double range_m,
           const radar::ComplexChannels& amplitude, double unambiguous_range_m, const VoltageGain& gain) const;
  void spread(Line& line, double delay_m, const radar::ComplexChannels& received) const;

  double frequency_hz_;
  GatedAxis range_;
  ResponseTransform transform_;
  SpreadingKernel kernel_;
};

}  // namespace sigmascape::receiver
