#include "sigmascape/atlas/half_texture.h"

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>

#include "sigmascape/base/hash.h"

namespace sigmascape::atlas {
namespace {

/// Texels of any power from the brightest down to where halves end, of any two shares of VV and HH, many of them
/// wholly correlated.
Array2D<radar::Channels> correlated_texels(std::size_t side) {
  Array2D<radar::Channels> texels(side, side);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const auto uniform = [i](std::uint64_t what) { return unit_float(mixed(hashed(7, i, what))); };
    const float vv = std::exp2(-45.0F * uniform(0)), hh = vv * std::exp2(6.0F * uniform(1) - 3.0F);
    const float correlation = std::min(1.0F, 1.5F * uniform(2)) * (uniform(3) < 0.5F ? -1.0F : 1.0F);
    texels.values()[i] = {vv, hh, 0.1F * vv, correlation * std::sqrt(vv * hh)};
  }
  return texels;
}

class CorrelationAtRest : public testing::TestWithParam<int> {};

// |Re<S_VV S_HH*>|² ≤ σ0_VV·σ0_HH, which holds of any echoes and so of what is stored, at every level, to the last bit.
TEST_P(CorrelationAtRest, IsNeverMoreThanWhole) {
  const MipChain chain = mip_chain(correlated_texels(256), 32);
  const HalfTexture stored = encoded(chain, fitting_scale(chain.front()), GetParam());
  for (const Array2D<radar::Channels>& level : decoded(stored)) {
    for (const radar::Channels& texel : level.values()) {
      const double vv = texel.vv, hh = texel.hh, correlation = texel.re_vvhh;
      ASSERT_LE(correlation * correlation, vv * hh) << vv << " " << hh;
    }
  }
}

/// The half of so many bits next to a positive one of so many on the far side from zero.
double next_beyond(Half half, int bits) {
  const double value = static_cast<double>(float_from_half(half));
  const int exponent = value > 0.0 ? std::ilogb(value) : -24;
  return value + std::ldexp(1.0, std::max(exponent - bits, -24));
}

// What is stored is the nearest half to what was given, or else the next one beyond it would be too much.
TEST_P(CorrelationAtRest, IsCutByNoMoreThanItMust) {
  const Array2D<radar::Channels> texels = correlated_texels(256);
  const double scale = fitting_scale(texels);
  const HalfTexture stored = encoded(MipChain{texels}, scale, GetParam());
  std::size_t cut = 0;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const Half* const halves = &stored.levels[0][4 * i];
    const float given = static_cast<float>(static_cast<double>(texels.values()[i].re_vvhh) / scale);
    const auto value = [](Half half) { return static_cast<double>(float_from_half(half)); };
    ASSERT_TRUE(halves[3] % 0x8000U == 0 || std::signbit(given) == std::signbit(float_from_half(halves[3])));
    if (halves[3] == half_from_float(given, GetParam())) continue;
    ++cut;
    ASSERT_GT(std::pow(next_beyond(halves[3] & 0x7fffU, GetParam()), 2.0), value(halves[0]) * value(halves[1]));
  }
  EXPECT_GT(cut, 1000U);
  EXPECT_LT(cut, texels.size() / 2);
}

INSTANTIATE_TEST_SUITE_P(HalfTexture, CorrelationAtRest, testing::Values(1, 2, 3, 5, 8, 10));

}  // namespace
}  // namespace sigmascape::atlas
