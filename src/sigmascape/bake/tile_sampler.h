#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sigmascape/bake/bake_settings.h"
#include "sigmascape/bake/cell_sum.h"
#include "sigmascape/bake/echo_landing.h"
#include "sigmascape/bake/sampling.h"
#include "sigmascape/receiver/ground_accumulator.h"
#include "sigmascape/trace/path_tracer.h"

namespace sigmascape::bake {

/// Gives each cell of a tile the rays that it needs and adds what they bring to the patch. One a thread: it keeps
/// scratch space.
class TileSampler {
 public:
  /// `patch` has one accumulator a frequency; all are held by reference.
  TileSampler(const Sampling& sampling, Shadows shadows, const EchoLanding& landing,
              std::vector<receiver::GroundAccumulator>& patch);

  void sample(trace::TilePaths& tile, double cell_area_m2);

 private:
  /// What the pilots of a cell say of the power of one sample, all texels together.
  struct Pilot {
    double mean_m2 = 0.0;
    double variance_m4 = 0.0;
  };

  void trace_pilots(trace::TilePaths& tile);
  [[nodiscard]] std::uint32_t samples_needed(std::span<const trace::LaunchCell> cells, std::size_t cell,
                                             double cell_area_m2) const;
  void trace_cell(trace::TilePaths& tile, std::size_t cell, const Batches& batches, std::uint32_t pilots);
  /// Follows a sample, keeps what lands in the patch, and returns the power of all echoes by frequency in `powers_`.
  void follow(trace::TilePaths& tile, std::size_t cell, std::uint32_t batch, std::uint32_t sample,
              std::vector<std::vector<Landed>>& landed);

  const Sampling& sampling_;
  bool ground_apart_;
  const EchoLanding& landing_;
  std::vector<receiver::GroundAccumulator>& patch_;
  double target_;                                       // relative standard error
  double floor_;                                        // σ0
  std::vector<std::vector<Pilot>> pilots_;              // [frequency][cell]
  std::vector<std::vector<Landed>> pilot_echoes_;       // [frequency], cell by cell
  std::vector<std::vector<std::size_t>> pilot_starts_;  // [frequency][cell]: the cell's first
  std::vector<std::vector<Landed>> cell_echoes_;        // [frequency]
  std::vector<double> powers_;
};

}  // namespace sigmascape::bake
