#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "sigmascape/base/sha256.h"

namespace sigmascape {

/// Writes another word for the first `from` in an item, and the SHA-256 of itself that fits then, as if it had been
/// written so.
inline void rewrite_item(const std::filesystem::path& item, std::string_view from, std::string_view to) {
  std::string text;
  {
    std::ifstream file(item, std::ios::binary);
    text = {std::istreambuf_iterator<char>(file), {}};
  }
  text.replace(text.find(from), from.size(), to);
  constexpr std::string_view own_hash = "\"sigmascape:item_sha256\": \"";
  constexpr std::size_t digits = 64;
  const std::size_t place = text.find(own_hash) + own_hash.size();
  text.erase(place, digits);
  text.insert(place, sha256_of(text));
  std::ofstream(item, std::ios::binary) << text;
}

}  // namespace sigmascape
