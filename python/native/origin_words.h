#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "sigmascape/geo/local_frame.h"

namespace sigmascape::python {

using Words = std::map<std::string, std::string>;

/// What I/Q files say of where they come from.
inline Words origin_words(const std::string& processing, const geo::LocalFrame& frame, const std::string& scene,
                          const std::string& scene_hash, std::uint64_t seed) {
  return {{"processing", processing},
          {"crs", frame.proj()},
          {"scene", scene},
          {"scene_hash", scene_hash},
          {"seed", std::to_string(seed)}};
}

}  // namespace sigmascape::python
