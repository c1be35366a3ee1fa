#include "sigmascape/render/sweep_kernel.h"

#include <algorithm>
#include <cstddef>
#include <memory>

// Vectors are members here, which those of no fixed length cannot be.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sigmascape/render/sweep_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sigmascape::render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::CappedTag<float, SweptAzimuths::count>;
using Words = hn::RebindToSigned<Floats>;
using Float = hn::Vec<Floats>;
using Word = hn::Vec<Words>;
using FloatMask = hn::Mask<Floats>;

constexpr Floats floats;
constexpr Words words;

HWY_INLINE Float splat(float value) {
  return hn::Set(floats, value);
}

/// (1 − t)·a + t·b
HWY_INLINE Float blend(Float a, Float b, Float t) {
  return hn::Add(a, hn::Mul(t, hn::Sub(b, a)));
}

/// Each node's value and that of its eastern neighbour. Where the machine fetches words of 64 bits, both at once: it
/// takes a step for every word, whatever its size.
HWY_INLINE void gather_pairs(const float* nodes, Word node, Float& west, Float& east) {
#if HWY_TARGET <= HWY_AVX2
  using Pairs = hn::RepartitionToWide<Words>;
  constexpr Pairs pairs;
  const hn::Half<Words> half;
  const auto* const base = reinterpret_cast<const std::int64_t*>(nodes);
  const auto fetch = [&](auto half_nodes) {
    // Places are counted in floats, so that every other pair stands across two words.
    return hn::BitCast(floats, hn::GatherOffset(pairs, base, hn::ShiftLeft<2>(hn::PromoteTo(pairs, half_nodes))));
  };
  const Float lower = fetch(hn::LowerHalf(half, node)), upper = fetch(hn::UpperHalf(half, node));
  west = hn::ConcatEven(floats, upper, lower);
  east = hn::ConcatOdd(floats, upper, lower);
#else
  west = hn::GatherIndex(floats, nodes, node);
  east = hn::GatherIndex(floats, nodes + 1, node);
#endif
}

/// One vector of azimuths on their way outwards.
class VectorSweep {
 public:
  VectorSweep(const SweepPlan& plan, const SweptAzimuths& azimuths, std::size_t lane)
      : plan_(plan),
        azimuths_(azimuths),
        lane_(lane),
        most_columns_(static_cast<float>(plan.columns - 1)),
        most_rows_(static_cast<float>(plan.rows - 1)) {}

  HWY_INLINE void begin() {
    way_ = {.steepest = splat(-1e30F), .visible = splat(0.0F), .present = splat(0.0F), .ground = nothing()};
    for (std::size_t step = azimuths_.any_begin; step < plan_.lead_steps; ++step) occlude(step);
  }

  HWY_INLINE void advance(std::size_t sample) {
    const std::size_t first = plan_.lead_steps + sample * plan_.steps_per_sample;
    const std::size_t last = first + plan_.steps_per_sample - 1;
    if (last < azimuths_.any_begin || first >= azimuths_.any_end) return write_nothing(sample);
    for (std::size_t step = first; step < last; ++step) occlude(step);
    if (last >= azimuths_.all_begin && last < azimuths_.all_end) {
      take_sample<true>(sample, last);
    } else {
      take_sample<false>(sample, last);
    }
  }

  [[nodiscard]] HWY_INLINE SweepCounts counts() const {
    const Float weight = hn::LoadU(floats, azimuths_.weight.data() + lane_);
    return {summed(hn::Mul(way_.present, weight)), summed(hn::Mul(way_.visible, weight))};
  }

 private:
  HWY_INLINE static std::size_t summed(Float counts) {
    return static_cast<std::size_t>(hn::GetLane(hn::SumOfLanes(floats, counts)));
  }

  HWY_INLINE Float column_at(std::size_t step) const { return walked(azimuths_.column, azimuths_.column_step, step); }
  HWY_INLINE Float row_at(std::size_t step) const { return walked(azimuths_.row, azimuths_.row_step, step); }
  HWY_INLINE Float walked(const SweptAzimuths::Lane& start, const SweptAzimuths::Lane& pace, std::size_t step) const {
    const Float steps = splat(static_cast<float>(step - azimuths_.any_begin));
    return hn::Add(hn::LoadU(floats, start.data() + lane_), hn::Mul(steps, hn::LoadU(floats, pace.data() + lane_)));
  }

  HWY_INLINE FloatMask on_lattice(Float column, Float row) const {
    return hn::And(between(column, most_columns_), between(row, most_rows_));
  }

  /// The ground under a step of the way.
  struct Ground {
    Float column, row;
    Word cell_column, cell_row, node;  ///< its north-western
    Float height_m;                    ///< far below everything where there is no ground
    Float to_east_m, to_south_m;       ///< rise over the cell
    Float u, v;
  };
  struct Progress {
    Float steepest, visible, present;
    Ground ground;
  };

  HWY_INLINE static Ground nothing() {
    const Float zero = splat(0.0F);
    const Word none = hn::Zero(words);
    return {zero, zero, none, none, none, zero, zero, zero, zero, zero};
  }

  HWY_INLINE Ground ground_at(Float column, Float row) const {
    const Float none = splat(0.0F);
    const Float x = hn::Min(hn::Max(column, none), splat(most_columns_));
    const Float y = hn::Min(hn::Max(row, none), splat(most_rows_));
    const Word i = hn::Min(hn::ConvertTo(words, x), hn::Set(words, plan_.columns - 2));
    const Word j = hn::Min(hn::ConvertTo(words, y), hn::Set(words, plan_.rows - 2));
    const Float u = hn::Sub(x, hn::ConvertTo(floats, i)), v = hn::Sub(y, hn::ConvertTo(floats, j));
    const Word node = hn::Add(hn::Mul(j, hn::Set(words, plan_.columns)), i);

    const float* const nodes = plan_.height_m;
    Float north_west, north_east, south_west, south_east;
    gather_pairs(nodes, node, north_west, north_east);
    gather_pairs(nodes + plan_.columns, node, south_west, south_east);
    const Float north = blend(north_west, north_east, u), south = blend(south_west, south_east, u);
    const Float to_south = hn::Sub(south, north);
    const Float to_east = blend(hn::Sub(north_east, north_west), hn::Sub(south_east, south_west), v);
    return {column, row, i, j, node, hn::Add(north, hn::Mul(v, to_south)), to_east, to_south, u, v};
  }

  HWY_INLINE Float slope_of(Float height_m, std::size_t step) const {
    return hn::Mul(hn::Sub(height_m, splat(plan_.lowered_m[step])), splat(plan_.per_distance[step]));
  }

  /// Where the way passes from cell to cell the surface is bent, and its ridges stand: takes the lines of sight over
  /// the one column line and the one row line that may lie between the step before and this one.
  HWY_INLINE void cross_lines(std::size_t step, const Ground& before, const Ground& now, Float& steepest) const {
    const auto column_changes = hn::Ne(before.cell_column, now.cell_column);
    if (!hn::AllFalse(words, column_changes)) {
      const Word line = hn::Max(before.cell_column, now.cell_column);
      const Float part =
          hn::Div(hn::Sub(hn::ConvertTo(floats, line), before.column), hn::Sub(now.column, before.column));
      const Float row = blend(before.row, now.row, part);
      const Word j = hn::Min(hn::ConvertTo(words, hn::Max(row, splat(0.0F))), hn::Set(words, plan_.rows - 2));
      const Word node = hn::Add(hn::Mul(j, hn::Set(words, plan_.columns)), line);
      const FloatMask here = hn::And(hn::RebindMask(floats, column_changes), between(row, most_rows_));
      const Float height_m =
          blend(hn::GatherIndex(floats, plan_.height_m, node),
                hn::GatherIndex(floats, plan_.height_m + plan_.columns, node), hn::Sub(row, hn::ConvertTo(floats, j)));
      pass(step, part, height_m, here, steepest);
    }
    const auto row_changes = hn::Ne(before.cell_row, now.cell_row);
    if (!hn::AllFalse(words, row_changes)) {
      const Word line = hn::Max(before.cell_row, now.cell_row);
      const Float part = hn::Div(hn::Sub(hn::ConvertTo(floats, line), before.row), hn::Sub(now.row, before.row));
      const Float column = blend(before.column, now.column, part);
      const Word i = hn::Min(hn::ConvertTo(words, hn::Max(column, splat(0.0F))), hn::Set(words, plan_.columns - 2));
      const Word node = hn::Add(hn::Mul(line, hn::Set(words, plan_.columns)), i);
      const FloatMask here = hn::And(hn::RebindMask(floats, row_changes), between(column, most_columns_));
      Float west, east;
      gather_pairs(plan_.height_m, node, west, east);
      pass(step, part, blend(west, east, hn::Sub(column, hn::ConvertTo(floats, i))), here, steepest);
    }
  }

  HWY_INLINE static FloatMask between(Float place, float most) {
    return hn::And(hn::Ge(place, splat(0.0F)), hn::Le(place, splat(most)));
  }

  /// The line of sight over a point that was met `part` of the way into the step.
  HWY_INLINE void pass(std::size_t step, Float part, Float height_m, FloatMask here, Float& steepest) const {
    const Float lowered_m = blend(splat(plan_.lowered_m[step - 1]), splat(plan_.lowered_m[step]), part);
    const Float per_distance = blend(splat(plan_.per_distance[step - 1]), splat(plan_.per_distance[step]), part);
    const Float slope = hn::Mul(hn::Sub(height_m, lowered_m), per_distance);
    steepest = hn::IfThenElse(here, hn::Max(steepest, slope), steepest);
  }

  HWY_INLINE void occlude(std::size_t step) {
    if (step < azimuths_.any_begin || step >= azimuths_.any_end) return;
    const Float column = column_at(step), row = row_at(step);
    Ground ground = ground_at(column, row);
    ground.height_m = hn::IfThenElse(on_lattice(column, row), ground.height_m, splat(-1e9F));
    if (step > azimuths_.any_begin) cross_lines(step, way_.ground, ground, way_.steepest);
    way_.steepest = hn::Max(way_.steepest, slope_of(ground.height_m, step));
    way_.ground = ground;
  }

  template <bool all_on_lattice>
  HWY_INLINE void take_sample(std::size_t sample, std::size_t step) {
    const Float column = column_at(step), row = row_at(step);
    Ground ground = ground_at(column, row);
    const Float height_m = ground.height_m, one = splat(1.0F);
    FloatMask here = hn::Eq(one, one);
    if constexpr (!all_on_lattice) {
      here = on_lattice(column, row);
      ground.height_m = hn::IfThenElse(here, height_m, splat(-1e9F));
    }
    if (step > azimuths_.any_begin) cross_lines(step, way_.ground, ground, way_.steepest);
    const Float slope = slope_of(ground.height_m, step);
    const FloatMask seen = hn::And(here, hn::Ge(slope, way_.steepest));
    way_.steepest = hn::Max(way_.steepest, slope);
    way_.present = hn::Add(way_.present, hn::IfThenElseZero(here, one));
    way_.visible = hn::Add(way_.visible, hn::IfThenElseZero(seen, one));
    way_.ground = ground;

    const std::size_t out = sample * plan_.stride + azimuths_.first + lane_;
    const hn::Rebind<std::uint8_t, Floats> bytes;
    hn::StoreU(hn::DemoteTo(bytes, hn::ConvertTo(words, hn::IfThenElseZero(seen, one))), bytes, plan_.visible + out);
    hn::StoreU(height_m, floats, plan_.height_out_m + out);
    const Float sine = write_range(sample, out, height_m);
    if (plan_.sin_local_grazing == nullptr) return;

    Float east, north;
    if (plan_.slope == nullptr) {
      east = hn::Mul(ground.to_east_m, splat(plan_.cells_per_m));
      north = hn::Mul(ground.to_south_m, splat(-plan_.cells_per_m));
    } else {
      interpolated_slopes(ground.node, ground.u, ground.v, east, north);
    }
    write_slope(out, sine, east, north);
  }

  /// Range and grazing angle; returns the sine of the latter.
  HWY_INLINE Float write_range(std::size_t sample, std::size_t out, Float height_m) const {
    const Float term = splat(plan_.height_term_m[sample]);
    const Float excess_squared = hn::Mul(height_m, hn::Add(height_m, term));
    const Float range = hn::Sqrt(hn::Add(splat(plan_.sea_range_squared_m2[sample]), excess_squared));
    hn::StoreU(hn::Div(excess_squared, hn::Add(range, splat(plan_.sea_range_m[sample]))), floats,
               plan_.range_excess_m + out);
    const Float sine = hn::Div(hn::Sub(hn::Mul(term, splat(-0.5F)), height_m), range);
    hn::StoreU(sine, floats, plan_.sin_grazing + out);
    return sine;
  }

  HWY_INLINE void interpolated_slopes(Word node, Float u, Float v, Float& east, Float& north) const {
    const auto* const packed = reinterpret_cast<const std::int32_t*>(plan_.slope);
    const Word north_west = hn::GatherIndex(words, packed, node);
    const Word north_east = hn::GatherIndex(words, packed + 1, node);
    const Word south_west = hn::GatherIndex(words, packed + plan_.columns, node);
    const Word south_east = hn::GatherIndex(words, packed + plan_.columns + 1, node);
    const Float unit = splat(1.0F / terrain::PackedSlope::steps_per_unit);
    // Little-endian: `east` is the lower half of the word.
    const auto lower = [](Word w) { return hn::ConvertTo(floats, hn::ShiftRight<16>(hn::ShiftLeft<16>(w))); };
    const auto upper = [](Word w) { return hn::ConvertTo(floats, hn::ShiftRight<16>(w)); };
    east = hn::Mul(
        unit, blend(blend(lower(north_west), lower(north_east), u), blend(lower(south_west), lower(south_east), u), v));
    north = hn::Mul(
        unit, blend(blend(upper(north_west), upper(north_east), u), blend(upper(south_west), upper(south_east), u), v));
  }

  /// n · l with n = (−∂h/∂x, −∂h/∂y, 1) / |…| and l towards the radar.
  HWY_INLINE void write_slope(std::size_t out, Float sine, Float east, Float north) const {
    const Float one = splat(1.0F);
    const Float outwards = hn::Add(hn::Mul(east, hn::LoadU(floats, azimuths_.east.data() + lane_)),
                                   hn::Mul(north, hn::LoadU(floats, azimuths_.north.data() + lane_)));
    const Float cosine = hn::Sqrt(hn::Max(hn::Sub(one, hn::Mul(sine, sine)), splat(0.0F)));
    const Float area = hn::Sqrt(hn::Add(one, hn::Add(hn::Mul(east, east), hn::Mul(north, north))));
    hn::StoreU(area, floats, plan_.slope_area + out);
    hn::StoreU(hn::Div(hn::Add(sine, hn::Mul(cosine, outwards)), area), floats, plan_.sin_local_grazing + out);
  }

  HWY_INLINE void write_nothing(std::size_t sample) const {
    const std::size_t out = sample * plan_.stride + azimuths_.first + lane_;
    const hn::Rebind<std::uint8_t, Floats> bytes;
    const Float none = splat(0.0F);
    hn::StoreU(hn::Zero(bytes), bytes, plan_.visible + out);
    hn::StoreU(none, floats, plan_.height_out_m + out);
    hn::StoreU(none, floats, plan_.range_excess_m + out);
    hn::StoreU(none, floats, plan_.sin_grazing + out);
    if (plan_.sin_local_grazing == nullptr) return;
    hn::StoreU(none, floats, plan_.sin_local_grazing + out);
    hn::StoreU(none, floats, plan_.slope_area + out);
  }

  const SweepPlan& plan_;
  const SweptAzimuths& azimuths_;
  std::size_t lane_;
  float most_columns_, most_rows_;
  Progress way_ = {};
};

SweepCounts sweep_vectors(const SweepPlan& plan, std::span<const SweptAzimuths> blocks) {
  // Side by side, so that what is written at one distance lies together.
  constexpr std::size_t most_vectors = SweptAzimuths::together * SweptAzimuths::count / hn::MaxLanes(floats);
  alignas(VectorSweep) std::byte room[most_vectors * sizeof(VectorSweep)];
  auto* const sweeps = reinterpret_cast<VectorSweep*>(room);
  std::size_t vectors = 0;
  for (const SweptAzimuths& block : blocks) {
    for (std::size_t lane = 0; lane < SweptAzimuths::count; lane += hn::Lanes(floats)) {
      std::construct_at(sweeps + vectors, plan, block, lane)->begin();
      ++vectors;
    }
  }
  for (std::size_t sample = 0; sample < plan.samples; ++sample) {
    for (std::size_t i = 0; i < vectors; ++i) sweeps[i].advance(sample);
  }
  SweepCounts counts;
  for (std::size_t i = 0; i < vectors; ++i) {
    counts.on_terrain += sweeps[i].counts().on_terrain;
    counts.visible += sweeps[i].counts().visible;
  }
  return counts;
}

const char* target_name() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace sigmascape::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sigmascape::render {

HWY_EXPORT(sweep_vectors);
HWY_EXPORT(target_name);

SweepCounts sweep(const SweepPlan& plan, std::span<const SweptAzimuths> blocks) {
  return HWY_DYNAMIC_DISPATCH(sweep_vectors)(plan, blocks);
}

const char* sweep_instruction_set() {
  return HWY_DYNAMIC_DISPATCH(target_name)();
}

}  // namespace sigmascape::render
#endif
