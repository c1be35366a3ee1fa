#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sigmascape/atlas/aspect_grid.h"
#include "sigmascape/bake/bake.h"
#include "sigmascape/radar/radar_file.h"

namespace sigmascape::cli {

/// What a person may say about a measurement; what is absent follows from `small`.
struct ResultsOptions {
  bool small = false;
  std::string folder = "out/results";
  std::string page;  ///< Markdown page to write; empty for none
  std::optional<double> scale;
  std::optional<std::uint32_t> held_out, on_grid, baked_samples, traced_samples;
  int bounces = 8;
  std::uint64_t seed = 1;
  unsigned threads = 0;
};

/// A grid of baked looks: azimuths evenly spaced from north, each at every elevation.
struct LookGrid {
  unsigned azimuths = 8;
  std::vector<double> elevations_deg;

  [[nodiscard]] std::string name() const;  ///< "8 × 5"
  [[nodiscard]] atlas::AspectGrid aspects() const;
};

/// Where views stand to the baked looks: exactly on one that all grids hold, anywhere, or where the paper's picture was
/// made.
enum class ViewKind { OnGrid, HeldOut, Paper };

[[nodiscard]] std::string text_of(ViewKind kind);

struct PlannedView {
  ViewKind kind = ViewKind::HeldOut;
  double azimuth_deg = 0.0;
  double elevation_deg = 0.0;

  [[nodiscard]] std::string file_name() const;    ///< "az130.00_el08.60"
  [[nodiscard]] std::string description() const;  ///< "azimuth 130.0°, elevation 8.6°"
  /// The paper's radar, 20 km away: 2 m in range and across.
  [[nodiscard]] radar::RadarFile radar() const;
};

/// Everything that decides the numbers.
struct ResultsPlan {
  double scale = 0.25;                ///< of the paper's scene
  std::vector<LookGrid> grids;        ///< each within the next; only the last is baked
  std::vector<PlannedView> views;     ///< the paper's first
  std::uint32_t baked_samples = 16;   ///< rays a texel
  std::uint32_t finer_samples = 64;   ///< rays a texel of the looks that are baked again to tell the noise of the bake
  std::uint32_t traced_samples = 64;  ///< rays a 2 m cell of one traced map
  int bounces = 8;
  std::uint64_t seed = 1;
  unsigned threads = 0;

  /// Width of the rim along the scene's edges that is not compared. A wall near the edge mirrors ground beyond it,
  /// which goes on in a bake and ends where the terrain does in a traced map: that would be held against the method.
  [[nodiscard]] double rim_m() const;
  [[nodiscard]] bake::BakeSettings bake_settings() const;  ///< of the finest grid
  /// The places of a coarser grid within the last.
  [[nodiscard]] atlas::AspectSelection selection_of(const LookGrid& grid) const;
  /// The place of one view on the grid within the last.
  [[nodiscard]] atlas::AspectSelection selection_of(const PlannedView& view) const;
};

[[nodiscard]] ResultsPlan results_plan(const ResultsOptions& options);

}  // namespace sigmascape::cli
