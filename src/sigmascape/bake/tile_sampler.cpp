#include "sigmascape/bake/tile_sampler.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "sigmascape/base/units.h"
#include "sigmascape/trace/tile_tracer.h"

namespace sigmascape::bake {
namespace {

/// Cells whose pilots have a say in a cell's number of samples are at most this many away along either axis.
constexpr int neighbourhood = 2;

/// A pair, or there is no telling how far off their mean is.
constexpr std::uint32_t fewest_samples = 2;

/// What a cell gets of a number of samples.
std::uint32_t spared(std::uint32_t samples, const trace::LaunchCell& cell, std::uint32_t fewest) {
  return std::max(static_cast<std::uint32_t>(std::ceil(static_cast<float>(samples) * cell.share)),
                  std::min(fewest, samples));
}

}  // namespace

TileSampler::TileSampler(const BakeSettings& settings, const EchoLanding& landing, std::vector<PatchSums>& patch)
    : sampling_(settings.sampling),
      ground_apart_(settings.shadows == Shadows::RunTime),
      buildings_apart_(settings.buildings != Buildings::Baked),
      landing_(landing),
      patch_(patch),
      target_(sampling_.relative_target()),
      floor_(linear_from_db(sampling_.floor_db)),
      pilots_(patch.size()),
      pilot_echoes_(patch.size()),
      pilot_ends_(patch.size()),
      cell_echoes_(patch.size()) {}

void TileSampler::sample(trace::TilePaths& tile, double cell_area_m2) {
  const auto cells = tile.cells();
  samples_.clear();
  if (!sampling_.is_adaptive()) {
    for (const trace::LaunchCell& cell : cells) give(cell, sampling_.samples_per_texel, fewest_samples);
    trace_cells(tile, 0);
    return;
  }
  trace_pilots(tile);
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
    give(cells[cell], samples_needed(cells, cell, cell_area_m2), pilot_samples);
  trace_cells(tile, pilot_samples);
}

void TileSampler::give(const trace::LaunchCell& cell, std::uint32_t samples, std::uint32_t fewest) {
  samples_.push_back(spared(samples, cell, fewest));
  samples_of_whole_cells_ += static_cast<double>(samples) * static_cast<double>(cell.share);
}

TileSampler::Brought TileSampler::keep_landed(const trace::TilePaths& tile, std::size_t frequency, std::size_t start,
                                              std::vector<Landed>& landed) const {
  Brought brought;
  for (const radar::Echo& echo : tile.echoes(frequency, start - followed_.first)) {
    // Maps make these themselves, from the ground and from buildings.
    if (ground_apart_ && echo.from_ground) continue;
    const bool apart = buildings_apart_ && echo.from_building;
    (apart ? brought.of_buildings_m2 : brought.own_m2) +=
        static_cast<double>(echo.rcs_m2.power(radar::Polarization::Sum));
    if (const auto texel = patch_[frequency].all.cell_at(landing_.place_of(echo)))
      landed.push_back({*texel, starts_[start].sample, echo.bounces > 1, apart, echo.rcs_m2});
  }
  return brought;
}

void TileSampler::trace_pilots(trace::TilePaths& tile) {
  starts_.clear();
  for (const trace::LaunchCell& cell : tile.cells()) ask_for(cell, 0, pilot_samples);
  followed_ = {0, starts_.size()};
  tile.follow(starts_);
  for (std::size_t f = 0; f < patch_.size(); ++f) {
    pilots_[f].clear();
    pilot_echoes_[f].clear();
    pilot_ends_[f].clear();
    for (std::size_t cell = 0; cell < tile.cells().size(); ++cell) note_pilots(tile, f, cell);
  }
}

void TileSampler::note_pilots(const trace::TilePaths& tile, std::size_t frequency, std::size_t cell) {
  Pilot pilot;
  double of_buildings_m2 = 0.0;
  for (std::uint32_t sample = 0; sample < pilot_samples; ++sample) {
    // Mean and sum of squares about it, updated sample by sample.
    const Brought brought = keep_landed(tile, frequency, cell * pilot_samples + sample, pilot_echoes_[frequency]);
    const double before = brought.own_m2 - pilot.mean_m2;
    pilot.mean_m2 += before / (sample + 1);
    pilot.variance_m4 += before * (brought.own_m2 - pilot.mean_m2);
    of_buildings_m2 += brought.of_buildings_m2;
  }
  pilot.mean_m2 += of_buildings_m2 / pilot_samples;
  pilot.variance_m4 /= pilot_samples - 1;
  pilots_[frequency].push_back(pilot);
  pilot_ends_[frequency].push_back(pilot_echoes_[frequency].size());
}

std::uint32_t TileSampler::samples_needed(std::span<const trace::LaunchCell> cells, std::size_t cell,
                                          double cell_area_m2) const {
  double most = 0.0;
  for (const std::vector<Pilot>& pilots : pilots_) {
    Pilot sum;
    int neighbours = 0;
    for (std::size_t other = 0; other < cells.size(); ++other) {
      if (other == cell || std::abs(cells[other].i - cells[cell].i) > neighbourhood ||
          std::abs(cells[other].j - cells[cell].j) > neighbourhood) {
        continue;
      }
      sum.mean_m2 += pilots[other].mean_m2;
      sum.variance_m4 += pilots[other].variance_m4;
      ++neighbours;
    }
    const double aim = target_ * std::max(sum.mean_m2, floor_ * cell_area_m2 * neighbours);
    if (sum.variance_m4 > 0.0) most = std::max(most, sum.variance_m4 * neighbours / (aim * aim));
  }
  const double samples = std::min(std::ceil(most), static_cast<double>(sampling_.most_samples));
  return std::max(static_cast<std::uint32_t>(samples), pilot_samples);
}

void TileSampler::trace_cells(trace::TilePaths& tile, std::uint32_t pilots) {
  const auto cells = tile.cells();
  std::size_t in_all = 0;
  for (const std::uint32_t samples : samples_) in_all += samples;
  const std::size_t a_part = in_all / trace::waves_of(in_all);
  std::vector<std::size_t> ends;  // of each cell's starts
  for (std::size_t first = 0; first < cells.size(); first += ends.size()) {
    starts_.clear();
    ends.clear();
    while (first + ends.size() < cells.size() && starts_.size() < a_part) {
      const std::size_t cell = first + ends.size();
      ask_for(cells[cell], pilots, samples_[cell]);
      ends.push_back(starts_.size());
    }
    followed_ = {};
    for (std::size_t i = 0; i < ends.size(); ++i)
      trace_cell(tile, first + i, {i == 0 ? 0 : ends[i - 1], ends[i]}, pilots > 0);
  }
}

void TileSampler::trace_cell(trace::TilePaths& tile, std::size_t cell, Range starts, bool has_pilots) {
  for (std::size_t f = 0; f < patch_.size(); ++f) {
    cell_echoes_[f].clear();
    if (!has_pilots) continue;
    const auto begin = pilot_echoes_[f].begin();
    cell_echoes_[f].assign(begin + static_cast<std::ptrdiff_t>(cell == 0 ? 0 : pilot_ends_[f][cell - 1]),
                           begin + static_cast<std::ptrdiff_t>(pilot_ends_[f][cell]));
  }
  for (std::size_t start = starts.first; start < starts.end;) {
    if (start == followed_.end) follow_next(tile);
    const std::size_t end = std::min(starts.end, followed_.end);
    for (std::size_t f = 0; f < patch_.size(); ++f) {
      for (std::size_t i = start; i < end; ++i) keep_landed(tile, f, i, cell_echoes_[f]);
    }
    start = end;
  }
  for (std::size_t f = 0; f < patch_.size(); ++f)
    cell_sum_.add(cell_echoes_[f], SamplePairs(samples_[cell]), patch_[f]);
}

void TileSampler::follow_next(trace::TilePaths& tile) {
  // The waves that the tracer would make of them all: no path goes in other company, and echoes of a wave take memory.
  const std::size_t parts = trace::waves_of(starts_.size()),
                    part = (followed_.end * parts + starts_.size() - 1) / starts_.size();
  followed_ = {followed_.end, (part + 1) * starts_.size() / parts};
  tile.follow(std::span(starts_).subspan(followed_.first, followed_.end - followed_.first));
}

void TileSampler::ask_for(const trace::LaunchCell& cell, std::uint32_t first, std::uint32_t end) {
  for (std::uint32_t sample = first; sample < end; ++sample)
    starts_.push_back({.cell = cell, .sequence = 0, .sample = sample});
}

}  // namespace sigmascape::bake
