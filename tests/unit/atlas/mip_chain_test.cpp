#include "sigmascape/atlas/mip_chain.h"

#include <cmath>
#include <gtest/gtest.h>

#include "example_texels.h"

#include "sigmascape/atlas/half_texture.h"

namespace sigmascape::atlas {
namespace {

/// Sum of each channel times the area of a texel, with that of the finest level as one.
std::array<double, 4> power(const Array2D<radar::Channels>& texels, std::size_t level) {
  std::array<double, 4> total{};
  for (const radar::Channels& texel : texels.values()) {
    total[0] += static_cast<double>(texel.vv);
    total[1] += static_cast<double>(texel.hh);
    total[2] += static_cast<double>(texel.hv);
    total[3] += static_cast<double>(texel.re_vvhh);
  }
  for (double& channel : total) channel *= std::pow(4.0, static_cast<double>(level));
  return total;
}

TEST(MipChain, ATexelIsTheMeanOfTheFourItCovers) {
  Array2D<radar::Channels> fine(4, 2);
  fine(2, 0) = {1.0F, 10.0F, 0.0F, -1.0F};
  fine(3, 0) = {2.0F, 20.0F, 0.0F, -2.0F};
  fine(2, 1) = {3.0F, 30.0F, 4.0F, -3.0F};
  fine(3, 1) = {6.0F, 60.0F, 0.0F, 2.0F};
  const auto coarse = area_mean(fine);
  ASSERT_EQ(coarse.columns(), 2U);
  ASSERT_EQ(coarse.rows(), 1U);
  EXPECT_EQ(coarse(0, 0), radar::Channels{});
  EXPECT_EQ(coarse(1, 0), (radar::Channels{3.0F, 30.0F, 1.0F, -1.0F}));
}

TEST(MipChain, EndsAtTheSideAskedFor) {
  EXPECT_EQ(mip_chain(Array2D<radar::Channels>(1024, 1024), 256).size(), 3U);
  const MipChain whole = mip_chain(Array2D<radar::Channels>(256, 256), 1);
  EXPECT_EQ(whole.size(), 9U);
  EXPECT_EQ(whole.back().size(), 1U);
}

TEST(MipChain, EveryLevelKeepsThePower) {
  const MipChain chain = mip_chain(example_texels(512, 1), 1);
  const auto expected = power(chain.front(), 0);
  for (std::size_t level = 1; level < chain.size(); ++level) {
    const auto found = power(chain[level], level);
    for (std::size_t channel = 0; channel < 4; ++channel) {
      EXPECT_NEAR(found[channel] / expected[channel], 1.0, 1e-6) << level << " " << channel;
    }
  }
}

TEST(HalfTexture, EveryLevelKeepsThePowerThroughHalves) {
  const MipChain chain = mip_chain(example_texels(512, 1), 1);
  const auto expected = power(chain.front(), 0);
  const MipChain back = decoded(encoded(chain, fitting_scale(chain.front()), 10));
  for (std::size_t level = 0; level < back.size(); ++level) {
    const auto found = power(back[level], level);
    for (std::size_t channel = 0; channel < 4; ++channel) {
      EXPECT_NEAR(found[channel] / expected[channel], 1.0, 1e-3) << level << " " << channel;
    }
  }
}

TEST(HalfTexture, RoundingToFewBitsHasNoBias) {
  const MipChain chain{example_texels(512, 1)};
  const auto expected = power(chain.front(), 0);
  const auto found = power(decoded(encoded(chain, fitting_scale(chain.front()), 5)).front(), 0);
  EXPECT_NEAR(found[0] / expected[0], 1.0, 1e-3);
}

TEST(HalfTexture, TheBrightestDihedralFitsAndDarkWaterKeepsItsBits) {
  Array2D<radar::Channels> texels(256, 256);
  for (radar::Channels& texel : texels.values()) texel = {3.3e-4F, 2.2e-4F, 0.0F, 0.0F};
  texels(7, 9) = {1.6e7F, 1.6e7F, 0.0F, -1.6e7F};
  const Array2D<radar::Channels> bright = decoded(encoded({texels}, fitting_scale(texels), 10)).front();
  EXPECT_NEAR(bright(7, 9).vv / 1.6e7F, 1.0F, 1e-3F);
  EXPECT_NEAR(bright(7, 9).re_vvhh / -1.6e7F, 1.0F, 1e-3F);

  texels(7, 9) = {1.0F, 1.0F, 0.0F, -1.0F};
  const Array2D<radar::Channels> dark = decoded(encoded({texels}, fitting_scale(texels), 10)).front();
  EXPECT_NEAR(dark(0, 0).vv / 3.3e-4F, 1.0F, 5e-4F);
  EXPECT_NEAR(dark(0, 0).hh / 2.2e-4F, 1.0F, 5e-4F);
}

TEST(HalfTexture, TheScaleIsAPowerOfTwoAndTheBrightestTexelFits) {
  for (const float brightest : {1e-8F, 0.02F, 0.99999F, 1.0F, 3.0F, 65504.0F, 65535.9F, 1.6e7F}) {
    Array2D<radar::Channels> texels(2, 2);
    texels(1, 0).re_vvhh = -brightest;
    const double scale = fitting_scale(texels);
    int exponent = 0;
    EXPECT_EQ(std::frexp(scale, &exponent), 0.5) << brightest;
    EXPECT_LE(static_cast<double>(brightest) / scale, 32768.0) << brightest;
    EXPECT_GE(static_cast<double>(brightest) / scale, 16384.0) << brightest;
  }
  EXPECT_EQ(fitting_scale(Array2D<radar::Channels>(2, 2)), 1.0);
}

}  // namespace
}  // namespace sigmascape::atlas
