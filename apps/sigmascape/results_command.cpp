#include <algorithm>
#include <fmt/format.h>
#include <limits>

#include "command.h"
#include "map_files.h"
#include "results_bake.h"
#include "results_optical_view.h"
#include "results_page.h"
#include "results_plan.h"
#include "results_table.h"
#include "results_truth.h"
#include "stopwatch.h"
#include "terminal_progress.h"

#include "sigmascape/base/units.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/product/comparison_page.h"
#include "sigmascape/product/png_file.h"
#include "sigmascape/scene/paper_scene.h"
#include "sigmascape/simulate/placement.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::cli {
namespace {

constexpr std::size_t paper_grid = 1;  // of the plan's grids: the one that levels of detail are compared on
constexpr int coarsest_level_of_detail = 3;

/// An atlas in memory and what it stands for in the tables.
struct MeasuredAtlas {
  std::string grid;
  std::uint32_t baked_samples = 0;
  atlas::Atlas atlas;
  AtlasCost cost;
};

struct RenderedMap {
  radar::GroundMap map;
  double milliseconds = 0.0;
};

/// The map with its rim unseen.
radar::GroundMap without_rim(radar::GroundMap map, double rim_m) {
  const radar::Rectangle all = map.grid.extent();
  const radar::Rectangle middle{all.west_m + rim_m, all.south_m + rim_m, all.east_m - rim_m, all.north_m - rim_m};
  constexpr float unseen = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t row = 0; row < map.grid.rows; ++row) {
    for (std::size_t column = 0; column < map.grid.columns; ++column) {
      if (!middle.contains(map.grid.centre_of(column, row))) map.sigma0(column, row) = {unseen, unseen, unseen, unseen};
    }
  }
  return map;
}

/// Bakes, traces, renders and compares everything that a plan asks for.
class Measurement {
 public:
  Measurement(const ResultsPlan& plan, const std::filesystem::path& folder)
      : plan_(plan),
        folder_(folder),
        hills_("hills", scene::paper_scene({.scale = plan.scale})),
        level_("level", levelled(hills_.scene)),
        bake_(hills_.scene, plan.bake_settings(), folder / "atlas", progress_) {
    for (const LookGrid& grid : plan.grids)
      grids_.push_back(loaded(bake_, grid.name(), plan.baked_samples, plan.selection_of(grid)));
  }

  void compare_all() {
    std::size_t done = 0;
    for (const MeasuredScene* measured : {&hills_, &level_}) {
      for (const PlannedView& view : plan_.views) {
        if (measured == &hills_ || view.kind != ViewKind::Paper) compare(*measured, view);
        progress_.advanced("compare", static_cast<double>(++done), 2.0 * static_cast<double>(plan_.views.size()),
                           "views");
      }
    }
    std::ranges::stable_sort(results_, {}, [](const ViewResult& result) {
      return std::pair(result.of.scene, static_cast<int>(result.of.kind));
    });
  }

  [[nodiscard]] const std::vector<ViewResult>& results() const { return results_; }

  [[nodiscard]] std::vector<product::PageSection> picture_sections() const {
    return {scene_section(), texture_section(), paper_section(), worst_section()};
  }

 private:
  [[nodiscard]] static MeasuredAtlas loaded(const TimedBake& bake, const std::string& name, std::uint32_t samples,
                                            const atlas::AspectSelection& selection) {
    MeasuredAtlas measured{name, samples, atlas::load_atlas(bake.store(), {.aspects = selection}), {}};
    measured.cost = bake.cost_of(selection, measured.atlas);
    return measured;
  }

  /// The look that the view is on, baked again with more rays.
  [[nodiscard]] MeasuredAtlas finer_look(const PlannedView& view) {
    bake::BakeSettings settings = plan_.bake_settings();
    settings.aspects = selected_grid(settings.aspects, plan_.selection_of(view));
    settings.sampling.samples_per_texel = plan_.finer_samples;
    const TimedBake bake(hills_.scene, settings, folder_ / "finer" / view.file_name(), progress_);
    return loaded(bake, "look alone", plan_.finer_samples, {});
  }

  void compare(const MeasuredScene& measured, const PlannedView& view) {
    const Truth truth = traced_truth(measured, view, plan_, folder_ / "truth");
    for (std::size_t i = 0; i < grids_.size(); ++i) {
      const int coarsest = i == paper_grid && measured.name == "hills" ? coarsest_level_of_detail : 1;
      for (int level = 1; level <= coarsest; ++level) hold_against(truth, measured, view, grids_[i], level);
    }
    if (view.kind != ViewKind::OnGrid) return;
    hold_against(truth, measured, view, loaded(bake_, "look alone", plan_.baked_samples, plan_.selection_of(view)), 1);
    hold_against(truth, measured, view, finer_look(view), 1);
  }

  void hold_against(const Truth& truth, const MeasuredScene& measured, const PlannedView& view,
                    const MeasuredAtlas& from, int level_of_detail) {
    const RenderedMap rendered = rendered_map(measured, view, from.atlas, level_of_detail);
    results_.push_back({.of = {measured.name, from.grid, from.baked_samples, level_of_detail, view.kind},
                        .view = view,
                        .atlas = from.cost,
                        .comparison = compared(rendered.map, truth.mean),
                        .noise_floor = compared(truth.second, truth.first),
                        .trace_seconds = truth.trace_seconds,
                        .render_ms = rendered.milliseconds});
  }

  [[nodiscard]] product::MapComparison compared(const radar::GroundMap& tested, const radar::GroundMap& truth) const {
    return product::compare_maps(without_rim(tested, plan_.rim_m()), without_rim(truth, plan_.rim_m()),
                                 {.polarization = radar::Polarization::Sum});
  }

  [[nodiscard]] RenderedMap rendered_map(const MeasuredScene& measured, const PlannedView& view,
                                         const atlas::Atlas& atlas, int level_of_detail) const {
    const scene::Scene& scene = measured.scene;
    const radar::RadarFile file = view.radar();
    const auto radar = simulate::placed_radar(file, scene.frame, scene.terrain, scene.extent);
    const auto grid = simulate::map_grid(file.map, scene.extent);
    render::RenderCounts counts;
    const Stopwatch watch;
    const auto image = simulate::baked_image(atlas, scene.terrain, radar, grid.extent(),
                                             {.level_of_detail = level_of_detail, .threads = plan_.threads}, counts);
    const double milliseconds = 1e3 * watch.seconds();
    return {described_map(image, radar, scene.terrain, grid, scene.frame,
                          {{"scene", scene.name},
                           {"processing", fmt::format("level of detail {}: from terrain and atlas", level_of_detail)}}),
            milliseconds};
  }

  [[nodiscard]] product::PageSection scene_section() const {
    const auto path = folder_ / "scene.png";
    product::write_png(path, optical_view(hills_.scene, hills_.geometry, 1000, plan_.threads));
    return {.heading = "The scene from above",
            .figures = {{path, "Surfaces in the colours of their materials, the sun in the north-west"}}};
  }

  /// The baked textures themselves, texel by texel.
  [[nodiscard]] product::PageSection texture_section() const {
    const double azimuth_rad = radians_from_deg(135.0);
    product::PageSection section{.heading = "Baked reflectivity, seen from the south-east (azimuth 135°)"};
    for (const double elevation_deg : {5.0, 13.0, 21.0, 29.0}) {
      const auto path = folder_ / fmt::format("texture_az135_el{:02.0f}.png", elevation_deg);
      product::PictureOptions look{.polarization = radar::Polarization::Sum};
      const auto map = texture_map(grids_.front().atlas, {azimuth_rad, radians_from_deg(elevation_deg)});
      look.top_db = product::percentile_top_db(map, look);
      look.magnification = map.grid.columns < 400 ? 2 : 1;
      write_map_picture(path, map, look);
      section.figures.push_back({path, fmt::format("{:.0f}° elevation", elevation_deg)});
    }
    return section;
  }

  [[nodiscard]] radar::GroundMap texture_map(const atlas::Atlas& atlas, const radar::Aspect& aspect) const {
    const radar::Rectangle& extent = hills_.scene.extent;
    const double texel_m = atlas.patches().texel_m;
    radar::GroundMap map{.grid = simulate::map_grid({.area = {}, .cell_m = texel_m}, extent),
                         .sigma0 = {},
                         .crs = hills_.scene.frame.proj(),
                         .metadata = {{"scene", hills_.scene.name}, {"processing", "baked texture"}}};
    map.sigma0 = Array2D<radar::Channels>(map.grid.columns, map.grid.rows);
    const auto weights = atlas.weights_for(aspect, 10e9);
    for (std::size_t row = 0; row < map.grid.rows; ++row) {
      for (std::size_t column = 0; column < map.grid.columns; ++column)
        map.sigma0(column, row) = atlas.sigma0_at(map.grid.centre_of(column, row), weights, 0.0);
    }
    return map;
  }

  [[nodiscard]] product::PageSection paper_section() const {
    const auto is_paper = [](const PlannedView& view) { return view.kind == ViewKind::Paper; };
    return pictured(*std::ranges::find_if(plan_.views, is_paper), "paper_view",
                    "The paper's view: 20 km away, azimuth 130°, elevation 8.6°");
  }

  [[nodiscard]] product::PageSection worst_section() const {
    const ViewResult* worst = nullptr;
    for (const ViewResult& result : results_) {
      if (result.of != paper_case(ViewKind::HeldOut)) continue;
      const auto correlation = [](const ViewResult& of) { return of.comparison.at_cell(8.0)->correlation_db; };
      if (worst == nullptr || correlation(result) < correlation(*worst)) worst = &result;
    }
    if (worst == nullptr) return {};
    return pictured(worst->view, "worst_view", "The worst held-out view: " + worst->view.description());
  }

  [[nodiscard]] ResultsCase paper_case(ViewKind kind) const {
    return {"hills", plan_.grids[paper_grid].name(), plan_.baked_samples, 1, kind};
  }

  /// One view traced, baked on the paper's grid, and the difference.
  [[nodiscard]] product::PageSection pictured(const PlannedView& view, const std::string& name,
                                              const std::string& heading) const {
    const Truth truth = traced_truth(hills_, view, plan_, folder_ / "truth");
    const radar::GroundMap baked = rendered_map(hills_, view, grids_[paper_grid].atlas, 1).map;
    product::PictureOptions look = product::scope_look();
    look.polarization = radar::Polarization::Sum;
    look.top_db = product::percentile_top_db(truth.mean, look);
    look.magnification = baked.grid.columns < 400 ? 2 : 1;
    const auto path = [&](const char* what) { return folder_ / fmt::format("{}_{}.png", name, what); };
    write_map_picture(path("traced"), truth.mean, look);
    write_map_picture(path("baked"), baked, look);
    product::write_png(path("difference"), product::difference_picture(baked, truth.mean,
                                                                       {.polarization = radar::Polarization::Sum,
                                                                        .magnification = look.magnification}));
    return {.heading = heading,
            .figures = {{path("traced"), "Path-traced from the full scene"},
                        {path("baked"), "Rendered from terrain and baked reflectivity, " + grids_[paper_grid].grid},
                        {path("difference"), "Baked over traced, −10 dB (blue) to +10 dB (red)"}},
            .comparison = compared(baked, truth.mean),
            .noise_floor = compared(truth.second, truth.first)};
  }

  const ResultsPlan& plan_;
  std::filesystem::path folder_;
  TerminalProgress progress_;
  MeasuredScene hills_, level_;
  TimedBake bake_;
  std::vector<MeasuredAtlas> grids_;
  std::vector<ViewResult> results_;
};

void run_results(const ResultsOptions& options, const Output& output) {
  const ResultsPlan plan = results_plan(options);
  const std::filesystem::path folder = options.folder;
  Measurement measurement(plan, folder);
  measurement.compare_all();

  const auto rows = rows_of(measurement.results());
  const auto json = results_json(plan, rows, measurement.results());
  product::ComparisonPage page{.title = "How close the baked map is",
                               .lead = "Maps rendered from baked reflectivity, held against path-traced ones.",
                               .sections = measurement.picture_sections(),
                               .attribution = {}};
  page.sections.push_back({.heading = "What limits it", .paragraphs = {what_limits(plan, rows)}});
  std::ranges::move(results_sections(rows), std::back_inserter(page.sections));
  const std::string markdown = results_markdown(plan, rows);
  geo::write_atomically(folder / "results.json", json.dump(2) + "\n");
  product::write_comparison_page(folder / "index.html", page);
  if (!options.page.empty()) geo::write_atomically(options.page, markdown);
  output.finish(fmt::format("{}\nOpen {}", markdown, (folder / "index.html").string()), json);
}

}  // namespace

void add_results_command(CLI::App& app, Output& output) {
  auto* command =
      app.add_subcommand("results", "Measure how close baked maps come to traced ones, by grid, view and cell size");
  auto options = std::make_shared<ResultsOptions>();
  command->add_flag("--small", options->small, "a quarter of the scene's side, few views and rays: minutes, not hours");
  command
      ->add_option("--out", options->folder,
                   "folder for numbers, page, pictures, the atlas and the traced maps; what fits is used again. "
                   "Remove it when the program has changed")
      ->capture_default_str();
  command->add_option("--page", options->page, "Markdown page to write as well");
  command->add_option("--scale", options->scale, "size of the paper's scene, 1 being 2 km");
  command->add_option("--held-out", options->held_out, "number of views that were not baked");
  command->add_option("--on-grid", options->on_grid, "number of views that were baked");
  command->add_option("--samples", options->baked_samples, "rays a texel of the bake");
  command->add_option("--traced-samples", options->traced_samples, "rays a cell of each of the two traced maps");
  command->add_option("--bounces", options->bounces, "surfaces a path may meet")->capture_default_str();
  command->add_option("--seed", options->seed, "names the random numbers and draws the held-out views")
      ->capture_default_str();
  command->add_option("--threads", options->threads, "0: one a processor")->capture_default_str();
  command->add_flag("--json", output.json, "print the numbers as JSON");
  command->footer("Examples:\n  sigmascape results --small\n  sigmascape results --out out/results_full --held-out 48");
  command->callback([options, &output] { run_results(*options, output); });
}

}  // namespace sigmascape::cli
