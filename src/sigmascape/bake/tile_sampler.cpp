#include "sigmascape/bake/tile_sampler.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "sigmascape/base/units.h"

namespace sigmascape::bake {
namespace {

/// Cells whose pilots have a say in a cell's number of samples are at most this many away along either axis.
constexpr int neighbourhood = 2;

}  // namespace

TileSampler::TileSampler(const Sampling& sampling, Shadows shadows, const EchoLanding& landing,
                         std::vector<receiver::GroundAccumulator>& patch)
    : sampling_(sampling),
      ground_apart_(shadows == Shadows::RunTime),
      landing_(landing),
      patch_(patch),
      target_(linear_from_db(sampling.target_db) - 1.0),
      floor_(linear_from_db(sampling.floor_db)),
      pilots_(patch.size()),
      pilot_echoes_(patch.size()),
      pilot_starts_(patch.size()),
      cell_echoes_(patch.size()),
      powers_(patch.size()) {}

void TileSampler::sample(trace::TilePaths& tile, double cell_area_m2) {
  if (!sampling_.is_adaptive()) {
    const Batches batches = Batches::of(sampling_.samples_per_texel);
    for (std::size_t cell = 0; cell < tile.cells().size(); ++cell) trace_cell(tile, cell, batches, 0);
    return;
  }
  trace_pilots(tile);
  for (std::size_t cell = 0; cell < tile.cells().size(); ++cell) {
    const std::uint32_t samples = samples_needed(tile.cells(), cell, cell_area_m2);
    trace_cell(tile, cell, Batches::of(samples, pilot_samples), 1);
  }
}

void TileSampler::follow(trace::TilePaths& tile, std::size_t cell, std::uint32_t batch, std::uint32_t sample,
                         std::vector<std::vector<Landed>>& landed) {
  tile.follow(tile.cells()[cell], batch, sample);
  for (std::size_t f = 0; f < patch_.size(); ++f) {
    powers_[f] = 0.0;
    for (const radar::Echo& echo : tile.echoes(f)) {
      if (ground_apart_ && echo.from_ground) continue;
      powers_[f] += static_cast<double>(echo.rcs_m2.power(radar::Polarization::Sum));
      if (const auto texel = patch_[f].cell_at(landing_.place_of(echo)))
        landed[f].push_back({*texel, batch, echo.rcs_m2});
    }
  }
}

void TileSampler::trace_pilots(trace::TilePaths& tile) {
  const std::size_t cells = tile.cells().size(), frequencies = patch_.size();
  for (std::size_t f = 0; f < frequencies; ++f) {
    pilots_[f].assign(cells, {});
    pilot_echoes_[f].clear();
    pilot_starts_[f].clear();
  }
  for (std::size_t cell = 0; cell < cells; ++cell) {
    for (std::size_t f = 0; f < frequencies; ++f) pilot_starts_[f].push_back(pilot_echoes_[f].size());
    for (std::uint32_t batch = 0; batch < pilot_samples; ++batch) {
      follow(tile, cell, batch, 0, pilot_echoes_);
      for (std::size_t f = 0; f < frequencies; ++f) {
        // Mean and sum of squares about it, updated sample by sample.
        Pilot& pilot = pilots_[f][cell];
        const double before = powers_[f] - pilot.mean_m2;
        pilot.mean_m2 += before / (batch + 1);
        pilot.variance_m4 += before * (powers_[f] - pilot.mean_m2);
      }
    }
    for (std::size_t f = 0; f < frequencies; ++f) pilots_[f][cell].variance_m4 /= pilot_samples - 1;
  }
  for (std::size_t f = 0; f < frequencies; ++f) pilot_starts_[f].push_back(pilot_echoes_[f].size());
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

void TileSampler::trace_cell(trace::TilePaths& tile, std::size_t cell, const Batches& batches, std::uint32_t pilots) {
  for (std::size_t f = 0; f < patch_.size(); ++f) {
    cell_echoes_[f].clear();
    if (pilots == 0) continue;
    const auto first = pilot_echoes_[f].begin();
    cell_echoes_[f].assign(first + static_cast<std::ptrdiff_t>(pilot_starts_[f][cell]),
                           first + static_cast<std::ptrdiff_t>(pilot_starts_[f][cell + 1]));
  }
  for (std::uint32_t batch = 0; batch < batches.count; ++batch) {
    for (std::uint32_t sample = batch < pilots * pilot_samples ? 1 : 0; sample < batches.size(batch); ++sample) {
      follow(tile, cell, batch, sample, cell_echoes_);
    }
  }
  for (std::size_t f = 0; f < patch_.size(); ++f) add_cell(cell_echoes_[f], batches, patch_[f]);
}

}  // namespace sigmascape::bake
