#include "sigmascape/scatter/soil_permittivity.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/scatter/water_permittivity.h"

namespace sigmascape::scatter {
namespace {

/// The conductivity of soil water, a relaxation at 1.35 GHz between two values that texture gives, S/m.
std::complex<double> effective_conductivity(const SoilPermittivity& soil, double f_ghz) {
  const double density = soil.bulk_density();
  // The Recommendation prints the part of clay with the other sign; Peplinski et al., whom it follows, have it so.
  const double low = 0.0467 + 0.2204 * density - 0.004111 * soil.sand_percent + 0.006614 * soil.clay_percent;
  const double high = -1.645 + 1.939 * density - 0.0225622 * soil.sand_percent + 0.01594 * soil.clay_percent;
  const double x = f_ghz / 1.35;
  const double relaxing = (low - high) / (1.0 + x * x);
  // In soils of much sand the fit turns negative, which would make water a source of power.
  return {relaxing * x, std::max(0.0, high + relaxing)};
}

}  // namespace

double SoilPermittivity::bulk_density() const {
  const double silt_percent = 100.0 - sand_percent - clay_percent;
  return 1.072560 + 0.078886 * std::log(sand_percent) + 0.038753 * std::log(clay_percent) +
         0.032732 * std::log(silt_percent);
}

std::complex<double> SoilPermittivity::relative_at(double frequency_hz) const {
  constexpr double shape = 0.65;
  const double f_ghz = frequency_hz / 1e9;
  const double density = bulk_density();
  const double pores = (specific_gravity - density) / (specific_gravity * volumetric_moisture);
  const std::complex<double> conduction = effective_conductivity(*this, f_ghz) * (18.0 / f_ghz * pores);
  const std::complex<double> water = WaterPermittivity{temperature_c}.relative_at(frequency_hz);
  // In dry clay the fit may take more away than the water has; no less than vacuum is left.
  const double water_real = std::max(1.0, water.real() + conduction.real());
  const double water_loss = -water.imag() + conduction.imag();

  const double exponent_real = 1.2748 - 0.00519 * sand_percent - 0.00152 * clay_percent;
  const double exponent_loss = 1.33797 - 0.00603 * sand_percent - 0.00166 * clay_percent;
  const double grains = std::pow(1.01 + 0.44 * specific_gravity, 2) - 0.062;
  const double mixed_real = 1.0 + density / specific_gravity * (std::pow(grains, shape) - 1.0) +
                            std::pow(volumetric_moisture, exponent_real) * std::pow(water_real, shape) -
                            volumetric_moisture;
  const double mixed_loss = std::pow(volumetric_moisture, exponent_loss) * std::pow(water_loss, shape);
  return {std::pow(mixed_real, 1.0 / shape), -std::pow(mixed_loss, 1.0 / shape)};
}

}  // namespace sigmascape::scatter
