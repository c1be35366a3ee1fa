#pragma once

#include <string>
#include <vector>

#include "sigmascape/dataset/dataset_spec.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::dataset {

/// What whoever asks for this dataset should know before it is made, one sentence each: what radar::radar_warnings
/// objects to in the maps that the radar makes from nearest, with the finest beam and pulse that the spec lets be
/// drawn, and in those from farthest. Of sequences in which it flies, those that are drawn count. No map is cut off
/// where the scene ends: all lie within it. Throws Error as centres_of() does.
[[nodiscard]] std::vector<std::string> dataset_warnings(const DatasetSpec& spec, const terrain::HeightField& terrain,
                                                        const radar::Rectangle& scene_extent);

}  // namespace sigmascape::dataset
