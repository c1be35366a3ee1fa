#include "sigmascape/scatter/billingsley.h"

#include <cmath>
#include <span>

#include "sigmascape/base/units.h"

namespace sigmascape::scatter {
namespace {

/// Mean strength up to a depression angle.
struct Step {
  double to_deg;
  double mean_db;
};

constexpr Step general_rural[] = {{0.25, -33.0}, {0.75, -32.0}, {1.5, -30.0}, {4.0, -27.0}, {90.0, -25.0}};
constexpr Step forest[] = {{0.3, -45.0}, {1.0, -30.0}, {90.0, -15.0}};
constexpr Step desert[] = {{0.25, -68.0}, {0.75, -56.0}, {90.0, -38.0}};

std::span<const Step> steps_of(BillingsleyTerrain terrain) {
  switch (terrain) {
    case BillingsleyTerrain::GeneralRural:
      return general_rural;
    case BillingsleyTerrain::Forest:
      return forest;
    case BillingsleyTerrain::Desert:
      return desert;
  }
  return general_rural;
}

}  // namespace

Sigma0 billingsley_sigma0(const BillingsleyParameters& parameters, double grazing_rad) {
  const auto steps = steps_of(parameters.terrain);
  const double grazing_deg = deg_from_radians(grazing_rad);
  double mean_db = steps.back().mean_db;
  for (const Step& step : steps) {
    if (grazing_deg > step.to_deg) continue;
    mean_db = step.mean_db;
    break;
  }
  const double mean = linear_from_db(mean_db);
  return {mean, mean, parameters.depolarization.cross_ratio * mean};
}

ReciprocalBackscatter billingsley(const BillingsleyParameters& parameters) {
  return {[&](double cos_incidence) { return billingsley_sigma0(parameters, std::asin(cos_incidence)); },
          parameters.depolarization};
}

FrequencyRange billingsley_frequencies(BillingsleyTerrain terrain) {
  return terrain == BillingsleyTerrain::GeneralRural ? FrequencyRange{30e6, 12e9} : FrequencyRange{30e6, 300e6};
}

}  // namespace sigmascape::scatter
