#pragma once

#include <cstdint>
#include <vector>

#include "sigmascape/radar/target.h"
#include "sigmascape/radar/target_file.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/simulate/placement.h"

namespace sigmascape::python {

/// Those of the scene, when there is one, and the ones given, on this terrain, as simulate::placed_targets has them.
[[nodiscard]] inline std::vector<radar::Target> all_targets(const scene::Scene* scene,
                                                            const std::vector<radar::TargetSource>& given,
                                                            const geo::LocalFrame& frame,
                                                            const terrain::HeightField& terrain, std::uint64_t seed,
                                                            double time_s) {
  std::vector<radar::Target> targets;
  if (scene != nullptr) targets = simulate::targets_of(*scene);
  for (radar::Target& target : simulate::placed_targets(given, frame, terrain, seed, time_s))
    targets.push_back(std::move(target));
  return targets;
}

}  // namespace sigmascape::python
