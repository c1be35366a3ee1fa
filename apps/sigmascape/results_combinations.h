#pragma once

#include <string>
#include <vector>

#include "results_plan.h"
#include "results_table.h"

namespace sigmascape::cli {

/// The way to a map with the least RMS of dB at held-out views, among those with no more bytes than `most_bytes`;
/// nullptr for none. Ways that need a finer grid's maps to be made are none.
[[nodiscard]] const ResultsRow* best_combination(const ResultsPlan& plan, const std::vector<ResultsRow>& rows,
                                                 std::uintmax_t most_bytes);

/// What the mean squared error of a way at held-out views is made of. Medians over the views are taken for means, so
/// the parts are rough.
struct ErrorParts {
  double all_db2 = 0.0;
  double missing_angles_db2 = 0.0;  ///< what the view's own look does not have
  double truth_noise_db2 = 0.0;     ///< of the mean of two traced maps
  double rest_db2 = 0.0;            ///< what stays of the view's own look: the bake's noise, its texels and mips
};

/// From the RMS of the way, of the view's own look, and of one traced map against another.
[[nodiscard]] ErrorParts error_parts(double rms_db, double own_look_rms_db, double traced_rms_db);

/// Markdown: the paper's method at held-out views, beside it the best combination of the changes that takes no more
/// bytes and the best of all, and what limits each; empty without held-out views.
[[nodiscard]] std::string combinations_section(const ResultsPlan& plan, const std::vector<ResultsRow>& rows);

}  // namespace sigmascape::cli
