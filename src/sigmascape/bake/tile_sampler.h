#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sigmascape/bake/bake_settings.h"
#include "sigmascape/bake/cell_sum.h"
#include "sigmascape/bake/echo_landing.h"
#include "sigmascape/bake/patch_sums.h"
#include "sigmascape/bake/sampling.h"
#include "sigmascape/trace/path_tracer.h"

namespace sigmascape::bake {

/// Gives each cell of a tile the rays that it needs and adds what they bring to the patch. One a thread: it keeps
/// scratch space.
class TileSampler {
 public:
  /// `patch` has the sums of one frequency after the other; it and `landing` are held by reference, as is the sampling
  /// of the settings.
  TileSampler(const BakeSettings& settings, const EchoLanding& landing, std::vector<PatchSums>& patch);

  void sample(trace::TilePaths& tile, double cell_area_m2);

  /// The rays that the cells so far were found to need, each for as much as its share. Cells of a small share get a few
  /// more than their part, for two or the pilots are the fewest; those are not in it.
  [[nodiscard]] double samples_of_whole_cells() const { return samples_of_whole_cells_; }

 private:
  /// What the pilots of a cell say of the power of one sample, all texels together: of all of it, and how that varies
  /// which goes into the textures.
  struct Pilot {
    double mean_m2 = 0.0;
    double variance_m4 = 0.0;
  };
  /// The power of what a start brought.
  struct Brought {
    double own_m2 = 0.0, of_buildings_m2 = 0.0;  ///< for the textures, and of buildings that are kept apart
  };

  /// Numbers from `first` up to before `end`.
  struct Range {
    std::size_t first = 0;
    std::size_t end = 0;
  };

  /// Notes what a cell gets of a number of samples.
  void give(const trace::LaunchCell& cell, std::uint32_t samples, std::uint32_t fewest);
  void trace_pilots(trace::TilePaths& tile);
  void note_pilots(const trace::TilePaths& tile, std::size_t frequency, std::size_t cell);
  [[nodiscard]] std::uint32_t samples_needed(std::span<const trace::LaunchCell> cells, std::size_t cell,
                                             double cell_area_m2) const;
  /// Traces the samples of each cell beyond its pilots, which are the first of them, and adds all to the patch.
  void trace_cells(trace::TilePaths& tile, std::uint32_t pilots);
  /// The samples from `first` up to before `end` of one cell.
  void ask_for(const trace::LaunchCell& cell, std::uint32_t first, std::uint32_t end);
  /// Follows the starts of one cell, and adds what they and its pilots bring to the patch.
  void trace_cell(trace::TilePaths& tile, std::size_t cell, Range starts, bool has_pilots);
  /// Some of those asked for, from where the last ended: of many a part, or what they bring would take much memory.
  void follow_next(trace::TilePaths& tile);
  /// Keeps what a start that was followed last brought that lands in the patch, and returns the power of all of it.
  Brought keep_landed(const trace::TilePaths& tile, std::size_t frequency, std::size_t start,
                      std::vector<Landed>& landed) const;

  const Sampling& sampling_;
  bool ground_apart_, buildings_apart_;
  const EchoLanding& landing_;
  std::vector<PatchSums>& patch_;
  double target_;                                     // relative standard error
  double floor_;                                      // σ0
  std::vector<std::uint32_t> samples_;                // [cell]: how many
  double samples_of_whole_cells_ = 0.0;               // shares are powers of two: the same sum in any order
  std::vector<trace::PathStart> starts_;              // asked for
  Range followed_;                                    // of these last
  std::vector<std::vector<Pilot>> pilots_;            // [frequency][cell]
  std::vector<std::vector<Landed>> pilot_echoes_;     // [frequency], cell by cell
  std::vector<std::vector<std::size_t>> pilot_ends_;  // [frequency][cell]: one past the cell's last
  std::vector<std::vector<Landed>> cell_echoes_;      // [frequency]
  CellSum cell_sum_;
};

}  // namespace sigmascape::bake
