#pragma once

#include <functional>
#include <span>
#include <variant>
#include <vector>

#include "sigmascape/atlas/atlas.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/ground_grid.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/radar/scatterer.h"
#include "sigmascape/radar/scatterer_lattice.h"
#include "sigmascape/radar/target.h"
#include "sigmascape/radar/vantage.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::render {

/// σ0 of a point of the ground, linear and per horizontal area, as seen under an aspect. Called from several threads.
using ReflectivityField = std::function<radar::Channels(Vec2d point, const radar::Aspect& aspect)>;

/// What an atlas says: textures and, where it is kept apart, the bare ground behind what stands on it.
struct AtlasReflectivity {
  const atlas::Atlas* atlas = nullptr;
  double frequency_hz = 0.0;
  double level = 0.0;
};

using Reflectivity = std::variant<ReflectivityField, AtlasReflectivity>;

/// What an atlas says at the level whose texels are as large as `cell_m`. The atlas must outlive it. Throws Error when
/// the atlas has not been baked near this frequency.
[[nodiscard]] Reflectivity reflectivity_of(const atlas::Atlas& atlas, double frequency_hz, double cell_m);

struct ScattererRequest {
  /// From where visibility and aspect are reckoned, and by that when targets cast their shadows: the middle of the
  /// flight, or for a strip wherever its beam passes.
  radar::Vantage vantage;
  radar::Rectangle area;
  int level = 0;  ///< of the lattice; its cells should be no larger than half the finest resolution
  unsigned threads = 0;
  radar::CurvedEarth earth = radar::CurvedEarth::flat();  ///< for sight and aspect; places are in the local frame
};

/// Throws Error when the area has more cells of this side than 2²⁷, or than memory holds at 136 bytes each: for asking
/// before the work.
void check_scatterers(const radar::Rectangle& area, double side_m);

/// The scatterers of all ground in the area that the radar sees over the terrain: one a cell of the lattice, with the
/// cross-section σ0 · (area of the cell) in the mean, as the power mode has it (ReflectingGround). Ordered by rows from
/// the south. Ground behind a target's box is left out: its shadow, which stays where it is however the target's echo
/// is moved.
///
/// Throws Error as `check_scatterers` does.
[[nodiscard]] std::vector<radar::Scatterer> ground_scatterers(const terrain::HeightField& terrain,
                                                              const Reflectivity& sigma0,
                                                              const radar::ScattererLattice& lattice,
                                                              const ScattererRequest& request,
                                                              std::span<const radar::Target> targets = {});

}  // namespace sigmascape::render
