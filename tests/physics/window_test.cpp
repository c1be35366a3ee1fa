#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <vector>

#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/radar/antenna_pattern.h"
#include "sigmascape/radar/range_response.h"

namespace sigmascape::radar {
namespace {

constexpr const char* harris = "Harris, Proc. IEEE 66 (1978)";
const Window rectangular{.shape = WindowShape::Rectangular};
const Window hamming{.shape = WindowShape::Hamming};
const Window cosine{.shape = WindowShape::Cosine};

Window taylor(double side_lobe_db, int terms) {
  return {.shape = WindowShape::Taylor, .taylor_side_lobe = linear_from_db(side_lobe_db), .taylor_terms = terms};
}

void expect_side_lobe_db(const char* name, double expected_db, double power, double tolerance_db, const char* source) {
  validation::expect_close({.group = "Windows",
                            .name = name,
                            .expected = expected_db,
                            .measured = db_from_linear(power),
                            .tolerance = tolerance_db,
                            .unit = "dB",
                            .source = source});
}

void expect_width(const char* name, double expected, double measured) {
  validation::expect_close({.group = "Windows",
                            .name = name,
                            .expected = expected,
                            .measured = measured,
                            .tolerance = 0.02 * expected,
                            .unit = "1/B",
                            .source = harris});
}

TEST(Window, PeakSideLobesAreThePublishedOnes) {
  expect_side_lobe_db("peak side lobe, rectangular", -13.26, WindowResponse(rectangular).peak_side_lobe(), 0.1, "sinc");
  expect_side_lobe_db("peak side lobe, cosine", -23.0, WindowResponse(cosine).peak_side_lobe(), 0.1, harris);
  expect_side_lobe_db("peak side lobe, Hamming", -42.7, WindowResponse(hamming).peak_side_lobe(), 0.1, harris);
  expect_side_lobe_db("peak side lobe, Taylor −25 dB, n̄ 5", -25.0, WindowResponse(taylor(-25, 5)).peak_side_lobe(), 0.4,
                      "design");
  expect_side_lobe_db("peak side lobe, Taylor −35 dB, n̄ 5", -35.0, WindowResponse(taylor(-35, 5)).peak_side_lobe(), 0.4,
                      "design");
  expect_side_lobe_db("peak side lobe, Taylor −40 dB, n̄ 6", -40.0, WindowResponse(taylor(-40, 6)).peak_side_lobe(), 0.4,
                      "design");
}

// ∫ sinc² over the main lobe is 0.9028 (2 Si(2π)/π).
TEST(Window, IntegratedSideLobesOfTheRectangle) {
  expect_side_lobe_db("integrated side lobes, rectangular", db_from_linear(1.0 / 0.902823 - 1.0),
                      WindowResponse(rectangular).integrated_side_lobes(), 0.05, "2 Si(2π)/π");
}

// The response of so many weights, transformed, summed within its first zeros and beyond: no closed form of ours.
TEST(Window, IntegratedSideLobesAreThoseOfTheTransformedWeights) {
  constexpr std::size_t count = 400;
  const auto by_sum = [](const Window& window) {
    const auto weights = window_weights(window, count);
    const double null = WindowResponse(window).first_null(), step = 0.01;
    double within = 0.0, beyond = 0.0;
    for (double t = step / 2.0; t < count / 2.0; t += step) {
      double sum = 0.0;
      for (std::size_t k = 0; k < count / 2; ++k) {
        const double x = (static_cast<double>(k) + 0.5) / count - 0.5;
        sum += 2.0 * weights[k] * std::cos(2.0 * pi * x * t) / count;
      }
      (t < null ? within : beyond) += sum * sum;
    }
    return beyond / within;
  };
  struct Named {
    const char* name;
    Window window;
  };
  for (const auto& [name, window] :
       {Named{"integrated side lobes by sum, rectangular", rectangular},
        Named{"integrated side lobes by sum, cosine", cosine}, Named{"integrated side lobes by sum, Hamming", hamming},
        Named{"integrated side lobes by sum, Taylor −35 dB, n̄ 5", taylor(-35, 5)}}) {
    expect_side_lobe_db(name, db_from_linear(by_sum(window)), WindowResponse(window).integrated_side_lobes(), 0.1,
                        "transformed weights");
  }
}

TEST(Window, HalfPowerWidthsAreThePublishedOnes) {
  expect_width("half-power width, rectangular", 0.89, WindowResponse(rectangular).half_power_width());
  expect_width("half-power width, cosine", 1.20, WindowResponse(cosine).half_power_width());
  expect_width("half-power width, Hamming", 1.30, WindowResponse(hamming).half_power_width());
}

TEST(Window, NoiseBandwidthsAreThePublishedOnes) {
  EXPECT_NEAR(WindowResponse(rectangular).noise_bandwidth(), 1.0, 1e-12);
  EXPECT_NEAR(WindowResponse(cosine).noise_bandwidth(), 1.23, 0.01);
  EXPECT_NEAR(WindowResponse(hamming).noise_bandwidth(), 1.36, 0.01);
}

// The weights, transformed sample by sample, are the closed form of the response.
TEST(Window, WeightsAndResponseAreATransformPair) {
  constexpr std::size_t count = 2000;
  for (const Window& window : {rectangular, cosine, hamming, taylor(-35, 5), taylor(-40, 6)}) {
    const auto weights = window_weights(window, count);
    const WindowResponse response(window);
    for (double t = 0.0; t < 12.0; t += 0.173) {
      std::complex<double> sum;
      for (std::size_t k = 0; k < count; ++k) {
        const double x = (static_cast<double>(k) + 0.5) / count - 0.5;
        sum += weights[k] * std::polar(1.0 / count, 2.0 * pi * x * t);
      }
      EXPECT_NEAR(sum.real(), response.voltage(t), 1e-4) << t;
      EXPECT_NEAR(sum.imag(), 0.0, 1e-9) << t;
    }
  }
}

TEST(Window, TaylorsSideLobesStayWithinTwoDecibelsBelowTheDesign) {
  const WindowResponse response(taylor(-30, 6));
  for (int lobe = 1; lobe < 5; ++lobe) {
    double peak = 0.0;
    for (double t = response.first_null() + lobe - 1.0; t < response.first_null() + lobe + 0.2; t += 1e-3)
      peak = std::max(peak, response.power(t));
    EXPECT_LT(db_from_linear(peak), -30.0) << lobe;
    EXPECT_GT(db_from_linear(peak), -32.0) << lobe;
  }
}

TEST(RangeResponse, BandwidthGivesTheResolution) {
  EXPECT_NEAR(range_resolution_of(150e6, rectangular), 0.8859 * speed_of_light_mps / 300e6, 1e-4);
  for (const Window& window : {rectangular, hamming, taylor(-35, 5)}) {
    const auto pulse = RangeResponse::of_width(3.0, window);
    EXPECT_NEAR(pulse.power(1.5), 0.5, 1e-9);
    EXPECT_NEAR(pulse.half_power_width_m(), 3.0, 1e-9);
    EXPECT_NEAR(range_resolution_of(pulse.bandwidth_hz(), window), 3.0, 1e-9);
  }
}

// A uniform aperture of length D: θ = 0.886 λ/D, first side lobe −13.26 dB one way and −26.5 dB two ways.
TEST(AntennaCut, UniformApertureHasSincSideLobes) {
  const AntennaCut cut(ApertureBeam{rectangular}, 0.01);
  double one_way = 0.0, two_way = 0.0;
  for (double offset = 0.0115; offset < 0.1; offset += 1e-5) {
    one_way = std::max(one_way, cut.power(offset));
    two_way = std::max(two_way, cut.two_way_power(offset));
  }
  expect_side_lobe_db("uniform aperture, one way", -13.26, one_way, 0.1, "sinc");
  expect_side_lobe_db("uniform aperture, two ways", -26.52, two_way, 0.2, "sinc⁴");
}

}  // namespace
}  // namespace sigmascape::radar
