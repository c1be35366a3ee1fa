#include "sigmascape/atlas/half_texture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sigmascape::atlas {
namespace {

static_assert(radar::Channels::count == texel_halves);

/// `rounded_texel` gives the four halves of a texel of so many bits; `bits_of` tells how many, by its level and number.
template <typename Texel, typename RoundedTexel, typename BitsOf>
HalfTexture rounded(const std::vector<Array2D<Texel>>& chain, double scale, BitsOf bits_of,
                    RoundedTexel rounded_texel) {
  HalfTexture texture{chain.front().columns(), scale, {}};
  for (std::size_t level = 0; level < chain.size(); ++level) {
    std::vector<Half>& halves = texture.levels.emplace_back();
    halves.reserve(chain[level].size() * texel_halves);
    for (std::size_t i = 0; i < chain[level].size(); ++i) {
      const std::array<Half, texel_halves> texel = rounded_texel(chain[level].values()[i], bits_of(level, i));
      halves.insert(halves.end(), texel.begin(), texel.end());
    }
  }
  return texture;
}

std::array<Half, texel_halves> nearest_halves(const std::array<float, texel_halves>& values, int mantissa_bits) {
  std::array<Half, texel_halves> halves{};
  std::ranges::transform(values, halves.begin(),
                         [mantissa_bits](float value) { return half_from_float(value, mantissa_bits); });
  return halves;
}

/// Re⟨S_VV·S_HH*⟩ cut to what VV and HH, each rounded alone, let it be. Squares and products of halves are exact as
/// floats, and no half lies so little above the root of one that the root rounds up to it.
Half cut_correlation(Half correlation, Half vv, Half hh, int mantissa_bits) {
  const float value = float_from_half(correlation);
  const float most_squared = std::max(float_from_half(vv) * float_from_half(hh), 0.0F);
  if (value * value <= most_squared) return correlation;
  return half_towards_zero(std::copysign(std::sqrt(most_squared), value), mantissa_bits);
}

/// Texels of σ0 under a scale.
auto sigma0_under(double scale) {
  return [gain = static_cast<float>(1.0 / scale)](const radar::Channels& texel, int mantissa_bits) {
    auto halves =
        nearest_halves({texel.vv * gain, texel.hh * gain, texel.hv * gain, texel.re_vvhh * gain}, mantissa_bits);
    halves[3] = cut_correlation(halves[3], halves[0], halves[1], mantissa_bits);
    return halves;
  };
}

auto always(int mantissa_bits) {
  return [mantissa_bits](std::size_t, std::size_t) { return mantissa_bits; };
}

template <typename Texel, typename TexelFrom>
std::vector<Array2D<Texel>> widened(const HalfTexture& texture, TexelFrom texel_from) {
  std::vector<Array2D<Texel>> chain;
  for (std::size_t level = 0; level < texture.levels.size(); ++level) {
    const std::size_t side = texture.side >> level;
    Array2D<Texel>& texels = chain.emplace_back(side, side);
    for (std::size_t i = 0; i < texels.size(); ++i)
      texels.values()[i] = texel_from(&texture.levels[level][i * texel_halves]);
  }
  return chain;
}

}  // namespace

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
  return rounded(chain, scale, always(mantissa_bits), sigma0_under(scale));
}

HalfTexture encoded(const MipChain& chain, double scale, const BitsOfTexels& mantissa_bits) {
  const auto bits_of = [&](std::size_t level, std::size_t i) { return int{mantissa_bits[level].values()[i]}; };
  return rounded(chain, scale, bits_of, sigma0_under(scale));
}

HalfTexture encoded(const ObstacleChain& chain) {
  constexpr int all_bits = 10;
  return rounded(chain, 1.0, always(all_bits), [](const radar::Obstacle& texel, int mantissa_bits) {
    return nearest_halves(
        {std::min(texel.solid_top_m, largest_half), std::min(texel.crown_base_m, largest_half),
         std::min(texel.crown_top_m, largest_half), std::min(texel.crown_extinction_per_m, largest_half)},
        mantissa_bits);
  });
}

MipChain decoded(const HalfTexture& texture) {
  const auto scale = static_cast<float>(texture.scale);
  return widened<radar::Channels>(texture, [scale](const Half* stored) -> radar::Channels {
    return {float_from_half(stored[0]) * scale, float_from_half(stored[1]) * scale, float_from_half(stored[2]) * scale,
            float_from_half(stored[3]) * scale};
  });
}

ObstacleChain decoded_obstacles(const HalfTexture& texture) {
  return widened<radar::Obstacle>(texture, obstacle_from);
}

}  // namespace sigmascape::atlas
