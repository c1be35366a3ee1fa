#pragma once

#include <cmath>

namespace sigmascape {

/// Keeps of errors the farthest from none. One that is no number stays, for no tolerance allows it: std::max and >
/// would let it go by.
template <typename Number>
void keep_worst(Number& worst, Number error) {
  if (std::isnan(worst) || std::abs(error) <= std::abs(worst)) return;
  worst = error;
}

}  // namespace sigmascape
