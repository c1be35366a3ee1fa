#include "sigmascape/product/metric_text.h"

#include <limits>

#include "sigmascape/product/number_text.h"

namespace sigmascape::product {

double metric_of(const MetricColumn& column, const CellComparison& comparison) {
  const bool is_of_few = column.value == &CellComparison::shadow_iou && comparison.shadow_cells < least_shadow_cells;
  return is_of_few ? std::numeric_limits<double>::quiet_NaN() : comparison.*column.value;
}

std::string metric_text(const MetricColumn& column, const CellComparison& comparison, const char* none) {
  const double value = metric_of(column, comparison);
  return column.with_sign ? signed_text(value, column.decimals, none) : number_text(value, column.decimals, none);
}

}  // namespace sigmascape::product
