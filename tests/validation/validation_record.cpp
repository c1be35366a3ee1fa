#include "validation/validation_record.h"

#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace sigmascape::validation {
namespace {

void record(const nlohmann::ordered_json& line) {
  if (const char* file = std::getenv("SIGMASCAPE_VALIDATION_RECORDS")) {
    std::ofstream(file, std::ios::app) << line.dump() + "\n";
  }
}

void expect_within(const BoundedCase& validated, bool holds, const char* bound) {
  fmt::print("  {}: expected {} {:.6g}, measured {:.6g} {}\n", validated.name, bound, validated.limit,
             validated.measured, validated.unit);
  EXPECT_TRUE(holds) << validated.group << ", " << validated.name << ": expected " << bound << " " << validated.limit
                     << " " << validated.unit << " [" << validated.source << "], measured " << validated.measured;
  record({{"group", validated.group},
          {"name", validated.name},
          {"bound", bound},
          {"expected", validated.limit},
          {"measured", validated.measured},
          {"unit", validated.unit},
          {"source", validated.source}});
}

}  // namespace

void expect_close(const Case& validated) {
  const double error = validated.measured - validated.expected;
  fmt::print("  {}: expected {:.6g}, measured {:.6g} {}, error {:+.3g}, allowed {:.3g}\n", validated.name,
             validated.expected, validated.measured, validated.unit, error, validated.tolerance);
  EXPECT_TRUE(std::abs(error) <= validated.tolerance)
      << validated.group << ", " << validated.name << ": expected " << validated.expected << " " << validated.unit
      << " [" << validated.source << "], measured " << validated.measured << ", allowed error " << validated.tolerance;
  record({{"group", validated.group},
          {"name", validated.name},
          {"expected", validated.expected},
          {"measured", validated.measured},
          {"tolerance", validated.tolerance},
          {"unit", validated.unit},
          {"source", validated.source}});
}

void expect_at_least(const BoundedCase& validated) {
  expect_within(validated, validated.measured >= validated.limit, "at least");
}

void expect_at_most(const BoundedCase& validated) {
  expect_within(validated, validated.measured <= validated.limit, "at most");
}

}  // namespace sigmascape::validation
