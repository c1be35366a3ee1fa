#pragma once

#include <cstdint>

namespace sigmascape::radar {

/// How leaves and branches move in the wind, as their Doppler shows it: a part of the power stands still, the rest has
/// radial velocities that fall off exponentially to both sides,
///
///     P(v) = r/(r + 1) δ(v) + 1/(r + 1) · (β/2) exp(−β |v|)                    docs/physics/speckle.md, Eq. (8)
///
///     r = 489.8 w^−1.55 f^−1.21,   β⁻¹ = 0.1048 (log₁₀ w + 0.4147) m/s         docs/physics/speckle.md, Eq. (9)
///
/// w the wind in statute miles an hour, f in GHz. Assumes wind of a mile an hour at least; less counts as that much.
/// [Billingsley 1996]
class WindblownVegetation {
 public:
  WindblownVegetation(double wind_mps, double frequency_hz);

  /// r/(r + 1).
  [[nodiscard]] double still_part() const { return still_part_; }
  /// β, s/m.
  [[nodiscard]] double decay_s_per_m() const { return decay_s_per_m_; }
  /// The velocity of one scatterer away from the radar, drawn from P by 64 hashed bits: the spectrum emerges from many.
  [[nodiscard]] float range_rate_mps(std::uint64_t bits) const;

 private:
  double still_part_, decay_s_per_m_;
};

}  // namespace sigmascape::radar
