#include "sigmascape/scene/attribute_number.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

#include "sigmascape/geo/foot.h"
#include "sigmascape/geo/length_unit.h"

namespace sigmascape::scene {
namespace {

constexpr double inch_m = geo::foot_m / 12.0;

void skip_spaces(std::string_view& text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
}

std::string_view take_digits(std::string_view& text) {
  const std::string_view digits = text.substr(0, std::min(text.size(), text.find_first_not_of("0123456789")));
  text.remove_prefix(digits.size());
  return digits;
}

/// The digits of a number before and after its comma.
struct CommaNumber {
  std::string_view before, after;

  [[nodiscard]] bool may_part_thousands() const {
    return before.size() <= 3 && before.front() != '0' && after.size() == 3;
  }
};

/// With which a text begins, where it has one comma and no point.
std::optional<CommaNumber> comma_number(std::string_view text) {
  skip_spaces(text);
  if (text.starts_with('-')) text.remove_prefix(1);
  CommaNumber number;
  number.before = take_digits(text);
  if (number.before.empty() || !text.starts_with(',')) return std::nullopt;
  text.remove_prefix(1);
  number.after = take_digits(text);
  if (number.after.empty() || text.starts_with(',') || text.starts_with('.')) return std::nullopt;
  return number;
}

std::optional<double> take_number(std::string_view& text) {
  skip_spaces(text);
  std::string written(text);
  if (const auto number = comma_number(text)) {
    if (number->may_part_thousands()) return std::nullopt;
    written[written.find(',')] = '.';
  }
  double value = 0.0;
  const auto [end, fault] = std::from_chars(written.data(), written.data() + written.size(), value);
  if (fault != std::errc() || !std::isfinite(value)) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - written.data()));
  skip_spaces(text);
  return value;
}

}  // namespace

std::optional<double> metres_from_text(std::string_view text, double metres_per_plain_number) {
  const auto number = take_number(text);
  if (!number) return std::nullopt;
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  if (text.empty()) return *number * metres_per_plain_number;
  if (const auto metres = geo::metres_per_unit(text)) return *number * *metres;
  if (text == "'") return *number * geo::foot_m;
  if (text.front() != '\'' || text.back() != '"') return std::nullopt;
  text.remove_prefix(1);
  text.remove_suffix(1);
  if (text.starts_with('-')) text.remove_prefix(1);
  const auto inches = take_number(text);
  if (!inches || !text.empty() || *inches < 0.0 || *inches >= 12.0) return std::nullopt;
  return *number * geo::foot_m + *inches * inch_m;
}

bool has_doubtful_comma(std::string_view text) {
  const auto number = comma_number(text);
  return number && number->may_part_thousands();
}

}  // namespace sigmascape::scene
