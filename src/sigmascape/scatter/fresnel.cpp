#include "sigmascape/scatter/fresnel.h"

#include <cmath>

namespace sigmascape::scatter {
namespace {

Amplitude ratio(std::complex<float> numerator, std::complex<float> denominator) {
  const float norm = 1.0F / (denominator.real() * denominator.real() + denominator.imag() * denominator.imag());
  return {(numerator.real() * denominator.real() + numerator.imag() * denominator.imag()) * norm,
          (numerator.imag() * denominator.real() - numerator.real() * denominator.imag()) * norm};
}

/// √z with non-negative real part; for Im z ≤ 0 its imaginary part is ≤ 0, the wave that decays into the material.
std::complex<float> principal_root(std::complex<float> z) {
  const float modulus = std::hypot(z.real(), z.imag());
  const float re = std::sqrt(0.5F * (modulus + std::abs(z.real())));
  if (re == 0.0F) return {};
  const float other = 0.5F * std::abs(z.imag()) / re;
  return z.real() >= 0.0F ? std::complex<float>{re, std::copysign(other, z.imag())}
                          : std::complex<float>{other, std::copysign(re, z.imag())};
}

}  // namespace

FresnelCoefficients fresnel(std::complex<float> permittivity, float cos_incidence) {
  const float sin_squared = 1.0F - cos_incidence * cos_incidence;
  const std::complex<float> q = principal_root({permittivity.real() - sin_squared, permittivity.imag()});
  const std::complex<float> dense{permittivity.real() * cos_incidence, permittivity.imag() * cos_incidence};
  return {ratio(cos_incidence - q, cos_incidence + q), ratio(dense - q, dense + q)};
}

FieldPair reflected(const FieldPair& in, std::complex<float> permittivity, Vec3f travel_in, Vec3f travel_out, Vec3f facet) {
  const FresnelCoefficients r = fresnel(permittivity, std::abs(dot(travel_in, facet)));
  const Vec3f across = cross(travel_in, facet);
  const float across_length = length(across);
  // At normal incidence the plane of incidence is undefined and any s will do.
  const Vec3f s = across_length > 1e-5F ? across * (1.0F / across_length) : Basis(travel_in).tangent;
  const Vec3f p_in = cross(s, travel_in);
  const Vec3f p_out = cross(s, travel_out);
  const auto reflect = [&](const Field& e) { return field_along(s, r.s * e.along(s)) + field_along(p_out, r.p * e.along(p_in)); };
  return {reflect(in.from_v), reflect(in.from_h)};
}

}  // namespace sigmascape::scatter
