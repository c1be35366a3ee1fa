#include "sigmascape/simulate/error_of_passes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sigmascape/base/units.h"

namespace sigmascape::simulate {
namespace {

/// Median of the square root of a variance that was estimated with so many degrees of freedom, over the root of the
/// true variance: the median of chi-squared by Wilson and Hilferty.
double median_of_estimated_deviation(double freedom) {
  return std::pow(1.0 - 2.0 / (9.0 * freedom), 1.5);
}

}  // namespace

double relative_error_of_mean(double sum, double squares, double passes) {
  const double scatter = std::max(squares - sum * sum / passes, 0.0);
  return std::sqrt(scatter * passes / (passes - 1.0)) / sum;
}

double median_error_db(std::vector<double> relative_errors, double passes) {
  if (relative_errors.empty()) return 0.0;
  const auto middle = relative_errors.begin() + static_cast<std::ptrdiff_t>(relative_errors.size() / 2);
  std::ranges::nth_element(relative_errors, middle);
  return db_from_linear(1.0 + *middle / median_of_estimated_deviation(passes - 1.0));
}

}  // namespace sigmascape::simulate
