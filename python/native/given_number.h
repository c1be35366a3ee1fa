#pragma once

#include <cmath>
#include <fmt/format.h>
#include <string>

#include "sigmascape/base/error.h"

namespace sigmascape::python {

/// An argument or attribute called `name`, unless it lies outside these bounds or is no number, which raises.
inline double within(const std::string& name, double value, double lowest, double highest) {
  if (!(value >= lowest && value <= highest))
    throw Error(name, fmt::format("is {:g}", value), fmt::format("give a number from {:g} to {:g}", lowest, highest));
  return value;
}

inline double positive(const std::string& name, double value) {
  if (!(value > 0.0) || !std::isfinite(value))
    throw Error(name, fmt::format("is {:g}", value), "give a number above 0");
  return value;
}

/// Every number of an array.
template <typename Numbers>
const Numbers& all_within(const std::string& name, const Numbers& numbers, double lowest, double highest) {
  for (const double number : numbers) within(name, number, lowest, highest);
  return numbers;
}

}  // namespace sigmascape::python
