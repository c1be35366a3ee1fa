#include "sigmascape/dataset/speckle.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "sigmascape/base/hash.h"
#include "sigmascape/radar/scatterer_lattice.h"

namespace sigmascape::dataset {
namespace {

radar::ComplexChannels steady(const radar::Channels& power) {
  const auto amplitude = [](float p) { return std::complex<float>(std::sqrt(std::max(0.0F, p)), 0.0F); };
  return {amplitude(power.vv), amplitude(power.hh), amplitude(power.hv)};
}

/// The draws of one row of cells after another.
class RowDraws {
 public:
  RowDraws(std::uint64_t seed, std::size_t columns)
      : lattice_({.seed = seed, .cell_m = 1.0, .levels = 1}), columns_(columns), rows_(columns), draws_(columns) {
    std::iota(columns_.begin(), columns_.end(), 0);
  }

  std::span<const radar::DrawnCell> row(std::size_t index) {
    std::ranges::fill(rows_, static_cast<std::int32_t>(index));
    std::vector<float> re(columns_.size()), im(columns_.size());
    for (const auto& [draw, value] : {std::pair{radar::Draw::First, &radar::DrawnCell::first},
                                      {radar::Draw::Second, &radar::DrawnCell::second},
                                      {radar::Draw::Third, &radar::DrawnCell::third}}) {
      lattice_.values_of(columns_, rows_, 0, draw, re, im);
      for (std::size_t i = 0; i < draws_.size(); ++i) draws_[i].*value = {re[i], im[i]};
    }
    return draws_;
  }

 private:
  radar::ScattererLattice lattice_;
  std::vector<std::int32_t> columns_, rows_;
  std::vector<radar::DrawnCell> draws_;
};

/// The scatterers of the ground and the noise of one look; the noise of the polarizations is independent.
struct LookDraws {
  RowDraws ground, noise;
  LookDraws(std::uint64_t seed, std::size_t columns)
      : ground(hashed(seed, 1), columns), noise(hashed(seed, 2), columns) {}
};

}  // namespace

void draw_speckle(radar::GroundMap& map, const Array2D<radar::Channels>& targets, const SpeckleSettings& settings) {
  const std::size_t looks = std::max<std::size_t>(1, settings.looks);
  const radar::Channels of_noise = even_noise(settings.noise);
  Array2D<radar::Channels> sums(map.grid.columns, map.grid.rows);
  for (std::size_t look = 0; look < looks; ++look) {
    LookDraws draws(hashed(settings.seed, look), map.grid.columns);
    for (std::size_t row = 0; row < map.grid.rows; ++row) {
      const auto ground = settings.looks == 0 ? std::span<const radar::DrawnCell>{} : draws.ground.row(row);
      const auto noise = settings.noise > 0.0F ? draws.noise.row(row) : std::span<const radar::DrawnCell>{};
      for (std::size_t column = 0; column < map.grid.columns; ++column) {
        const radar::Channels mean = map.sigma0(column, row);
        const radar::Channels target = targets.empty() ? radar::Channels() : targets(column, row);
        // Without speckle ground and target have no phase between them: in the mean over all phases powers add.
        radar::ComplexChannels amplitude =
            ground.empty() ? steady(mean + target) : radar::polarized(ground[column], mean) + steady(target);
        if (!noise.empty()) amplitude += radar::polarized(noise[column], of_noise);
        sums(column, row) += radar::power_of(amplitude);
      }
    }
  }
  const float share = 1.0F / static_cast<float>(looks);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    radar::Channels& cell = map.sigma0.values()[i];
    if (!std::isnan(cell.vv)) cell = sums.values()[i] * share;
  }
}

}  // namespace sigmascape::dataset
