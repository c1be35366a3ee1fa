#include "sigmascape/scatter/nrl_sea.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/units.h"

namespace sigmascape::scatter {
namespace {

struct Coefficients {
  double c1, c2, c3, c4, c5;

  [[nodiscard]] double sigma0_db(double grazing_deg, double f_ghz, double sea_state) const {
    const double psi = grazing_deg;
    return c1 + c2 * std::log10(std::sin(radians_from_deg(psi))) +
           (27.5 + c3 * psi) * std::log10(f_ghz) / (1.0 + 0.95 * psi) +
           c4 * std::pow(1.0 + sea_state, 1.0 / (2.0 + 0.085 * psi + 0.033 * sea_state)) + c5 * psi * psi;
  }
};

constexpr Coefficients horizontal{-73.0, 20.781, 7.351, 25.65, 0.0054};
constexpr Coefficients vertical{-50.796, 25.93, 0.7093, 21.588, 0.00211};
constexpr double greatest_grazing_deg = 60.0;

}  // namespace

Sigma0 nrl_sea_sigma0(const NrlSeaParameters& parameters, double frequency_hz, double grazing_rad) {
  const double fitted_deg = std::min(deg_from_radians(grazing_rad), greatest_grazing_deg);
  const double continued = std::sin(grazing_rad) / std::sin(radians_from_deg(fitted_deg));
  const auto sigma0 = [&](const Coefficients& c) {
    return continued * linear_from_db(c.sigma0_db(fitted_deg, frequency_hz / 1e9, parameters.sea_state));
  };
  const double vv = sigma0(vertical);
  const double hh = sigma0(horizontal);
  return {vv, hh, parameters.depolarization.cross_ratio * std::sqrt(vv * hh)};
}

ReciprocalBackscatter nrl_sea(const NrlSeaParameters& parameters, double frequency_hz) {
  return {[&](double cos_incidence) { return nrl_sea_sigma0(parameters, frequency_hz, std::asin(cos_incidence)); },
          parameters.depolarization};
}

}  // namespace sigmascape::scatter
