#pragma once

#include <algorithm>
#include <istream>
#include <string>
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

}  // namespace sigmascape::radar
