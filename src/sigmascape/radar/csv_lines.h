#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sigmascape::radar {

/// Calls `visit(line, number)` for the lines of comma-separated values that hold some, numbers from one: without blank
/// lines, remarks that begin with #, and the byte-order mark that spreadsheets begin their files with.
template <typename Visit>
void for_each_csv_line(std::istream& stream, const Visit& visit) {
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    if (number == 1 && line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first != std::string::npos && line[first] != '#') visit(line, number);
  }
}

/// What stands between the commas of a line, without blanks about it.
[[nodiscard]] inline std::vector<std::string> csv_fields(const std::string& line) {
  std::vector<std::string> fields;
  std::size_t begin = 0;
  while (begin <= line.size()) {
    const std::size_t comma = std::min(line.find(',', begin), line.size());
    const std::string field = line.substr(begin, comma - begin);
    const std::size_t first = field.find_first_not_of(" \t\r"), last = field.find_last_not_of(" \t\r");
    fields.push_back(first == std::string::npos ? "" : field.substr(first, last - first + 1));
    begin = comma + 1;
  }
  return fields;
}

/// The finite number that a field is, all of it; nothing where it is none.
[[nodiscard]] inline std::optional<double> csv_number(std::string_view field) {
  double value = 0.0;
  const char* const end = field.data() + field.size();
  const auto [stopped, fault] = std::from_chars(field.data(), end, value);
  const bool is_number = fault == std::errc{} && stopped == end && std::isfinite(value);
  return is_number ? std::optional(value) : std::nullopt;
}

}  // namespace sigmascape::radar
