#include "results/tile_power.h"

#include <cmath>

#include "sigmascape/product/block_mean.h"
#include "sigmascape/product/same_cells.h"

namespace sigmascape::cli {

std::size_t give_power_of_tiles(radar::GroundMap& map, const radar::GroundMap& reference) {
  const std::size_t factor = product::required_block_factor(power_tile_m, map.grid);
  const Array2D<double> given = product::block_mean(map, radar::Polarization::Sum, factor);
  const Array2D<double> wanted = product::block_mean(reference, radar::Polarization::Sum, factor);
  for (std::size_t row = 0; row < given.rows() * factor; ++row) {
    for (std::size_t column = 0; column < given.columns() * factor; ++column) {
      const double gain = wanted(column / factor, row / factor) / given(column / factor, row / factor);
      if (std::isfinite(gain)) map.sigma0(column, row) = map.sigma0(column, row) * static_cast<float>(gain);
    }
  }
  return given.size();
}

}  // namespace sigmascape::cli
