#pragma once

#include <complex>

#include "sigmascape/radar/channels.h"

namespace sigmascape::radar {

/// What Channels become when phase is kept: one complex number a polarization. Of a scatterer they are the square root
/// of its cross-section (metres), of an I/Q sample what that record says.
struct ComplexChannels {
  std::complex<float> vv;
  std::complex<float> hh;
  std::complex<float> hv;  ///< equal to VH

  static constexpr int count = 3;

  friend bool operator==(const ComplexChannels&, const ComplexChannels&) = default;
  friend ComplexChannels operator+(const ComplexChannels& a, const ComplexChannels& b) {
    return {a.vv + b.vv, a.hh + b.hh, a.hv + b.hv};
  }
  /// The plain products: std::complex multiplies with a detour for infinities that has no place in a kernel.
  friend ComplexChannels operator*(const ComplexChannels& a, std::complex<float> s) {
    const auto times = [s](std::complex<float> v) {
      return std::complex<float>(v.real() * s.real() - v.imag() * s.imag(), v.real() * s.imag() + v.imag() * s.real());
    };
    return {times(a.vv), times(a.hh), times(a.hv)};
  }
  friend ComplexChannels operator*(const ComplexChannels& a, float s) { return {a.vv * s, a.hh * s, a.hv * s}; }
  ComplexChannels& operator+=(const ComplexChannels& b) { return *this = *this + b; }
};

/// The powers and the correlation of one observation: |VV|², |HH|², |HV|², Re VV·HH*.
[[nodiscard]] inline Channels power_of(const ComplexChannels& a) {
  return {std::norm(a.vv), std::norm(a.hh), std::norm(a.hv), a.vv.real() * a.hh.real() + a.vv.imag() * a.hh.imag()};
}

/// One polarization of a complex reading. For `Sum`, which has no phase, VV.
[[nodiscard]] inline std::complex<float> component(const ComplexChannels& a, Polarization polarization) {
  switch (polarization) {
    case Polarization::HH:
      return a.hh;
    case Polarization::HV:
    case Polarization::VH:
      return a.hv;
    case Polarization::VV:
    case Polarization::Sum:
      break;
  }
  return a.vv;
}

}  // namespace sigmascape::radar
