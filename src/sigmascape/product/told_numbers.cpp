#include "sigmascape/product/told_numbers.h"

#include <array>
#include <charconv>
#include <cmath>
#include <system_error>

namespace sigmascape::product {

std::map<std::string, double> numbers_taken_from(std::map<std::string, std::string>& words) {
  constexpr std::array counted_or_measured{
      "bounces",      "dwell",  "mode_interval_s",      "pulse",   "targets", "samples_per_cell",
      "targets_seen", "time_s", "texture_frequency_hz", "wind_mps"};
  constexpr double last_whole = 0x1p53;
  std::map<std::string, double> numbers;
  for (const char* key : counted_or_measured) {
    const auto told = words.find(key);
    if (told == words.end()) continue;
    const std::string& text = told->second;
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || !(std::abs(number) <= last_whole)) continue;
    numbers[key] = number;
    words.erase(told);
  }
  return numbers;
}

}  // namespace sigmascape::product
