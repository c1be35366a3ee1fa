#include "sigmascape/dataset/speckle.h"

#include <cmath>
#include <gtest/gtest.h>

namespace sigmascape::dataset {
namespace {

struct Moments {
  double mean = 0.0, variance = 0.0;
};

Moments moments_of(float power, float noise, std::size_t looks) {
  const std::size_t side = 256;
  radar::GroundMap map{.grid = {0.0, 0.0, 1.0, side, side},
                       .sigma0 = Array2D<radar::Channels>(side, side, {power, power, power, 0.0F}),
                       .crs = {},
                       .metadata = {}};
  draw_speckle(map, {}, {.looks = looks, .noise = noise, .seed = 3});
  Moments moments;
  for (const radar::Channels& cell : map.sigma0.values()) moments.mean += static_cast<double>(cell.vv) / (side * side);
  for (const radar::Channels& cell : map.sigma0.values())
    moments.variance += std::pow(static_cast<double>(cell.vv) - moments.mean, 2) / (side * side);
  return moments;
}

// Of power P, noise N and L looks: mean P + N, variance (P + N)² / L. The mean of 65,536 cells is good to 0.4 %, their
// variance to about 1 %.
TEST(Speckle, HasTheMeanAndVarianceOfItsLooks) {
  for (const std::size_t looks : {1, 4}) {
    const Moments moments = moments_of(2.0F, 0.5F, looks);
    EXPECT_NEAR(moments.mean, 2.5, 0.04);
    EXPECT_NEAR(moments.variance, 2.5 * 2.5 / static_cast<double>(looks), 0.3 / static_cast<double>(looks));
  }
}

// A steady amplitude √P in noise N: mean P + N, variance N² + 2PN (Rice).
TEST(Speckle, WithoutLooksIsNoiseAboutASteadyEcho) {
  const Moments moments = moments_of(2.0F, 0.5F, 0);
  EXPECT_NEAR(moments.mean, 2.5, 0.03);
  EXPECT_NEAR(moments.variance, 0.25 + 2.0, 0.08);
  EXPECT_EQ(moments_of(2.0F, 0.0F, 0).variance, 0.0);
}

// Mean N in VV, HH, HV and VH each: 4N in their sum. Exponential in each, so that the mean of 65,536 cells of the sum
// is good to 0.3 %.
TEST(Speckle, NoiseAloneIsWhatItIsSaidToBeInEveryPolarization) {
  const std::size_t side = 256;
  const float noise = 0.01F;
  radar::GroundMap map{
      .grid = {0.0, 0.0, 1.0, side, side}, .sigma0 = Array2D<radar::Channels>(side, side), .crs = {}, .metadata = {}};
  draw_speckle(map, {}, {.looks = 1, .noise = noise, .seed = 3});
  using enum radar::Polarization;
  for (const radar::Polarization polarization : {VV, HH, HV, Sum}) {
    double mean = 0.0;
    for (const radar::Channels& cell : map.sigma0.values())
      mean += static_cast<double>(cell.power(polarization)) / (side * side);
    EXPECT_NEAR(mean / static_cast<double>(even_noise(noise).power(polarization)), 1.0, 0.02);
  }
  EXPECT_FLOAT_EQ(even_noise(noise).power(Sum), 4.0F * noise);
}

// Where a target stands on ground and nothing is drawn, powers add: amplitudes would give (√2 + √8)² = 18.
TEST(Speckle, WithoutLooksAddsTheTargetsPowerToTheGrounds) {
  const radar::Channels ground{2.0F, 1.0F, 0.5F, 0.25F}, target{8.0F, 4.0F, 0.0F, -1.0F};
  radar::GroundMap map{
      .grid = {0.0, 0.0, 1.0, 1, 1}, .sigma0 = Array2D<radar::Channels>(1, 1, ground), .crs = {}, .metadata = {}};
  draw_speckle(map, Array2D<radar::Channels>(1, 1, target), {.looks = 0, .noise = 0.0F, .seed = 3});
  EXPECT_FLOAT_EQ(map.sigma0(0, 0).vv, 10.0F);
  EXPECT_FLOAT_EQ(map.sigma0(0, 0).hh, 5.0F);
  EXPECT_FLOAT_EQ(map.sigma0(0, 0).hv, 0.5F);
}

}  // namespace
}  // namespace sigmascape::dataset
