#pragma once

#include <vector>

#include "sigmascape/scatter/permittivity.h"
#include "sigmascape/scatter/reciprocal_backscatter.h"

namespace sigmascape::scatter {

/// Measured mean σ0 of a terrain class, VV, HH and HV each by its own fit over incidence, for the band that holds the
/// frequency [Ulaby and Dobson 1989]. docs/physics/ulaby_dobson.md.
///
/// Throws Error when the table has no row for that class and band.
[[nodiscard]] Sigma0 ulaby_dobson_sigma0(const UlabyDobsonParameters& parameters, double frequency_hz,
                                         double incidence_rad);

/// The same as a surface for paths of any number of bounces.
[[nodiscard]] ReciprocalBackscatter ulaby_dobson(const UlabyDobsonParameters& parameters, double frequency_hz);

/// The bands that the table serves with both co-polarizations, from low to high.
[[nodiscard]] std::vector<FrequencyRange> ulaby_dobson_bands(const UlabyDobsonParameters& parameters);

}  // namespace sigmascape::scatter
