#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <vector>

#include "sigmascape/atlas/half.h"
#include "sigmascape/atlas/mip_chain.h"
#include "sigmascape/atlas/worthwhile_bits.h"

namespace sigmascape::atlas {

/// A mip chain as it is stored: halves times one power of two. [level][(row · columns + column) · 4 + band].
struct HalfTexture {
  std::size_t side = 0;  ///< texels of the first level held
  double scale = 1.0;    ///< σ0 of a stored 1; 1 for obstacles
  std::vector<std::vector<Half>> levels;
};

/// What the four bands of a texture hold.
using BandNames = std::array<std::string_view, 4>;
/// Of a texel: one a band.
inline constexpr std::size_t texel_halves = std::tuple_size_v<BandNames>;
inline constexpr BandNames sigma0_bands{"VV", "HH", "HV", "RE_VVHH"};
inline constexpr BandNames obstacle_bands{"SOLID_TOP_M", "CROWN_BASE_M", "CROWN_TOP_M", "CROWN_EXTINCTION_PER_M"};

/// The power of two that σ0 is to be divided by before it becomes halves: the brightest texel of level 0 lands between
/// 2¹⁴ and 2¹⁵, so that it fits whatever it is, and dark ground keeps as many bits as can be. 1 when all is black.
[[nodiscard]] double fitting_scale(const Array2D<radar::Channels>& level_0);

/// All levels rounded to the nearest half of so many mantissa bits, under the given scale. Where rounding would leave
/// |Re⟨S_VV·S_HH*⟩| above √(σ0_VV·σ0_HH), which no echoes do, it becomes the largest half of these bits that is not
/// above.
[[nodiscard]] HalfTexture encoded(const MipChain& chain, double scale, int mantissa_bits);
/// The same, every texel with bits of its own.
[[nodiscard]] HalfTexture encoded(const MipChain& chain, double scale, const BitsOfTexels& mantissa_bits);

/// Obstacles in metres and per metre as they are, to the nearest half: heights to one part in 2000, extinctions below
/// 6·10⁻⁵ per metre in steps of 6·10⁻⁸, an optical depth of 0.006 in 100 km. What is beyond the largest half, such as
/// the extinction of a crown as flat as paper, becomes the largest.
[[nodiscard]] HalfTexture encoded(const ObstacleChain& chain);

/// σ0 again.
[[nodiscard]] MipChain decoded(const HalfTexture& texture);
/// Obstacles again.
[[nodiscard]] ObstacleChain decoded_obstacles(const HalfTexture& texture);

/// One obstacle of four halves.
[[nodiscard]] inline radar::Obstacle obstacle_from(const Half* stored) {
  return {float_from_half(stored[0]), float_from_half(stored[1]), float_from_half(stored[2]),
          float_from_half(stored[3])};
}

}  // namespace sigmascape::atlas
