#pragma once

#include <cstdint>

#include "sigmascape/base/array2d.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::simulate {

/// When a map has been sampled enough.
struct ErrorGoal {
  /// Standard error of a bin's total power, 10 lg(1 + s/P), in the median over the bins that answer from the area.
  double median_error_db = 1.5;
  std::uint32_t samples_a_pass = 2;  ///< rays a cell that each pass adds; passes are drawn independently
  std::uint32_t most_passes = 512;   ///< that are made though the goal is not reached
};

/// A map and what it knows of its own noise.
struct TracedToError {
  radar::RangeAzimuthImage image;
  Array2D<float> relative_errors;  ///< [azimuth, range]: standard error of the total power over it; 0 where none is
  double median_error_db = 0.0;    ///< that was reached
  std::uint32_t samples_per_cell = 0;
};

/// LOD 0 as traced_image makes it, in passes until the median error is that of the goal: the mean of the passes, whose
/// scatter about it tells its error. `settings.samples_per_cell` has no say. At least 8 passes are made, fewer would
/// know too little of their error. The same bytes for any number of threads.
///
/// Throws Error for a goal that is not positive, and as traced_image does.
[[nodiscard]] TracedToError traced_to_error(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                                            const radar::Radar& radar, const radar::Rectangle& area,
                                            const TraceSettings& settings, const ErrorGoal& goal,
                                            trace::TraceCounts& counts, ProgressListener* progress = nullptr);

}  // namespace sigmascape::simulate
