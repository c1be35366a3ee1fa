#include "sigmascape/render/row_looks.h"

#include <bit>
#include <cmath>

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
  LatticeRow::Of<float> of;
};

/// Parts of the looks of one (frequency, elevation, azimuth) corner of the aspect cell.
SIGMASCAPE_VECTOR_TARGETS
void corner_weights(const LatticeRow& row, std::size_t first, std::size_t count, const BlendOf& looks, std::size_t e,
                    std::size_t a, float factor, Weights& weights) {
  const float* const beam = row.beam.data() + first;
  const float* const cotangent = row.cotangent.data() + first;
  const float* const sine = row.sine.data() + first;
  float* const out = weights.of.data();
  const float span = looks.cotangent[0] - looks.cotangent[1];
  const float per_cotangent = span > 0.0F ? 1.0F / span : 0.0F;
  const float gain = factor / looks.sine[e];
  const float azimuth_offset = looks.azimuth_offset, azimuth_per_beam = looks.azimuth_per_beam;
  const float lowest = looks.cotangent[0], highest_sine = looks.sine[1];
  // The part of the second neighbour, or 1 less it.
  const float first_azimuth = a == 0 ? 1.0F : 0.0F, azimuth_sign = a == 0 ? -1.0F : 1.0F;
  const float first_elevation = e == 0 ? 1.0F : 0.0F, elevation_sign = e == 0 ? -1.0F : 1.0F;
  for (std::size_t i = 0; i < count; ++i) {
    const float azimuth_part = lesser(greater(azimuth_offset + azimuth_per_beam * beam[i], 0.0F), 1.0F);
    const float elevation_part = lesser(greater((lowest - cotangent[i]) * per_cotangent, 0.0F), 1.0F);
    // Above the highest baked elevation σ0 is held, below the lowest γ = σ0 / sin ψ.
    out[i] = gain * lesser(sine[i], highest_sine) * (first_elevation + elevation_sign * elevation_part) *
             (first_azimuth + azimuth_sign * azimuth_part);
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

/// Adds four looks that lie one after the other.
SIGMASCAPE_VECTOR_TARGETS
void add_four_looks(const Half* __restrict planes, const std::array<Weights, 4>& weights, std::size_t count,
                    const Returned& to) {
  constexpr std::size_t look = GroundPage::channels * plane;
  const float* __restrict a = weights[0].of.data();
  const float* __restrict b = weights[1].of.data();
  const float* __restrict c = weights[2].of.data();
  const float* __restrict d = weights[3].of.data();
  float* const powers[3] = {to.vv, to.hh, to.hv};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    float* __restrict power = powers[channel];
    const Half* __restrict from = planes + channel * plane;
    for (std::size_t i = 0; i < count; ++i) {
      power[i] += ((a[i] * tiny_power_of(from[i]) + b[i] * tiny_power_of(from[look + i])) +
                   (c[i] * tiny_power_of(from[2 * look + i]) + d[i] * tiny_power_of(from[3 * look + i]))) *
                  into_sum;
    }
  }
  float* __restrict re = to.re;
  const Half* __restrict from = planes + 3 * plane;
  for (std::size_t i = 0; i < count; ++i) {
    re[i] += ((a[i] * tiny_number_of(from[i]) + b[i] * tiny_number_of(from[look + i])) +
              (c[i] * tiny_number_of(from[2 * look + i]) + d[i] * tiny_number_of(from[3 * look + i]))) *
             into_sum;
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

Extremes cotangent_extremes(const LatticeRow& row) {
  Extremes found{row.cotangent[0], row.cotangent[0]};
  for (std::size_t i = 1; i < row.count; ++i) {
    found.least = lesser(found.least, row.cotangent[i]);
    found.greatest = greater(found.greatest, row.cotangent[i]);
  }
  return found;
}

void blend(LatticeRow& row, std::size_t first, std::size_t count, const BlendOf& looks) {
  const Returned returned{row.returned[0].data() + first, row.returned[1].data() + first,
                          row.returned[2].data() + first, row.returned[3].data() + first};
  // Of each frequency four looks, [elevation][azimuth].
  std::array<Weights, 4> weights;
  for (std::size_t f = 0; f < looks.looks / 4; ++f) {
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const float factor = looks.scale[4 * f + corner] * looks.frequency_part[f] * into_weights;
      corner_weights(row, first, count, looks, corner / 2, corner % 2, factor, weights[corner]);
    }
    add_four_looks(looks.planes + 4 * f * GroundPage::channels * plane, weights, count, returned);
  }
}

SIGMASCAPE_VECTOR_TARGETS
void weigh(LatticeRow& row, float area_m2) {
  for (auto& channel : row.returned) {
    for (std::size_t i = 0; i < row.count; ++i) channel[i] *= area_m2 * row.lit[i];
  }
}

}  // namespace sigmascape::render
