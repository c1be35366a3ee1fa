#pragma once

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

namespace sigmascape::cli {

/// Lets an option that is an enumeration take the words of a list alone, in either case. CLI::CheckedTransformer would
/// show and take the enumeration's numbers as well.
template <typename Enumeration>
CLI::Option* takes_words(CLI::Option* option, const std::map<std::string, Enumeration>& words) {
  std::vector<std::string> names;
  for (const auto& [name, meaning] : words) names.push_back(name);
  const auto to_number = [words, names](std::string& text) {
    const auto found = words.find(CLI::detail::to_lower(text));
    if (found == words.end()) return fmt::format("is {}; choose among {}", text, fmt::join(names, ", "));
    text = std::to_string(static_cast<std::underlying_type_t<Enumeration>>(found->second));
    return std::string();
  };
  return option->transform(CLI::Validator(to_number, ""))->type_name(fmt::format("{{{}}}", fmt::join(names, ",")));
}

}  // namespace sigmascape::cli
