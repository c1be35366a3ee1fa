#include "sigmascape/bake/error_target.h"

#include <gtest/gtest.h>

namespace sigmascape::bake {
namespace {

// 10^0.04 = 1.0965: a target of 0.4 dB is a relative error of 0.0965.
TEST(ErrorTarget, CountsTexelsThatReturnAnything) {
  BakedLook look;
  look.sigma0 = Array2D<radar::Channels>(2, 2);
  look.relative_errors = Array2D<float>(2, 2, 0.0966F);
  const Sampling sampling{.target_db = 0.4};
  EXPECT_EQ(texels_above_target(look, sampling)->lit, 0U);
  look.sigma0(0, 0) = look.sigma0(1, 0) = look.sigma0(0, 1) = {.vv = 1.0F, .hh = 1.0F};
  look.relative_errors(1, 0) = 0.0964F;
  EXPECT_EQ(texels_above_target(look, sampling)->lit, 3U);
  EXPECT_EQ(texels_above_target(look, sampling)->above, 2U);
  EXPECT_EQ(texels_above_target(look, {.target_db = 0.5})->above, 0U);
}

TEST(ErrorTarget, IsNoneOfABakeWithTheSameRaysEverywhere) {
  BakedLook look;
  look.sigma0 = Array2D<radar::Channels>(1, 1, {.vv = 1.0F});
  look.relative_errors = Array2D<float>(1, 1, 1.0F);
  EXPECT_FALSE(texels_above_target(look, {.samples_per_texel = 100}));
}

}  // namespace
}  // namespace sigmascape::bake
