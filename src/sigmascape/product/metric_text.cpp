#include "sigmascape/product/metric_text.h"

#include "sigmascape/product/number_text.h"

namespace sigmascape::product {

std::string metric_text(const MetricColumn& column, const CellComparison& comparison, const char* none) {
  const bool is_of_few = column.value == &CellComparison::shadow_iou && comparison.shadow_cells < least_shadow_cells;
  if (is_of_few) return none;
  const double value = comparison.*column.value;
  return column.with_sign ? signed_text(value, column.decimals, none) : number_text(value, column.decimals, none);
}

}  // namespace sigmascape::product
