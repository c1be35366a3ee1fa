#include "sigmascape/product/told_numbers.h"

#include <array>
#include <charconv>
#include <system_error>

namespace sigmascape::product {

std::map<std::string, double> numbers_taken_from(std::map<std::string, std::string>& words) {
  constexpr std::array counted_or_measured{"dwell", "samples_per_cell", "targets", "time_s", "wind_mps"};
  std::map<std::string, double> numbers;
  for (const char* key : counted_or_measured) {
    const auto told = words.find(key);
    if (told == words.end()) continue;
    const std::string& text = told->second;
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) continue;
    numbers[key] = number;
    words.erase(told);
  }
  return numbers;
}

}  // namespace sigmascape::product
