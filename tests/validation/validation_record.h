#pragma once

#include <string_view>

namespace sigmascape::validation {

/// One comparison of the program with a closed form or a published value.
struct Case {
  std::string_view group;  ///< heading under which docs/physics/validation.md lists it: "Fresnel", "Wall and ground"
  std::string_view name;   ///< "mirror wall on Beckmann ground, incidence 45°"
  double expected = 0.0;
  double measured = 0.0;
  double tolerance = 0.0;   ///< greatest |measured − expected| that passes, in the same unit
  std::string_view unit;    ///< "dB", "m²", "1"
  std::string_view source;  ///< where the expected value comes from
};

/// Fails the running test when the case is out of tolerance. Prints expected, measured and error in any event, and adds
/// them as a line of JSON to the file named by SIGMASCAPE_VALIDATION_RECORDS when that is set, from which `make
/// validation` writes its table.
void expect_close(const Case& validated);

/// One figure of which only a bound is known: a gain that must be reached, a bias that must not show.
struct BoundedCase {
  std::string_view group;
  std::string_view name;
  double limit = 0.0;
  double measured = 0.0;
  std::string_view unit;
  std::string_view source;  ///< what the limit rests on
};

/// As expect_close, for figures that must not fall below the limit.
void expect_at_least(const BoundedCase& validated);
/// As expect_close, for figures that must not rise above the limit.
void expect_at_most(const BoundedCase& validated);

}  // namespace sigmascape::validation
