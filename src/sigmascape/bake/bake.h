#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "sigmascape/atlas/power_error.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/bake/bake_settings.h"
#include "sigmascape/bake/shard.h"
#include "sigmascape/base/progress.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/trace/path_tracer.h"

namespace sigmascape::bake {

/// Which part of a bake a process does and how. Nothing of it shows in what is written.
struct BakeShare {
  Shard shard = {};
  /// How closely looks that are there already are examined; those with a fault are baked again.
  atlas::Scrutiny scrutiny = atlas::Scrutiny::Size;
};

struct BakeReport {
  std::size_t looks = 0;      ///< (patch, look) pairs of the share; without shards of the whole atlas
  std::size_t already = 0;    ///< that were there before
  std::size_t elsewhere = 0;  ///< that another process baked in the meantime
  std::size_t pyramid = 0;    ///< textures of looks written above the patches; obstacles and ground are not counted
  trace::TraceCounts counts;
  std::size_t geometry_bytes = 0;  ///< of the largest structures for rays that were needed at a time
  /// Of the looks that this call baked alone, over their finest texels; of all that an atlas holds summary_of tells.
  atlas::PowerErrors errors = {};
  /// Files, relative to the atlas, that were damaged or of which a part was missing, and were made anew.
  std::vector<atlas::StoreFault> mended = {};
};

/// Bakes the scene, its objects where they stand (`footing_of` says when on level ground instead), into the atlas at
/// `folder`: for each patch and look the path-traced echoes are summed over the texels they lie over to and divided by
/// the texel's area. Then makes what has become possible of the pyramid above the patches.
///
/// A bake that was broken off goes on where it stopped: looks that are there already are left as they are. Any number
/// of processes and machines may bake into one folder at once, shards of it or the whole: one that comes to a look that
/// another is at goes on to the next, and at the end waits for it. The same scene and settings give the same bytes for
/// any number of threads, any shards and any interruption (under one SIMD setting). The scene's
/// description is in memory as a whole; of what rays need and of texels there is only what the patch that is being
/// baked takes.
///
/// Tells `progress` of the "looks" of the work "bake" as it begins and as each is done, before the first of the ground
/// (bake_ground), and at the end of the "layers" of the work "pyramid", where there are levels above the patches.
///
/// Throws Error for settings out of range and when another scene or other settings are in `folder`.
BakeReport bake(const scene::Scene& scene, const BakeSettings& settings, const std::filesystem::path& folder,
                ProgressListener& progress, const BakeShare& share = {});

/// What the atlas of such a bake is of.
[[nodiscard]] atlas::AtlasDescription description_of(const scene::Scene& scene, const BakeSettings& settings);

}  // namespace sigmascape::bake
