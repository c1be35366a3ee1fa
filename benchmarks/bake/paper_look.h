#pragma once

#include <cstdint>
#include <vector>

#include "sigmascape/bake/look_baker.h"
#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/channels.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/trace/path_tracer.h"
#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape::bench {

/// One look of the paper's scene, or of a crop of it, and the processor time that it took.
struct TimedLook {
  std::vector<float> power;  ///< VV + HH + 2 HV, texel by texel
  double processor_seconds = 0.0;
  double wall_seconds = 0.0;
  trace::TraceCounts counts;
};

/// Bakes the paper's scene over and over, in the ways that are to be compared.
class PaperLooks {
 public:
  /// The whole scene, or a crop of 256² texels with houses, trees and fields.
  PaperLooks(const scene::Scene& scene, bool whole, unsigned threads);

  /// Independent random numbers, no reciprocal weighting, no roulette, everywhere as many rays.
  [[nodiscard]] TimedLook plain(const radar::Aspect& aspect, std::uint32_t samples, std::uint64_t seed) const;
  /// As LookBaker does it.
  [[nodiscard]] TimedLook ours(const radar::Aspect& aspect, const bake::Sampling& sampling, std::uint64_t seed) const;

  [[nodiscard]] const std::vector<atlas::PatchIndex>& patches() const { return patches_; }
  [[nodiscard]] const bake::BakeSettings& settings() const { return settings_; }

 private:
  const scene::Scene& scene_;
  bake::BakeSettings settings_;
  std::vector<atlas::PatchIndex> patches_;
  trace::SceneGeometry geometry_;
  trace::SpectralSurfaces surfaces_;
};

}  // namespace sigmascape::bench
