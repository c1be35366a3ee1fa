#include "sigmascape/render/lattice_row.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "sigmascape/base/vector_targets.h"
#include "sigmascape/radar/complex_gaussian.h"

namespace sigmascape::render {
namespace {

using atlas::Half;
constexpr std::size_t most = LatticeRow::most;
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

/// arctan for |u| ≤ 1, by half the angle and the power series; error below 1e-7.
float small_arc(float u) {
  const float t = u / (1.0F + std::sqrt(1.0F + u * u));
  const float s = t * t;
  const float series =
      1.0F -
      s * (1.0F / 3 - s * (1.0F / 5 - s * (1.0F / 7 - s * (1.0F / 9 - s * (1.0F / 11 - s * (1.0F / 13 - s / 15))))));
  return 2.0F * t * series;
}

/// The smaller, and the greater, of two numbers: by value, as vector units do it.
float lesser(float a, float b) {
  return a < b ? a : b;
}
float greater(float a, float b) {
  return a > b ? a : b;
}

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

/// Bins' centres lie at halves: the last one before a position, and what of it goes there and what to the next.
SIGMASCAPE_VECTOR_TARGETS
void split_positions(const float* position, std::size_t count, bool amplitudes, std::int32_t* bin, float* here,
                     float* next) {
  for (std::size_t i = 0; i < count; ++i) {
    const float from_centre = position[i] - 0.5F;
    const float whole = std::floor(from_centre);
    bin[i] = static_cast<std::int32_t>(whole);
    next[i] = from_centre - whole;
    here[i] = 1.0F - next[i];
  }
  if (!amplitudes) return;
  for (std::size_t i = 0; i < count; ++i) {
    here[i] = std::sqrt(here[i]);
    next[i] = std::sqrt(next[i]);
  }
}

void find_shares(LatticeRow& row, bool amplitudes) {
  BinShares& shares = row.shares;
  split_positions(row.beam.data(), row.count, amplitudes, shares.beam.data(), shares.beam_here.data(),
                  shares.beam_next.data());
  split_positions(row.range_bin.data(), row.count, amplitudes, shares.range.data(), shares.range_here.data(),
                  shares.range_next.data());
}

// All numbers of a bin, added in one go.
using FourNumbers = float __attribute__((vector_size(16), aligned(4)));
using EightNumbers = float __attribute__((vector_size(32), aligned(4)));

/// Adds one texel's numbers to the four bins about it; what lies outside the sector falls away.
template <typename Numbers>
[[gnu::always_inline]] inline void share(const SectorBins& sector, const BinShares& shares, std::size_t i, const Numbers& numbers) {
  constexpr std::size_t count = sizeof(Numbers) / sizeof(float);
  const std::int32_t beam = shares.beam[i], range = shares.range[i];
  const auto first_beam = static_cast<std::int32_t>(sector.first_beam);
  const auto beams = static_cast<std::int32_t>(sector.end_beam), ranges = static_cast<std::int32_t>(sector.ranges);
  const auto bin = [&](std::int32_t b, std::int32_t r) {
    return reinterpret_cast<Numbers*>(sector.bins +
                                      static_cast<std::ptrdiff_t>(b * ranges + r) * static_cast<std::ptrdiff_t>(count));
  };
  const Numbers here = numbers * shares.beam_here[i], next = numbers * shares.beam_next[i];
  if (beam >= first_beam && beam + 1 < beams && range >= 0 && range + 1 < ranges) {
    Numbers* const first = bin(beam, range);
    Numbers* const second = bin(beam + 1, range);
    first[0] += here * shares.range_here[i];
    first[1] += here * shares.range_next[i];
    second[0] += next * shares.range_here[i];
    second[1] += next * shares.range_next[i];
    return;
  }
  const auto add_within = [&](std::int32_t b, std::int32_t r, const Numbers& part) {
    if (b >= first_beam && b < beams && r >= 0 && r < ranges) *bin(b, r) += part;
  };
  add_within(beam, range, here * shares.range_here[i]);
  add_within(beam, range + 1, here * shares.range_next[i]);
  add_within(beam + 1, range, next * shares.range_here[i]);
  add_within(beam + 1, range + 1, next * shares.range_next[i]);
}

SIGMASCAPE_VECTOR_TARGETS
void find_ranges(LatticeRow& row, const RowGeometry& geometry) {
  const double* const east = row.east_m.data();
  const double* const north = row.north_m.data();
  const float* const height = row.height_m.data();
  double* const range_m = row.range_m.data();
  float* const range_bin = row.range_bin.data();
  float* const ground = row.ground_m.data();
  float* const below = row.below_m.data();
  const double radar_height = geometry.radar_height_m, drop = geometry.drop_per_square_m;
  const double first_range = geometry.first_range_m, ranges_per_m = geometry.ranges_per_m;
  const std::size_t count = row.count;
  for (std::size_t i = 0; i < count; ++i) {
    const double square = east[i] * east[i] + north[i] * north[i];
    const double under = radar_height - static_cast<double>(height[i]) + drop * square;
    const double range = std::sqrt(square + under * under);
    range_m[i] = range;
    range_bin[i] = static_cast<float>((range - first_range) * ranges_per_m);
    ground[i] = static_cast<float>(std::sqrt(square));
    below[i] = static_cast<float>(under);
  }
}

SIGMASCAPE_VECTOR_TARGETS
void find_angles(LatticeRow& row, const RowGeometry& geometry) {
  const double* const east = row.east_m.data();
  const double* const north = row.north_m.data();
  const auto s = static_cast<float>(geometry.sin_middle), c = static_cast<float>(geometry.cos_middle);
  const auto middle_beam = static_cast<float>(geometry.middle_beam);
  const auto beams_per_rad = static_cast<float>(geometry.beams_per_rad);
  const auto tilt = static_cast<float>(2.0 * geometry.drop_per_square_m);
  const std::size_t count = row.count;
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<float>(east[i]), y = static_cast<float>(north[i]);
    row.beam[i] = middle_beam + small_arc((x * c - y * s) / (x * s + y * c)) * beams_per_rad;
    const float fall = row.below_m[i] / row.ground_m[i];
    row.slope[i] = -fall;
    // The horizontal at the texel is tilted away from the radar's by the angle between their verticals.
    const float dip = tilt * row.ground_m[i];
    const float tangent = greater((fall - dip) / (1.0F + fall * dip), 1e-6F);
    row.cotangent[i] = 1.0F / tangent;
    row.sine[i] = tangent / std::sqrt(1.0F + tangent * tangent);
  }
}

}  // namespace

namespace {

constexpr std::size_t last_column = atlas::tile_side - 1;

void stand_one_on(LatticeRow& row, const PageHeights& heights, std::size_t i, float per_rows) {
  const std::size_t column = (heights.first_column + i) >> heights.levels_up;
  const std::size_t left = std::max<std::size_t>(column, 1) - 1, right = std::min(column + 1, last_column);
  const float rise_east = (heights.row[right] - heights.row[left]) / static_cast<float>(right - left);
  const float rise_north = (heights.north_row[column] - heights.south_row[column]) * per_rows;
  const double middle_m = heights.west_m + (static_cast<double>(column) + 0.5) * heights.texel_m;
  const auto east = static_cast<float>((row.east_m[i] - middle_m) / heights.texel_m);
  const auto north = static_cast<float>((row.north_m[i] - heights.north_m) / heights.texel_m);
  row.height_m[i] = heights.row[column] + rise_east * east + rise_north * north;
}

/// Texels whose page is their own and that have neighbours on both sides.
SIGMASCAPE_VECTOR_TARGETS
void stand_many_on(LatticeRow& row, const PageHeights& heights, std::size_t first, std::size_t end, float per_rows) {
  const float* const here = heights.row + heights.first_column;
  const float* const north_of = heights.north_row + heights.first_column;
  const float* const south_of = heights.south_row + heights.first_column;
  const double per_texel = 1.0 / heights.texel_m;
  const double west = heights.west_m * per_texel + static_cast<double>(heights.first_column) + 0.5;
  const double north_m = heights.north_m * per_texel;
  for (std::size_t i = first; i < end; ++i) {
    const double middle = west + static_cast<double>(static_cast<std::int32_t>(i));
    const auto east = static_cast<float>(row.east_m[i] * per_texel - middle);
    const auto north = static_cast<float>(row.north_m[i] * per_texel - north_m);
    row.height_m[i] =
        here[i] + (here[i + 1] - here[i - 1]) * 0.5F * east + (north_of[i] - south_of[i]) * per_rows * north;
  }
}

}  // namespace

void stand_on(LatticeRow& row, const PageHeights& heights) {
  const float per_rows = heights.north_row != heights.row && heights.south_row != heights.row ? 0.5F : 1.0F;
  const bool many = heights.levels_up == 0 && row.count > 2;
  if (!many) {
    for (std::size_t i = 0; i < row.count; ++i) stand_one_on(row, heights, i, per_rows);
    return;
  }
  stand_one_on(row, heights, 0, per_rows);
  stand_many_on(row, heights, 1, row.count - 1, per_rows);
  stand_one_on(row, heights, row.count - 1, per_rows);
}

void locate(LatticeRow& row, const RowGeometry& geometry) {
  find_ranges(row, geometry);
  find_angles(row, geometry);
}

namespace {
/// Single precision leaves this much doubt in a slope; level ground must not hide itself.
constexpr float doubt = 1e-6F;
}  // namespace

SIGMASCAPE_VECTOR_TARGETS
std::size_t light(LatticeRow& row, const Horizon& horizon) {
  const float* const slopes = horizon.slopes;
  const auto distances = static_cast<std::int32_t>(horizon.distances);
  const auto last_left = static_cast<float>(horizon.azimuths) - 2.0F, last_node = static_cast<float>(distances - 1);
  const float first_beam = horizon.first_beam, near_m = horizon.near_m, per_step = horizon.per_step;
  const std::size_t count = row.count;
  float lit = 0.0F;
  for (std::size_t i = 0; i < count; ++i) {
    const float across = row.beam[i] + first_beam;
    const auto left = static_cast<std::int32_t>(lesser(greater(across, 0.0F), last_left));
    const float part = lesser(greater(across - static_cast<float>(left), 0.0F), 1.0F);
    const auto node =
        static_cast<std::int32_t>(lesser(greater((row.ground_m[i] - near_m) * per_step, 0.0F), last_node));
    const std::int32_t index = left * distances + node;
    const float steepest = (1.0F - part) * slopes[index] + part * slopes[index + distances];
    const float seen = row.slope[i] >= steepest - doubt ? 1.0F : 0.0F;
    row.horizon[i] = steepest;
    row.lit[i] = seen;
  }
  for (std::size_t i = 0; i < count; ++i) lit += row.lit[i];
  return static_cast<std::size_t>(lit);
}

SIGMASCAPE_VECTOR_TARGETS
void light_apart(LatticeRow& row, const Horizon& horizon) {
  const float* const solid_slopes = horizon.solid_slopes;
  const float* const through = horizon.through;
  const auto distances = static_cast<std::int32_t>(horizon.distances);
  const auto last_left = static_cast<float>(horizon.azimuths) - 2.0F, last_node = static_cast<float>(distances - 1);
  const float first_beam = horizon.first_beam, near_m = horizon.near_m, per_step = horizon.per_step;
  for (std::size_t i = 0; i < row.count; ++i) {
    const float across = row.beam[i] + first_beam;
    const auto left = static_cast<std::int32_t>(lesser(greater(across, 0.0F), last_left));
    const float part = lesser(greater(across - static_cast<float>(left), 0.0F), 1.0F);
    const auto node =
        static_cast<std::int32_t>(lesser(greater((row.ground_m[i] - near_m) * per_step + 0.5F, 0.0F), last_node));
    const std::int32_t index = left * distances + node;
    // Obstacles are narrower than terrain: their shadows, not their slopes, are shared between azimuths.
    const float slope = row.slope[i] + doubt;
    const float on_left = slope >= solid_slopes[index] ? through[index] : 0.0F;
    const float on_right = slope >= solid_slopes[index + distances] ? through[index + distances] : 0.0F;
    row.ground_lit[i] = row.lit[i] * (on_left + part * (on_right - on_left));
    const float hidden_m = (row.horizon[i] - row.slope[i]) * row.ground_m[i];
    const float above = greater(1.0F - hidden_m / greater(row.top_m[i], 1e-3F), 0.0F);
    row.lit[i] = row.lit[i] > 0.0F ? 1.0F : above;
  }
}

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

namespace {

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

void add_ground(LatticeRow& row, const GroundLook& look) {
  Weights weights;
  ground_weights(row, look, weights);
  add_look(look.planes, weights, row.count,
           {row.returned[0].data(), row.returned[1].data(), row.returned[2].data(), row.returned[3].data()});
}

SIGMASCAPE_VECTOR_TARGETS
void join_lights(LatticeRow& row) {
  for (std::size_t i = 0; i < row.count; ++i) {
    row.lit[i] = row.lit[i] + row.ground_area_m2[i] > 0.0F ? 1.0F : 0.0F;
  }
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

SIGMASCAPE_VECTOR_TARGETS
void scatter(LatticeRow& row, const std::array<LatticeRow::Of<float>, 6>& gaussians, double turns_per_m) {
  const double* const range = row.range_m.data();
  const std::size_t count = row.count;
  for (std::size_t i = 0; i < count; ++i) {
    const double turns = range[i] * turns_per_m;
    // The phase falls with range; of it only the broken part of a turn matters.
    const double rest_of_turn = std::floor(turns) - turns + 0.5;
    const auto phase = static_cast<std::uint32_t>(static_cast<std::int32_t>(rest_of_turn * 0x1p32)) + 0x80000000U;
    const radar::ComplexPair phasor = radar::unit_phasor(phase);
    row.phasor[0][i] = phasor.re;
    row.phasor[1][i] = phasor.im;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const float re = row.phasor[0][i], im = row.phasor[1][i];
    const float vv = std::sqrt(row.returned[0][i]), hh = std::sqrt(row.returned[1][i]);
    const float hv = std::sqrt(row.returned[2][i]);
    const float correlation = lesser(greater(row.returned[3][i] / greater(vv * hh, 1e-30F), -1.0F), 1.0F);
    const float rest = std::sqrt(1.0F - correlation * correlation);
    const float first_re = gaussians[0][i], first_im = gaussians[1][i];
    const float other_re = correlation * first_re + rest * gaussians[2][i];
    const float other_im = correlation * first_im + rest * gaussians[3][i];
    const float third_re = gaussians[4][i], third_im = gaussians[5][i];
    row.amplitude[0][i] = vv * (first_re * re - first_im * im);
    row.amplitude[1][i] = vv * (first_re * im + first_im * re);
    row.amplitude[2][i] = hh * (other_re * re - other_im * im);
    row.amplitude[3][i] = hh * (other_re * im + other_im * re);
    row.amplitude[4][i] = hv * (third_re * re - third_im * im);
    row.amplitude[5][i] = hv * (third_re * im + third_im * re);
  }
}

SIGMASCAPE_VECTOR_TARGETS
void deposit_amplitudes(LatticeRow& row, const SectorBins& sector) {
  find_shares(row, true);
  const auto& a = row.amplitude;
  for (std::size_t i = 0; i < row.count; ++i) {
    if (row.lit[i] == 0.0F) continue;
    share(sector, row.shares, i, EightNumbers{a[0][i], a[1][i], a[2][i], a[3][i], a[4][i], a[5][i], a[4][i], a[5][i]});
  }
}

void deposit_powers(LatticeRow& row, const SectorBins& sector) {
  find_shares(row, false);
  const auto& p = row.returned;
  for (std::size_t i = 0; i < row.count; ++i) {
    if (row.lit[i] == 0.0F) continue;
    share(sector, row.shares, i, FourNumbers{p[0][i], p[1][i], p[2][i], p[3][i]});
  }
}

}  // namespace sigmascape::render
