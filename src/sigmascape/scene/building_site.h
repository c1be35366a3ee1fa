#pragma once

#include <cstddef>
#include <vector>

#include "sigmascape/scene/painted_ground.h"
#include "sigmascape/scene/roofed_building.h"

namespace sigmascape::scene {

/// Sets up buildings where there is room for them, until there are as many as wanted.
class BuildingSite {
 public:
  BuildingSite(PaintedGround& ground, std::size_t wanted) : ground_(ground), wanted_(wanted) {}

  [[nodiscard]] bool is_done() const { return buildings_.size() >= wanted_; }
  [[nodiscard]] std::vector<RoofedBuilding>& buildings() { return buildings_; }
  [[nodiscard]] PaintedGround& ground() { return ground_; }

  /// Puts the building up if more are wanted and it stands, with a margin, on free grass or concrete inside `lot`. The
  /// margin is wider than the diagonal of a cell, so that buildings whose cells are apart are apart themselves.
  bool put_up(const RoofedBuilding& shape, const ConvexPolygon& lot);

 private:
  PaintedGround& ground_;
  std::size_t wanted_;
  std::vector<RoofedBuilding> buildings_;
};

}  // namespace sigmascape::scene
