#include "sigmascape/product/metric_text.h"

#include <cmath>
#include <fmt/format.h>

namespace sigmascape::product {

std::string metric_text(const MetricColumn& column, const CellComparison& comparison, const char* none) {
  const double value = comparison.*column.value;
  const bool is_of_few = column.value == &CellComparison::shadow_iou && comparison.shadow_cells < least_shadow_cells;
  if (is_of_few || std::isnan(value)) return none;
  const bool rounds_to_nothing = std::abs(value) < 0.5 * std::pow(10.0, -column.decimals);
  if (column.with_sign && !rounds_to_nothing) return fmt::format("{:+.{}f}", value, column.decimals);
  return fmt::format("{:.{}f}", rounds_to_nothing ? 0.0 : value, column.decimals);
}

}  // namespace sigmascape::product
