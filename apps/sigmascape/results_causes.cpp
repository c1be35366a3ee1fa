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

}  // namespace

std::vector<Contrast> causes(const ResultsPlan& plan) {
  const std::string place = plan.scene_name(), grid = plan.paper_grid().name();
  const std::uint32_t samples = plan.baked_samples;
  const ResultsCase paper{.scene = place, .method = Method::Paper, .grid = grid, .baked_samples = samples};
  const auto changed = [](ResultsCase of, auto change) {
    change(of);
    return of;
  };
  const auto method = [&](ResultsCase of, Method which) {
    of.method = which;
    return of;
  };
  const auto on_grid = [](ResultsCase of) {
    of.kind = ViewKind::OnGrid;
    return of;
  };
  const auto level = [&](ResultsCase of) {
    of.scene = "level";
    return of;
  };
  const ResultsCase level_ground = method(paper, Method::LevelGround), own_ground = method(paper, Method::OwnGround);
  const ResultsCase own_look_alone = changed(own_ground, [](ResultsCase& of) { of.grid = own_look; });
  const ResultsCase own_on_grid = on_grid(own_look_alone);
  const ResultsCase finer_on_grid =
      changed(own_on_grid, [&](ResultsCase& of) { of.baked_samples = plan.finer_samples; });
  return {
      {"missing angles", "ours on its own ground: the grid against the view's own look", own_ground, own_look_alone},
      {"shadows and layover of level ground laid on slopes",
       "the paper's method, on-grid views: hills against level ground", on_grid(paper), level(on_grid(paper))},
      {"shadows on the ground alone", "ours: baked against made at run time", method(paper, Method::BakedShadows),
       level_ground},
      {"layover of objects on slopes and how they shade each other",
       "ours: baked on level ground against on its own ground", level_ground, own_ground},
      {"mips", "the paper's method: mips against the finest level alone", paper,
       changed(paper, [](ResultsCase& of) { of.change = finest_change; })},
      {"half floats", "the paper's method: halves against floats",
       changed(paper, [](ResultsCase& of) { of.change = halves_change; }), paper},
      {"noise of the bake",
       fmt::format("ours on its own ground, on-grid views, own look: {} rays a texel against {}", samples,
                   plan.finer_samples),
       own_on_grid, finer_on_grid},
      {"texels as wide as the finest cells",
       fmt::format("the same from {} rays: texels of {:.2f} m against {:.2f} m", plan.finer_samples, plan.texel_m,
                   plan.texel_m / 2.0),
       finer_on_grid, changed(finer_on_grid, [&](ResultsCase& of) {
         of.baked_samples = plan.samples_of_finer_texels();
         of.change = finer_texels_change;
       })}};
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

std::string causes_table(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  std::string text =
      "| cause | with against without it | with: correlation | RMS [dB] | L1 | IoU | without: correlation | RMS [dB] | "
      "L1 | IoU |\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|\n";
  for (const Contrast& cause : causes(plan)) {
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

std::string largest_cause(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  std::string name;
  double largest_db = 0.0, with_db = 0.0, without_db = 0.0;
  for (const Contrast& cause : causes(plan)) {
    const auto both = found(cause, rows);
    if (!both) continue;
    const double here_db = both->with_cell->median.rms_db - both->without_cell->median.rms_db;
    if (here_db <= largest_db) continue;
    largest_db = here_db;
    with_db = both->with_cell->median.rms_db;
    without_db = both->without_cell->median.rms_db;
    name = cause.name;
  }
  if (name.empty()) return "No cause adds error.";
  return fmt::format("The largest is: {}. Without it the RMS error at {:.0f} m cells falls from {:.2f} to {:.2f} dB.",
                     name, summary_cell_m, with_db, without_db);
}

}  // namespace sigmascape::cli
