#pragma once

#include <map>
#include <optional>
#include <string>

#include "sigmascape/base/error.h"
#include "sigmascape/product/described_map.h"
#include "sigmascape/radar/polarization_words.h"

namespace sigmascape::python {

inline radar::Polarization polarization_from(const std::string& word) {
  const auto found = radar::polarization_words().find(word);
  if (found != radar::polarization_words().end()) return found->second;
  throw Error("polarization", "is '" + word + "'", "give 'vv', 'hh', 'hv', 'vh' or 'sum'");
}

/// The one that is asked for, and where none is that of the radar that made the map with these metadata; VV where they
/// do not tell.
inline radar::Polarization polarization_from(const std::optional<std::string>& asked,
                                             const std::map<std::string, std::string>& map_metadata) {
  if (asked) return polarization_from(*asked);
  const auto of_radar = map_metadata.find(product::polarization_key);
  return of_radar == map_metadata.end() ? radar::Polarization::VV : polarization_from(of_radar->second);
}

}  // namespace sigmascape::python
