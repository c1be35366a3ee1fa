#include "results/table.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "number_or_null.h"

namespace sigmascape::cli {
namespace {

using product::CellComparison;

constexpr double not_defined = std::numeric_limits<double>::quiet_NaN();

/// Of two values the larger is the worse one after this.
using Badness = double (*)(double);

struct Metric {
  const char* key;
  double CellComparison::*value;
  Badness badness;
};

constexpr Badness low_is_bad = [](double value) { return -value; };
constexpr Badness high_is_bad = [](double value) { return value; };
constexpr Badness far_from_zero_is_bad = [](double value) { return std::abs(value); };

constexpr Metric metrics[] = {
    {"correlation_db", &CellComparison::correlation_db, low_is_bad}, {"rms_db", &CellComparison::rms_db, high_is_bad},
    {"bias_db", &CellComparison::bias_db, far_from_zero_is_bad},     {"l1", &CellComparison::l1, high_is_bad},
    {"shadow_iou", &CellComparison::shadow_iou, low_is_bad},
};

double worst(std::vector<double> values, Badness badness) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  return values.empty() ? not_defined : *std::ranges::max_element(values, {}, badness);
}

/// A view at one cell size: a map against the truth, and one traced map against another.
struct ViewCell {
  const CellComparison *tested, *floor;

  /// Shadows of few cells say nothing. The traced maps decide, so that all methods are held to the same views.
  [[nodiscard]] bool has_shadows() const { return floor->shadow_cells >= product::least_shadow_cells; }
};

std::vector<ViewCell> at_cells(const std::vector<const ViewResult*>& views, double cell_m) {
  std::vector<ViewCell> cells;
  for (const ViewResult* view : views) {
    const ViewCell cell{view->comparison.at_cell(cell_m), view->noise_floor.at_cell(cell_m)};
    if (cell.tested != nullptr && cell.floor != nullptr) cells.push_back(cell);
  }
  return cells;
}

struct MedianAndWorst {
  CellComparison median, worst;
};

MedianAndWorst over_views(const std::vector<ViewCell>& views, const CellComparison* ViewCell::*which) {
  MedianAndWorst over{*(views.front().*which), *(views.front().*which)};
  for (const Metric& metric : metrics) {
    std::vector<double> values;
    for (const ViewCell& view : views) {
      if (metric.value == &CellComparison::shadow_iou && !view.has_shadows()) continue;
      values.push_back(view.*which->*metric.value);
    }
    over.median.*metric.value = median(values);
    over.worst.*metric.value = worst(values, metric.badness);
  }
  return over;
}

template <typename Value>
double median_of(const std::vector<const ViewResult*>& views, Value value) {
  std::vector<double> values;
  for (const ViewResult* view : views) values.push_back(view->*value);
  return median(values);
}

AtlasCost mean_cost(const std::vector<const ViewResult*>& views) {
  AtlasCost sum;
  for (const ViewResult* view : views) {
    sum.looks += view->atlas.looks;
    sum.store_bytes += view->atlas.store_bytes;
    sum.memory_bytes += view->atlas.memory_bytes;
    sum.bake_seconds += view->atlas.bake_seconds;
  }
  const std::size_t count = views.size();
  return {sum.looks / count, sum.store_bytes / count, sum.memory_bytes / count,
          sum.bake_seconds / static_cast<double>(count)};
}

using LevelErrors = std::vector<product::LevelError>;

LevelErrors sum_of(const std::vector<const ViewResult*>& views, LevelErrors ViewResult::*errors) {
  LevelErrors sum = views.front()->*errors;
  for (std::size_t i = 1; i < views.size(); ++i) {
    const LevelErrors& more = views[i]->*errors;
    for (std::size_t range = 0; range < sum.size(); ++range) {
      sum[range].cells += more[range].cells;
      sum[range].squared_error_db2 += more[range].squared_error_db2;
    }
  }
  return sum;
}

ResultsWithoutNoise without_noise_of(const std::vector<const ViewResult*>& views) {
  std::vector<double> correlations, errors_db;
  std::vector<const ViewResult*> repeated;
  for (const ViewResult* view : views) {
    if (!view->without_noise) continue;
    correlations.push_back(view->without_noise->correlation_db);
    errors_db.push_back(view->without_noise->rms_db);
    repeated.push_back(view);
  }
  if (repeated.empty()) return {};
  const std::vector<ViewCell> cells = at_cells(repeated, summary_cell_m);
  return {repeated.size(), median(correlations), median(errors_db), over_views(cells, &ViewCell::tested).median,
          over_views(cells, &ViewCell::floor).median};
}

TracedRays rays_of(const std::vector<const ViewResult*>& views) {
  const auto [fewest, most] =
      std::ranges::minmax(views, {}, [](const ViewResult* view) { return view->view.traced_samples; });
  return {fewest->view.traced_samples, most->view.traced_samples};
}

/// As long as rays are many, the time goes by their number.
double median_trace_seconds(const std::vector<const ViewResult*>& views, std::uint32_t rays) {
  std::vector<double> seconds;
  for (const ViewResult* view : views) seconds.push_back(view->trace_seconds * rays / view->view.traced_samples);
  return median(seconds);
}

std::vector<ResultsAtView> each_of(const std::vector<const ViewResult*>& views) {
  std::vector<ResultsAtView> each;
  for (const ViewResult* view : views) {
    const CellComparison* cell = view->comparison.at_cell(summary_cell_m);
    if (cell != nullptr) each.push_back({view->view.azimuth_deg, view->view.elevation_deg, *cell});
  }
  return each;
}

ResultsRow row_of(const std::vector<const ViewResult*>& views) {
  const TracedRays rays = rays_of(views);
  ResultsRow row{.of = views.front()->of,
                 .views = views.size(),
                 .agreeing_views = static_cast<std::size_t>(std::ranges::count_if(
                     views, [](const ViewResult* view) { return agreement(*view) >= least_agreement; })),
                 .rays = rays,
                 .atlas = mean_cost(views),
                 .trace_seconds = median_trace_seconds(views, rays.fewest),
                 .render_ms = median_of(views, &ViewResult::render_ms),
                 .cells = {},
                 .at_views = each_of(views),
                 .by_level = sum_of(views, &ViewResult::by_level),
                 .noise_by_level = sum_of(views, &ViewResult::noise_by_level),
                 .without_noise = without_noise_of(views)};
  for (const CellComparison& size : views.front()->comparison.at) {
    const std::vector<ViewCell> cells = at_cells(views, size.cell_m);
    if (cells.empty()) continue;
    const MedianAndWorst values = over_views(cells, &ViewCell::tested), noise = over_views(cells, &ViewCell::floor);
    row.cells.push_back({values.median, values.worst, noise.median, noise.worst,
                         static_cast<std::size_t>(std::ranges::count_if(cells, &ViewCell::has_shadows))});
  }
  return row;
}

nlohmann::ordered_json entry_of(const CellComparison& cell) {
  nlohmann::ordered_json json;
  for (const Metric& metric : metrics) json[metric.key] = number_or_null(cell.*metric.value);
  return json;
}

/// Bounds at infinity are null.
nlohmann::ordered_json entry_of(const LevelErrors& errors) {
  auto json = nlohmann::ordered_json::array();
  for (const product::LevelError& range : errors) {
    json.push_back({{"from_db", number_or_null(range.from_db)},
                    {"to_db", number_or_null(range.to_db)},
                    {"cells", range.cells},
                    {"squared_error_db2", range.squared_error_db2}});
  }
  return json;
}

nlohmann::ordered_json entry_of(const ResultsWithoutNoise& free) {
  return {{"views", free.views},
          {"correlation_db", number_or_null(free.correlation_db)},
          {"rms_db", number_or_null(free.rms_db)},
          {"measured", entry_of(free.measured)},
          {"noise_floor", entry_of(free.noise_floor)}};
}

nlohmann::ordered_json entry_of(const ResultsCase& of, const AtlasCost& atlas) {
  return {{"scene", of.scene},
          {"method", text_of(of.method)},
          {"change", of.change},
          {"grid", of.grid},
          {"baked_samples", of.baked_samples},
          {"lod", of.level_of_detail},
          {"view_kind", text_of(of.kind)},
          {"looks", atlas.looks},
          {"bytes", atlas.store_bytes},
          {"memory_bytes", atlas.memory_bytes},
          {"bake_s", atlas.bake_seconds}};
}

nlohmann::ordered_json settings_json(const ResultsPlan& plan) {
  nlohmann::ordered_json grids, views;
  std::vector<LookGrid> baked = plan.grids;
  baked.push_back(plan.even_in_cotangent());
  for (const LookGrid& grid : baked)
    grids.push_back({{"name", grid.name()}, {"azimuths", grid.azimuths}, {"elevations_deg", grid.elevations_deg}});
  for (const PlannedView& view : plan.views) {
    views.push_back(
        {{"kind", text_of(view.kind)}, {"azimuth_deg", view.azimuth_deg}, {"elevation_deg", view.elevation_deg}});
  }
  const product::CompareOptions compare;
  return {{"scale", plan.scale},
          {"around_m", {plan.around_m.x, plan.around_m.y}},
          {"baked_samples", plan.baked_samples},
          {"finer_samples", plan.finer_samples},
          {"traced_samples", plan.traced_samples},
          {"most_traced_samples", plan.most_traced_samples},
          {"traced_maps_a_truth", 2},
          {"rim_m", plan.rim_m()},
          {"bounces", plan.bounces},
          {"seed", plan.seed},
          {"polarization", product::polarization_name(radar::Polarization::Sum)},
          {"floor_db", compare.floor_db},
          {"shadow_db", compare.shadow_db},
          {"grids", grids},
          {"views", views}};
}

}  // namespace

double median(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  if (values.empty()) return not_defined;
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2.0;
}

std::string TracedRays::text() const {
  return fewest == most ? fmt::format("{}", fewest) : fmt::format("{} to {}", fewest, most);
}

std::string TracedRays::with_fewest() const {
  return fewest == most ? "" : fmt::format(" with {}", fewest);
}

double agreement(const ViewResult& view) {
  const CellComparison* floor = view.noise_floor.at_cell(summary_cell_m);
  return floor != nullptr ? floor->correlation_db : not_defined;
}

TracedRays traced_rays(const ResultsPlan& plan, const std::vector<ResultsRow>& rows, const std::string& scene,
                       ViewKind kind) {
  if (const ResultsRow* row = baseline_row(plan, rows, scene, kind)) return row->rays;
  return {plan.traced_samples_of(kind), plan.traced_samples_of(kind)};
}

const ResultsCell* ResultsRow::at_cell(double cell_m) const {
  const auto found = std::ranges::find(cells, cell_m, [](const ResultsCell& cell) { return cell.median.cell_m; });
  return found == cells.end() ? nullptr : &*found;
}

std::vector<ResultsRow> rows_of(const std::vector<ViewResult>& views) {
  std::vector<std::vector<const ViewResult*>> groups;
  for (const ViewResult& view : views) {
    const auto group = std::ranges::find(groups, view.of, [](const auto& members) { return members.front()->of; });
    if (group != groups.end()) {
      group->push_back(&view);
    } else {
      groups.push_back({&view});
    }
  }
  std::vector<ResultsRow> rows;
  for (const auto& group : groups) rows.push_back(row_of(group));
  return rows;
}

std::string way_text(const ResultsCase& of) {
  return fmt::format("{}{}{}", text_of(of.method), of.change.empty() ? "" : ", ", of.change);
}

const ResultsRow* find_row(const std::vector<ResultsRow>& rows, const ResultsCase& of) {
  const auto found = std::ranges::find(rows, of, &ResultsRow::of);
  return found == rows.end() ? nullptr : &*found;
}

const ResultsRow* baseline_row(const ResultsPlan& plan, const std::vector<ResultsRow>& rows, const std::string& scene,
                               ViewKind kind) {
  return find_row(rows, {.scene = scene,
                         .method = Method::Paper,
                         .grid = plan.paper_grid().name(),
                         .baked_samples = plan.baked_samples,
                         .kind = kind});
}

const ResultsCell* summary_cell(const ResultsRow* row) {
  return row != nullptr ? row->at_cell(summary_cell_m) : nullptr;
}

const product::CellComparison* noise_floor(const ResultsPlan& plan, const std::vector<ResultsRow>& rows,
                                           const std::string& scene, ViewKind kind) {
  const ResultsCell* cell = summary_cell(baseline_row(plan, rows, scene, kind));
  return cell != nullptr ? &cell->floor_median : nullptr;
}

nlohmann::ordered_json results_json(const ResultsPlan& plan, const std::vector<ResultsRow>& rows,
                                    const std::vector<ViewResult>& views) {
  nlohmann::ordered_json json{{"settings", settings_json(plan)},
                              {"rows", nlohmann::ordered_json::array()},
                              {"views", nlohmann::ordered_json::array()}};
  for (const ResultsRow& row : rows) {
    for (const ResultsCell& cell : row.cells) {
      nlohmann::ordered_json entry = entry_of(row.of, row.atlas);
      entry.update({{"views", row.views},
                    {"trace_s", row.trace_seconds},
                    {"render_ms", row.render_ms},
                    {"cell_m", cell.median.cell_m},
                    {"median", entry_of(cell.median)},
                    {"worst", entry_of(cell.worst)},
                    {"noise_floor_median", entry_of(cell.floor_median)},
                    {"noise_floor_worst", entry_of(cell.floor_worst)}});
      if (cell.median.cell_m == summary_cell_m) {
        entry["by_level"] = entry_of(row.by_level);
        entry["noise_by_level"] = entry_of(row.noise_by_level);
        if (row.without_noise.views > 0) entry["without_noise"] = entry_of(row.without_noise);
      }
      json["rows"].push_back(entry);
    }
  }
  for (const ViewResult& view : views) {
    for (const CellComparison& cell : view.comparison.at) {
      nlohmann::ordered_json entry = entry_of(view.of, view.atlas);
      entry.update({{"azimuth_deg", view.view.azimuth_deg},
                    {"elevation_deg", view.view.elevation_deg},
                    {"trace_s", view.trace_seconds},
                    {"render_ms", view.render_ms},
                    {"cell_m", cell.cell_m},
                    {"metrics", entry_of(cell)}});
      if (const CellComparison* floor = view.noise_floor.at_cell(cell.cell_m)) entry["noise_floor"] = entry_of(*floor);
      json["views"].push_back(entry);
    }
  }
  return json;
}

}  // namespace sigmascape::cli
