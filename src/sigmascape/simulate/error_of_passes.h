#pragma once

#include <vector>

namespace sigmascape::simulate {

/// The standard error of the mean of n passes over that mean, s / x̄, from the sum of what they brought and that of its
/// squares:
///
///     s² = Σ_k (x_k − x̄)² / (n (n − 1))
[[nodiscard]] double relative_error_of_mean(double sum, double squares, double passes);

/// 10 lg(1 + s / x̄) in the median, corrected for what the root of a variance that was estimated from so few passes is
/// too small by in the median; 0 of none.
[[nodiscard]] double median_error_db(std::vector<double> relative_errors, double passes);

}  // namespace sigmascape::simulate
