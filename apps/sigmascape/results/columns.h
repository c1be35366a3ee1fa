#pragma once

#include <cstdint>
#include <string>

#include "results/plan.h"
#include "results/table.h"

#include "sigmascape/product/map_metrics.h"

namespace sigmascape::cli {

/// How the tables of the page write their numbers, and the columns that they have in common.

/// "0.83"; a dash for what is not defined. What rounds to nothing has no sign.
[[nodiscard]] std::string number_text(double value, int decimals);
/// The same with its sign: "+0.83".
[[nodiscard]] std::string signed_text(double value, int decimals);
/// How many decimals, at least so many, it takes to see on which side of an aim a value lies: 4 for 0.9896 beside 0.99,
/// which three would show as reached. Six at most.
[[nodiscard]] int decimals_that_tell(double value, double aim, int at_least);
/// At least two digits that count, and no power of ten: "0.018", "0.43", "1.9", "81", "238".
[[nodiscard]] std::string two_digits(double value);
/// "5.02 dB": the median RMS at summary_cell_m, which the row has.
[[nodiscard]] std::string rms_text(const ResultsRow& row);
/// "26.84".
[[nodiscard]] std::string megabytes(std::uintmax_t bytes);

inline constexpr const char* metric_heads = "correlation of dB | RMS [dB] | bias [dB] | relative L1 | shadow IoU";
inline constexpr const char* metric_rules = "---:|---:|---:|---:|---:";

/// The cells below metric_heads.
[[nodiscard]] std::string metrics_text(const product::CellComparison& cell);
/// The same over several views: medians and, in brackets, the worst values; of one view its own. Where the overlap of
/// shadows is of fewer views their number stands behind it.
[[nodiscard]] std::string metrics_text(const product::CellComparison& median, const product::CellComparison& worst,
                                       std::size_t views, std::size_t shadow_views);
/// The same of a row at one of its cell sizes.
[[nodiscard]] std::string metrics_text(const ResultsRow& row, const ResultsCell& cell);
/// The same of one traced map against another at the row's views.
[[nodiscard]] std::string floor_text(const ResultsRow& row, const ResultsCell& cell);
/// Cells of correlation, RMS, L1 and IoU alone.
[[nodiscard]] std::string error_text(const product::CellComparison& cell);

/// The first column of tables about several scenes; nothing where a page is about one.
class SceneColumn {
 public:
  explicit SceneColumn(const ResultsPlan& plan) : is_shown_(plan.has_level_ground()) {}

  [[nodiscard]] std::string head() const { return is_shown_ ? " scene |" : ""; }
  [[nodiscard]] std::string rule() const { return is_shown_ ? "---|" : ""; }
  [[nodiscard]] std::string cell(const std::string& scene) const { return is_shown_ ? " " + scene + " |" : ""; }

 private:
  bool is_shown_;
};

}  // namespace sigmascape::cli
