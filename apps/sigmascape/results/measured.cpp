#include "results/measured.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <limits>
#include <optional>
#include <utility>

#include "number_or_null.h"

#include "sigmascape/bake/bake_settings.h"
#include "sigmascape/base/error.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/trace/simd_setting.h"

namespace sigmascape::cli {
namespace {

using Json = nlohmann::ordered_json;
using product::CellComparison;
using product::LevelError;

/// Raised when maps are made otherwise or more is measured of a view: what was kept before does not go with it.
constexpr int form_of_views = 6;

double number_in(const Json& json, double absent) {
  return json.is_null() ? absent : json.get<double>();
}

double number_in(const Json& json) {
  return number_in(json, std::numeric_limits<double>::quiet_NaN());
}

Json json_of(const product::MapComparison& comparison) {
  Json cells = Json::array();
  for (const CellComparison& cell : comparison.at) {
    cells.push_back({cell.cell_m, cell.cells, number_or_null(cell.correlation_db), number_or_null(cell.rms_db),
                     number_or_null(cell.bias_db), number_or_null(cell.l1), number_or_null(cell.shadow_iou),
                     cell.shadow_cells});
  }
  return cells;
}

product::MapComparison comparison_in(const Json& json) {
  product::MapComparison comparison{.options = {.polarization = radar::Polarization::Sum}, .at = {}};
  for (const Json& cell : json) {
    comparison.at.push_back({.cell_m = cell.at(0).get<double>(),
                             .cells = cell.at(1).get<std::size_t>(),
                             .correlation_db = number_in(cell.at(2)),
                             .rms_db = number_in(cell.at(3)),
                             .bias_db = number_in(cell.at(4)),
                             .l1 = number_in(cell.at(5)),
                             .shadow_iou = number_in(cell.at(6)),
                             .shadow_cells = cell.at(7).get<std::size_t>()});
  }
  return comparison;
}

Json json_of(const std::vector<LevelError>& errors) {
  Json ranges = Json::array();
  for (const LevelError& range : errors)
    ranges.push_back(
        {number_or_null(range.from_db), number_or_null(range.to_db), range.cells, range.squared_error_db2});
  return ranges;
}

std::vector<LevelError> level_errors_in(const Json& json) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::vector<LevelError> errors;
  for (const Json& range : json) {
    errors.push_back({.from_db = number_in(range.at(0), -infinite),
                      .to_db = number_in(range.at(1), infinite),
                      .cells = range.at(2).get<std::size_t>(),
                      .squared_error_db2 = range.at(3).get<double>()});
  }
  return errors;
}

Json json_of(const ViewResult& result) {
  const ResultsCase& of = result.of;
  Json json{{"method", text_of(of.method)},
            {"grid", of.grid},
            {"baked_samples", of.baked_samples},
            {"change", of.change},
            {"lod", of.level_of_detail},
            {"looks", result.atlas.looks},
            {"store_bytes", result.atlas.store_bytes},
            {"memory_bytes", result.atlas.memory_bytes},
            {"bake_s", result.atlas.bake_seconds},
            {"render_ms", result.render_ms},
            {"cells", json_of(result.comparison)},
            {"by_level", json_of(result.by_level)}};
  if (const auto& free = result.without_noise)
    json["without_noise"] = {free->cell_m, free->cells, number_or_null(free->correlation_db),
                             number_or_null(free->rms_db)};
  return json;
}

/// Which of some values has that text.
template <typename Value>
Value named(std::initializer_list<Value> values, const std::string& text) {
  const auto* found = std::ranges::find(values, text, [](Value value) { return text_of(value); });
  if (found == values.end()) throw Error(text, "is the name of nothing that is measured", "measure anew");
  return *found;
}

ViewResult result_in(const Json& json, const std::string& scene, const PlannedView& view) {
  ViewResult result{.of = {.scene = scene,
                           .method = named(all_methods, json.at("method").get<std::string>()),
                           .grid = json.at("grid").get<std::string>(),
                           .baked_samples = json.at("baked_samples").get<std::uint32_t>(),
                           .kind = view.kind,
                           .change = json.at("change").get<std::string>(),
                           .level_of_detail = json.at("lod").get<int>()},
                    .view = view,
                    .atlas = {.looks = json.at("looks").get<std::size_t>(),
                              .store_bytes = json.at("store_bytes").get<std::uintmax_t>(),
                              .memory_bytes = json.at("memory_bytes").get<std::size_t>(),
                              .bake_seconds = json.at("bake_s").get<double>()},
                    .comparison = comparison_in(json.at("cells")),
                    .noise_floor = {},
                    .by_level = level_errors_in(json.at("by_level")),
                    .noise_by_level = {},
                    .render_ms = json.at("render_ms").get<double>()};
  if (json.contains("without_noise")) {
    const Json& free = json.at("without_noise");
    result.without_noise = {.cell_m = free.at(0).get<double>(),
                            .cells = free.at(1).get<std::size_t>(),
                            .correlation_db = number_in(free.at(2)),
                            .rms_db = number_in(free.at(3))};
  }
  return result;
}

Json json_of(const MeasuredView& measured) {
  const PlannedView& view = measured.view;
  Json results = Json::array();
  for (const ViewResult& result : measured.results) results.push_back(json_of(result));
  // What is of the traced maps is the same for all.
  const ViewResult any = measured.results.empty() ? ViewResult() : measured.results.front();
  return {{"scene", measured.scene},
          {"kind", text_of(view.kind)},
          {"azimuth_deg", view.azimuth_deg},
          {"elevation_deg", view.elevation_deg},
          {"slant_range_m", view.slant_range_m},
          {"traced_samples", view.traced_samples},
          {"repeated", view.is_repeated},
          {"machines", measured.machines},
          {"trace_s", any.trace_seconds},
          {"noise_floor", json_of(any.noise_floor)},
          {"noise_by_level", json_of(any.noise_by_level)},
          {"results", std::move(results)}};
}

/// Files of a former kind name one.
std::vector<std::string> machines_in(const Json& json) {
  if (!json.contains("machines")) return {json.at("machine").get<std::string>()};
  return json.at("machines").get<std::vector<std::string>>();
}

MeasuredView view_in(const Json& json) {
  MeasuredView measured{.scene = json.at("scene").get<std::string>(),
                        .view = {.kind = named({ViewKind::OnGrid, ViewKind::HeldOut, ViewKind::Paper},
                                               json.at("kind").get<std::string>()),
                                 .azimuth_deg = json.at("azimuth_deg").get<double>(),
                                 .elevation_deg = json.at("elevation_deg").get<double>(),
                                 .slant_range_m = json.at("slant_range_m").get<double>(),
                                 .traced_samples = json.at("traced_samples").get<std::uint32_t>(),
                                 .is_repeated = json.at("repeated").get<bool>()},
                        .machines = machines_in(json),
                        .results = {}};
  for (const Json& each : json.at("results")) {
    ViewResult& result = measured.results.emplace_back(result_in(each, measured.scene, measured.view));
    result.trace_seconds = json.at("trace_s").get<double>();
    result.noise_floor = comparison_in(json.at("noise_floor"));
    result.noise_by_level = level_errors_in(json.at("noise_by_level"));
  }
  return measured;
}

/// "was measured with bounces 4, not 8"; nothing for equal settings.
std::optional<std::string> difference(const Json& kept, const Json& wanted) {
  for (const auto& [key, value] : wanted.items()) {
    if (!kept.contains(key)) return fmt::format("does not say its {}", key);
    if (key == "form" && kept.at(key) != value) return "was kept by another version of this program";
    if (kept.at(key) != value)
      return fmt::format("was measured with {} {}, not {}", key, kept.at(key).dump(), value.dump());
  }
  return std::nullopt;
}

/// Whether two views are one but for the rays of their traced maps. On the grid, where looks are baked again with as
/// many rays, those of other rays are other views.
bool is_same_view(PlannedView one, const PlannedView& other) {
  if (one.kind != ViewKind::OnGrid) one.traced_samples = other.traced_samples;
  return one == other;
}

}  // namespace

MeasuredViews::MeasuredViews(std::filesystem::path file, Json settings)
    : file_(std::move(file)), settings_(std::move(settings)) {}

void MeasuredViews::go_on() {
  if (!std::filesystem::exists(file_)) return;
  try {
    read(file_);
  } catch (const Error&) {
    // As with maps and bakes in the folder, what does not fit is made anew.
    views_.clear();
  }
}

void MeasuredViews::take_over(const std::filesystem::path& other) {
  read(other);
}

const MeasuredView* MeasuredViews::find(const std::string& scene, const PlannedView& view) const {
  const auto found = std::ranges::find_if(views_, [&](const MeasuredView& measured) {
    return measured.scene == scene && is_same_view(measured.view, view) &&
           measured.view.traced_samples >= view.traced_samples;
  });
  return found == views_.end() ? nullptr : &*found;
}

const MeasuredView& MeasuredViews::add(MeasuredView view) {
  put(std::move(view));
  write();
  return views_.back();
}

void MeasuredViews::put(MeasuredView view) {
  std::erase_if(views_, [&](const MeasuredView& other) {
    return other.scene == view.scene && is_same_view(other.view, view.view);
  });
  views_.push_back(std::move(view));
}

void MeasuredViews::read(const std::filesystem::path& file) {
  constexpr const char* remedy = "name a file that a run with these options has kept, or none";
  std::ifstream stream(file);
  if (!stream) throw Error(file.string(), "cannot be read", remedy);
  try {
    const Json json = Json::parse(stream);
    if (const auto differs = difference(json.at("settings"), settings_)) throw Error(file.string(), *differs, remedy);
    for (const Json& view : json.at("views")) {
      MeasuredView measured = view_in(view);
      if (find(measured.scene, measured.view) == nullptr) put(std::move(measured));
    }
  } catch (const Json::exception&) {
    throw Error(file.string(), "does not hold measured views", remedy);
  }
}

void MeasuredViews::write() const {
  std::vector<const MeasuredView*> all;
  for (const MeasuredView& measured : views_) all.push_back(&measured);
  write(file_, all);
}

void MeasuredViews::write(const std::filesystem::path& file, std::span<const MeasuredView* const> views) const {
  Json written = Json::array();
  for (const MeasuredView* measured : views) written.push_back(json_of(*measured));
  geo::write_atomically(file, Json{{"settings", settings_}, {"views", std::move(written)}}.dump() + "\n");
}

std::vector<ViewResult> results_kept_in(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) return {};
  try {
    const Json json = Json::parse(stream);
    if (json.at("settings").at("form") != form_of_views) return {};
    std::vector<ViewResult> results;
    for (const Json& view : json.at("views")) {
      const MeasuredView measured = view_in(view);
      results.insert(results.end(), measured.results.begin(), measured.results.end());
    }
    return results;
  } catch (const Json::exception&) {
    return {};
  } catch (const Error&) {
    // Names of methods that are no more.
    return {};
  }
}

nlohmann::ordered_json settings_of_views(const ResultsPlan& plan, const std::string& scene) {
  Json grids = Json::array();
  for (const LookGrid& grid : plan.grids) grids.push_back(grid.name());
  const product::CompareOptions compare;
  return {{"form", form_of_views},
          {"scene", scene},
          {"side_m", plan.side_m()},
          {"rim_m", plan.rim_m()},
          {"grids", std::move(grids)},
          {"baked_samples", plan.baked_samples},
          {"bounces", plan.bounces},
          {"seed", plan.seed},
          {"floor_db", compare.floor_db},
          {"shadow_db", compare.shadow_db},
          {"simd", trace::simd_setting()},
          {"physics", bake::physics_revision},
          {"default_bake", plan.has_default_bake}};
}

}  // namespace sigmascape::cli
