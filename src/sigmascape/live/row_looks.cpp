#include "sigmascape/live/row_looks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "sigmascape/base/vector_targets.h"
#include "sigmascape/live/lesser_greater.h"

namespace sigmascape::live {
namespace {

using atlas::Half;
constexpr std::size_t vector = GroundPage::vector;

/// A finite half, subnormal ones included, times 2⁻¹¹²: its bits at the place of a float's.
float tiny_number_of(Half half) {
  return std::bit_cast<float>(((half & 0x7fffU) << 13U) | ((half & 0x8000U) << 16U));
}
/// The same for one that is not negative.
float tiny_power_of(Half half) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(half) << 13U);
}

// What puts the difference of the exponents' offsets right, in two parts: one goes into the weights, so that products
// stay clear of the smallest floats, and one into the sum.
constexpr float into_weights = 0x1p40F, into_sum = 0x1p72F;

/// Of the columns of a stretch's blocks.
struct Weights {
  alignas(64) LatticeRow::Of<float> of;

  /// Where those of `count` texels begin; columns before the first and after the last weigh nothing.
  float* from_lane(std::size_t lane, std::size_t count) {
    std::fill_n(of.data(), vector, 0.0F);
    std::fill_n(of.data() + LatticeRow::whole_vectors(lane + count) - vector, vector, 0.0F);
    return of.data() + lane;
  }
};

/// What falls to the four corners [elevation][azimuth] of an aspect cell, or to the four elevations of a page of bare
/// ground, but for what is the same for all texels.
using CornerWeights = std::array<Weights, 4>;
static_assert(GroundPage::elevations == 4);

SIGMASCAPE_VECTOR_TARGETS
void find_corner_weights(const LatticeRow& row, std::size_t first, std::size_t count, const BlendOf& looks,
                         CornerWeights& weights) {
  const float* const beam = row.beam.data() + first;
  const float* const cotangent = row.cotangent.data() + first;
  const float* const sine = row.sine.data() + first;
  const float* const lit = row.lit.data() + first;
  float* const low_left = weights[0].from_lane(looks.blocks.lane, count);
  float* const low_right = weights[1].from_lane(looks.blocks.lane, count);
  float* const high_left = weights[2].from_lane(looks.blocks.lane, count);
  float* const high_right = weights[3].from_lane(looks.blocks.lane, count);
  const float span = looks.cotangent[0] - looks.cotangent[1];
  const float per_cotangent = span > 0.0F ? 1.0F / span : 0.0F;
  const float at_zero = looks.second_azimuth_at_zero, per_beam = looks.second_azimuth_per_beam;
  const float lowest = looks.cotangent[0], highest_sine = looks.sine[1];
  SIGMASCAPE_INDEPENDENT_TURNS
  for (std::size_t i = 0; i < count; ++i) {
    const float right = lesser(greater(at_zero + per_beam * beam[i], 0.0F), 1.0F);
    const float high = lesser(greater((lowest - cotangent[i]) * per_cotangent, 0.0F), 1.0F);
    // Above the highest baked elevation σ0 is held, below the lowest γ = σ0 / sin ψ.
    const float whole = lesser(sine[i], highest_sine) * lit[i];
    const float of_high = whole * high, of_low = whole - of_high;
    low_right[i] = of_low * right;
    low_left[i] = of_low - low_right[i];
    high_right[i] = of_high * right;
    high_left[i] = of_high - high_right[i];
  }
}

/// Where the four numbers that texels return go, those of the first texel first.
using Returned = std::array<float*, GroundPage::channels>;

Returned returned_from(LatticeRow& row, std::size_t first) {
  return {row.returned[0].data() + first, row.returned[1].data() + first, row.returned[2].data() + first,
          row.returned[3].data() + first};
}

/// One channel of a block.
struct Lanes {
  alignas(64) std::array<float, vector> of;
};

/// Whether Re VV·HH*, which may be negative, is what a channel holds; the others are powers.
constexpr bool is_signed(std::size_t channel) {
  return channel + 1 == GroundPage::channels;
}

/// Asks the second cache for a block that will be wanted soon: the first is full of the row at hand.
[[gnu::always_inline]] inline void fetch(const Half* block, std::size_t halves) {
  constexpr std::size_t line = 64 / sizeof(Half);
  for (std::size_t i = 0; i < halves; i += line) __builtin_prefetch(block + i, 0, 2);
}

/// Blends one channel of a block, `gain` of each look: of each frequency four, the corners of the aspect cell.
template <std::size_t looks, float number_of(Half)>
[[gnu::always_inline]] inline void blend_channel(const Half* __restrict from, const float* const* corner,
                                                 const float* gain, float* __restrict to) {
  constexpr std::size_t apart = GroundPage::look_halves, next_frequency = 4 * apart;
  const float* __restrict a = corner[0];
  const float* __restrict b = corner[1];
  const float* __restrict c = corner[2];
  const float* __restrict d = corner[3];
  for (std::size_t i = 0; i < vector; ++i) {
    float of_a = gain[0] * number_of(from[i]);
    float of_b = gain[1] * number_of(from[apart + i]);
    float of_c = gain[2] * number_of(from[2 * apart + i]);
    float of_d = gain[3] * number_of(from[3 * apart + i]);
    if constexpr (looks == 8) {
      const Half* const next = from + next_frequency;
      of_a += gain[4] * number_of(next[i]);
      of_b += gain[5] * number_of(next[apart + i]);
      of_c += gain[6] * number_of(next[2 * apart + i]);
      of_d += gain[7] * number_of(next[3 * apart + i]);
    }
    to[i] = ((a[i] * of_a + b[i] * of_b) + (c[i] * of_c + d[i] * of_d)) * into_sum;
  }
}

/// The same of whichever kind of numbers the channel has.
template <std::size_t looks>
[[gnu::always_inline]] inline void blend_numbers(std::size_t channel, const Half* from, const float* const* corner,
                                                 const float* gain, float* to) {
  if (is_signed(channel)) blend_channel<looks, tiny_number_of>(from, corner, gain, to);
  if (!is_signed(channel)) blend_channel<looks, tiny_power_of>(from, corner, gain, to);
}

/// Blends all channels of a stretch, block by block, fetching the block to the south of each meanwhile.
template <std::size_t looks>
[[gnu::always_inline]] inline void blend_blocks(const BlendOf& blend, const CornerWeights& weights, const float* gain,
                                                std::size_t count, const Returned& returned) {
  constexpr std::size_t block_halves = looks * GroundPage::look_halves;
  const std::size_t lane = blend.blocks.lane;
  const Half* from = blend.blocks.blocks;
  const Half* next = blend.next_blocks;
  for (std::size_t first = 0; first < count; first += vector, from += block_halves) {
    if (next != nullptr) {
      fetch(next, block_halves);
      next += block_halves;
    }
    const float* const corner[] = {weights[0].of.data() + first, weights[1].of.data() + first,
                                   weights[2].of.data() + first, weights[3].of.data() + first};
    // Columns before the first texel are not this stretch's.
    const std::size_t before = first == 0 ? lane : 0;
    for (std::size_t channel = 0; channel < GroundPage::channels; ++channel) {
      const Half* const numbers = from + channel * vector;
      float* const to = returned[channel] + (first + before) - lane;
      if (before == 0) {
        blend_numbers<looks>(channel, numbers, corner, gain, to);
        continue;
      }
      Lanes lanes;
      blend_numbers<looks>(channel, numbers, corner, gain, lanes.of.data());
      std::copy_n(lanes.of.data() + before, vector - before, to);
    }
  }
}

SIGMASCAPE_VECTOR_TARGETS
void blend_four(const BlendOf& looks, const CornerWeights& weights, const float* gain, std::size_t count,
                const Returned& returned) {
  blend_blocks<4>(looks, weights, gain, count, returned);
}

SIGMASCAPE_VECTOR_TARGETS
void blend_eight(const BlendOf& looks, const CornerWeights& weights, const float* gain, std::size_t count,
                 const Returned& returned) {
  blend_blocks<8>(looks, weights, gain, count, returned);
}

SIGMASCAPE_VECTOR_TARGETS
void find_ground_weights(const LatticeRow& row, const GroundElevation& elevation, float highest_sine, float* weight) {
  const float gain = into_weights / elevation.sine;
  const float below = elevation.below, own = elevation.own, above = elevation.above;
  // Without a neighbour the part is held at one.
  const float per_below = below > own ? 1.0F / (below - own) : 0.0F;
  const float per_above = own > above ? 1.0F / (own - above) : 0.0F;
  const float held_below = below > own ? 0.0F : 1.0F, held_above = own > above ? 0.0F : 1.0F;
  for (std::size_t i = 0; i < row.count; ++i) {
    const float cotangent = row.local_cotangent[i];
    const float from_below = held_below + (below - cotangent) * per_below;
    const float from_above = held_above + (cotangent - above) * per_above;
    const float part = greater(lesser(lesser(from_below, from_above), 1.0F), 0.0F);
    weight[i] = gain * part * lesser(row.local_sine[i], highest_sine) * row.ground_area_m2[i];
  }
}

/// Adds one channel of one elevation of a block.
template <std::size_t frequencies, float number_of(Half)>
[[gnu::always_inline]] inline void add_channel(const Half* __restrict from, const float* __restrict weight,
                                               const float* factor, float* __restrict to) {
  for (std::size_t i = 0; i < vector; ++i) {
    float number = factor[0] * number_of(from[i]);
    if constexpr (frequencies == 2) number += factor[1] * number_of(from[GroundPage::look_halves + i]);
    to[i] += weight[i] * number * into_sum;
  }
}

/// Adds one channel of all elevations of a block.
template <std::size_t frequencies>
[[gnu::always_inline]] inline void add_elevations(const GroundLooks& looks, const CornerWeights& weights,
                                                  std::size_t first, std::size_t channel, const Half* block,
                                                  float* to) {
  for (std::size_t e = looks.first; e < looks.end; ++e) {
    const Half* const numbers = block + e * frequencies * GroundPage::look_halves + channel * vector;
    const float* const weight = weights[e].of.data() + first;
    const float* const factor = looks.elevations[e].factor.data();
    if (is_signed(channel)) add_channel<frequencies, tiny_number_of>(numbers, weight, factor, to);
    if (!is_signed(channel)) add_channel<frequencies, tiny_power_of>(numbers, weight, factor, to);
  }
}

/// Adds all channels of a stretch, block by block, fetching the block to the south of each meanwhile.
template <std::size_t frequencies>
[[gnu::always_inline]] inline void add_blocks(const GroundLooks& looks, const CornerWeights& weights, std::size_t count,
                                              const Returned& returned) {
  constexpr std::size_t elevation_halves = frequencies * GroundPage::look_halves;
  constexpr std::size_t block_halves = GroundPage::elevations * elevation_halves;
  const std::size_t lane = looks.blocks.lane;
  const Half* from = looks.blocks.blocks;
  const Half* next = looks.next_blocks;
  for (std::size_t first = 0; first < count; first += vector, from += block_halves) {
    if (next != nullptr) {
      fetch(next + looks.first * elevation_halves, (looks.end - looks.first) * elevation_halves);
      next += block_halves;
    }
    // Columns before the first texel are not this stretch's.
    const std::size_t before = first == 0 ? lane : 0;
    for (std::size_t channel = 0; channel < GroundPage::channels; ++channel) {
      float* const to = returned[channel] + (first + before) - lane;
      if (before == 0) {
        add_elevations<frequencies>(looks, weights, first, channel, from, to);
        continue;
      }
      Lanes lanes{};
      std::copy_n(to, vector - before, lanes.of.data() + before);
      add_elevations<frequencies>(looks, weights, first, channel, from, lanes.of.data());
      std::copy_n(lanes.of.data() + before, vector - before, to);
    }
  }
}

SIGMASCAPE_VECTOR_TARGETS
void add_one_frequency(const GroundLooks& looks, const CornerWeights& weights, std::size_t count,
                       const Returned& returned) {
  add_blocks<1>(looks, weights, count, returned);
}

SIGMASCAPE_VECTOR_TARGETS
void add_two_frequencies(const GroundLooks& looks, const CornerWeights& weights, std::size_t count,
                         const Returned& returned) {
  add_blocks<2>(looks, weights, count, returned);
}

/// How far a texel lies below the radar over its own horizontal, which is tilted away from the radar's by the angle
/// between their verticals.
[[gnu::always_inline]] inline float below_radar(const LatticeRow& row, std::size_t i, float tilt) {
  return row.below_m[i] - tilt * row.ground_m[i] * row.ground_m[i];
}

/// How far the plane of a texel's slope falls from there to under the radar.
[[gnu::always_inline]] inline float fall_under_radar(const LatticeRow& row, std::size_t i) {
  return static_cast<float>(row.east_m[i]) * row.slope_east[i] +
         static_cast<float>(row.north_m[i]) * row.slope_north[i];
}

/// Numbers in the order of floats: vector units compare integers in any order. Its own inverse.
std::int32_t ordered(std::int32_t bits) {
  return bits ^ ((bits >> 31) & 0x7fffffff);
}

SIGMASCAPE_VECTOR_TARGETS
Extremes extremes(const float* values, std::size_t count) {
  std::int32_t least = ordered(std::bit_cast<std::int32_t>(values[0])), greatest = least;
  for (std::size_t i = 1; i < count; ++i) {
    const std::int32_t value = ordered(std::bit_cast<std::int32_t>(values[i]));
    least = value < least ? value : least;
    greatest = value > greatest ? value : greatest;
  }
  return {std::bit_cast<float>(ordered(least)), std::bit_cast<float>(ordered(greatest))};
}

}  // namespace

SIGMASCAPE_VECTOR_TARGETS
void hold_lowest_look(LatticeRow& row, const RowGeometry& geometry, float lowest_cotangent, float lowest_sine) {
  const auto tilt = static_cast<float>(2.0 * geometry.drop_per_square_m);
  for (std::size_t i = 0; i < row.count; ++i) {
    // How far the radar, and one over the same place at the lowest elevation, stand above the plane of the slope.
    const float under = fall_under_radar(row, i), ground = row.ground_m[i];
    const float rise = below_radar(row, i, tilt) + under, lowest_rise = ground / lowest_cotangent + under;
    const float lit_as_lowest = greater(rise, 0.0F) * ground / (static_cast<float>(row.range_m[i]) * lowest_rise);
    const float sine = lowest_rise > 0.0F ? lesser(lit_as_lowest / lowest_cotangent, lowest_sine) : 0.0F;
    row.sine[i] = row.cotangent[i] > lowest_cotangent ? greater(row.sine[i], sine) : row.sine[i];
  }
}

SIGMASCAPE_VECTOR_TARGETS
Extremes face(LatticeRow& row, const RowGeometry& geometry, float area_m2) {
  const auto tilt = static_cast<float>(2.0 * geometry.drop_per_square_m);
  constexpr float none = 1e30F;
  for (std::size_t i = 0; i < row.count; ++i) {
    const float east = row.slope_east[i], north = row.slope_north[i];
    const float square = 1.0F + east * east + north * north;
    const float rise = below_radar(row, i, tilt) + fall_under_radar(row, i);
    const float stretch = std::sqrt(square);
    const float sine = rise / (stretch * static_cast<float>(row.range_m[i]));
    const bool faces = sine > 1e-6F;
    const float held = lesser(greater(sine, 1e-6F), 1.0F);
    row.local_sine[i] = held;
    row.local_cotangent[i] = std::sqrt(1.0F - held * held) / held;
    row.ground_area_m2[i] = faces ? area_m2 * stretch * row.ground_lit[i] : 0.0F;
  }
  Extremes found{none, -none};
  for (std::size_t i = 0; i < row.count; ++i) {
    const bool counts = row.ground_area_m2[i] > 0.0F;
    found.least = lesser(found.least, counts ? row.local_cotangent[i] : none);
    found.greatest = greater(found.greatest, counts ? row.local_cotangent[i] : -none);
  }
  return found;
}

void add_ground(LatticeRow& row, const GroundLooks& looks) {
  const std::size_t lane = looks.blocks.lane;
  CornerWeights weights;
  for (std::size_t e = looks.first; e < looks.end; ++e) {
    find_ground_weights(row, looks.elevations[e], looks.highest_sine, weights[e].from_lane(lane, row.count));
  }
  const std::size_t reckoned = LatticeRow::whole_vectors(lane + row.count);
  (looks.frequencies == 2 ? add_two_frequencies : add_one_frequency)(looks, weights, reckoned, returned_from(row, 0));
}

Extremes cotangent_extremes(const LatticeRow& row) {
  return extremes(row.cotangent.data(), row.count);
}

Extremes beam_extremes(const LatticeRow& row) {
  return extremes(row.beam.data(), row.count);
}

void blend(LatticeRow& row, std::size_t first, std::size_t count, const BlendOf& looks) {
  CornerWeights weights;
  find_corner_weights(row, first, LatticeRow::whole_vectors(count), looks, weights);
  // Of each frequency four looks, [elevation][azimuth].
  std::array<float, atlas::AspectCells::most_looks> gain;
  for (std::size_t look = 0; look < looks.looks; ++look) {
    gain[look] =
        looks.area_m2 * looks.scale[look] * looks.frequency_part[look / 4] * into_weights / looks.sine[look % 4 / 2];
  }
  const std::size_t reckoned = LatticeRow::whole_vectors(looks.blocks.lane + count);
  (looks.looks == 8 ? blend_eight : blend_four)(looks, weights, gain.data(), reckoned, returned_from(row, first));
}

void blend_nothing(LatticeRow& row, std::size_t first, std::size_t count) {
  for (auto& channel : row.returned) std::fill_n(channel.begin() + static_cast<std::ptrdiff_t>(first), count, 0.0F);
}

}  // namespace sigmascape::live
