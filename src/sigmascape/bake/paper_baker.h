#pragma once

#include "sigmascape/bake/bake_settings.h"
#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/trace/path_tracer.h"
#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape::bake {

/// Bakes single textures the way the paper does: all objects on level ground, the same number of rays everywhere, all
/// echoes, shadows with them, into range-azimuth bins that are then re-projected onto the ground
/// (receiver::PolarGround). How the paper is read is told in docs/decisions/0050-the-paper-literally.md.
class PaperBaker {
 public:
  /// Keeps a reference to the scene. Of the settings the texel, the rays a texel, bounces, seed, threads and the first
  /// frequency count.
  PaperBaker(const scene::Scene& scene, const BakeSettings& settings);

  /// σ0 of every texel, linear. Throws Error when a texel is brighter than sums can hold.
  [[nodiscard]] Array2D<radar::Channels> bake(const radar::GroundGrid& texels, const radar::Aspect& aspect) const;

 private:
  const scene::Scene& scene_;
  BakeSettings settings_;
  trace::SceneGeometry geometry_;
  std::vector<scatter::SurfaceModel> surfaces_;
};

}  // namespace sigmascape::bake
