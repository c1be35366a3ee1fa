#pragma once

#include <cstdint>

#include "sigmascape/base/array2d.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::simulate {

/// When a map has been sampled enough.
struct ErrorGoal {
  /// Standard error of a bin's total power, 10 lg(1 + s/P), in the median over the bins that answer from the area.
  double median_error_db = 1.5;
  /// Rays that each pass adds to the cells that bring most of the noise; others get fewer. Passes are drawn
  /// independently.
  std::uint32_t samples_a_pass = 8;
  std::uint32_t most_passes = 128;  ///< that are made though the goal is not reached
};

/// A map and what it knows of its own noise.
struct TracedToError {
  radar::RangeAzimuthImage image;
  Array2D<float> relative_errors;      ///< [azimuth, range]: standard error of the total power over it; 0 where none is
  double median_error_db = 0.0;        ///< that was reached
  std::uint32_t samples_per_cell = 0;  ///< rays of the cells that got the most
};

/// LOD 0 as traced_image makes it, in passes until the median error is that of the goal: the mean of the passes, whose
/// scatter about it tells its error. `settings.samples_per_cell` has no say. The first pass goes over all cells alike;
/// after it cells that bring little noise into the area get fewer rays than the others (CellNoise). As that is decided
/// before the rays of a pass are drawn, and a pass counts the same whatever its cells got, every pass has the right
/// mean. At least 8 passes are made, fewer would know too little of their error. The same bytes for any number of
/// threads.
///
/// The error is that which the passes show. Where power comes over rare bright paths most maps have met fewer of them
/// than there are, and know of less noise than they have: the mean of s² is right, its median is too small
/// (docs/decisions/0097-rays-where-the-noise-is.md).
///
/// Throws Error for a goal that is not positive, and as traced_image does.
[[nodiscard]] TracedToError traced_to_error(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                                            const radar::Radar& radar, const radar::Rectangle& area,
                                            const TraceSettings& settings, const ErrorGoal& goal,
                                            trace::TraceCounts& counts, ProgressListener* progress = nullptr);

}  // namespace sigmascape::simulate
