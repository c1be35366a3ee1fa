#pragma once

#include <filesystem>
#include <optional>

#include "results/plan.h"
#include "results/table.h"

#include "sigmascape/bake/paper_baker.h"
#include "sigmascape/base/progress.h"
#include "sigmascape/render/paper_method.h"

namespace sigmascape::cli {

/// Textures baked in the paper's way, and what they cost.
struct PaperAtlas {
  render::PaperTextures textures;
  AtlasCost cost;
};

/// Bakes in the paper's way into a folder of float GeoTIFFs, one a look, and finds there what an earlier run baked.
class PaperBake {
 public:
  PaperBake(const ResultsPlan& plan, const scene::Scene& scene, std::filesystem::path folder, std::uint64_t seed);

  /// All looks of a grid; `in_halves` rounds their texels to half floats.
  [[nodiscard]] PaperAtlas atlas_of(const atlas::AspectGrid& aspects, std::uint32_t samples, ProgressListener& progress,
                                    bool in_halves = false);

 private:
  [[nodiscard]] radar::GroundMap baked_or_kept(const radar::Aspect& aspect, std::uint32_t samples);

  const ResultsPlan& plan_;
  const scene::Scene& scene_;
  std::filesystem::path folder_;
  std::uint64_t seed_;
  std::string scene_hash_;
  radar::GroundGrid texels_;
  std::optional<bake::PaperBaker> baker_;  // made when something has to be baked
  std::uint32_t baker_samples_ = 0;
};

}  // namespace sigmascape::cli
