#pragma once

namespace sigmascape::radar {

/// Which transmit and receive polarizations a reading is for. By reciprocity HV and VH are equal in monostatic
/// geometry; `Sum` is VV + HH + 2·HV, the total over both transmit and both receive polarizations.
enum class Polarization { VV, HH, HV, VH, Sum };

/// The four numbers that every echo, texel and bin carries: three powers and the correlation that tells an odd number
/// of bounces (positive) from an even one (negative). Linear; the unit is that of the quantity they describe (m² for
/// cross-sections, none for σ0).
struct Channels {
  float vv = 0.0F;
  float hh = 0.0F;
  float hv = 0.0F;       ///< equal to VH
  float re_vvhh = 0.0F;  ///< Re⟨S_VV · S_HH*⟩, may be negative

  static constexpr int count = 4;

  friend constexpr bool operator==(const Channels&, const Channels&) = default;
  friend constexpr Channels operator+(Channels a, Channels b) {
    return {a.vv + b.vv, a.hh + b.hh, a.hv + b.hv, a.re_vvhh + b.re_vvhh};
  }
  friend constexpr Channels operator*(Channels a, float s) { return {a.vv * s, a.hh * s, a.hv * s, a.re_vvhh * s}; }
  constexpr Channels& operator+=(Channels b) { return *this = *this + b; }

  [[nodiscard]] constexpr float power(Polarization polarization) const {
    switch (polarization) {
      case Polarization::VV:
        return vv;
      case Polarization::HH:
        return hh;
      case Polarization::HV:
      case Polarization::VH:
        return hv;
      case Polarization::Sum:
        return vv + hh + 2.0F * hv;
    }
    return 0.0F;
  }
};

}  // namespace sigmascape::radar
