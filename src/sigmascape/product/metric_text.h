#pragma once

#include <array>
#include <string>

#include "sigmascape/product/map_metrics.h"

namespace sigmascape::product {

/// How a metric of two maps is written.
struct MetricColumn {
  const char* key;      ///< in JSON and plain tables
  const char* heading;  ///< for readers
  double CellComparison::*value;
  int decimals;
  bool with_sign;
};

/// All five, in the order in which they are told.
inline constexpr std::array<MetricColumn, 5> metric_columns = {{
    {"correlation_db", "correlation of dB", &CellComparison::correlation_db, 3, false},
    {"rms_db", "RMS [dB]", &CellComparison::rms_db, 2, false},
    {"bias_db", "bias [dB]", &CellComparison::bias_db, 2, true},
    {"l1", "relative L1", &CellComparison::l1, 3, false},
    {"shadow_iou", "shadow IoU", &CellComparison::shadow_iou, 3, false},
}};

/// The metric of a comparison as it may be told: not a number for an overlap of fewer than `least_shadow_cells`.
[[nodiscard]] double metric_of(const MetricColumn& column, const CellComparison& comparison);

/// The same in words; `none` where it is not a number. What rounds to nothing has no sign.
[[nodiscard]] std::string metric_text(const MetricColumn& column, const CellComparison& comparison, const char* none);

}  // namespace sigmascape::product
