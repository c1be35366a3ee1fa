#pragma once

#include <cstddef>
#include <filesystem>

#include "sigmascape/bake/bake_settings.h"
#include "sigmascape/bake/shard.h"
#include "sigmascape/base/progress.h"
#include "sigmascape/scene/scene.h"

namespace sigmascape::bake {

/// What a bake would come to.
struct BakePlan {
  std::size_t patches = 0;
  std::size_t jobs = 0;              ///< patches times aspects: what can be shared out
  std::size_t jobs_of_share = 0;     ///< of these
  std::size_t patches_of_share = 0;  ///< of which these are some or all: the share makes what rays need for each
  bool has_whole_patches = false;    ///< whether they are all
  std::size_t looks = 0;             ///< (patch, look) pairs of the share
  std::size_t already = 0;           ///< of these in the folder
  double cells = 0.0;                ///< launch cells of the looks that are not there, gutters included
  /// Jobs whose cells were counted: all of which a look is missing, but of many at one elevation 64, spread evenly over
  /// them, which stand for the others.
  std::size_t jobs_counted = 0;
  double seconds = 0.0;  ///< expected for the looks that are not there, on this machine, with these threads
  /// Expected size of the textures of all looks with their standard errors, all levels, of all shares. The ground, the
  /// obstacles and the terrain that an atlas may hold besides are not in it.
  double bytes = 0.0;
  double bytes_of_share = 0.0;  ///< of these, the share's part of the levels above the patches among them
  double probe_seconds = 0.0;   ///< what finding out took
  std::size_t probe_looks = 0;
};

/// Plans a bake without writing anything: time and size are those of a trial. For each elevation a piece of 256 × 256
/// texels in the middle of the scene is baked, each time from another azimuth; a look's time goes with its launch
/// cells, its size with its texels. So it is as good as the middle of the scene speaks for the rest. It takes as long
/// as these pieces, with all their rays: as the bake itself, of one azimuth, where the scene is no larger. Tells
/// `progress` of them as "looks" of the work "plan". Throws Error as bake does, when another scene or other settings
/// are in `folder` as well.
[[nodiscard]] BakePlan plan(const scene::Scene& scene, const BakeSettings& settings,
                            const std::filesystem::path& folder, ProgressListener& progress, const Shard& shard = {});

}  // namespace sigmascape::bake
