#pragma once

#include <complex>
#include <cstdint>
#include <vector>

#include "sigmascape/radar/target.h"
#include "sigmascape/receiver/strip_pattern.h"
#include "sigmascape/receiver/target_passage.h"

namespace sigmascape::receiver {

/// How pulses are made into a strip.
struct StripProcessing {
  radar::Motion platform;  ///< at time zero
  double wavelength_m = 0.0;
  double repetition_hz = 0.0;
  double squint_rad = 0.0;
  double band_per_m = 0.0;  ///< cycles a metre along the flight that are kept, about those of the squint
  double closest_range_cell_m = 0.0;
  std::uint64_t dwell = 0;

  /// Of the angle ahead of broadside at a place of the band, from −½ to ½: docs/physics/doppler.md, Eq. (13).
  [[nodiscard]] double sine_at(double part_of_band) const;
  /// That are processed of a point, for each metre of its slant range.
  [[nodiscard]] double pulses_a_metre() const;
};

/// A point of a strip that shows a part of a target's band, as if it stood there at rest.
struct StripPart {
  double along_m = 0.0, closest_range_m = 0.0;
  std::complex<float> amplitude;  ///< of a target of 1 m², but for the phase of its closest range
  TargetPassage seen;             ///< in the middle of the part
};

/// What a strip shows of a target, whatever its way.
///
/// A processor finds at each Doppler f' of its band what the pulses have at f' + k f_p, and takes it for a point at
/// rest: at the time t and range r at which the target's Doppler is that, with
///
///     r sin φ' + v t along the flight,  r cos φ' from it,  sin φ' = λ f'/2v
///     √(cos² φ' v²/(|w|² − (λ (f' + k f_p)/2)²)) g²(φ)/g²(φ')                    docs/physics/doppler.md, Eqs. (6b),
///
/// its voltage: as much longer as the target stays in the band it is brighter, and the pattern is undone for the wrong
/// place. What this makes over the band is a Fourier series of points along the flight (Eq. (8)); where the closest
/// range wanders as well, two such series for each of its cells. Order 0 is the k under which it is seen nearest to the
/// axis of the beam, others are counted from there.
[[nodiscard]] std::vector<StripPart> strip_parts(const radar::Target& target, const StripProcessing& processing,
                                                 const StripPattern& pattern, int order);

}  // namespace sigmascape::receiver
