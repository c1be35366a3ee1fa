#pragma once

#include <cstddef>
#include <vector>

#include "sigmascape/bake/bake_settings.h"
#include "sigmascape/base/array2d.h"
#include "sigmascape/base/progress.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/scatter/surface_model.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/trace/path_tracer.h"
#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape::bake {

/// What was baked of one patch from one look.
struct BakedLook {
  Array2D<radar::Channels> sigma0;       ///< [column, row], north up, as PatchGrid::texels_of says
  double relative_standard_error = 0.0;  ///< of a texel's total power, root mean square over the lit texels
  trace::TraceCounts counts;
};

/// Bakes single looks of one scene, its objects set on level ground. What all looks share is made once: the structures
/// for rays, and the surface models of every frequency.
class LookBaker {
 public:
  /// Keeps references to both.
  LookBaker(const scene::Scene& scene, const BakeSettings& settings);

  /// Bakes one patch from one aspect at all frequencies, in the order of their axis. Tells `progress` of one "look".
  /// Throws Error when a texel is brighter than sums can hold.
  [[nodiscard]] std::vector<BakedLook> bake(atlas::PatchIndex patch, const radar::Aspect& aspect,
                                            ProgressListener& progress) const;

  [[nodiscard]] std::size_t geometry_bytes() const { return geometry_.memory_bytes(); }

 private:
  [[nodiscard]] BakedLook bake_frequency(atlas::PatchIndex patch, const radar::Aspect& aspect, std::size_t frequency,
                                         ProgressListener& progress) const;

  const scene::Scene& scene_;
  const BakeSettings& settings_;
  trace::SceneGeometry geometry_;
  std::vector<std::vector<scatter::SurfaceModel>> surfaces_;  // [frequency, material]
};

}  // namespace sigmascape::bake
