#include "sigmascape/scatter/git_sea.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/units.h"

namespace sigmascape::scatter {
namespace {

constexpr double greatest_grazing_rad = radians_from_deg(10.0);

double risen_sea_wind_mps(double sea_state) {
  return 3.16 * std::pow(sea_state, 0.8);
}

double mean_wave_height_m(double sea_state) {
  return 0.00452 * std::pow(risen_sea_wind_mps(sea_state), 2.5);
}

/// The cancellation of direct waves by those that the sea reflects, complete at grazing.
double interference(double wavelength, double grazing_rad, double wave_height_m) {
  const double roughness = (14.4 * wavelength + 5.5) * grazing_rad * wave_height_m / wavelength;
  const double fourth = std::pow(roughness, 4);
  return fourth / (1.0 + fourth);
}

double upwind(double wavelength, double grazing_rad, double wind_angle_rad) {
  return std::exp(0.2 * std::cos(wind_angle_rad) * (1.0 - 2.8 * grazing_rad) * std::pow(wavelength + 0.015, -0.4));
}

double wind(double wavelength, double wind_speed_mps) {
  return std::pow(1.94 * wind_speed_mps / (1.0 + wind_speed_mps / 15.4), 1.1 * std::pow(wavelength + 0.015, -0.4));
}

double vertical_over_horizontal(double frequency_hz, double grazing_rad, double wave_height_m) {
  const double height = wave_height_m + 0.015;
  const double grazing = grazing_rad + 1e-4;
  const double wavelength = wavelength_m(frequency_hz);
  return frequency_hz < 3e9 ? 166.0 * std::pow(height, -0.4) * std::pow(wavelength, 0.87) * std::pow(grazing, 0.57)
                            : 9.33 * std::pow(height, -0.24) * std::pow(wavelength, 0.25) * std::pow(grazing, 0.29);
}

}  // namespace

Sigma0 git_sea_sigma0(const GitSeaParameters& parameters, double frequency_hz, double grazing_rad) {
  const double fitted = std::min(grazing_rad, greatest_grazing_rad);
  const double continued = std::sin(grazing_rad) / std::sin(fitted);
  const double wavelength = wavelength_m(frequency_hz);
  const double wave_height_m = mean_wave_height_m(parameters.sea_state);
  const double wind_speed_mps =
      parameters.wind_speed_mps > 0.0 ? parameters.wind_speed_mps : risen_sea_wind_mps(parameters.sea_state);
  const double hh = continued * 3.9e-6 * wavelength * std::pow(fitted, 0.4) *
                    interference(wavelength, fitted, wave_height_m) *
                    upwind(wavelength, fitted, parameters.wind_angle_rad) * wind(wavelength, wind_speed_mps);
  const double vv = hh * vertical_over_horizontal(frequency_hz, fitted, wave_height_m);
  return {vv, hh, parameters.depolarization.cross_ratio * std::sqrt(vv * hh)};
}

ReciprocalBackscatter git_sea(const GitSeaParameters& parameters, double frequency_hz) {
  return {[&](double cos_incidence) { return git_sea_sigma0(parameters, frequency_hz, std::asin(cos_incidence)); },
          parameters.depolarization};
}

}  // namespace sigmascape::scatter
