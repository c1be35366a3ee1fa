#include "sigmascape/scatter/cmod5.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sigmascape/base/units.h"

namespace sigmascape::scatter {
namespace {

/// c₁ … c₂₈ of the report, from place 1 on.
constexpr std::array<double, 29> c{0.0,   -0.6880, -0.793, 0.338, -0.173, 0.0,   0.004, 0.111, 0.0162, 6.340,
                                   2.570, -2.180,  0.40,   -0.6,  0.045,  0.007, 0.330, 0.012, 22.0,   1.95,
                                   3.0,   8.390,   -3.440, 1.360, 5.350,  1.990, 0.29,  3.800, 1.530};

double logistic(double x) {
  return 1.0 / (1.0 + std::exp(-x));
}

/// The part that knows no wind direction.
double isotropic_part(double v, double x) {
  const double a0 = c[1] + c[2] * x + c[3] * x * x + c[4] * x * x * x;
  const double a1 = c[5] + c[6] * x, a2 = c[7] + c[8] * x;
  const double gamma = c[9] + c[10] * x + c[11] * x * x, s0 = c[12] + c[13] * x;
  const double s = a2 * v;
  double a3 = logistic(std::max(s, s0));
  if (s < s0) a3 *= std::pow(s / s0, s0 * (1.0 - logistic(s0)));
  return std::pow(a3, gamma) * std::pow(10.0, a0 + a1 * v);
}

/// How upwind differs from downwind.
double upwind_part(double v, double x) {
  const double rising = c[14] * (1.0 + x) - c[15] * v * (0.5 + x - std::tanh(4.0 * (x + c[16] + c[17] * v)));
  return rising / (1.0 + std::exp(0.34 * (v - c[18])));
}

/// How along the wind differs from across it.
double crosswind_part(double v, double x) {
  const double y0 = c[19], n = c[20];
  const double a = y0 - (y0 - 1.0) / n, b = 1.0 / (n * std::pow(y0 - 1.0, n - 1.0));
  const double v0 = c[21] + c[22] * x + c[23] * x * x;
  const double d1 = c[24] + c[25] * x + c[26] * x * x, d2 = c[27] + c[28] * x;
  double y = v / v0 + 1.0;
  if (y < y0) y = a + b * std::pow(y - 1.0, n);
  return (-d1 + d2 * y) * std::exp(-y);
}

}  // namespace

double cmod5_sigma0(double wind_speed_mps, double wind_azimuth_rad, double incidence_rad) {
  const double x = (deg_from_radians(incidence_rad) - 40.0) / 25.0;
  const double shape = 1.0 + upwind_part(wind_speed_mps, x) * std::cos(wind_azimuth_rad) +
                       crosswind_part(wind_speed_mps, x) * std::cos(2.0 * wind_azimuth_rad);
  return isotropic_part(wind_speed_mps, x) * std::pow(shape, 1.6);
}

}  // namespace sigmascape::scatter
