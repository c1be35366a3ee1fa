#include "sigmascape/product/number_text.h"

#include <cmath>
#include <fmt/format.h>

namespace sigmascape::product {
namespace {

bool rounds_to_nothing(double value, int decimals) {
  return std::abs(value) < 0.5 * std::pow(10.0, -decimals);
}

}  // namespace

std::string number_text(double value, int decimals, const char* none) {
  if (std::isnan(value)) return none;
  return fmt::format("{:.{}f}", rounds_to_nothing(value, decimals) ? 0.0 : value, decimals);
}

std::string signed_text(double value, int decimals, const char* none) {
  if (std::isnan(value) || rounds_to_nothing(value, decimals)) return number_text(value, decimals, none);
  return fmt::format("{:+.{}f}", value, decimals);
}

}  // namespace sigmascape::product
