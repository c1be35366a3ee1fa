#include "sigmascape/geo/osm_tags.h"

#include <optional>

namespace sigmascape::geo {
namespace {

/// Takes a quoted word from the front of the text.
std::optional<std::string> take_quoted(std::string_view& text) {
  if (text.empty() || text.front() != '"') return std::nullopt;
  std::string word;
  for (std::size_t i = 1; i < text.size(); ++i) {
    if (text[i] == '"') {
      text.remove_prefix(i + 1);
      return word;
    }
    if (text[i] == '\\' && i + 1 < text.size()) ++i;
    word.push_back(text[i]);
  }
  return std::nullopt;
}

}  // namespace

std::map<std::string, std::string> unpacked_tags(std::string_view other_tags) {
  std::map<std::string, std::string> tags;
  while (!other_tags.empty()) {
    const auto key = take_quoted(other_tags);
    if (!key || !other_tags.starts_with("=>")) break;
    other_tags.remove_prefix(2);
    const auto value = take_quoted(other_tags);
    if (!value) break;
    tags[*key] = *value;
    if (other_tags.starts_with(",")) other_tags.remove_prefix(1);
  }
  return tags;
}

}  // namespace sigmascape::geo
