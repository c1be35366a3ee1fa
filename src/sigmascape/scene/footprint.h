#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "sigmascape/geo/polygon_overlay.h"
#include "sigmascape/scene/flaw_tally.h"
#include "sigmascape/scene/scene.h"

namespace sigmascape::scene {

/// The ground plan of a building before it is raised.
struct Footprint {
  geo::Polygons shape;
  double height_m = 0.0;
  MaterialIndex wall = 0, roof = 0;
  std::size_t source = 0;  ///< which of the scene's building files it comes from
  std::string id;
  geo::Polygons uncut{};              ///< the shape before taller ones cut it; empty where none did
  std::vector<std::size_t> cut_of{};  ///< of each polygon of the shape, which of `uncut` it is a piece of, if cut
};

/// Makes footprints share no ground, because a wall inside another building would make a dihedral that is not there. Of
/// two that overlap the lower is cut by the taller; those of equal height that overlap by a tenth of the smaller become
/// one. What a cut leaves that is less than 1 m² or 0.2 m across is dropped. Every footprint that changed is counted in
/// its source's tally.
[[nodiscard]] std::vector<Footprint> without_overlaps(std::vector<Footprint> footprints, std::span<FlawTally> tallies);

/// What a polygon of a footprint's shape, by its number, was before it was cut: all pieces of it are one building,
/// under one roof.
[[nodiscard]] const geo::Polygon& whole_of(std::size_t piece, const Footprint& footprint);

}  // namespace sigmascape::scene
