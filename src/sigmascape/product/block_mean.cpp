#include "sigmascape/product/block_mean.h"

namespace sigmascape::product {

Array2D<double> block_mean(const Array2D<radar::Channels>& cells, radar::Polarization polarization,
                           std::size_t factor) {
  Array2D<double> sums(cells.columns() / factor, cells.rows() / factor, 0.0);
  for (std::size_t row = 0; row < sums.rows() * factor; ++row) {
    const auto line = cells.row(row);
    const auto blocks = sums.row(row / factor);
    for (std::size_t column = 0; column < sums.columns() * factor; ++column) {
      blocks[column / factor] += static_cast<double>(line[column].power(polarization));
    }
  }
  for (double& value : sums.values()) value /= static_cast<double>(factor * factor);
  return sums;
}

}  // namespace sigmascape::product
