#pragma once

#include <map>
#include <string>

#include "sigmascape/radar/channels.h"

namespace sigmascape::radar {

/// The words by which files and options name polarizations: "vv", "hh", "hv", "vh" and "sum".
[[nodiscard]] inline const std::map<std::string, Polarization>& polarization_words() {
  static const std::map<std::string, Polarization> words{{"vv", Polarization::VV},
                                                         {"hh", Polarization::HH},
                                                         {"hv", Polarization::HV},
                                                         {"vh", Polarization::VH},
                                                         {"sum", Polarization::Sum}};
  return words;
}

/// The word of a polarization: "vv" to "vh", "sum".
[[nodiscard]] inline std::string polarization_word(Polarization polarization) {
  for (const auto& [word, meant] : polarization_words()) {
    if (meant == polarization) return word;
  }
  return {};
}

}  // namespace sigmascape::radar
