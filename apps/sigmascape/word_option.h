#pragma once

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include "command_parser.h"

namespace sigmascape::cli {

/// The same word in small letters, of ASCII.
inline std::string lower_case(std::string word) {
  std::ranges::transform(word, word.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return word;
}

/// Adds an option that is an enumeration and takes the words of a list alone, in either case.
template <typename Enumeration>
Option add_word_option(Command command, const std::string& name, Enumeration& variable,
                       const std::map<std::string, std::type_identity_t<Enumeration>>& words,
                       const std::string& description) {
  std::vector<std::string> names;
  for (const auto& [word, meaning] : words) names.push_back(word);
  const auto fault = [words, names](const std::string& word) {
    if (words.contains(lower_case(word))) return std::string();
    return fmt::format("is {}; choose among {}", word, fmt::join(names, ", "));
  };
  const auto take = [&variable, words](const std::string& word) { variable = words.at(lower_case(word)); };
  return command.add_option_function(name, take, description)
      .check({fault, ""})
      .type_name(fmt::format("{{{}}}", fmt::join(names, ",")));
}

}  // namespace sigmascape::cli
