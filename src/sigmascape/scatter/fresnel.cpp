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

/// q = √(ε − sin² θ), with Im q ≤ 0: the wave that decays into the material.
std::complex<float> refracted_cosine(std::complex<float> permittivity, float cos_incidence) {
  return principal_root({permittivity.real() - (1.0F - cos_incidence * cos_incidence), permittivity.imag()});
}

}  // namespace

FresnelCoefficients fresnel(std::complex<float> permittivity, float cos_incidence) {
  const std::complex<float> q = refracted_cosine(permittivity, cos_incidence);
  const std::complex<float> dense = permittivity * cos_incidence;
  return {ratio(cos_incidence - q, cos_incidence + q), ratio(dense - q, dense + q)};
}

FieldPair reflected(const FieldPair& in, std::complex<float> permittivity, Vec3f travel_in, Vec3f travel_out,
                    Vec3f facet) {
  // The mean of both angles, so that the way back meets the same coefficients to the last bit.
  const float cos_incidence = 0.5F * dot(travel_out - travel_in, facet);
  const std::complex<float> q = refracted_cosine(permittivity, cos_incidence);
  const std::complex<float> dense = permittivity * cos_incidence;
  const Amplitude mirrored = ratio(cos_incidence - q, cos_incidence + q);
  // (r_s + r_p) / sin² θ with the sine cancelled: finite at normal incidence, zero for the ideal conductor.
  const Amplitude dense_part = ratio(-2.0F * (permittivity - 1.0F), dense + q);
  const Amplitude in_plane = ratio({dense_part.re, dense_part.im}, cos_incidence + q);

  const Vec3f across = cross(travel_in, facet);
  const Vec3f p_in = cross(across, travel_in);
  const Vec3f p_out = cross(across, travel_out);
  const auto reflect = [&](const Field& e) {
    const Field image{e.re - facet * (2.0F * dot(e.re, facet)), e.im - facet * (2.0F * dot(e.im, facet))};
    const Field s_like{image.re * mirrored.re - image.im * mirrored.im,
                       image.re * mirrored.im + image.im * mirrored.re};
    return s_like + field_along(p_out, in_plane * e.along(p_in));
  };
  return {reflect(in.from_v), reflect(in.from_h)};
}

float mean_reflectivity(std::complex<float> permittivity) {
  // Midpoints in √μ, which crowd where a good conductor has its pseudo-Brewster angle.
  constexpr int steps = 512;
  float sum = 0.0F;
  for (int i = 0; i < steps; ++i) {
    const float root = (static_cast<float>(i) + 0.5F) / steps;
    const auto [s, p] = fresnel(permittivity, root * root);
    sum += (power_of(s) + power_of(p)) * 2.0F * root * root * root / steps;
  }
  return sum;
}

}  // namespace sigmascape::scatter
