#include "sigmascape/base/elementary.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "keep_worst.h"

namespace sigmascape {
namespace {

constexpr int steps = 200'000;

/// The greatest of error(t) for t in (0, 1).
template <typename Error>
double greatest(const Error& error) {
  double worst = 0.0;
  for (int i = 0; i < steps; ++i) keep_worst(worst, error((i + 0.5) / steps));
  return worst;
}

TEST(Elementary, ExponentialAgreesWithTheLibrarys) {
  EXPECT_LT(greatest([](double t) {
              const auto x = static_cast<float>(-80.0 + 160.0 * t);
              return std::abs(static_cast<double>(fast_exp(x)) / std::exp(static_cast<double>(x)) - 1.0);
            }),
            1.5e-7);
  EXPECT_EQ(fast_exp(0.0F), 1.0F);
  EXPECT_EQ(fast_exp(-88.0F), 0.0F);
  EXPECT_EQ(fast_exp(-1e30F), 0.0F);
  EXPECT_EQ(fast_exp(1e30F), fast_exp(87.0F));
}

TEST(Elementary, LogarithmAgreesWithTheLibrarys) {
  for (const auto& [low, high] : {std::pair(-80.0, 80.0), std::pair(-0.5, 0.5)}) {
    EXPECT_LT(greatest([&](double t) {
                const auto x = static_cast<float>(std::exp(low + (high - low) * t));
                const double exact = std::log(static_cast<double>(x));
                return std::abs(static_cast<double>(fast_log(x)) - exact) / std::max(std::abs(exact), 1e-3);
              }),
              2e-7);
  }
  EXPECT_EQ(fast_log(1.0F), 0.0F);
}

TEST(Elementary, PhasorGoesRoundTheCircle) {
  EXPECT_LT(greatest([](double t) {
              const auto turns = static_cast<float>(3.0 * t);
              const Vec2f phasor = fast_phasor(turns);
              const double angle = 2.0 * std::numbers::pi * static_cast<double>(turns);
              return std::hypot(static_cast<double>(phasor.x) - std::cos(angle),
                                static_cast<double>(phasor.y) - std::sin(angle));
            }),
            2e-7);
  EXPECT_EQ(fast_phasor(0.0F), (Vec2f{1.0F, 0.0F}));
}

TEST(Elementary, AngleIsThatOfTheHalfCircle) {
  EXPECT_LT(greatest([](double t) {
              const double angle = std::numbers::pi * t, length = std::exp(20.0 * t - 10.0);
              const auto x = static_cast<float>(length * std::cos(angle)),
                         y = static_cast<float>(length * std::sin(angle));
              return std::abs(static_cast<double>(fast_angle(x, y)) -
                              std::atan2(static_cast<double>(y), static_cast<double>(x)));
            }),
            4e-7);
  EXPECT_EQ(fast_angle(1.0F, 0.0F), 0.0F);
  EXPECT_FLOAT_EQ(fast_angle(-1.0F, 0.0F), std::numbers::pi_v<float>);
}

TEST(Elementary, ScaledErrorFunctionKeepsItsDigitsInTheTail) {
  EXPECT_LT(greatest([](double t) {
              const auto x = static_cast<float>(4.2 * t);
              const auto exact =
                  std::erfc(static_cast<double>(x)) * std::exp(static_cast<double>(x) * static_cast<double>(x));
              return std::abs(static_cast<double>(fast_erfcx(x)) / exact - 1.0);
            }),
            4e-7);
}

}  // namespace
}  // namespace sigmascape
