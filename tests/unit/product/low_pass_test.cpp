#include "sigmascape/product/low_pass.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>

#include "sigmascape/base/hash.h"

namespace sigmascape::product {
namespace {

constexpr double unseen = std::numeric_limits<double>::quiet_NaN();

double seen_total(const Array2D<double>& power) {
  return std::accumulate(power.values().begin(), power.values().end(), 0.0,
                         [](double sum, double p) { return std::isnan(p) ? sum : sum + p; });
}

Array2D<double> rough_map_with_holes() {
  Array2D<double> power(37, 23);
  for (std::size_t i = 0; i < power.size(); ++i) {
    const bool hole = hashed(i, 1) % 7 == 0;
    power.values()[i] = hole ? unseen : std::exp(8.0 * static_cast<double>(unit_float(hashed(i, 2))));
  }
  return power;
}

TEST(LowPass, KeepsTheTotalPowerAlsoBesideEdgesAndHoles) {
  const Array2D<double> power = rough_map_with_holes();
  for (const double width : {0.5, 1.0, 3.0}) {
    EXPECT_NEAR(seen_total(low_pass(power, width)) / seen_total(power), 1.0, 1e-12) << width;
  }
}

TEST(LowPass, KeepsAConstantMapConstant) {
  Array2D<double> power(20, 20, 0.3);
  power(4, 4) = power(5, 4) = unseen;
  const Array2D<double> smooth = low_pass(power, 1.5);
  for (std::size_t i = 0; i < power.size(); ++i) {
    if (std::isnan(power.values()[i])) continue;
    EXPECT_NEAR(smooth.values()[i], 0.3, 1e-12);
  }
}

TEST(LowPass, UnseenCellsStayUnseenAndSpreadNothing) {
  const Array2D<double> power = rough_map_with_holes();
  const Array2D<double> smooth = low_pass(power, 1.0);
  for (std::size_t i = 0; i < power.size(); ++i) {
    EXPECT_EQ(std::isnan(power.values()[i]), std::isnan(smooth.values()[i]));
  }
}

TEST(LowPass, APointBecomesAGaussianOfTheStatedWidth) {
  Array2D<double> power(41, 41, 0.0);
  power(20, 20) = 1.0;
  const Array2D<double> smooth = low_pass(power, 2.0);
  EXPECT_NEAR(smooth(22, 20) / smooth(20, 20), std::exp(-0.5), 1e-12);
  EXPECT_NEAR(smooth(20, 18) / smooth(20, 20), std::exp(-0.5), 1e-12);
  EXPECT_NEAR(smooth(23, 24) / smooth(20, 20), std::exp(-25.0 / 8.0), 1e-12);
  EXPECT_EQ(smooth(27, 20), 0.0);
}

TEST(LowPass, ZeroWidthChangesNothing) {
  Array2D<double> power(5, 5, 1.0);
  power(2, 2) = 100.0;
  EXPECT_EQ(low_pass(power, 0.0)(2, 2), 100.0);
}

}  // namespace
}  // namespace sigmascape::product
