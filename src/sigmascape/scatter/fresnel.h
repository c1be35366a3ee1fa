#pragma once

#include <algorithm>
#include <cmath>
#include <complex>

#include "sigmascape/scatter/field.h"

namespace sigmascape::scatter {

/// Reflection of a plane wave by a plane mirror of relative permittivity ε:
///
///     r_s = (cos θ − q) / (cos θ + q),   r_p = (ε cos θ − q) / (ε cos θ + q),   q = √(ε − sin² θ)
///
/// s lies across the plane of incidence, p = s × k for both the incoming and the outgoing wave; with time e^{jωt}, Im ε
/// ≤ 0. At normal incidence r_p = −r_s. docs/physics/fresnel.md, Eq. (1).
struct FresnelCoefficients {
  Amplitude s, p;
};

[[nodiscard]] FresnelCoefficients fresnel(std::complex<float> permittivity, float cos_incidence);

/// √z with non-negative real part, without a branch; for Im z ≤ 0 its imaginary part is ≤ 0, the wave that decays into
/// the material.
[[nodiscard]] inline Amplitude principal_root(Amplitude z) {
  const float modulus = std::sqrt(power_of(z));
  const float greater = std::sqrt(0.5F * (modulus + std::abs(z.re)));
  const float lesser = 0.5F * std::abs(z.im) / std::max(greater, 1e-30F);
  return {z.re >= 0.0F ? greater : lesser, std::copysign(z.re >= 0.0F ? lesser : greater, z.im)};
}

[[nodiscard]] inline Amplitude ratio_of(Amplitude numerator, Amplitude denominator) {
  const float inverse = 1.0F / power_of(denominator);
  return {(numerator.re * denominator.re + numerator.im * denominator.im) * inverse,
          (numerator.im * denominator.re - numerator.re * denominator.im) * inverse};
}

/// q = √(ε − sin² θ).
[[nodiscard]] inline Amplitude refracted_cosine(Amplitude permittivity, float cos_incidence) {
  return principal_root({permittivity.re - (1.0F - cos_incidence * cos_incidence), permittivity.im});
}

/// The field after reflection by a mirror facet with unit normal m: out = r_s (E·s) s + r_p (E·p_i) p_o, written
/// without s, which a wave that meets the mirror head-on does not have:
///
///     out = r_s (E − 2 (E·m) m) + g (E·(a × k_i)) (a × k_o),   a = k_i × m,   g = (r_s + r_p) / sin² θ
///
/// `travel_in` and `travel_out`, k_i and k_o, are the directions of travel, mirror images of one another in the facet.
/// For the way back (−k_o to −k_i) the matrix is the transpose, to rounding. docs/physics/fresnel.md, Eqs. (4), (5).
[[nodiscard]] inline FieldPair reflected(const FieldPair& in, std::complex<float> permittivity, Vec3f travel_in,
                                         Vec3f travel_out, Vec3f facet) {
  // The mean of both angles, so that the way back meets the same coefficients to the last bit.
  const float cos_incidence = 0.5F * dot(travel_out - travel_in, facet);
  const Amplitude epsilon{permittivity.real(), permittivity.imag()}, cosine{cos_incidence, 0.0F};
  const Amplitude q = refracted_cosine(epsilon, cos_incidence);
  const Amplitude mirrored = ratio_of(cosine - q, cosine + q);
  // (r_s + r_p) / sin² θ with the sine cancelled: finite at normal incidence, zero for the ideal conductor.
  const Amplitude in_plane =
      ratio_of(ratio_of((epsilon - Amplitude{1.0F, 0.0F}) * -2.0F, epsilon * cos_incidence + q), cosine + q);

  const Vec3f across = cross(travel_in, facet);
  const Vec3f p_in = cross(across, travel_in);
  const Vec3f p_out = cross(across, travel_out);
  const auto reflect = [&](const Field& e) {
    const Field image{e.re - facet * (2.0F * dot(e.re, facet)), e.im - facet * (2.0F * dot(e.im, facet))};
    return image.turned(mirrored) + field_along(p_out, in_plane * e.along(p_in));
  };
  return {reflect(in.from_v), reflect(in.from_h)};
}

/// The part of unpolarized power from all directions alike that a mirror returns:
///
///     F_avg = ∫ (|r_s|² + |r_p|²) μ dμ,   μ = cos θ from 0 to 1        docs/physics/fresnel.md, Eq. (6)
[[nodiscard]] float mean_reflectivity(std::complex<float> permittivity);

}  // namespace sigmascape::scatter
