#pragma once

#include <cstddef>

#include "sigmascape/dataset/dataset_spec.h"
#include "sigmascape/dataset/sample_plan.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::dataset {

/// The ground in the middle of a planned map.
[[nodiscard]] Vec3d middle_of(const SamplePlan& plan, const terrain::HeightField& terrain);

/// The radar of a planned sample over this terrain, where it stands at the time of the sample.
[[nodiscard]] radar::Radar radar_of(const DatasetSpec& spec, const SamplePlan& plan,
                                    const terrain::HeightField& terrain);

/// The frame of a sequence, counted from 0, in which the radar comes nearest to the middle of the map. `begin` is the
/// first of its samples.
[[nodiscard]] std::size_t nearest_frame(const DatasetSpec& spec, const SamplePlan& begin,
                                        const terrain::HeightField& terrain);

/// Whether the radar flies on from frame to frame of a sequence.
[[nodiscard]] bool flies(const Sequence& sequence);

}  // namespace sigmascape::dataset
