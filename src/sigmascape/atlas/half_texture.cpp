#include "sigmascape/atlas/half_texture.h"

#include <algorithm>
#include <cmath>

namespace sigmascape::atlas {

double fitting_scale(const Array2D<radar::Channels>& level_0) {
  float brightest = 0.0F;
  for (const radar::Channels& texel : level_0.values()) {
    brightest =
        std::max({brightest, std::abs(texel.vv), std::abs(texel.hh), std::abs(texel.hv), std::abs(texel.re_vvhh)});
  }
  if (brightest == 0.0F) return 1.0;
  // Beyond 2^±100 scale and reciprocal would leave the range of float; no σ0 is near either end.
  const int exponent = std::clamp(std::ilogb(brightest), -100, 100);
  return std::ldexp(1.0, exponent - 14);
}

HalfTexture encoded(const MipChain& chain, double scale, int mantissa_bits) {
  HalfTexture texture{chain.front().columns(), scale, {}};
  const auto gain = static_cast<float>(1.0 / scale);
  for (const Array2D<radar::Channels>& level : chain) {
    std::vector<Half>& halves = texture.levels.emplace_back();
    halves.reserve(level.size() * radar::Channels::count);
    for (const radar::Channels& texel : level.values()) {
      for (const float value : {texel.vv, texel.hh, texel.hv, texel.re_vvhh}) {
        halves.push_back(half_from_float(value * gain, mantissa_bits));
      }
    }
  }
  return texture;
}

MipChain decoded(const HalfTexture& texture) {
  MipChain chain;
  const auto scale = static_cast<float>(texture.scale);
  for (std::size_t level = 0; level < texture.levels.size(); ++level) {
    const std::vector<Half>& halves = texture.levels[level];
    const std::size_t side = texture.side >> level;
    Array2D<radar::Channels>& texels = chain.emplace_back(side, side);
    for (std::size_t i = 0; i < texels.size(); ++i) {
      const Half* stored = &halves[i * radar::Channels::count];
      texels.values()[i] = {float_from_half(stored[0]) * scale, float_from_half(stored[1]) * scale,
                            float_from_half(stored[2]) * scale, float_from_half(stored[3]) * scale};
    }
  }
  return chain;
}

}  // namespace sigmascape::atlas
