#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include "sigmascape/live/frame.h"

namespace sigmascape::live {

/// VV of all bins together.
inline double total_vv(const Frame& frame) {
  double sum = 0.0;
  for (std::size_t bin = 0; bin < frame.powers_m2.size(); bin += 4) sum += static_cast<double>(frame.powers_m2[bin]);
  return sum;
}

/// Every channel of every bin, powers or parts of amplitudes.
inline std::vector<float> numbers_of(const Frame& frame) {
  std::vector<float> numbers(frame.powers_m2.begin(), frame.powers_m2.end());
  for (const std::complex<float>& a : frame.amplitudes_m) numbers.insert(numbers.end(), {a.real(), a.imag()});
  return numbers;
}

}  // namespace sigmascape::live
