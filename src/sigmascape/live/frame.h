#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "sigmascape/live/drawn_beams.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/receiver/targets_by_beam.h"

namespace sigmascape::live {

/// What a frame cost and what it lacked.
struct FrameReport {
  std::size_t cells = 0;   ///< lattice cells looked at; where the atlas ends they are counted alone
  std::size_t lit = 0;     ///< of them seen by the radar
  std::size_t coarse = 0;  ///< of them shown from a coarser level than wanted, for the finer was not there yet
  /// Others of them for which there was nothing, of the ground or of what stands on it: outside the atlas, or its two
  /// coarsest levels are damaged.
  std::size_t dark = 0;
  std::size_t level = 0;  ///< of the textures, 0 the finest; of two in use that with more of the power
  /// By how much the terrain that hides may be wrong, for tiles of it cannot be had, or were not there yet: then it is
  /// taken to lie so much lower that no ground is hidden by what is not there. 0 when nothing was lacking.
  double terrain_error_m = 0.0;
  /// Tiles of what stands on the ground under all beams (256 × 256 squares each) that are coarser than the sweep's
  /// steps, for finer ones were not there yet, cannot be had or are more than the budget holds: shadows are those of
  /// several obstacles together. 0 when nothing was lacking, and where the textures hold the shadows.
  std::size_t coarse_obstacles = 0;
  std::size_t targets = 0;  ///< of those of the pose that stand in the bins and are seen, by a step's beams of a scan
  /// By how much the radar lies below the ground, as far as the terrain that is there tells for sure: it sees little or
  /// nothing then. 0 above it. A radar that is deeper than all terrain about it is refused. Beyond the terrain, where
  /// the ground is not known, below the lowest of all that is, or below mean sea level where that is lower. 0 of a
  /// traced frame.
  double below_ground_m = 0.0;
  /// How many beams a cell is wide at the nearest ground in the bins, where beams are narrowest: what is told apart
  /// across them there is so much coarser than they are. 1 where none is narrower than a cell, 0 of a traced frame.
  double beams_a_cell = 0.0;
  /// Of a frame that was traced (simulate::LiveTracer): rays a cell that it is made of; 0 of one from textures.
  std::uint64_t rays_per_cell = 0;
  /// And the standard error of a bin's mean power, 10 lg(1 + s/P), in the median over the bins that answer to at
  /// least half of the rays' passes; infinite while too few rays were sent to tell.
  double median_error_db = 0.0;
};

/// A frame, valid until the next one.
struct Frame {
  radar::RangeAzimuthGrid grid;
  /// [beam][range][VV, HH, HV, VH], metres: |a|² is a cross-section in m², and the phase that of the way out and back,
  /// −4π r/λ, which falls as range r grows. Empty when powers were asked for.
  std::span<const std::complex<float>> amplitudes_m;
  /// [beam][range][VV, HH, HV, Re VV·HH*], m². Empty when amplitudes were asked for.
  std::span<const float> powers_m2;
  FrameReport report;
  /// Of the ground and the targets that answer: what a radar's is held against (live::image_of); 0 of a frame that
  /// nobody has said it of.
  double frequency_hz = 0.0;
  /// On which ranges and depressions are reckoned: LiveSettings::refraction.
  radar::CurvedEarth earth = {};
  /// What of it targets are: their echoes, each from its own place, and what the bins held before.
  receiver::TargetsApart targets = {};
  /// [beam] When each was drawn, and from where: in steps of a scan they differ.
  std::span<const DrawnBeam> beams = {};
  /// Number of the last drawing that it knows of: that of the beam drawn last. 0 before the first.
  std::uint64_t drawing = 0;
};

/// Throws Error, naming `who` wants the bins, for a frame that nobody has drawn yet, and for what was told of bins that
/// have been drawn into since, or of which a drawing that broke off has left some.
void check_holds(const Frame& frame, const std::string& who);

}  // namespace sigmascape::live
