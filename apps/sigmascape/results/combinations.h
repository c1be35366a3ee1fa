#pragma once

#include <string>
#include <vector>

#include "results/plan.h"
#include "results/table.h"

namespace sigmascape::cli {

/// The way to a map with the least RMS of dB at held-out views, among those with no more bytes than `most_bytes`;
/// nullptr for none. Of ways whose medians lie within least_fall_db of the least, it is the one that is closer at more
/// of the views. Ways that need a finer grid's maps to be made are none.
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

/// Two traced maps that differ by so much in RMS of dB, or in relative L1, each have the noise σ = difference / √2, and
/// their mean has σ / √2: a map without fault or noise of its own differs from the mean by half of the difference.
[[nodiscard]] constexpr double least_error(double traced_difference) {
  return traced_difference / 2.0;
}

/// With the noise of two traced maps alike and independent, a map without any correlates with their mean by
/// √(2ρ / (1 + ρ)) of their own correlation ρ.
[[nodiscard]] double most_correlation(double traced_correlation);

/// Markdown: the paper's method at held-out views, beside it ours from the same looks, the best way that takes no more
/// bytes, the best of all, and the paper's from the looks of that; below it the rule by which the best are told, and
/// what no error can be shown below. Empty without held-out views.
[[nodiscard]] std::string combinations_table(const ResultsPlan& plan, const std::vector<ResultsRow>& rows);

/// Markdown: what limits each of these.
[[nodiscard]] std::string limits_section(const ResultsPlan& plan, const std::vector<ResultsRow>& rows);

/// What is found, in a few sentences with few numbers: what is compared; how far our maps and the paper's are from
/// traced ones at held-out views, from the paper's looks; how far the best are; what such a map takes, and a traced one
/// that is as close. Empty without held-out views.
[[nodiscard]] std::string verdict(const ResultsPlan& plan, const std::vector<ResultsRow>& rows);

}  // namespace sigmascape::cli
