#include "results_causes.h"

#include <fmt/format.h>
#include <optional>

#include "results_tile_power.h"

namespace sigmascape::cli {
namespace {

/// Two rows of measurements that both exist.
struct Found {
  const ResultsRow *with, *without;
  const ResultsCell *with_cell, *without_cell;
};

std::optional<Found> found(const Contrast& contrast, const std::vector<ResultsRow>& rows) {
  const Found both{find_row(rows, contrast.with), find_row(rows, contrast.without), nullptr, nullptr};
  if (both.with == nullptr || both.without == nullptr) return std::nullopt;
  const Found cells{both.with, both.without, both.with->at_cell(summary_cell_m), both.without->at_cell(summary_cell_m)};
  if (cells.with_cell == nullptr || cells.without_cell == nullptr) return std::nullopt;
  return cells;
}

std::string metrics(const product::CellComparison& cell) {
  return fmt::format("{:.3f} | {:.2f} | {:.3f} | {:.2f}", cell.correlation_db, cell.rms_db, cell.l1, cell.shadow_iou);
}

/// The first line of a table: what two traced maps of the views differ by, for no method can be shown to come closer,
/// and cells that stay empty. No line without such views.
std::string truth_line(const ResultsPlan& plan, const std::vector<ResultsRow>& rows, ViewKind kind,
                       const char* empty_cells) {
  const ResultsRow* row = baseline_row(plan, rows, plan.scene_name(), kind);
  const ResultsCell* cell = row != nullptr ? row->at_cell(summary_cell_m) : nullptr;
  if (cell == nullptr) return {};
  return fmt::format("| *truth* | one traced map against another | {} |{}\n", metrics(cell->floor_median), empty_cells);
}

/// What the error falls by when the cause that adds most to it is switched off.
struct Fall {
  std::string cause;
  double with = 0.0, without = 0.0;
};

std::optional<Fall> largest(const ResultsPlan& plan, const std::vector<ResultsRow>& rows, ViewKind kind,
                            double product::CellComparison::*error) {
  std::optional<Fall> most;
  for (const Contrast& cause : causes(plan, kind)) {
    const auto both = found(cause, rows);
    if (!both || !are_of_the_same_views(cause)) continue;
    const double with = both->with_cell->median.*error, without = both->without_cell->median.*error;
    if (with - without > (most ? most->with - most->without : 0.0))
      most = {fmt::format("{} ({})", cause.name, cause.how), with, without};
  }
  return most;
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
    list.push_back({"missing angles", "ours on its own ground: the grid against the view's own look", own_ground,
                    from_own_look(Method::OwnGround, plan.baked_samples)});
    list.push_back({"missing angles", "the paper's method: the grid against the view's own look", paper,
                    from_own_look(Method::Paper, plan.baked_samples)});
  }
  list.push_back({"shadows on the ground alone", "ours: baked against made at run time",
                  from_grid(Method::BakedShadows), level_ground});
  list.push_back({"layover of objects on slopes and how they shade each other",
                  "ours: baked on level ground against on its own ground", level_ground, own_ground});
  list.push_back({"mips", "the paper's method: mips against the finest level alone", paper,
                  from_grid(Method::Paper, finest_change)});
  list.push_back(
      {"half floats", "the paper's method: halves against floats", from_grid(Method::Paper, halves_change), paper});
  if (kind != ViewKind::OnGrid) return list;

  // Only views that were baked have looks almost without noise.
  const ResultsCase finer = from_own_look(Method::OwnGround, plan.finer_samples);
  list.push_back({"noise of the bake",
                  fmt::format("ours on its own ground, own look: {} rays a texel against {}", plan.baked_samples,
                              plan.finer_samples),
                  from_own_look(Method::OwnGround, plan.baked_samples), finer});
  list.push_back({"texels as wide as the finest cells",
                  fmt::format("the same from {} rays: texels of {:.2f} m against {:.2f} m", plan.finer_samples,
                              plan.texel_m, plan.texel_m / 2.0),
                  finer, from_own_look(Method::OwnGround, plan.samples_of_finer_texels(), finer_texels_change)});
  ResultsCase levelled = paper;
  levelled.scene = "level";
  list.push_back({"shadows and layover of level ground laid on slopes",
                  "the paper's method: hills against level ground, another truth", paper, levelled});
  return list;
}

std::vector<Contrast> changes(const ResultsPlan& plan) {
  const std::string place = plan.scene_name(), grid = plan.paper_grid().name();
  const ResultsCase paper{.scene = place, .method = Method::Paper, .grid = grid, .baked_samples = plan.baked_samples};
  std::vector<Contrast> list;
  for (const char* change : {cotangent_change, gamma_change, cotangent_gamma_change, map_area_change}) {
    ResultsCase changed = paper;
    changed.change = change;
    list.push_back({change, "paper", changed, paper});
  }
  ResultsCase baked = paper, level = paper, own = paper, elevations = paper, azimuths = paper, both = paper;
  baked.method = Method::BakedShadows;
  level.method = Method::LevelGround;
  own.method = elevations.method = azimuths.method = both.method = Method::OwnGround;
  elevations.grid = plan.more_elevations().name();
  azimuths.grid = plan.more_azimuths().name();
  both.grid = plan.grids[2].name();
  list.push_back({"ours: echoes straight into texels, γ in cot ψ, map area, half floats", "paper", baked, paper});
  list.push_back({"shadows made at run time", text_of(Method::BakedShadows), level, baked});
  list.push_back({"objects baked on their own ground", text_of(Method::LevelGround), own, level});
  ResultsCase by_tiles = own;
  by_tiles.change = renormalized_change;
  list.push_back({fmt::format("every {:.0f} m tile given the power that it has from {}", power_tile_m, both.grid),
                  text_of(Method::OwnGround), by_tiles, own});
  ResultsCase even = own;
  even.grid = plan.even_in_cotangent().name();
  list.push_back({"as many elevations, spaced evenly, " + even.grid, text_of(Method::OwnGround), even, own});
  list.push_back({"more elevations, " + elevations.grid, text_of(Method::OwnGround), elevations, own});
  list.push_back({"more azimuths, " + azimuths.grid, text_of(Method::OwnGround), azimuths, own});
  list.push_back({"both, " + both.grid, text_of(Method::OwnGround), both, own});
  if (plan.grids.size() > 3) {
    ResultsCase finest = both;
    finest.grid = plan.grids.back().name();
    list.push_back({"the finest, " + finest.grid, text_of(Method::OwnGround), finest, own});
  }
  return list;
}

std::string causes_table(const ResultsPlan& plan, const std::vector<ResultsRow>& rows, ViewKind kind) {
  std::string text =
      "| cause | with against without it | with: correlation | RMS [dB] | L1 | IoU | without: correlation | RMS [dB] | "
      "L1 | IoU |\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|\n";
  text += truth_line(plan, rows, kind, " | | | |");
  for (const Contrast& cause : causes(plan, kind)) {
    if (const auto both = found(cause, rows)) {
      text += fmt::format("| {} | {} | {} | {} |\n", cause.name, cause.how, metrics(both->with_cell->median),
                          metrics(both->without_cell->median));
    }
  }
  return text;
}

std::string changes_table(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  std::string text =
      "| change | to | before: correlation | RMS [dB] | L1 | IoU | MB | frame [ms] | after: correlation | RMS [dB] | "
      "L1 "
      "| IoU | MB | frame [ms] |\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";
  text += truth_line(plan, rows, ViewKind::HeldOut, " | | | | | | | |");
  for (const Contrast& change : changes(plan)) {
    const auto both = found(change, rows);
    if (!both) continue;
    const auto side = [](const ResultsRow& row, const ResultsCell& cell) {
      return fmt::format("{} | {:.2f} | {:.0f}", metrics(cell.median), static_cast<double>(row.atlas.store_bytes) / 1e6,
                         row.render_ms);
    };
    text += fmt::format("| {} | {} | {} | {} |\n", change.name, change.how, side(*both->without, *both->without_cell),
                        side(*both->with, *both->with_cell));
  }
  return text;
}

std::string worth_of_looks(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  ResultsCase own{.scene = plan.scene_name(),
                  .method = Method::OwnGround,
                  .grid = plan.paper_grid().name(),
                  .baked_samples = plan.baked_samples};
  std::string text;
  for (const auto& [what, looks] :
       {std::pair("elevations", plan.more_elevations()), {"azimuths", plan.more_azimuths()}}) {
    ResultsCase more = own;
    more.grid = looks.name();
    const auto both = found({what, {}, more, own}, rows);
    if (!both) continue;
    const double fall_db = both->without_cell->median.rms_db - both->with_cell->median.rms_db;
    const double rise_mb =
        (static_cast<double>(both->with->atlas.store_bytes) - static_cast<double>(both->without->atlas.store_bytes)) /
        1e6;
    text += fmt::format("{}More {}, {}, take {:.2f} dB off the RMS error for {:.2f} MB: {:.3f} dB a megabyte.",
                        text.empty() ? "" : " ", what, more.grid, fall_db, rise_mb, fall_db / rise_mb);
  }
  return text;
}

std::string largest_causes(const ResultsPlan& plan, const std::vector<ResultsRow>& rows, ViewKind kind) {
  const auto by_rms = largest(plan, rows, kind, &product::CellComparison::rms_db);
  const auto by_l1 = largest(plan, rows, kind, &product::CellComparison::l1);
  const std::string rms =
      by_rms ? fmt::format("by RMS is: {}. Without it the RMS error at {:.0f} m cells falls from {:.2f} to {:.2f} dB.",
                           by_rms->cause, summary_cell_m, by_rms->with, by_rms->without)
             : "by RMS is none: no cause adds to it.";
  std::string l1 = "No cause adds to the relative L1.";
  if (by_l1 && by_rms && by_l1->cause == by_rms->cause) {
    l1 = fmt::format("It is by relative L1 too, which falls from {:.3f} to {:.3f}.", by_l1->with, by_l1->without);
  } else if (by_l1) {
    l1 = fmt::format("By relative L1 it is: {}. Without it L1 falls from {:.3f} to {:.3f}.", by_l1->cause, by_l1->with,
                     by_l1->without);
  }
  return fmt::format("The largest {} {}", rms, l1);
}

}  // namespace sigmascape::cli
