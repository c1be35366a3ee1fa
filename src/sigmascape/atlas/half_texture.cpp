#include "sigmascape/atlas/half_texture.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace sigmascape::atlas {
namespace {

constexpr std::size_t bands = std::tuple_size_v<BandNames>;
static_assert(radar::Channels::count == bands);

/// `bands_of` gives the four numbers of a texel that are rounded, `bits_of` to how many bits, by its level and number.
template <typename Texel, typename BandsOf, typename BitsOf>
HalfTexture rounded(const std::vector<Array2D<Texel>>& chain, double scale, BitsOf bits_of, BandsOf bands_of) {
  HalfTexture texture{chain.front().columns(), scale, {}};
  for (std::size_t level = 0; level < chain.size(); ++level) {
    std::vector<Half>& halves = texture.levels.emplace_back();
    halves.reserve(chain[level].size() * bands);
    for (std::size_t i = 0; i < chain[level].size(); ++i) {
      for (const float value : bands_of(chain[level].values()[i]))
        halves.push_back(half_from_float(value, bits_of(level, i)));
    }
  }
  return texture;
}

/// Bands of σ0 under a scale.
auto bands_under(double scale) {
  return [gain = static_cast<float>(1.0 / scale)](const radar::Channels& texel) {
    return std::array{texel.vv * gain, texel.hh * gain, texel.hv * gain, texel.re_vvhh * gain};
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
    for (std::size_t i = 0; i < texels.size(); ++i) texels.values()[i] = texel_from(&texture.levels[level][i * bands]);
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
  return rounded(chain, scale, always(mantissa_bits), bands_under(scale));
}

HalfTexture encoded(const MipChain& chain, double scale, const BitsOfTexels& mantissa_bits) {
  const auto bits_of = [&](std::size_t level, std::size_t i) { return int{mantissa_bits[level].values()[i]}; };
  return rounded(chain, scale, bits_of, bands_under(scale));
}

HalfTexture encoded(const ObstacleChain& chain) {
  constexpr int all_bits = 10;
  return rounded(chain, 1.0, always(all_bits), [](const radar::Obstacle& texel) {
    return std::array{std::min(texel.solid_top_m, largest_half), std::min(texel.crown_base_m, largest_half),
                      std::min(texel.crown_top_m, largest_half), std::min(texel.crown_extinction_per_m, largest_half)};
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
