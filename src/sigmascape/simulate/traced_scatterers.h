#pragma once

#include <complex>
#include <span>

#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/scatterer_lattice.h"
#include "sigmascape/simulate/traced_ground.h"

namespace sigmascape::simulate {

/// The lattice that a frame is drawn from, as the radar sees it.
struct ScattererView {
  const radar::ScattererLattice& lattice;
  int level = 0;
  Vec3d radar;  ///< where it stands
  radar::CurvedEarth earth = {};
  double frequency_hz = 10e9;
};

/// Adds traced ground to its beams among the bins of a frame, [beam][range][VV, HH, HV, VH] in metres, as one scatterer
/// a cell of the lattice:
///
///     a(bin) = Σ_cells √w(bin, cell) · √P(cell) ξ(cell) exp(−j 4π R(cell)/λ),   so that  E|a(bin)|² = Σ w P
///
/// P is what the cell's echoes bring, w the linear shares of the four bins about their middle, R the range of the
/// scatterer's own place in the cell, on the ground.
void add_scatterers(const TracedGround& ground, const ScattererView& view, std::span<std::complex<float>> amplitudes_m);

}  // namespace sigmascape::simulate
