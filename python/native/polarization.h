#pragma once

#include <string>

#include "sigmascape/base/error.h"
#include "sigmascape/radar/polarization_words.h"

namespace sigmascape::python {

inline radar::Polarization polarization_from(const std::string& word) {
  const auto found = radar::polarization_words().find(word);
  if (found != radar::polarization_words().end()) return found->second;
  throw Error("polarization", "is '" + word + "'", "give 'vv', 'hh', 'hv', 'vh' or 'sum'");
}

inline std::string word_of(radar::Polarization polarization) {
  for (const auto& [word, meant] : radar::polarization_words()) {
    if (meant == polarization) return word;
  }
  return "";
}

}  // namespace sigmascape::python
