#include "validation/validation_record.h"

#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace sigmascape::validation {

void expect_close(const Case& validated) {
  const double error = validated.measured - validated.expected;
  fmt::print("  {}: expected {:.6g}, measured {:.6g} {}, error {:+.3g}, allowed {:.3g}\n", validated.name,
             validated.expected, validated.measured, validated.unit, error, validated.tolerance);
  EXPECT_TRUE(std::abs(error) <= validated.tolerance)
      << validated.group << ", " << validated.name << ": expected " << validated.expected << " " << validated.unit
      << " [" << validated.source << "], measured " << validated.measured << ", allowed error " << validated.tolerance;
  if (const char* file = std::getenv("SIGMASCAPE_VALIDATION_RECORDS")) {
    const nlohmann::ordered_json line{{"group", validated.group},         {"name", validated.name},
                                      {"expected", validated.expected},   {"measured", validated.measured},
                                      {"tolerance", validated.tolerance}, {"unit", validated.unit},
                                      {"source", validated.source}};
    std::ofstream(file, std::ios::app) << line.dump() + "\n";
  }
}

}  // namespace sigmascape::validation
