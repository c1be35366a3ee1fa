#include "sigmascape/scatter/permittivity.h"

#include <cmath>

#include "sigmascape/base/units.h"

namespace sigmascape::scatter {
namespace {

struct RangeOf {
  FrequencyRange operator()(const PowerLawPermittivity&) const { return {}; }
  FrequencyRange operator()(const WaterPermittivity&) const { return {1e6, 1e12}; }
  FrequencyRange operator()(const SoilPermittivity&) const { return {0.3e9, 37e9}; }
  FrequencyRange operator()(const VegetationPermittivity&) const { return {0.2e9, 20e9}; }
};

}  // namespace

std::complex<double> PowerLawPermittivity::relative_at(double frequency_hz) const {
  const double f_ghz = frequency_hz / 1e9;
  const double relative = a * std::pow(f_ghz, b);
  const double conductivity_s_per_m = c * std::pow(f_ghz, d);
  return {relative, -conductivity_s_per_m / (2.0 * pi * frequency_hz * vacuum_permittivity_f_per_m)};
}

std::complex<double> Permittivity::relative_at(double frequency_hz) const {
  return std::visit([&](const auto& law) { return law.relative_at(frequency_hz); }, law_);
}

FrequencyRange Permittivity::valid_frequencies() const {
  return std::visit(RangeOf{}, law_);
}

}  // namespace sigmascape::scatter
