#pragma once

#include <string>

#include "sigmascape/radar/radar.h"

namespace sigmascape::radar {

/// What errors and warnings call a radar: "radar X-band scout", and "radar" alone when nobody named it.
[[nodiscard]] inline std::string title_of(const Radar& radar) {
  const bool is_named = !radar.name.empty() && radar.name != Radar{}.name;
  return is_named ? "radar " + radar.name : "radar";
}

}  // namespace sigmascape::radar
