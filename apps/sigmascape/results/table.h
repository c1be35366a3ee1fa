#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "results/plan.h"

#include "sigmascape/product/level_errors.h"
#include "sigmascape/product/map_metrics.h"
#include "sigmascape/product/noise_free_metrics.h"

namespace sigmascape::cli {

/// The cells that most tables are about, and levels of true σ0 that part their error.
inline constexpr double summary_cell_m = 8.0;
inline constexpr double level_bounds_db[] = {-30.0, -15.0};

/// The correlation of dB at summary_cell_m to which two traced maps of a view are to agree.
inline constexpr double least_agreement = 0.99;

inline constexpr const char* own_look = "own look";

/// Changes of the paper's method.
inline constexpr const char* cotangent_change = "elevations blended in cot ψ";
inline constexpr const char* gamma_change = "γ blended instead of σ0";
inline constexpr const char* cotangent_gamma_change = "γ blended in cot ψ";
inline constexpr const char* map_area_change = "map area instead of the slope's";
inline constexpr const char* middle_change = "azimuths blended over the middle 12°";
inline constexpr const char* finest_change = "no mips";
inline constexpr const char* halves_change = "half floats";
/// Changes of ours.
inline constexpr const char* renormalized_change = "power by tiles";
inline constexpr const char* shared_noise_change = "noise shared";
inline constexpr const char* finer_texels_change = "texels half as wide";
/// As `sigmascape bake` does if not told otherwise: bake::Sampling's own target, no fixed number of rays.
inline constexpr const char* adaptive_change = "rays where the noise is";

/// What is measured together: all views of one kind of one scene, made in one way.
struct ResultsCase {
  std::string scene;  ///< "hills", "level" or "place"
  Method method = Method::OwnGround;
  std::string grid;  ///< "8 × 5", or own_look for the one look that is the view's own; empty of traced maps
  std::uint32_t baked_samples = 0;  ///< rays a texel, of traced maps a cell; 0: as many as each wants
  ViewKind kind = ViewKind::HeldOut;
  std::string change = {};  ///< what of the method is otherwise, one of the names below; empty for nothing
  int level_of_detail = 1;

  friend bool operator==(const ResultsCase&, const ResultsCase&) = default;
};

/// Of those that are numbers, of an even count the mean of the middle two; NaN for none.
[[nodiscard]] double median(std::vector<double> values);

/// Method and change, "ours, on its own ground, rays where the noise is".
[[nodiscard]] std::string way_text(const ResultsCase& of);

/// The atlas that a map was rendered from.
struct AtlasCost {
  std::size_t looks = 0;
  std::uintmax_t store_bytes = 0;
  std::size_t memory_bytes = 0;  ///< as far as it is of the scene's extent
  double bake_seconds = 0.0;     ///< of processor time
};

/// One baked map against the truth.
struct ViewResult {
  ResultsCase of;
  PlannedView view;
  AtlasCost atlas;
  product::MapComparison comparison;
  product::MapComparison noise_floor;  ///< one traced map against another
  /// The squared error at summary_cell_m by level of truth, and that of one traced map against another.
  std::vector<product::LevelError> by_level, noise_by_level;
  /// Of a map that was made twice, at summary_cell_m.
  std::optional<product::NoiseFreeComparison> without_noise = {};
  double trace_seconds = 0.0;  ///< of processor time, for one traced map
  double render_ms = 0.0;      ///< of processor time
};

/// How well the two traced maps of the view agree: their correlation of dB at summary_cell_m; NaN when they were too
/// small for such cells.
[[nodiscard]] double agreement(const ViewResult& view);

/// A case at one cell size. Medians and worst values are taken over the views, each number by itself; the worst bias is
/// the one farthest from zero. The overlap of shadows is of the views whose traced maps have enough of them; NaN for
/// none.
struct ResultsCell {
  product::CellComparison median, worst;
  product::CellComparison floor_median, floor_worst;
  std::size_t shadow_views = 0;  ///< that the overlap of shadows is of
};

/// A case at one view, at summary_cell_m.
struct ResultsAtView {
  double azimuth_deg = 0.0, elevation_deg = 0.0;
  product::CellComparison tested;
};

/// What is left at summary_cell_m without noise, beside what was measured: medians over the views that were repeated.
struct ResultsWithoutNoise {
  std::size_t views = 0;
  double correlation_db = 0.0, rms_db = 0.0;
  product::CellComparison measured, noise_floor;
};

/// Rays a 2 m cell of the traced maps of some views.
struct TracedRays {
  std::uint32_t fewest = 0, most = 0;

  [[nodiscard]] std::string text() const;  ///< "1024", "1024 to 6144"
  /// For times, which are of the fewest: " with 1024" where others have more.
  [[nodiscard]] std::string with_fewest() const;
};

struct ResultsRow {
  ResultsCase of;
  std::size_t views = 0;
  std::size_t agreeing_views = 0;  ///< whose two traced maps agree to least_agreement
  TracedRays rays;
  AtlasCost atlas;             ///< mean over the views
  double trace_seconds = 0.0;  ///< median over the views, of so many rays as the view with the fewest has
  double render_ms = 0.0;      ///< median over the views
  std::vector<ResultsCell> cells;
  std::vector<ResultsAtView> at_views;
  std::vector<product::LevelError> by_level, noise_by_level;  ///< sums over the views
  ResultsWithoutNoise without_noise = {};

  /// The entry of that cell size; nullptr when the maps were too small for it.
  [[nodiscard]] const ResultsCell* at_cell(double cell_m) const;
};

/// One row a case, in the order in which the cases first appear.
[[nodiscard]] std::vector<ResultsRow> rows_of(const std::vector<ViewResult>& views);

/// The row of a case, or nullptr.
[[nodiscard]] const ResultsRow* find_row(const std::vector<ResultsRow>& rows, const ResultsCase& of);

/// The row of the paper's method and grid at such views, the baseline of every table; nullptr for none. All methods are
/// measured at the same views, so that its noise floor is theirs.
[[nodiscard]] const ResultsRow* baseline_row(const ResultsPlan& plan, const std::vector<ResultsRow>& rows,
                                             const std::string& scene, ViewKind kind);

/// The entry of a row for summary_cell_m; nullptr for no row, and when the maps were too small for it.
[[nodiscard]] const ResultsCell* summary_cell(const ResultsRow* row);

/// Rays of the traced maps of such views; those that are planned where none was measured.
[[nodiscard]] TracedRays traced_rays(const ResultsPlan& plan, const std::vector<ResultsRow>& rows,
                                     const std::string& scene, ViewKind kind);

/// What two traced maps of one of such views differ by at summary_cell_m, medians; nullptr for none.
[[nodiscard]] const product::CellComparison* noise_floor(const ResultsPlan& plan, const std::vector<ResultsRow>& rows,
                                                         const std::string& scene, ViewKind kind);

/// {"settings": …, "rows": one entry a case and cell, "views": one entry a map and cell}.
[[nodiscard]] nlohmann::ordered_json results_json(const ResultsPlan& plan, const std::vector<ResultsRow>& rows,
                                                  const std::vector<ViewResult>& views);

}  // namespace sigmascape::cli
