#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sigmascape/atlas/aspect_grid.h"
#include "sigmascape/bake/bake.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/radar/radar_file.h"
#include "sigmascape/scene/paper_scene.h"

namespace sigmascape::cli {

/// What a person may say about a measurement; what is absent follows from `small`.
struct ResultsOptions {
  bool small = false;
  bool without_finest_grid = false;  ///< as `small` goes too: that grid's bake takes longest
  std::string folder = "out/results";
  std::string measured;          ///< numbers of an earlier run to go on from; empty for none
  std::string page;              ///< Markdown page to write, its pictures beside it; empty for none
  std::string scene_file;        ///< a landscape to measure on instead of the paper's
  std::vector<double> around_m;  ///< east and north from that landscape's middle; empty for the middle itself
  bool itu_materials = false;
  std::optional<double> scale;
  std::optional<std::uint32_t> held_out, on_grid, baked_samples, finer_samples, traced_samples, most_traced_samples;
  std::uint32_t repeated = 3;  ///< of the views on the grid, baked twice
  int bounces = 8;
  std::uint64_t seed = 1;
  unsigned threads = 0;
};

/// A grid of baked looks: azimuths evenly spaced from north, each at every elevation.
struct LookGrid {
  unsigned azimuths = 8;
  std::vector<double> elevations_deg;
  std::string spacing = {};  ///< of the elevations, where it is all that tells the grid from another of as many looks

  [[nodiscard]] std::string name() const;  ///< "8 × 5", "8 × 5 in cot ψ"
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
  double slant_range_m = 20e3;  ///< the paper's radar
  /// Rays a 2 m cell of each of its two traced maps: ResultsPlan::traced_samples_of its kind, or more.
  std::uint32_t traced_samples = 64;
  /// Baked a second time from another seed, to tell the bake's noise; traced maps are made twice in any event.
  bool is_repeated = false;

  friend bool operator==(const PlannedView&, const PlannedView&) = default;
  [[nodiscard]] std::string file_name() const;    ///< "az130.00_el08.60"
  [[nodiscard]] std::string description() const;  ///< "azimuth 130.0°, elevation 8.6°"
  /// 2 m in range and across.
  [[nodiscard]] radar::RadarFile radar() const;
  /// The same from ten times as far away, where waves are as good as plane.
  [[nodiscard]] PlannedView from_afar() const;
};

/// The ways from a scene to a ground map that are held against one another.
enum class Method {
  Paper,         ///< the paper to the letter: render/paper_method.h
  BakedShadows,  ///< Shadows::Baked
  LevelGround,   ///< Shadows::RunTime, objects baked on level ground
  OwnGround,     ///< the same, objects baked on their own terrain
  Apart,         ///< the same, buildings kept apart
  Traced,        ///< from the full scene, with fewer rays than the truth
};

inline constexpr std::initializer_list<Method> all_methods = {
    Method::Paper, Method::BakedShadows, Method::LevelGround, Method::OwnGround, Method::Apart, Method::Traced};

[[nodiscard]] std::string text_of(Method method);

/// Everything that decides the numbers.
struct ResultsPlan {
  double scale = 0.25;  ///< side of what is measured over the paper's 2 km
  scene::PaperMaterials materials = scene::PaperMaterials::Paper;
  std::string scene_file = {};        ///< in place of the paper's scene
  Vec2d around_m = {};                ///< the middle of what is measured there, from that scene's own
  std::vector<LookGrid> grids;        ///< each within the next; of these only the last is baked
  std::vector<PlannedView> views;     ///< the paper's first
  std::uint32_t baked_samples = 16;   ///< rays a texel
  std::uint32_t finer_samples = 64;   ///< rays a texel of looks that are baked again, as free of noise as their truth
  std::uint32_t traced_samples = 64;  ///< rays a 2 m cell of one traced map
  /// The same of views that were not baked and whose two maps do not agree with fewer (least_agreement).
  std::uint32_t most_traced_samples = 64;
  /// Whether a bake as `sigmascape bake` makes it by default, with rays where the noise is, is measured from whole
  /// grids too.
  bool has_default_bake = true;
  int bounces = 8;
  std::uint64_t seed = 1;
  unsigned threads = 0;

  static constexpr double texel_m = 2000.0 / 1024.0;  ///< the paper's
  /// Rays a 2 m cell of traced maps that are held against the truth as a way of their own, where it has more.
  static constexpr std::uint32_t few_traced_samples[] = {1, 4, 16, 64, 256};

  /// Rays a 2 m cell of one traced map of a view. Views that were baked are held to the highest aims and get as many
  /// as the looks that are baked again.
  [[nodiscard]] std::uint32_t traced_samples_of(ViewKind kind) const {
    return kind == ViewKind::OnGrid ? finer_samples : traced_samples;
  }
  /// As many rays a square metre as finer_samples, of texels half as wide; two at least, as any bake.
  [[nodiscard]] std::uint32_t samples_of_finer_texels() const { return std::max(finer_samples / 4, 2U); }
  /// Width of the rim along the scene's edges that is not compared: what lies beyond the scene, bare ground that goes
  /// on level, has a part in what is returned there.
  [[nodiscard]] double rim_m() const;
  [[nodiscard]] double side_m() const { return 2000.0 * scale; }
  /// What the kept files of the scene are named after: "hills" for the paper's scene, "place" for another.
  [[nodiscard]] std::string scene_name() const { return scene_file.empty() ? "hills" : "place"; }
  /// Whether it is the paper's own scene: neither another place nor of other materials.
  [[nodiscard]] bool is_the_papers_scene() const {
    return scene_file.empty() && materials == scene::PaperMaterials::Paper;
  }
  /// Whether the same is measured on level ground too, as it is of the paper's scene.
  [[nodiscard]] bool has_level_ground() const { return scene_file.empty(); }
  /// The grid that all methods have and most tables are about: the paper's with five elevations.
  [[nodiscard]] const LookGrid& paper_grid() const { return grids[1]; }
  /// The grid after it.
  [[nodiscard]] const LookGrid& next_grid() const { return grids[2]; }
  /// The finest grid that a measurement may have; one that is to take minutes goes without.
  [[nodiscard]] static LookGrid finest_grid() { return {32, {3, 5, 7, 9, 13, 21, 29, 37}}; }
  [[nodiscard]] bool has_finest_grid() const { return grids.size() > 3; }
  /// The paper's grid with the elevations, or the azimuths, of the one after it.
  [[nodiscard]] LookGrid more_elevations() const { return {paper_grid().azimuths, next_grid().elevations_deg}; }
  [[nodiscard]] LookGrid more_azimuths() const { return {next_grid().azimuths, paper_grid().elevations_deg}; }
  /// The paper's grid with as many elevations over the same span, evenly spaced in cot ψ. No other grid holds them all,
  /// and so it is baked by itself.
  [[nodiscard]] LookGrid even_in_cotangent() const;
  /// The finest grid that buildings are kept apart from: their bakes are made beside those of all else.
  [[nodiscard]] const LookGrid& finest_grid_apart() const { return has_default_bake ? next_grid() : paper_grid(); }
  /// Of the finest grid for objects on their own ground, of finest_grid_apart with buildings apart, of the paper's
  /// otherwise.
  [[nodiscard]] bake::BakeSettings bake_settings(Method method) const;
  /// The places of a coarser grid within a finer one.
  [[nodiscard]] static atlas::AspectSelection selection_of(const LookGrid& grid, const atlas::AspectGrid& within);
  /// The angle between the line of sight and that of the nearest look of a grid, degrees.
  [[nodiscard]] static double distance_deg(const PlannedView& view, const LookGrid& grid);
};

[[nodiscard]] ResultsPlan results_plan(const ResultsOptions& options);

}  // namespace sigmascape::cli
