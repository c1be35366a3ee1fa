#pragma once

#include <cstdint>
#include <filesystem>

#include "sigmascape/atlas/aspect_grid.h"
#include "sigmascape/atlas/patch_grid.h"
#include "sigmascape/base/progress.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/trace/path_tracer.h"

namespace sigmascape::bake {

/// What to bake and how finely.
struct BakeSettings {
  atlas::AspectGrid aspects = atlas::paper_aspect_grid();
  /// The paper's texel (2 km over 1024); the side is a power of two of them.
  atlas::PatchGrid patches{.texel_m = 2000.0 / 1024.0, .texels_per_side = 512};
  std::uint32_t samples_per_texel = 100;  ///< N_r of the paper
  int max_bounces = 8;                    ///< N_b of the paper
  std::uint64_t seed = 1;
  int mantissa_bits = 10;  ///< of the stored half floats, see atlas::AtlasDescription
  unsigned threads = 0;    ///< 0: one a hardware thread; has no effect on the result
};

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
