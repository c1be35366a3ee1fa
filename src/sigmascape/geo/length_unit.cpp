#include "sigmascape/geo/length_unit.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "sigmascape/base/small_letters.h"
#include "sigmascape/geo/foot.h"

namespace sigmascape::geo {
namespace {

/// Names of units are spelled in many ways: in capitals, with blanks, dots, hyphens and underscores.
std::string plainly_spelled(std::string_view name) {
  std::string plain;
  for (const char c : name) {
    if (std::string_view(" .-_").find(c) == std::string_view::npos) plain += c;
  }
  return in_small_letters(std::move(plain));
}

}  // namespace

std::optional<double> metres_per_unit(std::string_view name) {
  struct LengthUnit {
    double metres;
    std::vector<std::string_view> names;
  };
  static const std::array<LengthUnit, 6> known{{
      {1.0, {"m", "metre", "metres", "meter", "meters"}},
      {0.1, {"dm", "decimetre", "decimetres", "decimeter", "decimeters"}},
      {0.01, {"cm", "centimetre", "centimetres", "centimeter", "centimeters"}},
      {0.001, {"mm", "millimetre", "millimetres", "millimeter", "millimeters"}},
      {foot_m, {"ft", "foot", "feet", "internationalfoot", "internationalfeet"}},
      {us_survey_foot_m,
       {"usft", "ftus", "usfoot", "usfeet", "footus", "feetus", "ussurveyfoot", "ussurveyfeet", "surveyfoot",
        "surveyfeet"}},
  }};
  const std::string plain = plainly_spelled(name);
  for (const LengthUnit& length : known) {
    if (std::ranges::find(length.names, plain) != length.names.end()) return length.metres;
  }
  return std::nullopt;
}

}  // namespace sigmascape::geo
