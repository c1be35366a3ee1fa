#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/radar/scatterer_lattice.h"
#include "sigmascape/radar/target.h"
#include "sigmascape/receiver/power_bins.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/simulate/frame_passes.h"
#include "sigmascape/simulate/lattice_sums.h"
#include "sigmascape/simulate/unhidden_echoes.h"
#include "sigmascape/trace/path_tracer.h"

namespace sigmascape::simulate {

/// Rays a cell in each pass: few, for what is left to noise are rare bright paths, which better spread points within a
/// pass do not find (docs/decisions/0066-tracing-to-an-error.md).
inline constexpr std::uint32_t rays_a_pass = 2;

/// What is to be traced. All that is referred to must outlive the TracedGround.
struct TracedView {
  const scene::Scene& scene;
  const trace::SceneGeometry& geometry;
  const std::vector<scatter::SurfaceModel>& surfaces;
  Vec3d radar;                            ///< from where lines of sight are straight
  radar::RangeAzimuthGrid bins;           ///< of the whole frame
  std::size_t first_beam = 0, beams = 0;  ///< of them those that are traced
  /// How far beside those an echo has a say in them, in beams: half of one, for echoes are shared between neighbours,
  /// and with cells as much more as one is wide, for those that reach into a beam are needed whole.
  double rim_beams = 0.5;
  radar::Rectangle area;  ///< of ground that the beams look at
  double cell_m = 1.0;    ///< side of the squares that rays are aimed at, and of the scatterers' cells
  int max_bounces = 8;
  std::uint64_t seed = 1;
  unsigned threads = 0;
  bool with_cells = false;  ///< whether to keep apart what lands on each cell of the scatterers' lattice
};

/// The ground of one view, traced in passes as often as wanted: bins and cells hold what all of them brought. Of a beam
/// they hold the same whether it is traced alone or among others, but for paths of several bounces, whose rays are
/// weighted by what else is traced.
class TracedGround {
 public:
  /// Throws Error for a radar that does not stand above the scene.
  explicit TracedGround(const TracedView& view);

  /// Adds passes with what stands behind the boxes of the targets left out: the same boxes in all passes.
  void add_passes(std::uint64_t count, std::span<const radar::Target> targets, double time_s);

  [[nodiscard]] const TracedView& view() const { return view_; }
  /// Of the beams that are traced, [beam][range].
  [[nodiscard]] const FramePasses& bins() const { return bins_; }
  [[nodiscard]] const LatticeSums& cells() const { return cells_; }
  /// Squares that rays are aimed at, and those of which anything came back.
  [[nodiscard]] std::size_t squares() const { return launch_.cells.size(); }
  [[nodiscard]] std::size_t answering() const;
  /// Where the middle of a cell lies, in beams and range bins of the frame; what LatticeSums counts places from.
  [[nodiscard]] LatticeSums::Place middle_of(radar::LatticeCell cell) const;

 private:
  void add_pass(UnhiddenEchoes& unhidden);
  void add(const radar::Echo& echo, receiver::PowerBins& pass);
  void add_to_cells(const radar::Echo& echo, Vec3d place, double beam, double range);
  /// Where on the ground someone who knows the ground alone takes an echo to come from.
  [[nodiscard]] Vec2d landing_of(const radar::Echo& echo, Vec3d place) const;
  [[nodiscard]] double beam_of(double azimuth_rad) const;

  TracedView view_;
  trace::LaunchArea launch_;
  trace::PathTracer tracer_;
  FramePasses bins_;
  LatticeSums cells_;
  std::vector<std::uint8_t> answers_;  // by square
};

}  // namespace sigmascape::simulate
