#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <system_error>

#include "command.h"
#include "number_within.h"
#include "results/command_line.h"
#include "results/figures.h"
#include "results/measurement.h"
#include "results/page.h"
#include "seed_option.h"
#include "threads_option.h"

#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/product/json_text.h"

namespace sigmascape::cli {
namespace {

/// Copies a file as a whole or not at all.
void copy_atomically(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::ifstream stream(from, std::ios::binary);
  geo::write_atomically(to, std::string(std::istreambuf_iterator<char>(stream), {}));
}

/// The page, and beside it the pictures that it shows.
void write_page(const std::filesystem::path& page, const ResultsReport& report, const std::filesystem::path& folder) {
  std::filesystem::create_directories(std::filesystem::absolute(page).parent_path());
  for (const product::PageSection& section : report.figures) {
    for (const product::PageFigure& figure : section.figures)
      copy_atomically(figure.png, page.parent_path() / figure.png.filename());
  }
  for (const auto& [name, plot] : plots_of(report)) {
    const std::string svg = svg_of(plot);
    geo::write_atomically(folder / name, svg);
    geo::write_atomically(page.parent_path() / name, svg);
  }
  geo::write_atomically(page, results_markdown(report));
}

void run_results(const ResultsOptions& options, const Output& output) {
  const ResultsPlan plan = results_plan(options);
  if (!options.page.empty()) geo::check_place_for(options.page);
  const std::filesystem::path folder = options.folder;
  geo::check_place_for(folder / "results.json");
  Measurement measurement(plan, folder, options.measured);
  measurement.compare_all();

  const scene::Scene& scene = measurement.scene().scene;
  const ResultsReport report{.plan = plan,
                             .scene = scene.name,
                             .attribution = scene.attribution,
                             .machine = measurement.machines(),
                             .command_line = command_line(options, plan),
                             .links = PageLinks(path_within(options.page)),
                             .vertices = vertices_within_extent(scene),
                             .tracing_memory_bytes = measurement.scene().geometry.memory_bytes(),
                             .patches = plan.bake_settings(Method::OwnGround).patches.covering(scene.extent).size(),
                             .views = measurement.results(),
                             .rows = rows_of(measurement.results()),
                             .figures = paper_figures(measurement, plan, folder),
                             .neighbours = neighbours_of(options.page, plan)};
  const auto json = results_json(plan, report.rows, report.views);
  product::ComparisonPage page{.title = "How close the baked map is",
                               .lead = "Maps rendered from baked reflectivity, held against path-traced ones.",
                               .sections = report.figures,
                               .attribution = report.attribution};
  std::ranges::move(results_sections(report.rows), std::back_inserter(page.sections));
  geo::write_atomically(folder / "results.json", product::json_text(json, 2));
  product::write_comparison_page(folder / "index.html", page);
  if (!options.page.empty()) {
    write_page(options.page, report, folder);
    measurement.write_told(std::filesystem::path(options.page).replace_filename("measured.json"));
  }
  output.finish(fmt::format("{}\nOpen {}", results_markdown(report), (folder / "index.html").string()), json);
}

}  // namespace

void add_results_command(Command app, Output& output) {
  const auto command =
      app.add_subcommand("results", "Measure how close baked maps come to traced ones, by grid, view and cell size");
  auto options = std::make_shared<ResultsOptions>();
  command.add_flag("--small", options->small, "a fifth of the scene's side, few views and rays: minutes, not hours");
  command.add_flag("--no-finest-grid", options->without_finest_grid,
                   "leave out 32 × 8 looks, whose bake takes longest");
  command
      .add_option("--out", options->folder,
                  "folder for numbers, page, pictures, the atlas and the traced maps; what fits is used again. "
                  "Remove it when the program has changed")
      .capture_default_str();
  command.add_option("--measured", options->measured,
                     "measured.json of such a run, here or elsewhere: the views that are in it are not measured again");
  command.add_option("--page", options->page, "Markdown page to write as well, its pictures beside it");
  const auto scene = command.add_option("--scene", options->scene_file,
                                        "scene file (TOML) to measure on, instead of the paper's scene");
  command.add_option("--scale", options->scale, "side of the paper's scene, or of the middle of another, over 2 km")
      .check(number_within(0.01, 1000.0));
  command
      .add_option("--around", options->around_m,
                  "of another scene: the middle of what is measured, in metres east and north of the scene's own")
      .expected(2)
      .needs(scene)
      .check(number_within(-1e6, 1e6));
  command
      .add_flag("--itu-materials", options->itu_materials,
                "the paper's scene with walls and trees of real materials instead of the paper's")
      .excludes(scene);
  command.add_option("--held-out", options->held_out, "number of views that were not baked");
  command.add_option("--on-grid", options->on_grid, "number of views that were baked");
  command
      .add_option("--repeated", options->repeated,
                  "number of those that are baked twice, which tells the noise of the bake")
      .capture_default_str();
  command.add_option("--samples", options->baked_samples, "rays a texel of the bake");
  command.add_option("--traced-samples", options->traced_samples, "rays a cell of each of the two traced maps");
  command.add_option("--most-traced-samples", options->most_traced_samples,
                     "the same where two maps of a view that was not baked agree to a correlation of less than 0.99 "
                     "at 8 m cells: it is traced anew, steep views first; none: all stay with as many rays");
  command.add_option("--finer-samples", options->finer_samples,
                     "rays of views that were baked: a cell of their traced maps, and a texel of their looks when "
                     "those are baked again almost without noise");
  command.add_option("--bounces", options->bounces, "surfaces a path may meet")
      .capture_default_str()
      .check(count_within(1, 64));
  add_seed_option(command, options->seed, "names the random numbers and draws the held-out views");
  add_threads_option(command, options->threads);
  command.add_flag("--json", output.json, "print the numbers as JSON");
  command.footer(
      "Examples:\n  sigmascape results --small\n"
      "  sigmascape results --scene examples/bilbao/bilbao.toml --around 350 400 --out out/results/bilbao");
  command.callback([options, &output] { run_results(*options, output); });
}

}  // namespace sigmascape::cli
