#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sigmascape/radar/radar.h"

namespace sigmascape::radar {

/// The words by which files, options and metadata name modes, the usual one first.
inline constexpr std::array<std::pair<std::string_view, Mode>, 4> mode_words{
    {{"real-beam", Mode::RealBeam},
     {"doppler-beam-sharpening", Mode::DopplerBeamSharpening},
     {"stripmap", Mode::Stripmap},
     {"spotlight", Mode::Spotlight}}};

[[nodiscard]] constexpr std::string_view mode_word(Mode mode) {
  return std::ranges::find(mode_words, mode, &std::pair<std::string_view, Mode>::second)->first;
}

/// The mode of that word, if it is one.
[[nodiscard]] constexpr std::optional<Mode> mode_of(std::string_view word) {
  const auto* const found = std::ranges::find(mode_words, word, &std::pair<std::string_view, Mode>::first);
  return found != mode_words.end() ? std::optional(found->second) : std::nullopt;
}

/// All of the words.
[[nodiscard]] inline std::vector<std::string> words_of_modes() {
  std::vector<std::string> words;
  for (const auto& [word, mode] : mode_words) words.emplace_back(word);
  return words;
}

}  // namespace sigmascape::radar
