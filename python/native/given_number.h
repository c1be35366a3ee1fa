#pragma once

#include <cmath>
#include <fmt/format.h>
#include <string>

#include "sigmascape/base/error.h"
#include "sigmascape/base/toml_reader.h"
#include "sigmascape/base/vec.h"

namespace sigmascape::python {

/// An argument or attribute called `name`, unless it lies outside these bounds or is no number, which raises.
inline double within(const std::string& name, double value, double lowest, double highest) {
  if (!(value >= lowest && value <= highest))
    throw Error(name, fmt::format("is {:.10g}", value),
                fmt::format("give a number from {:.10g} to {:.10g}", lowest, highest));
  return value;
}

/// The same within what a file may say. `units` is how many of the argument's unit go on one of the file's.
inline double within(const std::string& name, double value, const Interval& allowed, double units = 1.0) {
  return within(name, value, allowed.lowest * units, allowed.highest * units);
}

inline double positive(const std::string& name, double value) {
  if (!(value > 0.0) || !std::isfinite(value))
    throw Error(name, fmt::format("is {:g}", value), "give a number above 0");
  return value;
}

/// A place in a local frame.
inline Vec2d checked_place(double x_m, double y_m) {
  constexpr double farthest_m = 1e7;
  return {within("x_m", x_m, -farthest_m, farthest_m), within("y_m", y_m, -farthest_m, farthest_m)};
}

/// Every number of an array.
template <typename Numbers>
const Numbers& all_within(const std::string& name, const Numbers& numbers, double lowest, double highest) {
  for (const double number : numbers) within(name, number, lowest, highest);
  return numbers;
}

}  // namespace sigmascape::python
