#pragma once

#include "sigmascape/radar/antenna_pattern.h"

namespace sigmascape::receiver {

/// What is left of an antenna's pattern in a strip, whose processor evens it out over its band: the two-way voltage
/// where a point is seen over that where the processor believes it,
///
///     g²(φ)/g²(φ'),   azimuth = atan(tan φ/cos ψ)                               docs/physics/doppler.md, Eq. (14)
///
/// with φ ahead of broadside and ψ the depression of the point as it is passed. None where the processor cannot believe
/// anything.
class StripPattern {
 public:
  /// `squint_rad`: of the beam's axis, ahead of broadside. Patterns turn clockwise, as what is ahead does to the left
  /// of the flight and not to its right.
  StripPattern(const radar::AntennaCut& azimuth, double squint_rad, bool looks_left);

  /// By the sines of both angles ahead of broadside, and of the depression.
  [[nodiscard]] double voltage(double sine_seen, double sine_believed, double sine_depression) const;

 private:
  radar::AntennaCut azimuth_;
  double sine_squint_, clockwise_;
};

}  // namespace sigmascape::receiver
