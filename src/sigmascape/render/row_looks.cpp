#include "sigmascape/render/row_looks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "sigmascape/base/vector_targets.h"
#include "sigmascape/render/lesser_greater.h"

namespace sigmascape::render {
namespace {

using atlas::Half;
constexpr std::size_t plane = atlas::tile_side;

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

struct Weights {
  alignas(64) LatticeRow::Of<float> of;
};

/// What falls to the four corners [elevation][azimuth] of an aspect cell, but for what is the same for all texels.
using CornerWeights = std::array<Weights, 4>;

SIGMASCAPE_VECTOR_TARGETS
void find_corner_weights(const LatticeRow& row, std::size_t first, std::size_t count, const BlendOf& looks,
                         CornerWeights& weights) {
  const float* const beam = row.beam.data() + first;
  const float* const cotangent = row.cotangent.data() + first;
  const float* const sine = row.sine.data() + first;
  const float* const lit = row.lit.data() + first;
  float* const low_left = weights[0].of.data();
  float* const low_right = weights[1].of.data();
  float* const high_left = weights[2].of.data();
  float* const high_right = weights[3].of.data();
  const float span = looks.cotangent[0] - looks.cotangent[1];
  const float per_cotangent = span > 0.0F ? 1.0F / span : 0.0F;
  const float azimuth_offset = looks.azimuth_offset, azimuth_per_beam = looks.azimuth_per_beam;
  const float lowest = looks.cotangent[0], highest_sine = looks.sine[1];
  SIGMASCAPE_INDEPENDENT_TURNS
  for (std::size_t i = 0; i < count; ++i) {
    const float right = lesser(greater(azimuth_offset + azimuth_per_beam * beam[i], 0.0F), 1.0F);
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

/// The four numbers that texels return, to be added to.
struct Returned {
  float* vv;
  float* hh;
  float* hv;
  float* re;
};

/// Adds one look. Powers are never negative; Re VV·HH* may be.
SIGMASCAPE_VECTOR_TARGETS
void add_look(const Half* __restrict planes, const Weights& weights, std::size_t count, const Returned& to) {
  const float* __restrict weight = weights.of.data();
  float* __restrict vv = to.vv;
  float* __restrict hh = to.hh;
  float* __restrict hv = to.hv;
  float* __restrict re = to.re;
  for (std::size_t i = 0; i < count; ++i) {
    vv[i] += weight[i] * tiny_power_of(planes[i]) * into_sum;
    hh[i] += weight[i] * tiny_power_of(planes[plane + i]) * into_sum;
    hv[i] += weight[i] * tiny_power_of(planes[2 * plane + i]) * into_sum;
    re[i] += weight[i] * tiny_number_of(planes[3 * plane + i]) * into_sum;
  }
}

constexpr std::size_t look_stride = GroundPage::channels * plane;

/// Asks for `looks` stretches of a channel that will be wanted soon.
void fetch(const Half* from, std::size_t looks, std::size_t count) {
  constexpr std::size_t line = 64 / sizeof(Half);
  for (std::size_t look = 0; look < looks; ++look) {
    for (std::size_t i = 0; i < count + line - 1; i += line) __builtin_prefetch(from + look * look_stride + i, 0, 3);
  }
}

/// Blends one channel of four looks that lie one after the other, `gain` of each.
template <float number_of(Half)>
[[gnu::always_inline]] inline void blend_four(const Half* __restrict from, const CornerWeights& weights,
                                              const float* gain, std::size_t count, float* __restrict to) {
  const float* __restrict a = weights[0].of.data();
  const float* __restrict b = weights[1].of.data();
  const float* __restrict c = weights[2].of.data();
  const float* __restrict d = weights[3].of.data();
  const float gain_a = gain[0], gain_b = gain[1], gain_c = gain[2], gain_d = gain[3];
  for (std::size_t i = 0; i < count; ++i) {
    to[i] = ((a[i] * (gain_a * number_of(from[i])) + b[i] * (gain_b * number_of(from[look_stride + i]))) +
             (c[i] * (gain_c * number_of(from[2 * look_stride + i])) +
              d[i] * (gain_d * number_of(from[3 * look_stride + i])))) *
            into_sum;
  }
}

/// The same of eight looks, those of a second frequency after those of the first.
template <float number_of(Half)>
[[gnu::always_inline]] inline void blend_eight(const Half* __restrict from, const CornerWeights& weights,
                                               const float* gain, std::size_t count, float* __restrict to) {
  const float* __restrict a = weights[0].of.data();
  const float* __restrict b = weights[1].of.data();
  const float* __restrict c = weights[2].of.data();
  const float* __restrict d = weights[3].of.data();
  const float gain_a = gain[0], gain_b = gain[1], gain_c = gain[2], gain_d = gain[3];
  const float next_a = gain[4], next_b = gain[5], next_c = gain[6], next_d = gain[7];
  const Half* __restrict next = from + 4 * look_stride;
  for (std::size_t i = 0; i < count; ++i) {
    const float of_a = gain_a * number_of(from[i]) + next_a * number_of(next[i]);
    const float of_b = gain_b * number_of(from[look_stride + i]) + next_b * number_of(next[look_stride + i]);
    const float of_c = gain_c * number_of(from[2 * look_stride + i]) + next_c * number_of(next[2 * look_stride + i]);
    const float of_d = gain_d * number_of(from[3 * look_stride + i]) + next_d * number_of(next[3 * look_stride + i]);
    to[i] = ((a[i] * of_a + b[i] * of_b) + (c[i] * of_c + d[i] * of_d)) * into_sum;
  }
}

/// Blends all channels, fetching those of the next row meanwhile.
SIGMASCAPE_VECTOR_TARGETS
void blend_channels(const BlendOf& looks, const CornerWeights& weights, const float* gain, std::size_t count,
                    const Returned& to) {
  float* const channels[] = {to.vv, to.hh, to.hv, to.re};
  for (std::size_t channel = 0; channel < GroundPage::channels; ++channel) {
    const Half* const from = looks.planes + channel * plane;
    if (looks.next_planes != nullptr) fetch(looks.next_planes + channel * plane, looks.looks, count);
    // Powers are never negative; Re VV·HH*, the last, may be.
    const bool is_power = channel + 1 < GroundPage::channels;
    if (looks.looks == 8 && is_power) blend_eight<tiny_power_of>(from, weights, gain, count, channels[channel]);
    if (looks.looks == 8 && !is_power) blend_eight<tiny_number_of>(from, weights, gain, count, channels[channel]);
    if (looks.looks == 4 && is_power) blend_four<tiny_power_of>(from, weights, gain, count, channels[channel]);
    if (looks.looks == 4 && !is_power) blend_four<tiny_number_of>(from, weights, gain, count, channels[channel]);
  }
}

SIGMASCAPE_VECTOR_TARGETS
void ground_weights(const LatticeRow& row, const GroundLook& look, Weights& weights) {
  const float gain = look.factor * into_weights / look.sine, highest_sine = look.highest_sine;
  const float below = look.below, above = look.above;
  // Without a neighbour the part is held at one.
  const float per_below = below > look.own ? 1.0F / (below - look.own) : 0.0F;
  const float per_above = look.own > above ? 1.0F / (look.own - above) : 0.0F;
  const float held_below = below > look.own ? 0.0F : 1.0F, held_above = look.own > above ? 0.0F : 1.0F;
  for (std::size_t i = 0; i < row.count; ++i) {
    const float cotangent = row.local_cotangent[i];
    const float from_below = held_below + (below - cotangent) * per_below;
    const float from_above = held_above + (cotangent - above) * per_above;
    const float part = greater(lesser(lesser(from_below, from_above), 1.0F), 0.0F);
    weights.of[i] = gain * part * lesser(row.local_sine[i], highest_sine) * row.ground_area_m2[i];
  }
}

}  // namespace

SIGMASCAPE_VECTOR_TARGETS
Extremes face(LatticeRow& row, const RowGeometry& geometry, float area_m2) {
  const auto tilt = static_cast<float>(2.0 * geometry.drop_per_square_m);
  constexpr float none = 1e30F;
  for (std::size_t i = 0; i < row.count; ++i) {
    const float east = row.slope_east[i], north = row.slope_north[i];
    const auto x = static_cast<float>(row.east_m[i]), y = static_cast<float>(row.north_m[i]);
    const float square = 1.0F + east * east + north * north;
    // The horizontal at the texel is tilted away from the radar's by the angle between their verticals.
    const float rise = row.below_m[i] - tilt * row.ground_m[i] * row.ground_m[i] + x * east + y * north;
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

void add_ground(LatticeRow& row, const GroundLook& look) {
  Weights weights;
  ground_weights(row, look, weights);
  add_look(look.planes, weights, row.count,
           {row.returned[0].data(), row.returned[1].data(), row.returned[2].data(), row.returned[3].data()});
}

SIGMASCAPE_VECTOR_TARGETS
Extremes cotangent_extremes(const LatticeRow& row) {
  // Positive floats stand in the order of their bits, and vector units compare integers in any order.
  std::int32_t least = std::bit_cast<std::int32_t>(row.cotangent[0]), greatest = least;
  for (std::size_t i = 1; i < row.count; ++i) {
    const auto bits = std::bit_cast<std::int32_t>(row.cotangent[i]);
    least = bits < least ? bits : least;
    greatest = bits > greatest ? bits : greatest;
  }
  return {std::bit_cast<float>(least), std::bit_cast<float>(greatest)};
}

void blend(LatticeRow& row, std::size_t first, std::size_t count, const BlendOf& looks) {
  const Returned returned{row.returned[0].data() + first, row.returned[1].data() + first,
                          row.returned[2].data() + first, row.returned[3].data() + first};
  CornerWeights weights;
  const std::size_t reckoned = LatticeRow::whole_vectors(count);
  find_corner_weights(row, first, reckoned, looks, weights);
  // Of each frequency four looks, [elevation][azimuth].
  std::array<float, atlas::AspectCells::most_looks> gain;
  for (std::size_t look = 0; look < looks.looks; ++look) {
    gain[look] =
        looks.area_m2 * looks.scale[look] * looks.frequency_part[look / 4] * into_weights / looks.sine[look % 4 / 2];
  }
  blend_channels(looks, weights, gain.data(), reckoned, returned);
}

void blend_nothing(LatticeRow& row, std::size_t first, std::size_t count) {
  for (auto& channel : row.returned) std::fill_n(channel.begin() + static_cast<std::ptrdiff_t>(first), count, 0.0F);
}

}  // namespace sigmascape::render
