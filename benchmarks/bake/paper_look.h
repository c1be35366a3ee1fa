#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sigmascape/bake/look_baker.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/trace/launch.h"
#include "sigmascape/trace/path_tracer.h"

namespace sigmascape::bench {

/// One look of the paper's scene and the processor time that it took.
struct TimedLook {
  std::vector<float> power;   ///< VV + HH + 2 HV, texel by texel
  std::vector<float> errors;  ///< relative standard errors of that as the bake tells them; none of plain sampling
  double processor_seconds = 0.0;
  double wall_seconds = 0.0;
  trace::TraceCounts counts;
};

/// Bakes the paper's scene over and over, in the ways that are to be compared, shadows in the textures as in the paper.
class PaperLooks {
 public:
  /// Rays go to one tile of 16 × 16 cells, chosen by lot, of every block of `thinning`² tiles, so that forest, fields
  /// and town keep their shares; 1: to all.
  PaperLooks(const scene::Scene& scene, int thinning, unsigned threads);
  /// Of a part of the scene, whose corners lie on the lattice of texels.
  PaperLooks(const scene::Scene& scene, const radar::Rectangle& part, int thinning, unsigned threads);

  /// Independent random numbers, no reciprocal weighting, no roulette, everywhere as many rays.
  [[nodiscard]] TimedLook plain(const radar::Aspect& aspect, std::uint32_t samples, std::uint64_t seed);
  /// The echoes of first surfaces alone, as plain sampling has them.
  [[nodiscard]] TimedLook direct(const radar::Aspect& aspect, std::uint32_t samples, std::uint64_t seed);
  /// As LookBaker does it.
  [[nodiscard]] TimedLook ours(const radar::Aspect& aspect, const bake::Sampling& sampling, std::uint64_t seed);

  /// The same with Noise::Shared, which a thinned look, full of edges beyond which nothing is, has no use for.
  [[nodiscard]] TimedLook shared(const radar::Aspect& aspect, const bake::Sampling& sampling, std::uint64_t seed);

  [[nodiscard]] trace::LaunchArea area_of(const radar::Aspect& aspect) const;
  /// Number of launch cells over those of the whole look.
  [[nodiscard]] double part_of(const radar::Aspect& aspect) const;
  [[nodiscard]] trace::SceneGeometry& geometry() { return baker_->geometry_about(texels_); }
  [[nodiscard]] const bake::BakeSettings& settings() const { return settings_; }
  [[nodiscard]] const radar::GroundGrid& texels() const { return texels_; }

 private:
  /// A thinned look makes whole textures for a part of the rays: of the time that they take only that part is due.
  void take_off_what_is_not_due(TimedLook& look, const radar::Aspect& aspect);
  [[nodiscard]] TimedLook plain(const radar::Aspect& aspect, std::uint32_t samples, std::uint64_t seed, int bounces);
  bake::BakeSettings settings_;
  int thinning_;
  radar::GroundGrid texels_;
  std::unique_ptr<bake::LookBaker> baker_;
  trace::SpectralSurfaces surfaces_;
};

}  // namespace sigmascape::bench
