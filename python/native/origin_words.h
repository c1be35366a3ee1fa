#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "sigmascape/geo/local_frame.h"

namespace sigmascape::python {

using Words = std::map<std::string, std::string>;

/// What I/Q files say of where they come from.
inline Words origin_words(const std::string& processing, const geo::LocalFrame& frame, const std::string& scene,
                          const std::string& scene_hash, const std::string& attribution, std::uint64_t seed) {
  Words words{{"processing", processing},
              {"crs", frame.proj()},
              {"scene", scene},
              {"scene_hash", scene_hash},
              {"seed", std::to_string(seed)}};
  if (!attribution.empty()) words["attribution"] = attribution;
  return words;
}

}  // namespace sigmascape::python
