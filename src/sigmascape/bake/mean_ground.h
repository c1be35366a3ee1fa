#pragma once

#include <optional>
#include <vector>

#include "sigmascape/atlas/aspect_grid.h"
#include "sigmascape/atlas/patch_grid.h"
#include "sigmascape/scene/scene.h"

namespace sigmascape::bake {

/// What the ground that a bake stores apart (bake_ground) returns of patches in the mean, lying level and with nothing
/// in front of it: what baked power is to be held against. For one thread at a time.
class MeanGround {
 public:
  /// Keeps references to scene and patches. Throws Error for materials that do not know a frequency.
  MeanGround(const scene::Scene& scene, const atlas::AspectGrid& aspects, const atlas::PatchGrid& patches);

  /// Mean of VV + HH + 2 HV as σ0 over all texels of the patch; those beyond the scene's extent return nothing.
  [[nodiscard]] double power_of(atlas::PatchIndex patch, atlas::LookIndex look) const;

 private:
  /// What part of the patch is made of each material within the scene.
  [[nodiscard]] const std::vector<double>& shares_of(atlas::PatchIndex patch) const;

  const scene::Scene& scene_;
  const atlas::PatchGrid& patches_;
  std::vector<std::vector<double>> powers_;  // [look][material]
  struct Shares {
    atlas::PatchIndex patch;
    std::vector<double> of_materials;
  };
  mutable std::optional<Shares> shares_;  // of the patch asked for last, whose looks come one after another
};

}  // namespace sigmascape::bake
