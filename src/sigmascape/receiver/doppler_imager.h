#pragma once

#include <cstdint>
#include <span>

#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/scatterer.h"
#include "sigmascape/radar/slant_image.h"
#include "sigmascape/radar/target.h"
#include "sigmascape/radar/track.h"
#include "sigmascape/receiver/equivalent_noise.h"
#include "sigmascape/receiver/multilook.h"
#include "sigmascape/receiver/range_gate.h"
#include "sigmascape/receiver/response_plane.h"
#include "sigmascape/receiver/voltage_gain.h"

namespace sigmascape::receiver {

/// The pulses that one image is made of.
struct CoherentInterval {
  double middle_time_s = 0.0;
  std::size_t pulses = 64;
  double repetition_hz = 1000.0;
  radar::Window window = {};  ///< over the pulses
  double oversampling = 2.0;  ///< Doppler bins a resolution cell, at least 1
  std::uint64_t dwell = 0;    ///< number of the interval, by which fluctuating targets are drawn
};

/// Range–Doppler imaging of a straight flight, in the image domain: Doppler beam sharpening with few pulses, spotlight
/// SAR with many, at any squint.
///
/// Every point answers at its slant range and Doppler in the middle of the interval, with the exact responses of band
/// and pulses; Doppler folds at the pulse repetition frequency. The ground is taken to be in focus over the whole
/// interval, as after a processor that corrects range walk and Doppler rate for points at rest; what moves is shifted
/// and smeared by what it differs. docs/physics/doppler.md, Eqs. (1)–(8).
class DopplerImager {
 public:
  /// `aim`: the ground point whose Doppler stands in the middle of the image. Throws Error when the gate or the
  /// interval make no sense.
  DopplerImager(const radar::Radar& radar, const radar::Track& platform, const CoherentInterval& interval,
                const RangeGate& gate, Vec3d aim, VoltageGain gain = {});

  void add(std::span<const radar::Scatterer> ground, unsigned threads = 0);
  void add(std::span<const radar::Target> targets);
  /// Thermal noise, in place of what there was of it; lifted as on level ground in the height of the image's middle.
  void add(const EquivalentNoise& noise);

  /// All pulses as one look, or one of several that have equal parts of them: each has speckle and noise of its own,
  /// and cells that are wider across range by as much as it has fewer pulses. Throws Error when a look would have none.
  [[nodiscard]] radar::RangeDopplerImage image(const Subband& part = {}, unsigned threads = 0) const;

 private:
  [[nodiscard]] PlacedAmplitude placed(const radar::Motion& seen, double own_range_rate_mps,
                                       const radar::ComplexChannels& amplitude) const;

  CoherentInterval interval_;
  GatedAxis range_;
  Vec3d aim_;
  VoltageGain gain_;
  radar::RangeDopplerImage frame_;  // without bins
  ResponsePlane plane_;
  RowNoise noise_;
};

}  // namespace sigmascape::receiver
