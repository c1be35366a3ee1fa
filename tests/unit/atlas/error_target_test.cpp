#include "sigmascape/atlas/error_target.h"

#include <gtest/gtest.h>

namespace sigmascape::atlas {
namespace {

TEST(ErrorTarget, IsTheRelativeErrorOfSoManyDecibels) {
  AtlasDescription description;
  EXPECT_FALSE(error_target(description));
  description.settings[target_setting] = "0.4";
  EXPECT_NEAR(error_target(description).value(), 0.0965, 1e-4);
  for (const char* words : {"", "none", "0.4 dB"}) {
    description.settings[target_setting] = words;
    EXPECT_FALSE(error_target(description)) << words;
  }
}

TEST(ErrorTarget, CountsTexelsThatReturnAnything) {
  Array2D<float> errors(2, 2, 0.2F);
  Array2D<radar::Channels> texels(2, 2);
  EXPECT_EQ(texels_above(0.1, errors, texels).lit, 0U);
  texels(0, 0) = texels(1, 0) = texels(0, 1) = {.vv = 1.0F, .hh = 1.0F};
  errors(1, 0) = 0.05F;
  EXPECT_EQ(texels_above(0.1, errors, texels).lit, 3U);
  EXPECT_EQ(texels_above(0.1, errors, texels).above, 2U);
  EXPECT_EQ(texels_above(0.3, errors, texels).above, 0U);
}

}  // namespace
}  // namespace sigmascape::atlas
