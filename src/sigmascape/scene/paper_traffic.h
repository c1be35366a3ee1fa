#pragma once

#include <vector>

#include "sigmascape/scene/paper_town.h"

namespace sigmascape::scene {

/// Which vehicle prototypes there are, by index into Scene::prototypes.
struct VehiclePrototypes {
  std::uint32_t car = 0, van = 0, truck = 0;
};

/// Vehicles that drive on the right on highway and main roads, and others parked along the streets and on paved yards.
[[nodiscard]] std::vector<Instance> paper_traffic(const PaperLayout& layout, const PaperLandscape& landscape,
                                                  const PaperTown& town, const VehiclePrototypes& prototypes);

}  // namespace sigmascape::scene
