#include "results/changes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bake_options.h"
#include "results/columns.h"
#include "results/error_tables.h"
#include "results/tile_power.h"

namespace sigmascape::cli {
namespace {

constexpr const char* kept_mark = "kept";

std::vector<Change> changes_of_the_paper(const ResultsCase& paper) {
  std::vector<Change> list;
  for (const auto& [change, kept] : {std::pair(cotangent_change, "only with γ"),
                                     {gamma_change, "only in cot ψ"},
                                     {cotangent_gamma_change, kept_mark},
                                     {map_area_change, kept_mark},
                                     {middle_change, kept_mark}}) {
    ResultsCase changed = paper;
    changed.change = change;
    list.push_back({{change, text_of(Method::Paper), changed, paper}, kept});
  }
  return list;
}

/// What the error falls by when looks are added to the paper's grid, and what they take.
struct Worth {
  double fall_db = 0.0, rise_mb = 0.0;

  [[nodiscard]] double db_a_megabyte() const { return fall_db / rise_mb; }
};

Worth worth_of(const MeasuredContrast& more) {
  const auto megabytes_of = [](const ResultsRow& row) { return static_cast<double>(row.atlas.store_bytes) / 1e6; };
  return {fall_between(*more.without, *more.with, &product::CellComparison::rms_db).mean,
          megabytes_of(*more.with) - megabytes_of(*more.without)};
}

std::string worth_text(const char* what, const LookGrid& grid, const Worth& worth) {
  if (worth.fall_db < 0.0) {
    return fmt::format("More {}, {} looks, add {} dB to the RMS error, for {} MB more. ", what, grid.name(),
                       number_text(-worth.fall_db, 2), number_text(worth.rise_mb, 2));
  }
  return fmt::format("More {}, {} looks, take {} dB off the RMS error for {} MB more: {} dB a megabyte. ", what,
                     grid.name(), number_text(worth.fall_db, 2), number_text(worth.rise_mb, 2),
                     number_text(worth.db_a_megabyte(), 3));
}

/// The looks of `sigmascape bake` where no option says which.
LookGrid default_grid() {
  const BakeOptions usual;
  return {usual.azimuths, usual.elevations_deg};
}

/// What the grid after the paper's takes and gives beside it.
std::string next_grid_text(const LookGrid& next, const MeasuredContrast& finer) {
  const AtlasCost &before = finer.without->atlas, &after = finer.with->atlas;
  const double rms_db = finer.without_cell->median.rms_db, finer_rms_db = finer.with_cell->median.rms_db;
  const auto times = [](auto many, auto few) { return static_cast<double>(many) / static_cast<double>(few); };
  return fmt::format(
      "`sigmascape bake` takes {} looks by default. {} looks (`--azimuths {} --elevations-deg {:g}`) take {:.1f} times "
      "the bytes, {} instead of {} MB, and {:.1f} times the processor time of the bake, {:.0f} instead of {:.0f} s, "
      "for an RMS error of {:.2f} instead of {:.2f} dB, {:.0f} % {}; a frame takes {:.0f} instead of {:.0f} ms. ",
      default_grid().name(), next.name(), next.azimuths, fmt::join(next.elevations_deg, ","),
      times(after.store_bytes, before.store_bytes), megabytes(after.store_bytes), megabytes(before.store_bytes),
      times(after.bake_seconds, before.bake_seconds), after.bake_seconds, before.bake_seconds, finer_rms_db, rms_db,
      100.0 * std::abs(1.0 - finer_rms_db / rms_db), finer_rms_db > rms_db ? "more" : "less", finer.with->render_ms,
      finer.without->render_ms);
}

/// Which looks to add first: those that take more off for a megabyte, or both where it is nearly the same.
std::string choice_text(const ResultsPlan& plan, const Worth& elevations, const Worth& azimuths, const Worth& both) {
  constexpr double clearly = 2.0;  // times as much
  const std::string default_name = default_grid().name(), next = plan.next_grid().name();
  if (both.fall_db < least_fall_db) return fmt::format("The choice: {}; more looks bring nothing here.", default_name);
  std::string first = fmt::format("elevations and azimuths together, {}", next);
  const double by_azimuths = std::max(azimuths.db_a_megabyte(), 0.0);
  const double by_elevations = std::max(elevations.db_a_megabyte(), 0.0);
  if (by_azimuths > clearly * by_elevations)
    first = fmt::format("azimuths first, {}, then elevations too, {}", plan.more_azimuths().name(), next);
  if (by_elevations > clearly * by_azimuths)
    first = fmt::format("elevations first, {}, then azimuths too, {}", plan.more_elevations().name(), next);
  return fmt::format("The choice: {} while bytes and bakes are dear; where they are not, {}.", default_name, first);
}

}  // namespace

std::vector<Change> changes(const ResultsPlan& plan) {
  const std::string place = plan.scene_name(), grid = plan.paper_grid().name();
  const ResultsCase paper{.scene = place, .method = Method::Paper, .grid = grid, .baked_samples = plan.baked_samples};
  ResultsCase baked = paper, level = paper, own = paper, apart = paper;
  baked.method = Method::BakedShadows;
  level.method = Method::LevelGround;
  own.method = Method::OwnGround;
  apart.method = Method::Apart;
  const auto from = [](ResultsCase of, const LookGrid& looks) {
    of.grid = looks.name();
    return of;
  };
  ResultsCase shared_noise = own;
  shared_noise.change = shared_noise_change;
  const auto with_rays_where_noise_is = [](ResultsCase of) {
    of.baked_samples = 0;
    of.change = adaptive_change;
    return of;
  };
  ResultsCase by_tiles = own;
  by_tiles.change = renormalized_change;

  const std::string before = text_of(Method::OwnGround), next = plan.next_grid().name();
  std::vector<Change> list = changes_of_the_paper(paper);
  list.push_back(
      {{"ours: echoes straight into texels, what is kept of these, half floats", text_of(Method::Paper), baked, paper},
       kept_mark});
  list.push_back({{"shadows made at run time", text_of(Method::BakedShadows), level, baked}, kept_mark});
  list.push_back({{"objects baked on their own ground", text_of(Method::LevelGround), own, level}, kept_mark});
  list.push_back({{"buildings kept apart", before, from(apart, plan.paper_grid()), own}, "an option"});
  if (plan.has_default_bake) {
    list.push_back(
        {{fmt::format("{}: {} a texel", adaptive_change, rays_text(0)), before, with_rays_where_noise_is(own), own},
         kept_mark});
  }
  list.push_back({{"texels share what few rays leave in doubt", before, shared_noise, own}, "an option"});
  list.push_back({{fmt::format("every {:.0f} m tile given the power that it has from {}", power_tile_m, next), before,
                   by_tiles, own},
                  "a bound: needs the map from " + next});
  const LookGrid even = plan.even_in_cotangent(), elevations = plan.more_elevations(), azimuths = plan.more_azimuths();
  list.push_back({{"as many elevations, spaced evenly, " + even.name(), before, from(own, even), own}, "not kept"});
  list.push_back({{"more elevations, " + elevations.name(), before, from(own, elevations), own}, "an option"});
  list.push_back({{"more azimuths, " + azimuths.name(), before, from(own, azimuths), own}, "an option"});
  list.push_back({{"both, " + next, before, from(own, plan.next_grid()), own}, "an option"});
  if (plan.has_default_bake) {
    const ResultsCase finer = from(own, plan.next_grid());
    list.push_back({{fmt::format("the same, {}", adaptive_change), fmt::format("{}, {}", before, next),
                     with_rays_where_noise_is(finer), finer},
                    kept_mark});
    list.push_back({{"buildings kept apart", fmt::format("{}, {}", before, next), from(apart, plan.next_grid()), finer},
                    "an option"});
  }
  if (plan.has_finest_grid()) {
    const LookGrid& finest = plan.grids.back();
    list.push_back({{"the finest, " + finest.name(), before, from(own, finest), own}, "an option"});
  }
  return list;
}

std::string changes_table(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  std::string text =
      "| change | of | before: correlation | RMS [dB] | L1 | IoU | MB | frame [ms] | after: correlation | RMS [dB] | "
      "L1 | IoU | MB | frame [ms] | RMS falls by, mean [dB] | at views | kept? |\n"
      "|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---|\n";
  text += truth_line(plan, rows, ViewKind::HeldOut, " | | | | | | | | | | |");
  for (const auto& [contrast, kept] : changes(plan)) {
    const auto both = measured(contrast, rows);
    if (!both) continue;
    const PairedFall fall = fall_between(*both->without, *both->with, &product::CellComparison::rms_db);
    std::string mark = kept;
    if (kept == kept_mark && fall.mean < least_fall_db)
      mark += fall.mean <= -least_fall_db ? ", costs here" : ", pays little here";
    const auto side = [](const ResultsRow& row, const ResultsCell& cell) {
      return fmt::format("{} | {} | {:.0f}", error_text(cell.median), megabytes(row.atlas.store_bytes), row.render_ms);
    };
    text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", contrast.name, contrast.how,
                        side(*both->without, *both->without_cell), side(*both->with, *both->with_cell),
                        fall_text(fall, &PairedFall::mean), mark);
  }
  return text;
}

std::string worth_of_looks(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  const ResultsCase own{.scene = plan.scene_name(),
                        .method = Method::OwnGround,
                        .grid = plan.paper_grid().name(),
                        .baked_samples = plan.baked_samples};
  const auto against_own = [&](const LookGrid& looks) {
    ResultsCase more = own;
    more.grid = looks.name();
    return measured({.name = {}, .how = {}, .with = more, .without = own}, rows);
  };
  const auto elevations = against_own(plan.more_elevations()), azimuths = against_own(plan.more_azimuths()),
             both = against_own(plan.next_grid());
  if (!elevations || !azimuths || !both) return {};
  const Worth of_elevations = worth_of(*elevations), of_azimuths = worth_of(*azimuths);
  return worth_text("elevations", plan.more_elevations(), of_elevations) +
         worth_text("azimuths", plan.more_azimuths(), of_azimuths) + next_grid_text(plan.next_grid(), *both) +
         choice_text(plan, of_elevations, of_azimuths, worth_of(*both));
}

std::string changes_section(const ResultsPlan& plan, const std::vector<ResultsRow>& rows) {
  return fmt::format(
      "## Cheap wins\n\nEach line makes one change to the method named beside it, from the {} grid where nothing else "
      "is said; medians over the held-out views at {:.0f} m cells. What the RMS falls by is here the mean of each "
      "view's own fall, and beside it stands at how many of the views it falls. *Kept*: `sigmascape bake` and "
      "`sigmascape render` do so by themselves; what is marked to pay little takes less than {} dB off the RMS here "
      "and was kept for other "
      "reasons. *An option*: they do so when asked to. *MB* are of the store, *frame* is the processor time of a "
      "map. Power is kept without a change: looks are blended linearly in power, so that every area gets the blend of "
      "its powers. How elevations are best spaced depends on where views are: held-out ones are drawn evenly in "
      "elevation.\n\n{}\n{}\n\n",
      plan.paper_grid().name(), summary_cell_m, least_fall_db, changes_table(plan, rows), worth_of_looks(plan, rows));
}

}  // namespace sigmascape::cli
