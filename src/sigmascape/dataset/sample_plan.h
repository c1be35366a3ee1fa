#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "sigmascape/dataset/dataset_spec.h"
#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::dataset {

/// A target before it is known whether the radar sees it.
struct PlannedTarget {
  std::size_t target_class = 0;  ///< place in DatasetSpec::targets
  std::size_t track = 0;         ///< number among the targets of its sequence
  Vec2d position;                ///< at the time of the sample
  Vec2d velocity_mps = {};
  double rcs_m2 = 1.0;
};

/// All that is drawn of one sample before anything is computed.
struct SamplePlan {
  std::size_t index = 0;
  std::size_t sequence = 0, frame = 0;  ///< the sequences of a dataset are numbered, and the frames of a sequence
  double time_s = 0.0;                  ///< since its sequence began
  std::uint64_t seed = 0;               ///< of its speckle and noise, and of its rays
  /// Where the radar stands as its sequence begins, and how it goes on.
  double azimuth_rad = 0.0, elevation_rad = 0.0, slant_range_m = 0.0;
  Vec2d flight_mps = {};
  double frequency_hz = 0.0, range_resolution_m = 0.0, beam_width_rad = 0.0;
  Vec2d centre;
  radar::GroundGrid grid;
  std::optional<double> snr_db, noise_sigma0_db;
  std::vector<PlannedTarget> targets;
};

/// Where the middles of maps may lie within the scene. Throws Error when the map is larger than the scene, or when the
/// places that the spec asks for lead beyond it.
[[nodiscard]] radar::Rectangle centres_of(const DatasetSpec& spec, const radar::Rectangle& scene_extent);

/// Sample number `index`: a pure function of spec, seed and index. The samples of a sequence share all that is drawn
/// but speckle and noise.
[[nodiscard]] SamplePlan plan_of(const DatasetSpec& spec, const radar::Rectangle& centres, std::size_t index);

}  // namespace sigmascape::dataset
