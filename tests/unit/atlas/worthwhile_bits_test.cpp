#include "sigmascape/atlas/worthwhile_bits.h"

#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/atlas/half_texture.h"

namespace sigmascape::atlas {
namespace {

// Half of the last bit of 1.…, 2^-(b + 1), is an eighth of the error at most, and with one bit less it would not be.
TEST(WorthwhileBits, KeepRoundingWithinAnEighthOfTheError) {
  for (const double error : {0.3, 0.1, 0.05, 0.02}) {
    const int bits = worthwhile_bits(error, 10);
    EXPECT_LE(std::exp2(-(bits + 1)), error / 8.0) << error;
    EXPECT_GT(std::exp2(-bits), error / 8.0) << error;
  }
}

TEST(WorthwhileBits, AreAtLeastOneAndAtMostSoMany) {
  EXPECT_EQ(worthwhile_bits(50.0, 10), 1);
  EXPECT_EQ(worthwhile_bits(1e-5, 10), 10);
  EXPECT_EQ(worthwhile_bits(1e-5, 6), 6);
  EXPECT_EQ(worthwhile_bits(0.0, 10), 10) << "what has no error keeps everything";
}

// Four texels of 0.4 each have a mean of 0.2: one bit more at every level.
TEST(WorthwhileBits, MeansHaveMore) {
  const MipChain chain = mip_chain(Array2D<radar::Channels>(8, 8, {1.0F, 0.0F, 0.0F, 0.0F}), 2);
  const BitsOfTexels bits = worthwhile_bits(chain, Array2D<float>(8, 8, 0.4F), 10);
  ASSERT_EQ(bits.size(), 3U);
  EXPECT_EQ(bits[0](3, 3), 4);
  EXPECT_EQ(bits[1](3, 3), 5);
  EXPECT_EQ(bits[2](1, 1), 6);
}

TEST(WorthwhileBits, EachTexelIsRoundedToItsOwn) {
  const Array2D<radar::Channels> texels(2, 2, {1.3F, 0.65F, 0.1F, -0.5F});
  BitsOfTexels bits{Array2D<std::uint8_t>(2, 2, std::uint8_t{10})};
  const HalfTexture texture = encoded({texels}, fitting_scale(texels), bits);
  bits[0](1, 0) = 2;
  const HalfTexture rounded = encoded({texels}, fitting_scale(texels), bits);
  EXPECT_EQ(rounded.levels[0][0], texture.levels[0][0]);
  // Of 1.3 between 1.25 and 1.5.
  EXPECT_FLOAT_EQ(decoded(rounded)[0](1, 0).vv, 1.25F);
  EXPECT_FLOAT_EQ(decoded(rounded)[0](1, 0).hh, 0.625F);
  EXPECT_FLOAT_EQ(decoded(rounded)[0](1, 0).re_vvhh, -0.5F);
}

}  // namespace
}  // namespace sigmascape::atlas
