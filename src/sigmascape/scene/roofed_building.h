#pragma once

#include "sigmascape/scene/scene.h"

namespace sigmascape::scene {

enum class RoofForm {
  Flat,
  Gabled,
  Hipped,
  FlatLShaped,    ///< flat, on a footprint with one corner left out; all of the material of the walls
  FlatWithHouse,  ///< flat, with the head of a stairwell on it
};

/// A simple building on a rectangle.
struct RoofedBuilding {
  Vec2d centre{};
  Vec2d along{1.0, 0.0};  ///< unit vector of the longer side; a ridge runs this way
  double length_m = 10.0, depth_m = 8.0;
  double eaves_m = 5.0;
  double roof_rise_m = 2.5;  ///< of gabled and hipped roofs
  RoofForm roof = RoofForm::Gabled;
  MaterialIndex walls = 0;
  MaterialIndex roofing = 0;
};

/// Adds a closed building with outward normals. Every flat facet has vertices of its own: a flat box has 24, a gabled
/// house 30.
void append_roofed_building(Buildings& buildings, const RoofedBuilding& building, double footing_m);

/// The lowest terrain height along the building's rectangle, sampled every two metres or closer.
[[nodiscard]] double footing_m(const terrain::HeightField& terrain, const RoofedBuilding& building);

}  // namespace sigmascape::scene
