#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "sigmascape/render/ground_samples.h"
#include "sigmascape/terrain/terrain_view.h"

namespace sigmascape::render {

/// What the sweep of every azimuth has in common: where it steps and where it writes.
struct SweepPlan {
  const float* height_m = nullptr;
  const terrain::PackedSlope* slope = nullptr;  ///< null: that of the bilinear surface
  std::int32_t columns = 0, rows = 0;
  float cells_per_m = 1.0F;

  /// Steps walked before the first sample, and steps a sample: occluders may stand closer than samples.
  std::size_t lead_steps = 0, steps_per_sample = 1;
  std::size_t samples = 0;
  const float* per_distance = nullptr;  ///< 1 / distance of every step, 1/m
  const float* lowered_m = nullptr;     ///< radar height and drop of the sea at every step: what heights count from

  /// Of docs/physics/curved_earth.md, Eq. (6), one a sample: s²/a − 2·H, r₀², r₀.
  const float* height_term_m = nullptr;
  const float* sea_range_squared_m2 = nullptr;
  const float* sea_range_m = nullptr;

  std::size_t stride = 0;
  std::uint8_t* visible = nullptr;
  float* height_out_m = nullptr;
  float* range_excess_m = nullptr;
  float* sin_grazing = nullptr;
  float* sin_local_grazing = nullptr;  ///< null: neither this nor `slope_area` is wanted
  float* slope_area = nullptr;
};

/// Sixteen neighbouring azimuths, in cells of the lattice: column eastwards, row southwards.
struct SweptAzimuths {
  static constexpr std::size_t count = GroundSamples::azimuths_together;
  static constexpr std::size_t together = 4;  ///< most blocks that `sweep` takes at a time
  using Lane = std::array<float, count>;
  std::size_t first = 0;
  Lane column = {}, row = {};            ///< where step `any_begin` stands
  Lane column_step = {}, row_step = {};  ///< from step to step
  Lane east = {}, north = {};            ///< unit direction outwards
  Lane weight = {};                      ///< 1, or 0 for what only fills the vector: not counted
  /// Steps from which and up to which any, and all, of them stand on the lattice.
  std::size_t any_begin = 0, any_end = 0, all_begin = 0, all_end = 0;
};

struct SweepCounts {
  std::size_t on_terrain = 0, visible = 0;
};

/// Walks outwards along up to four neighbouring blocks of azimuths at once, keeping the steepest line of sight met so
/// far of each azimuth.
///
/// Compiled for several instruction sets, the best of which is taken when the program runs. No multiplication is fused
/// with an addition, so that all give the same bits.
[[nodiscard]] SweepCounts sweep(const SweepPlan& plan, std::span<const SweptAzimuths> blocks);

/// Name of the instruction set that `sweep` uses on this machine.
[[nodiscard]] const char* sweep_instruction_set();

}  // namespace sigmascape::render
