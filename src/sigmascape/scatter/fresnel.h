#pragma once

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

/// The field after reflection by a mirror facet with unit normal m: out = r_s (E·s) s + r_p (E·p_i) p_o, written
/// without s, which a wave that meets the mirror head-on does not have:
///
///     out = r_s (E − 2 (E·m) m) + g (E·(a × k_i)) (a × k_o),   a = k_i × m,   g = (r_s + r_p) / sin² θ
///
/// `travel_in` and `travel_out`, k_i and k_o, are the directions of travel, mirror images of one another in the facet.
/// For the way back (−k_o to −k_i) the matrix is the transpose, to rounding. docs/physics/fresnel.md, Eqs. (4), (5).
[[nodiscard]] FieldPair reflected(const FieldPair& in, std::complex<float> permittivity, Vec3f travel_in,
                                  Vec3f travel_out, Vec3f facet);

/// The part of unpolarized power from all directions alike that a mirror returns:
///
///     F_avg = ∫ (|r_s|² + |r_p|²) μ dμ,   μ = cos θ from 0 to 1        docs/physics/fresnel.md, Eq. (6)
[[nodiscard]] float mean_reflectivity(std::complex<float> permittivity);

}  // namespace sigmascape::scatter
