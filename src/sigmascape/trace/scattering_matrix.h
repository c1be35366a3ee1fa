#pragma once

#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/complex_channels.h"
#include "sigmascape/scatter/field.h"

namespace sigmascape::trace {

/// A scattering matrix that is its own transpose, in the bases of the antenna.
struct ScatteringMatrix {
  scatter::Amplitude vv, hh, hv;

  [[nodiscard]] radar::Channels powers() const {
    return {power_of(vv), power_of(hh), power_of(hv), correlation_of(vv, hh)};
  }
  [[nodiscard]] radar::ComplexChannels amplitudes() const { return {{vv.re, vv.im}, {hh.re, hh.im}, {hv.re, hv.im}}; }
};

/// S + Sᵀ of a path and its reversal, from the fields that the path brings.
[[nodiscard]] inline ScatteringMatrix paired(const scatter::FieldPair& out, const scatter::PolarizationBasis& receive) {
  return {out.from_v.along(receive.v) * 2.0F, out.from_h.along(receive.h) * 2.0F,
          out.from_v.along(receive.h) + out.from_h.along(receive.v)};
}

}  // namespace sigmascape::trace
