#include "sigmascape/scene/attribute_number.h"

#include <charconv>
#include <cmath>

#include "sigmascape/geo/foot.h"

namespace sigmascape::scene {
namespace {

constexpr double inch_m = geo::foot_m / 12.0;

void skip_spaces(std::string_view& text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
}

std::optional<double> take_number(std::string_view& text) {
  skip_spaces(text);
  double value = 0.0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || !std::isfinite(value)) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  skip_spaces(text);
  return value;
}

}  // namespace

std::optional<double> metres_from_text(std::string_view text) {
  const auto number = take_number(text);
  if (!number) return std::nullopt;
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  if (text.empty() || text == "m" || text == "metres" || text == "meters") return number;
  if (text == "ft" || text == "feet" || text == "'") return *number * geo::foot_m;
  if (text.front() != '\'' || text.back() != '"') return std::nullopt;
  text.remove_prefix(1);
  text.remove_suffix(1);
  const auto inches = take_number(text);
  if (!inches || !text.empty()) return std::nullopt;
  return *number * geo::foot_m + *inches * inch_m;
}

}  // namespace sigmascape::scene
