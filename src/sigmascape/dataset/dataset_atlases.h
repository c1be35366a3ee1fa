#pragma once

#include <string>
#include <vector>

#include "sigmascape/atlas/atlas.h"
#include "sigmascape/dataset/dataset_spec.h"

namespace sigmascape::dataset {

/// What the maps of a dataset are made of, whole and read as samples come to it.
struct DatasetAtlases {
  atlas::Atlas all;
  std::vector<atlas::Atlas> of_bounces;  ///< of at most one bounce, at most two, …: as many as the layers ask for
  std::vector<std::string> hashes;       ///< SHA-256 of what each says of itself: of equal ones all texels are equal
};

/// Those of a specification for a scene of that hash. Throws Error when one cannot be read, is not whole or of another
/// scene, and when the bounces are of bakes that differ in more than them, or tell no orders.
[[nodiscard]] DatasetAtlases opened_atlases(const DatasetSpec& spec, const std::string& scene_hash);

}  // namespace sigmascape::dataset
