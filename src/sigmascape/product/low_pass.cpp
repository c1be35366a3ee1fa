#include "sigmascape/product/low_pass.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace sigmascape::product {
namespace {

/// The right half of the Gaussian, its centre first, so scaled that the whole sums to one.
std::vector<double> half_kernel(double width_cells) {
  std::vector<double> kernel(static_cast<std::size_t>(std::ceil(3.0 * width_cells)) + 1);
  double sum = 0.0;
  for (std::size_t i = 0; i < kernel.size(); ++i) {
    const double offset = static_cast<double>(i) / width_cells;
    kernel[i] = std::exp(-0.5 * offset * offset);
    sum += i == 0 ? kernel[i] : 2.0 * kernel[i];
  }
  for (double& weight : kernel) weight /= sum;
  return kernel;
}

/// Adds `weight` times each row of `from` to the row `offset` below it and the one `offset` above it, in `to`.
void spread_down_and_up(const Array2D<double>& from, std::size_t offset, double weight, Array2D<double>& to) {
  for (std::size_t row = 0; row + offset < from.rows(); ++row) {
    for (std::size_t column = 0; column < from.columns(); ++column) {
      to(column, row + offset) += weight * from(column, row);
      to(column, row) += weight * from(column, row + offset);
    }
  }
}

void spread_right_and_left(const Array2D<double>& from, std::size_t offset, double weight, Array2D<double>& to) {
  for (std::size_t row = 0; row < from.rows(); ++row) {
    for (std::size_t column = 0; column + offset < from.columns(); ++column) {
      to(column + offset, row) += weight * from(column, row);
      to(column, row) += weight * from(column + offset, row);
    }
  }
}

template <typename Spread>
Array2D<double> convolved(const Array2D<double>& values, const std::vector<double>& kernel, Spread spread) {
  Array2D<double> result(values.columns(), values.rows(), 0.0);
  spread(values, 0, 0.5 * kernel[0], result);
  for (std::size_t offset = 1; offset < kernel.size(); ++offset) spread(values, offset, kernel[offset], result);
  return result;
}

/// With nothing beyond the edges.
Array2D<double> convolved(const Array2D<double>& values, const std::vector<double>& kernel) {
  return convolved(convolved(values, kernel, spread_right_and_left), kernel, spread_down_and_up);
}

}  // namespace

Array2D<double> low_pass(const Array2D<double>& power, double width_cells) {
  if (!(width_cells > 0.0)) return power;
  Array2D<double> seen_power = power;
  Array2D<double> seen(power.columns(), power.rows(), 1.0);
  for (std::size_t i = 0; i < power.size(); ++i) {
    if (std::isnan(power.values()[i])) seen.values()[i] = seen_power.values()[i] = 0.0;
  }
  const std::vector<double> kernel = half_kernel(width_cells);
  const Array2D<double> weight = convolved(seen, kernel);
  Array2D<double> smooth = convolved(seen_power, kernel);
  for (std::size_t i = 0; i < power.size(); ++i) {
    const double original = power.values()[i];
    smooth.values()[i] = std::isnan(original) ? original : smooth.values()[i] + original * (1.0 - weight.values()[i]);
  }
  return smooth;
}

}  // namespace sigmascape::product
