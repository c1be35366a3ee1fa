#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "sigmascape/bake/bake_settings.h"
#include "sigmascape/bake/highest_ground.h"
#include "sigmascape/bake/patch_sums.h"
#include "sigmascape/base/array2d.h"
#include "sigmascape/base/progress.h"
#include "sigmascape/radar/answering_tops.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/trace/launch.h"
#include "sigmascape/trace/path_tracer.h"
#include "sigmascape/trace/scene_geometry.h"
#include "sigmascape/trace/scene_heights.h"

namespace sigmascape::bake {

/// A texture of one patch.
struct BakedTexels {
  Array2D<radar::Channels> sigma0;  ///< [column, row], north up, as PatchGrid::texels_of says
  Array2D<float> relative_errors;   ///< standard error of a texel's total power over that power; 0 where dark
};

/// What was baked of one patch from one look.
struct BakedLook : BakedTexels {
  std::optional<BakedTexels> buildings = {};  ///< what they return directly, where they are kept apart
  double samples_per_texel = 0.0;             ///< mean over the launch cells, each for as much as its share
  trace::TraceCounts counts = {};             ///< of all frequencies together, with the first of them
};

/// Bakes single looks of one scene, one at a time. What looks share is made once: the surface models of every frequency
/// for all, the structures for rays for those of one patch.
///
/// Objects that stand on their own terrain are baked with its slopes and ridges, but without its shadows, which are
/// made when a map is rendered (render::GroundRenderer): what a texel returns is divided by the part of it that the
/// terrain leaves to be seen. docs/decisions/0051-baked-on-its-own-ground.md.
class LookBaker {
 public:
  /// Keeps references to both.
  LookBaker(const scene::Scene& scene, const BakeSettings& settings);

  /// Bakes one patch from one aspect at all frequencies, in the order of their axis. Tells `progress` of one "look".
  /// Throws Error when a texel is brighter than sums can hold.
  [[nodiscard]] std::vector<BakedLook> bake(atlas::PatchIndex patch, const radar::Aspect& aspect,
                                            ProgressListener& progress) const;
  /// The same with rays at the cells of `area` alone, which are whole tiles of `area_of(texels, aspect)`.
  [[nodiscard]] std::vector<BakedLook> bake(const radar::GroundGrid& texels, const trace::LaunchArea& area,
                                            const radar::Aspect& aspect, ProgressListener& progress) const;

  /// Where rays are aimed for such texels: around them as well, as far as objects can shadow them, lie over into them
  /// or bounce into them.
  [[nodiscard]] trace::LaunchArea area_of(const radar::GroundGrid& texels, const radar::Aspect& aspect) const;

  /// What rays can meet that matters to such texels, whatever the look; good until other texels are asked for, which
  /// may need something else. For one thread at a time, as all of this. docs/decisions/0129-geometry-by-the-patch.md.
  trace::SceneGeometry& geometry_about(const radar::GroundGrid& texels) const;
  /// Of the largest so far.
  [[nodiscard]] std::size_t geometry_bytes() const { return geometry_bytes_; }

 private:
  [[nodiscard]] trace::Surroundings surroundings_of(const radar::GroundGrid& texels) const;
  /// What each texel is multiplied by to take the terrain's shadow on it out; 1 where nothing comes back.
  [[nodiscard]] Array2D<float> terrain_gains(const radar::GroundGrid& texels, const std::vector<PatchSums>& sums,
                                             const radar::Aspect& aspect) const;
  /// Of these texels, with regard to what stands about them.
  [[nodiscard]] radar::AnsweringTops tops_of(const radar::GroundGrid& texels) const;

  const scene::Scene& scene_;
  const BakeSettings& settings_;
  trace::Footing footing_;
  trace::SceneHeights heights_;
  // Of all terrain: what takes long to find is found once for all jobs.
  double lowest_ground_m_;
  std::optional<HighestGround> highest_ground_;  // of relief
  radar::Rectangle occupied_;
  double tallest_m_;
  trace::SpectralSurfaces surfaces_;
  struct Local {
    trace::Surroundings around;
    trace::SceneGeometry geometry;
  };
  /// Of the patch that was baked last, for its looks come one after another.
  mutable std::optional<Local> local_;
  mutable std::size_t geometry_bytes_ = 0;
  mutable std::optional<radar::AnsweringTops> tops_;  // of the same patch
};

}  // namespace sigmascape::bake
