#include "sigmascape/dataset/speckle.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "sigmascape/base/hash.h"
#include "sigmascape/radar/scatterer_lattice.h"

namespace sigmascape::dataset {
namespace {

radar::ComplexChannels steady(const radar::Channels& power) {
  const auto amplitude = [](float p) { return std::complex<float>(std::sqrt(std::max(0.0F, p)), 0.0F); };
  return {amplitude(power.vv), amplitude(power.hh), amplitude(power.hv)};
}

/// The scatterers of the ground and the noise of one look; the noise of the polarizations is independent.
class LookDraws {
 public:
  explicit LookDraws(std::uint64_t seed)
      : ground_({.seed = hashed(seed, 1), .cell_m = 1.0, .levels = 1}),
        noise_({.seed = hashed(seed, 2), .cell_m = 1.0, .levels = 1}) {}

  [[nodiscard]] radar::ComplexChannels ground(radar::LatticeCell cell, const radar::Channels& mean) const {
    return radar::polarized(ground_.drawn(cell, 0), mean);
  }
  [[nodiscard]] radar::ComplexChannels noise(radar::LatticeCell cell, float power) const {
    return radar::polarized(noise_.drawn(cell, 0), {power, power, power, 0.0F});
  }

 private:
  radar::ScattererLattice ground_, noise_;
};

}  // namespace

void draw_speckle(radar::GroundMap& map, const Array2D<radar::Channels>& targets, const SpeckleSettings& settings) {
  const std::size_t looks = std::max<std::size_t>(1, settings.looks);
  Array2D<radar::Channels> sums(map.grid.columns, map.grid.rows);
  for (std::size_t look = 0; look < looks; ++look) {
    const LookDraws draws(hashed(settings.seed, look));
    for (std::size_t row = 0; row < map.grid.rows; ++row) {
      for (std::size_t column = 0; column < map.grid.columns; ++column) {
        const radar::LatticeCell cell{static_cast<std::int32_t>(column), static_cast<std::int32_t>(row)};
        const radar::Channels mean = map.sigma0(column, row);
        radar::ComplexChannels amplitude = settings.looks == 0 ? steady(mean) : draws.ground(cell, mean);
        if (!targets.empty()) amplitude += steady(targets(column, row));
        if (settings.noise > 0.0F) amplitude += draws.noise(cell, settings.noise);
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
