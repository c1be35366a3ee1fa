#include "results/causes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

#include "results/columns.h"

#include "sigmascape/base/units.h"

namespace sigmascape::cli {
namespace {

constexpr const char* flat_shadows = "flat-ground shadows on slopes";

/// A cause beside others of the same views, and what an error falls by without it.
struct WeighedCause {
  Contrast contrast;
  std::vector<FallAtView> falls;

  [[nodiscard]] std::string text() const { return fmt::format("{} ({})", contrast.name, contrast.how); }
  [[nodiscard]] PairedFall fall() const { return paired(falls); }
  /// At one view; 0 where it was not measured.
  [[nodiscard]] double falls_by_at(double azimuth_deg, double elevation_deg) const {
    const auto at_view =
        std::ranges::find_if(falls, [&](const FallAtView& fall) { return fall.is_at(azimuth_deg, elevation_deg); });
    return at_view != falls.end() ? at_view->falls_by : 0.0;
  }
};

std::vector<WeighedCause> weighed_causes(const ResultsPlan& plan, const std::vector<ResultsRow>& rows, ViewKind kind,
                                         double product::CellComparison::*error) {
  std::vector<WeighedCause> weighed;
  for (const Contrast& cause : causes(plan, kind)) {
    const auto both = measured(cause, rows);
    if (both && are_of_the_same_views(cause))
      weighed.push_back({cause, falls_at_views(*both->with, *both->without, error)});
  }
  return weighed;
}

/// What takes most off the error at one view; nullptr where nothing takes any.
const WeighedCause* largest_at(const std::vector<WeighedCause>& causes, double azimuth_deg, double elevation_deg) {
  const WeighedCause* largest = nullptr;
  double most = 0.0;
  for (const WeighedCause& cause : causes) {
    const double falls_by = cause.falls_by_at(azimuth_deg, elevation_deg);
    if (falls_by <= most) continue;
    most = falls_by;
    largest = &cause;
  }
  return largest;
}

/// The cause that takes most off an error.
struct LargestCause {
  std::string cause;
  PairedFall fall;
  std::size_t largest_at = 0;  ///< views at which no other takes more off

  /// "by 2.00 dB in the median over the views, at 20 of 24; it is the largest cause at 15 of these views".
  [[nodiscard]] std::string text(int decimals, const char* unit) const {
    return fmt::format(
        "by {}{} in the median over the views, at {} of {}; it is the largest cause at {} of these views",
        number_text(fall.median, decimals), unit, fall.better, fall.views, largest_at);
  }
};

std::optional<LargestCause> largest(const ResultsPlan& plan, const std::vector<ResultsRow>& rows, ViewKind kind,
                                    double product::CellComparison::*error) {
  const auto weighed = weighed_causes(plan, rows, kind, error);
  const WeighedCause* most = nullptr;
  for (const WeighedCause& cause : weighed) {
    if (cause.fall().median > (most != nullptr ? most->fall().median : 0.0)) most = &cause;
  }
  if (most == nullptr) return std::nullopt;
  // One cause may be measured by both methods, and is no rival of itself.
  const auto is_largest = [&](const FallAtView& fall) {
    const WeighedCause* cause = largest_at(weighed, fall.azimuth_deg, fall.elevation_deg);
    return cause != nullptr && cause->contrast.name == most->contrast.name;
  };
  return LargestCause{most->text(), most->fall(),
                      static_cast<std::size_t>(std::ranges::count_if(most->falls, is_largest))};
}

}  // namespace

bool are_of_the_same_views(const Contrast& contrast) {
  return contrast.with.scene == contrast.without.scene && contrast.with.kind == contrast.without.kind;
}

std::vector<Contrast> causes(const ResultsPlan& plan, ViewKind kind) {
  const auto from_grid = [&](Method method, const char* change = "") {
    return ResultsCase{.scene = plan.scene_name(),
                       .method = method,
                       .grid = plan.paper_grid().name(),
                       .baked_samples = plan.baked_samples,
                       .kind = kind,
                       .change = change};
  };
  const auto from_own_look = [&](Method method, std::uint32_t samples, const char* change = "") {
    ResultsCase of = from_grid(method, change);
    of.grid = own_look;
    of.baked_samples = samples;
    return of;
  };
  const ResultsCase paper = from_grid(Method::Paper), own_ground = from_grid(Method::OwnGround),
                    level_ground = from_grid(Method::LevelGround);
  std::vector<Contrast> list;
  // A view that was baked misses no angle.
  if (kind != ViewKind::OnGrid) {
    const std::string against = fmt::format("the {} grid against the view's own look", plan.paper_grid().name());
    list.push_back({"missing angles", "ours on its own ground: " + against, own_ground,
                    from_own_look(Method::OwnGround, plan.baked_samples)});
    list.push_back(
        {"missing angles", "the paper's method: " + against, paper, from_own_look(Method::Paper, plan.baked_samples)});
  }
  list.push_back(
      {flat_shadows, "ours: shadows baked against made at run time", from_grid(Method::BakedShadows), level_ground});
  list.push_back({"layover placement and mutual shadowing on slopes",
                  "ours: baked on level ground against on its own ground", level_ground, own_ground});
  list.push_back({"mip levels", "the paper's method: mips against the finest level alone", paper,
                  from_grid(Method::Paper, finest_change)});
  list.push_back({"half-float texels", "the paper's method: halves against floats",
                  from_grid(Method::Paper, halves_change), paper});
  if (kind != ViewKind::OnGrid) return list;

  // Only views that were baked have looks almost without noise.
  const ResultsCase finer = from_own_look(Method::OwnGround, plan.finer_samples);
  list.push_back({"sampling noise of the bake",
                  fmt::format("ours on its own ground, own look: {} rays a texel against {}", plan.baked_samples,
                              plan.finer_samples),
                  from_own_look(Method::OwnGround, plan.baked_samples), finer});
  list.push_back(
      {"texel size",
       fmt::format("the same from as many rays a square metre, {} and {} a texel: texels of {:.2f} m against "
                   "{:.2f} m",
                   plan.finer_samples, plan.samples_of_finer_texels(), plan.texel_m, plan.texel_m / 2.0),
       finer, from_own_look(Method::OwnGround, plan.samples_of_finer_texels(), finer_texels_change)});
  ResultsCase levelled = paper;
  levelled.scene = "level";
  list.push_back({"flat-ground shadows and layover on slopes",
                  "the paper's method: hills against level ground, another truth", paper, levelled});
  return list;
}

std::string causes_table(const ResultsPlan& plan, const std::vector<ResultsRow>& rows, ViewKind kind) {
  std::string text =
      "| cause | how it is switched off | with it: correlation | RMS [dB] | L1 | IoU | without it: correlation | RMS "
      "[dB] | L1 | IoU | RMS falls by, median [dB] | at views |\n"
      "|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";
  text += truth_line(plan, rows, kind, " | | | | | |");
  for (const Contrast& cause : causes(plan, kind)) {
    if (const auto both = measured(cause, rows)) {
      const PairedFall fall = are_of_the_same_views(cause)
                                  ? fall_between(*both->with, *both->without, &product::CellComparison::rms_db)
                                  : PairedFall{};
      text += fmt::format("| {} | {} | {} | {} | {} |\n", cause.name, cause.how, error_text(both->with_cell->median),
                          error_text(both->without_cell->median), fall_text(fall, &PairedFall::median));
    }
  }
  return text;
}

std::string largest_causes(const ResultsPlan& plan, const std::vector<ResultsRow>& rows, ViewKind kind) {
  const auto by_rms = largest(plan, rows, kind, &product::CellComparison::rms_db);
  const auto by_l1 = largest(plan, rows, kind, &product::CellComparison::l1);
  const std::string rms = by_rms ? fmt::format("by RMS is: {}. Without it the RMS error at {:.0f} m cells falls {}.",
                                               by_rms->cause, summary_cell_m, by_rms->text(2, " dB"))
                                 : "by RMS is none: no cause adds to it.";
  std::string l1 = "No cause adds to the relative L1.";
  if (by_l1 && by_rms && by_l1->cause == by_rms->cause) {
    l1 = fmt::format("It is by relative L1 too, which falls {}.", by_l1->text(3, ""));
  } else if (by_l1) {
    l1 = fmt::format("By relative L1 it is: {}. Without it L1 falls {}.", by_l1->cause, by_l1->text(3, ""));
  }
  return fmt::format("The largest {} {}", rms, l1);
}

std::string flat_shadows_text(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  constexpr double least_bias_db = 3.0;
  const ResultsRow* paper = baseline_row(plan, rows, plan.scene_name(), ViewKind::OnGrid);
  if (summary_cell(paper) == nullptr || paper->at_views.empty()) return {};
  const ResultsAtView& worst = *std::ranges::max_element(
      paper->at_views, {}, [](const ResultsAtView& view) { return std::abs(view.tested.bias_db); });
  const auto weighed = weighed_causes(plan, rows, ViewKind::OnGrid, &product::CellComparison::rms_db);
  const WeighedCause* cause = largest_at(weighed, worst.azimuth_deg, worst.elevation_deg);
  const bool is_far_off = std::abs(worst.tested.bias_db) >= least_bias_db;
  if (!is_far_off || cause == nullptr || cause->contrast.name != flat_shadows) return {};
  const bool is_dark = worst.tested.bias_db < 0.0;
  return fmt::format(
      "The total power of the paper's maps is farthest off at azimuth {:.1f}°, elevation {:.1f}°: {} dB too {}, {} dB "
      "RMS, correlation {}. There flat-ground shadows are the largest cause: our own maps come closer by {} dB when "
      "shadows are made at run time. Baked ones are {:.1f} times as long as what casts them is high, whatever the "
      "slope; on those that face {} the radar true shadows are {}.",
      worst.azimuth_deg, worst.elevation_deg, number_text(std::abs(worst.tested.bias_db), 2),
      is_dark ? "dark" : "bright", number_text(worst.tested.rms_db, 2), number_text(worst.tested.correlation_db, 3),
      number_text(cause->falls_by_at(worst.azimuth_deg, worst.elevation_deg), 2),
      1.0 / std::tan(radians_from_deg(worst.elevation_deg)), is_dark ? "towards" : "away from",
      is_dark ? "shorter" : "longer");
}

std::string causes_section(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  std::string text = fmt::format(
      "## Why\n\nWhat the error is made of: each line switches one cause off and leaves all else as it is, and what "
      "the error falls by is that cause's part. Medians over the views at {:.0f} m cells, from the {} grid where "
      "nothing else is said; what the RMS falls by is the median of each view's own fall, which need not be the "
      "difference of the two medians, and beside it stands at how many of the views it falls. The cause with the "
      "largest such median is named below each table, among those whose two maps are held against one truth.\n\n",
      summary_cell_m, plan.paper_grid().name());
  for (const ViewKind kind : {ViewKind::HeldOut, ViewKind::OnGrid}) {
    if (baseline_row(plan, rows, plan.scene_name(), kind) == nullptr) continue;
    text += fmt::format("### At views that were {}baked\n\n{}\n{}\n\n", kind == ViewKind::OnGrid ? "" : "not ",
                        causes_table(plan, rows, kind), largest_causes(plan, rows, kind));
    const std::string of_shadows = kind == ViewKind::OnGrid ? flat_shadows_text(plan, rows) : "";
    if (!of_shadows.empty()) text += of_shadows + "\n\n";
  }
  return text;
}

}  // namespace sigmascape::cli
