#pragma once

#include <charconv>
#include <fmt/format.h>
#include <string>
#include <system_error>

#include "command_parser.h"

namespace sigmascape::cli {

/// Takes numbers from `lowest` to `highest` alone, and no "nan".
inline Validator number_within(double lowest, double highest) {
  return {[lowest, highest](const std::string& word) {
            double value = 0.0;
            const char* const end = word.data() + word.size();
            const auto [stopped, fault] = std::from_chars(word.data(), end, value);
            if (fault == std::errc{} && stopped == end && value >= lowest && value <= highest) return std::string();
            return fmt::format("is {}; give a number from {:g} to {:g}", word, lowest, highest);
          },
          fmt::format("in [{:g} - {:g}]", lowest, highest)};
}

/// Takes whole numbers from `lowest` to `highest` alone, however long the one that is given.
template <typename Count>
Validator count_within(Count lowest, Count highest) {
  return {[lowest, highest](const std::string& word) {
            Count value = 0;
            const char* const end = word.data() + word.size();
            const auto [stopped, fault] = std::from_chars(word.data(), end, value);
            if (fault == std::errc{} && stopped == end && value >= lowest && value <= highest) return std::string();
            return fmt::format("is {}; give a whole number from {} to {}", word, lowest, highest);
          },
          fmt::format("in [{} - {}]", lowest, highest)};
}

}  // namespace sigmascape::cli
