#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <fmt/format.h>
#include <string>
#include <system_error>

namespace sigmascape::cli {

/// Takes numbers from `lowest` to `highest` alone. CLI::Range lets "nan" pass.
inline CLI::Validator number_within(double lowest, double highest) {
  return {[lowest, highest](std::string& text) {
            double value = 0.0;
            const char* const end = text.data() + text.size();
            const auto [stopped, fault] = std::from_chars(text.data(), end, value);
            if (fault == std::errc{} && stopped == end && value >= lowest && value <= highest) return std::string();
            return fmt::format("is {}; give a number from {:g} to {:g}", text, lowest, highest);
          },
          fmt::format("in [{:g} - {:g}]", lowest, highest)};
}

/// Takes whole numbers from `lowest` to `highest` alone, however long the one that is given.
template <typename Count>
CLI::Validator count_within(Count lowest, Count highest) {
  return {[lowest, highest](std::string& text) {
            Count value = 0;
            const char* const end = text.data() + text.size();
            const auto [stopped, fault] = std::from_chars(text.data(), end, value);
            if (fault == std::errc{} && stopped == end && value >= lowest && value <= highest) return std::string();
            return fmt::format("is {}; give a whole number from {} to {}", text, lowest, highest);
          },
          fmt::format("in [{} - {}]", lowest, highest)};
}

}  // namespace sigmascape::cli
