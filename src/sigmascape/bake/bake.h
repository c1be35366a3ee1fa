#pragma once

#include <cstddef>
#include <filesystem>

#include "sigmascape/bake/bake_settings.h"
#include "sigmascape/base/progress.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/trace/path_tracer.h"

namespace sigmascape::bake {

struct BakeReport {
  std::size_t looks = 0;    ///< (patch, look) pairs of the whole atlas
  std::size_t already = 0;  ///< that were there before
  trace::TraceCounts counts;
  std::size_t geometry_bytes = 0;
  double relative_standard_error = 0.0;  ///< root mean square over the baked looks of a level-0 texel's
};

/// Bakes the scene, its objects set on level ground, into the atlas at `folder`: for each patch and look the
/// path-traced echoes are summed over the texels they lie over to and divided by the texel's area.
///
/// A bake that was broken off goes on where it stopped: looks that are there already are left as they are. The same
/// scene and settings give the same bytes for any number of threads and any interruption (under one SIMD setting).
/// Throws Error for settings out of range and when another scene or other settings are in `folder`.
BakeReport bake(const scene::Scene& scene, const BakeSettings& settings, const std::filesystem::path& folder,
                ProgressListener& progress);

}  // namespace sigmascape::bake
