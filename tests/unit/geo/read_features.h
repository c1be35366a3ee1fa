#pragma once

#include <utility>
#include <vector>

#include "sigmascape/geo/vector_source.h"

namespace sigmascape::geo {

/// All of a file at once.
[[nodiscard]] inline std::vector<Feature> read_features(const VectorSource& source, const LocalFrame& frame) {
  std::vector<Feature> features;
  for_each_feature(source, frame, [&](Feature&& feature) { features.push_back(std::move(feature)); });
  return features;
}

}  // namespace sigmascape::geo
