#pragma once

#include <array>
#include <vector>

#include "sigmascape/scatter/material.h"

namespace sigmascape::scatter {

enum class UlabyDobsonBand { L, S, C, X, Ku, Ka };
enum class UlabyDobsonChannel { HH, HV, VV };

/// One fit of mean σ0 over incidence [Ulaby and Dobson 1989].
struct UlabyDobsonRow {
  TerrainClass terrain;
  UlabyDobsonBand band;
  UlabyDobsonChannel channel;
  std::array<double, 6> p;  ///< P1 to P6
  double least_incidence_deg;
  double greatest_incidence_deg;  ///< one for the three channels of a class and band
  bool verified;

  /// The fit itself, which follows no surface outside its angles:
  ///
  ///     σ0 [dB] = P1 + P2 exp(−P3 θ) + P4 cos(P5 θ + P6),   θ in radians     docs/physics/ulaby_dobson.md, Eq. (1)
  [[nodiscard]] double sigma0_db(double incidence_rad) const;
  /// Linear, and continued outside the row's angles: with constant γ towards grazing, with constant σ0 towards the
  /// zenith.
  [[nodiscard]] double sigma0(double incidence_rad) const;
};

/// All rows; those of a lesser standing are marked. docs/physics/ulaby_dobson.md, Table 1.
[[nodiscard]] const std::vector<UlabyDobsonRow>& ulaby_dobson_table();

}  // namespace sigmascape::scatter
