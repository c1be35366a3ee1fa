#include "sigmascape/scatter/ulaby_dobson_table.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/units.h"

namespace sigmascape::scatter {

double UlabyDobsonRow::sigma0_db(double incidence_rad) const {
  const auto& [p1, p2, p3, p4, p5, p6] = p;
  return p1 + p2 * std::exp(-p3 * incidence_rad) + p4 * std::cos(p5 * incidence_rad + p6);
}

double UlabyDobsonRow::sigma0(double incidence_rad) const {
  const double least = radians_from_deg(least_incidence_deg);
  const double greatest = radians_from_deg(greatest_incidence_deg);
  const double inside = linear_from_db(sigma0_db(std::clamp(incidence_rad, least, greatest)));
  return incidence_rad <= greatest ? inside : inside * std::cos(incidence_rad) / std::cos(greatest);
}

const std::vector<UlabyDobsonRow>& ulaby_dobson_table() {
  using Class = TerrainClass;
  using Band = UlabyDobsonBand;
  using Channel = UlabyDobsonChannel;
  static const std::vector<UlabyDobsonRow> rows{
      {Class::Soil, Band::L, Channel::HH, {2442.0, -3.771, -2.193, -2442.0, 0.1711, -0.07967}, 0.0, 60.0, true},
      {Class::Soil, Band::L, Channel::HV, {-30.2, 15.261, 3.56, -0.424, 0.0, 0.0}, 0.0, 60.0, true},
      {Class::Soil, Band::L, Channel::VV, {-94.36, 99.0, 0.365, -3.398, 5.0, -1.739}, 0.0, 60.0, true},
      {Class::Soil, Band::S, Channel::HH, {-91.2, 99.0, 0.433, 5.063, 2.941, -3.142}, 0.0, 60.0, true},
      {Class::Soil, Band::S, Channel::HV, {-46.467, 31.788, 2.189, -17.99, 1.34, 1.583}, 0.0, 60.0, true},
      {Class::Soil, Band::S, Channel::VV, {-97.016, 99.0, 0.27, -2.056, 5.0, -1.754}, 0.0, 60.0, true},
      {Class::Soil, Band::C, Channel::HH, {-24.855, 26.351, 1.146, 0.204, 0.0, 0.0}, 0.0, 70.0, true},
      {Class::Soil, Band::C, Channel::HV, {-26.7, 15.055, 1.816, -0.499, 0.0, 0.0}, 0.0, 70.0, true},
      {Class::Soil, Band::C, Channel::VV, {-24.951, 28.742, 1.043, -1.681, 0.0, 0.0}, 0.0, 70.0, true},
      {Class::Grass, Band::L, Channel::HH, {-29.325, 37.55, 2.332, -2.615, 5.0, -1.616}, 0.0, 70.0, true},
      {Class::Grass, Band::L, Channel::HV, {-40.166, 26.833, 2.029, -1.473, 3.738, -1.324}, 0.0, 70.0, true},
      {Class::Grass, Band::L, Channel::VV, {-28.022, 36.59, 2.53, -1.53, 5.0, -1.513}, 0.0, 70.0, true},
      {Class::Grass, Band::S, Channel::HH, {-20.361, 25.727, 2.979, -1.13, 5.0, -1.916}, 0.0, 70.0, true},
      {Class::Grass, Band::S, Channel::HV, {-29.035, 18.055, 2.8, -1.556, 4.554, -0.464}, 0.0, 70.0, true},
      {Class::Grass, Band::S, Channel::VV, {-21.198, 26.694, 2.828, -0.612, 5.0, -2.079}, 0.0, 70.0, true},
      {Class::Grass, Band::C, Channel::HH, {-15.75, 17.931, 2.369, -1.502, 4.592, -3.142}, 0.0, 70.0, true},
      {Class::Grass, Band::C, Channel::HV, {-23.109, 13.591, 1.508, -0.757, 4.491, -3.142}, 0.0, 70.0, true},
      {Class::Grass, Band::C, Channel::VV, {-93.606, 99.0, 0.22, -5.509, -2.964, 1.287}, 0.0, 70.0, true},
      {Class::ShortVegetation, Band::L, Channel::HH, {-27.265, 32.39, 2.133, 1.438, -3.847, 3.142}, 0.0, 70.0, true},
      {Class::ShortVegetation, Band::L, Channel::HV, {-41.6, 22.872, 0.689, -1.238, 0.0, 0.0}, 0.0, 70.0, true},
      {Class::ShortVegetation, Band::L, Channel::VV, {-24.614, 27.398, 2.265, -1.08, 5.0, -1.999}, 0.0, 70.0, true},
      {Class::ShortVegetation, Band::S, Channel::HH, {-20.779, 21.867, 2.434, 0.347, -0.013, -0.393}, 0.0, 70.0, true},
      {Class::ShortVegetation, Band::S, Channel::HV, {-99.0, 85.852, 0.179, 3.687, 2.121, -3.142}, 0.0, 70.0, true},
      {Class::ShortVegetation, Band::S, Channel::VV, {-20.367, 21.499, 2.151, -1.069, 5.0, -1.95}, 0.0, 70.0, true},
      {Class::ShortVegetation, Band::C, Channel::HH, {-87.727, 99.0, 0.322, 10.188, -1.747, 3.143}, 0.0, 70.0, true},
      {Class::ShortVegetation, Band::C, Channel::HV, {-99.0, 93.293, 0.181, 5.359, 1.948, -3.142}, 0.0, 70.0, true},
      {Class::ShortVegetation, Band::C, Channel::VV, {-88.593, 99.0, 0.326, 9.574, 1.969, -3.142}, 0.0, 70.0, true},
      {Class::Shrubs, Band::L, Channel::HH, {-26.688, 29.454, 1.814, 0.873, 4.135, -3.142}, 0.0, 70.0, true},
      {Class::Shrubs, Band::L, Channel::HV, {-99.0, 99.0, 0.086, -21.298, 0.0, 0.0}, 0.0, 70.0, true},
      {Class::Shrubs, Band::L, Channel::VV, {-81.371, 99.0, 0.567, 16.2, -1.948, 3.142}, 0.0, 70.0, true},
      {Class::Shrubs, Band::C, Channel::HH, {-91.95, 99.0, 0.27, 6.98, 1.922, -3.142}, 0.0, 70.0, true},
      {Class::Shrubs, Band::C, Channel::HV, {-99.0, 91.003, 0.156, 3.948, 2.239, -3.142}, 0.0, 70.0, true},
      {Class::Shrubs, Band::C, Channel::VV, {-91.133, 99.0, 0.294, 8.107, 2.112, -3.142}, 0.0, 70.0, true},
      {Class::DrySnow, Band::L, Channel::HH, {-74.019, 99.0, 1.592, -30.0, 1.928, 0.905}, 0.0, 70.0, true},
      {Class::DrySnow, Band::L, Channel::HV, {-91.341, 99.0, 1.202, 30.0, 1.79, -2.304}, 0.0, 70.0, true},
      {Class::DrySnow, Band::L, Channel::VV, {-77.032, 99.0, 1.415, -30.0, 1.72, 0.997}, 0.0, 70.0, true},
      {Class::DrySnow, Band::S, Channel::HH, {-47.055, 30.164, 5.788, 30.0, 1.188, -0.629}, 0.0, 70.0, true},
      {Class::DrySnow, Band::S, Channel::HV, {-54.29, 13.292, 10.0, -30.0, -0.715, 3.142}, 0.0, 70.0, true},
      {Class::DrySnow, Band::S, Channel::VV, {-40.652, 18.826, 9.211, 30.0, 0.69, 0.214}, 0.0, 70.0, true},
      {Class::DrySnow, Band::C, Channel::HH, {-42.864, 20.762, 10.0, 30.0, 0.763, -0.147}, 0.0, 70.0, true},
      {Class::DrySnow, Band::C, Channel::HV, {-25.543, 16.64, 10.0, -2.959, 3.116, 2.085}, 0.0, 70.0, true},
      {Class::DrySnow, Band::C, Channel::VV, {-19.765, 19.83, 10.0, 7.089, 1.54, -0.012}, 0.0, 70.0, true},
      {Class::WetSnow, Band::L, Channel::HH, {-73.069, 95.221, 1.548, 30.0, 1.795, -2.126}, 0.0, 70.0, true},
      {Class::WetSnow, Band::L, Channel::HV, {-90.98, 99.0, 1.129, 30.0, 1.827, -2.308}, 0.0, 70.0, true},
      {Class::WetSnow, Band::L, Channel::VV, {-75.156, 99.0, 1.446, 30.0, 1.793, -2.179}, 0.0, 70.0, true},
      {Class::WetSnow, Band::S, Channel::HH, {-45.772, 25.16, 5.942, 30.0, 0.929, -0.284}, 0.0, 70.0, true},
      {Class::WetSnow, Band::S, Channel::HV, {-42.94, 9.935, 15.0, 30.0, 0.438, 0.712}, 0.0, 70.0, true},
      {Class::WetSnow, Band::S, Channel::VV, {-39.328, 18.594, 8.046, 30.0, 0.666, 0.269}, 0.0, 70.0, true},
      {Class::WetSnow, Band::C, Channel::HH, {-31.91, 17.749, 11.854, 30.0, 0.421, 0.74}, 0.0, 70.0, true},
      {Class::WetSnow, Band::C, Channel::HV, {-24.622, 15.102, 15.0, -3.401, 2.431, 3.142}, 0.0, 70.0, true},
      {Class::WetSnow, Band::C, Channel::VV, {4.288, 15.642, 15.0, 30.0, 0.535, 1.994}, 0.0, 70.0, true},
      {Class::Soil, Band::X, Channel::HH, {4.337, 6.666, -0.107, -29.709, 0.863, -1.365}, 0.0, 70.0, false},
      {Class::Soil, Band::X, Channel::HV, {-99.0, 96.734, 0.304, 6.78, -2.506, 3.142}, 0.0, 70.0, false},
      {Class::Soil, Band::X, Channel::VV, {-42.553, 48.823, 0.722, 5.808, 3.0, -3.142}, 0.0, 70.0, false},
      {Class::Soil, Band::Ku, Channel::HH, {-95.843, 94.457, 0.144, -2.351, -3.556, 2.08}, 0.0, 70.0, false},
      {Class::Soil, Band::Ku, Channel::VV, {-98.32, 99.0, 0.129, -0.791, 5.0, -3.142}, 0.0, 70.0, false},
      {Class::Trees, Band::X, Channel::HH, {-12.078, 0.0, -10.0, 4.574, 1.171, 0.583}, 0.0, 70.0, false},
      {Class::Trees, Band::X, Channel::VV, {-11.751, 0.0, 2.0, 3.596, 2.033, 0.122}, 0.0, 70.0, false},
      {Class::Grass, Band::X, Channel::HH, {-33.288, 32.98, 0.51, -1.343, 4.874, -3.142}, 0.0, 70.0, false},
      {Class::Grass, Band::X, Channel::HV, {-48.245, 47.246, 10.0, -30.0, -0.19, 3.142}, 20.0, 70.0, false},
      {Class::Grass, Band::X, Channel::VV, {-22.177, 21.891, 1.054, -1.916, 4.555, -2.866}, 0.0, 70.0, false},
      {Class::Grass, Band::Ku, Channel::HH, {-88.494, 99.0, 0.246, 10.297, -1.36, 3.142}, 0.0, 70.0, false},
      {Class::Grass, Band::Ku, Channel::VV, {-16.263, 16.074, 1.873, 1.296, 5.0, -0.695}, 0.0, 70.0, false},
      {Class::Grass, Band::Ka, Channel::HH, {-99.0, 92.382, 0.038, 1.169, 5.0, -1.906}, 0.0, 70.0, false},
      {Class::Grass, Band::Ka, Channel::VV, {-99.0, 91.853, 0.038, 1.1, 5.0, -2.05}, 0.0, 70.0, false},
      {Class::Shrubs, Band::S, Channel::HH, {-21.202, 21.177, 2.058, -0.132, -5.0, -3.142}, 0.0, 70.0, false},
      {Class::Shrubs, Band::S, Channel::HV, {-89.222, 44.939, 0.253, 30.0, -0.355, 0.526}, 0.0, 70.0, false},
      {Class::Shrubs, Band::S, Channel::VV, {-20.566, 20.079, 1.776, -1.332, 5.0, -1.983}, 0.0, 70.0, false},
      {Class::Shrubs, Band::X, Channel::HH, {-99.0, 97.28, 0.107, -0.538, 5.0, -2.688}, 0.0, 70.0, false},
      {Class::Shrubs, Band::X, Channel::VV, {-99.0, 97.682, 0.113, -0.779, 5.0, -2.076}, 0.0, 70.0, false},
      {Class::Shrubs, Band::Ku, Channel::HH, {-99.0, 98.254, 0.098, -0.71, 5.0, -2.225}, 0.0, 70.0, false},
      {Class::Shrubs, Band::Ku, Channel::VV, {-99.0, 98.741, 0.103, -0.579, 5.0, -2.21}, 0.0, 70.0, false},
      {Class::ShortVegetation, Band::X, Channel::HH, {-99.0, 97.417, 0.114, -0.837, 5.0, -2.984}, 0.0, 70.0, false},
      {Class::ShortVegetation, Band::X, Channel::HV, {-16.716, 10.247, 10.0, -1.045, 5.0, -0.159}, 0.0, 70.0, false},
      {Class::ShortVegetation, Band::X, Channel::VV, {-99.0, 97.37, 0.119, -1.171, 5.0, -2.728}, 0.0, 70.0, false},
      {Class::ShortVegetation, Band::Ku, Channel::HH, {-99.0, 97.863, 0.105, -0.893, 5.0, -2.657}, 0.0, 70.0, false},
      {Class::ShortVegetation, Band::Ku, Channel::HV, {-14.234, 3.468, 10.0, -1.552, 5.0, -0.562}, 0.0, 70.0, false},
      {Class::ShortVegetation, Band::Ku, Channel::VV, {-99.0, 97.788, 0.105, -1.017, 5.0, -3.142}, 0.0, 70.0, false},
      {Class::ShortVegetation, Band::Ka, Channel::HH, {-99.0, 79.05, 0.263, -30.0, 0.73, 2.059}, 0.0, 70.0, false},
      {Class::ShortVegetation, Band::Ka, Channel::VV, {-99.0, 80.325, 0.282, -30.0, 0.833, 1.97}, 0.0, 70.0, false},
      {Class::DrySnow, Band::X, Channel::HH, {-13.298, 20.048, 10.0, 4.529, 2.927, -1.173}, 0.0, 70.0, false},
      {Class::DrySnow, Band::X, Channel::HV, {-18.315, 99.0, 10.0, 4.463, 3.956, -2.128}, 20.0, 70.0, false},
      {Class::DrySnow, Band::X, Channel::VV, {-11.46, 17.514, 10.0, 4.891, 3.135, -0.888}, 0.0, 70.0, false},
      {Class::DrySnow, Band::Ku, Channel::HH, {-36.188, 15.34, 10.0, 30.0, 0.716, -0.186}, 0.0, 70.0, false},
      {Class::DrySnow, Band::Ku, Channel::HV, {-16.794, 20.584, 3.263, -2.243, 5.0, 0.096}, 0.0, 70.0, false},
      {Class::DrySnow, Band::Ku, Channel::VV, {-10.038, 13.975, 10.0, -6.197, 1.513, 3.142}, 0.0, 70.0, false},
      {Class::WetSnow, Band::X, Channel::HH, {10.02, 7.909, 15.0, 30.0, 0.828, 2.073}, 0.0, 70.0, false},
      {Class::WetSnow, Band::X, Channel::HV, {4.495, 10.451, 15.0, -30.0, -0.746, 1.083}, 0.0, 70.0, false},
      {Class::WetSnow, Band::X, Channel::VV, {10.952, 6.473, 15.0, 30.0, 0.777, 2.081}, 0.0, 70.0, false},
  };
  return rows;
}

}  // namespace sigmascape::scatter
