#include <fmt/format.h>
#include <fstream>

#include "bake_options.h"
#include "command.h"
#include "map_files.h"
#include "number_within.h"
#include "received_files.h"
#include "scene_warnings.h"
#include "stopwatch.h"
#include "terminal_progress.h"
#include "words.h"

#include "sigmascape/atlas/aspect_grid.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/base/units.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/product/attribution_line.h"
#include "sigmascape/product/comparison_page.h"
#include "sigmascape/product/json_text.h"
#include "sigmascape/product/legend.h"
#include "sigmascape/product/map_file.h"
#include "sigmascape/product/png_file.h"
#include "sigmascape/radar/radar_file.h"
#include "sigmascape/radar/radar_warnings.h"
#include "sigmascape/scene/paper_scene.h"
#include "sigmascape/scene/scene_file.h"
#include "sigmascape/simulate/map_warnings.h"
#include "sigmascape/simulate/placement.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::cli {
namespace {

struct DemoOptions {
  std::string scene, radar, folder = "out/demo";
  double scale = 0.25;
  std::uint32_t traced_samples = 64;
  BakeOptions bake;
};

/// One direction from which both maps are made.
struct View {
  std::string name;     ///< for file names
  std::string heading;  ///< for the page
  radar::RadarFile radar;
};

radar::RadarFile paper_radar(double azimuth_deg, double elevation_deg) {
  return {.radar = {.name = "20 km, " + fmt::format("{}° elevation, {}° azimuth", elevation_deg, azimuth_deg),
                    .position = {},
                    .frequency_hz = 10e9,
                    .polarization = radar::Polarization::Sum,
                    .range_resolution_m = 2.0,
                    .beam_width_rad = 2.0 * std::numbers::sqrt2 / 20e3},  // 2 m across, two-way, at 20 km
          .place = radar::SeenFrom{.azimuth_rad = radians_from_deg(azimuth_deg),
                                   .elevation_rad = radians_from_deg(elevation_deg),
                                   .slant_range_m = 20e3,
                                   .target = {}},
          .map = {}};
}

/// Runs the whole chain on one scene: bake, then for each view trace twice, render once and compare.
class Demo {
 public:
  Demo(const DemoOptions& options, scene::Scene scene)
      : options_(options),
        folder_(options.folder),
        scene_(std::move(scene)),
        geometry_(scene_, trace::Footing::Terrain) {}

  /// What would only be found out after the bake.
  void check(const View& view) const {
    const auto radar = simulate::placed_radar(view.radar, scene_.frame, scene_.terrain, scene_.extent);
    radar::check_earth(radar, options_.radar);
    static_cast<void>(simulate::map_grid(view.radar.map, scene_.extent));
    warn_of(radar, simulate::map_warnings(radar, view.radar.map, scene_.terrain, scene_.extent));
    atlas::check_frequency(options_.bake.settings().aspects, radar.frequency_hz);
  }

  void bake() {
    const Stopwatch watch;
    bake_report_ = bake::bake(scene_, options_.bake.settings(), folder_ / "atlas", progress_);
    bake_seconds_ = watch.seconds();
    atlas_ = atlas::load_atlas(atlas::Store::open(folder_ / "atlas"));
  }

  void compare_at(const View& view) {
    const auto radar = simulate::placed_radar(view.radar, scene_.frame, scene_.terrain, scene_.extent);
    const auto grid = simulate::map_grid(view.radar.map, scene_.extent);
    Stopwatch watch;
    const auto traced = traced_map(radar, grid, 1);
    const double traced_seconds = watch.seconds();
    const auto repeated = traced_map(radar, grid, 2);
    watch = {};
    const auto baked = baked_map(radar, grid);
    const double baked_seconds = watch.seconds();

    const product::CompareOptions compare{.polarization = radar.polarization};
    const auto comparison = product::compare_maps(baked, traced, compare);
    const auto floor = product::compare_maps(repeated, traced, compare);
    write_files(view, radar, traced, baked);
    page_.sections.push_back(
        {.heading = view.heading,
         .figures = {{folder_ / (view.name + "_traced.png"), "Path-traced from the full scene"},
                     {folder_ / (view.name + "_baked.png"), "Rendered from terrain and baked reflectivity"},
                     {folder_ / (view.name + "_difference.png"),
                      "Baked over traced: red where the baked map is brighter"}},
         .comparison = comparison,
         .noise_floor = floor,
         .facts = {{"Tracing", fmt::format("{:.1f} s", traced_seconds)},
                   {"Rendering", fmt::format("{:.0f} ms", 1e3 * baked_seconds)}}});
    auto json = nlohmann::ordered_json::parse(product::comparison_json(comparison, floor));
    json["view"] = view.name;
    json["traced_seconds"] = traced_seconds;
    json["baked_seconds"] = baked_seconds;
    summary_["views"].push_back(json);
    text_ += fmt::format(
        "\n{}\ntraced in {:.1f} s, baked in {:.0f} ms; in brackets: the traced map against itself with another "
        "seed\n{}\n",
        view.heading, traced_seconds, 1e3 * baked_seconds, product::comparison_table(comparison, floor));
  }

  void finish(const Output& output) {
    page_.title = scene_.name;
    page_.lead =
        "The same ground map made two ways: by path tracing the full scene, and from baked reflectivity textures.";
    page_.attribution = scene_.attribution;
    page_.sections.push_back(
        {.heading = "The bake",
         .facts = {{"Looks", std::to_string(bake_report_.looks) + already_in_words()},
                   {"Time", fmt::format("{:.1f} s", bake_seconds_)},
                   {"Rays", fmt::format("{:.1f} million", static_cast<double>(bake_report_.counts.rays) / 1e6)},
                   {"Trees and vehicles", std::to_string(scene_.instances.size())},
                   {"Buildings", std::to_string(scene_.buildings.items.size())}}});
    product::write_comparison_page(folder_ / "index.html", page_);
    summary_["scene"] = scene_.name;
    summary_["bake"] = {{"looks", bake_report_.looks},
                        {"already", bake_report_.already},
                        {"seconds", bake_seconds_},
                        {"rays", bake_report_.counts.rays}};
    geo::write_atomically(folder_ / "comparison.json", product::json_text(summary_, 2));
    summary_["page"] = (folder_ / "index.html").string();
    output.finish(fmt::format("{}: {}{} baked in {:.1f} s\n{}\nOpen {}", scene_.name,
                              counted(bake_report_.looks, "look", "looks"), already_in_words(), bake_seconds_, text_,
                              (folder_ / "index.html").string()),
                  summary_);
  }

 private:
  /// Time and rays are of those that were not there.
  [[nodiscard]] std::string already_in_words() const {
    return bake_report_.already == 0 ? "" : fmt::format(" ({} there already)", bake_report_.already);
  }
  [[nodiscard]] radar::GroundMap traced_map(const radar::Radar& radar, const radar::GroundGrid& grid,
                                            std::uint64_t seed) {
    trace::TraceCounts counts;
    const auto image = simulate::traced_image(scene_, geometry_, radar, grid.extent(),
                                              {.cell_m = grid.cell_m,
                                               .samples_per_cell = options_.traced_samples,
                                               .max_bounces = options_.bake.bounces,
                                               .seed = seed,
                                               .threads = options_.bake.threads},
                                              counts, &progress_);
    return described_map(image, radar, scene_.terrain, grid, scene_.frame,
                         provenance("level of detail 0: path-traced"));
  }

  [[nodiscard]] radar::GroundMap baked_map(const radar::Radar& radar, const radar::GroundGrid& grid) const {
    render::RenderCounts counts;
    const std::vector<radar::Target> targets = simulate::targets_of(scene_);
    const auto image = simulate::baked_image(*atlas_, scene_.terrain, radar, grid.extent(),
                                             {.threads = options_.bake.threads, .targets = targets}, counts);
    return described_map(image, radar, scene_.terrain, grid, scene_.frame,
                         provenance("level of detail 1: from terrain and atlas"));
  }

  [[nodiscard]] Provenance provenance(const std::string& processing) const {
    Provenance provenance{{"scene", scene_.name}, {"processing", processing}};
    if (!scene_.attribution.empty()) provenance["attribution"] = scene_.attribution;
    return provenance;
  }

  void write_files(const View& view, const radar::Radar& radar, const radar::GroundMap& traced,
                   const radar::GroundMap& baked) const {
    product::PictureOptions look = product::scope_look();
    look.polarization = radar.polarization;
    look.top_db = product::percentile_top_db(traced, look);
    look.magnification = traced.grid.columns < 400 ? 2 : 1;
    write_map_picture(folder_ / (view.name + "_traced.png"), traced, look);
    write_map_picture(folder_ / (view.name + "_baked.png"), baked, look);
    product::write_png(folder_ / (view.name + "_difference.png"),
                       product::with_attribution(product::with_legend(product::difference_picture(
                           baked, traced, {.polarization = radar.polarization, .magnification = look.magnification}))));
    product::write_map(folder_ / (view.name + "_traced.tif"), traced);
    product::write_map(folder_ / (view.name + "_baked.tif"), baked);
  }

  const DemoOptions& options_;
  std::filesystem::path folder_;
  scene::Scene scene_;
  trace::SceneGeometry geometry_;
  std::optional<atlas::Atlas> atlas_;
  TerminalProgress progress_;
  bake::BakeReport bake_report_;
  double bake_seconds_ = 0.0;
  product::ComparisonPage page_;
  nlohmann::ordered_json summary_;
  std::string text_;
};

std::vector<View> views_of(const DemoOptions& options) {
  if (!options.radar.empty()) {
    radar::require_real_beam(options.radar, "the demo compares real-beam maps");
    const auto file = radar::read_radar_file(options.radar);
    return {{"view", file.radar.name, file}};
  }
  return {{"paper_view", "The paper's view: 20 km away, 8.6° elevation, azimuth 130°, between the baked looks",
           paper_radar(130.0, 8.6)},
          {"baked_view", "A view that was baked: 20 km away, 13° elevation, azimuth 135°", paper_radar(135.0, 13.0)}};
}

scene::Scene scene_of(const DemoOptions& options) {
  if (options.scene.empty()) return scene::paper_scene({.scale = options.scale});
  scene::Scene scene = scene::read_scene(options.scene);
  warn_of_scene(scene);
  return scene;
}

void run_demo(const DemoOptions& options, const Output& output) {
  const std::vector<View> views = views_of(options);
  Demo demo(options, scene_of(options));
  for (const View& view : views) demo.check(view);
  demo.bake();
  for (const View& view : views) demo.compare_at(view);
  demo.finish(output);
}

}  // namespace

void add_demo_command(Command app, Output& output) {
  const auto command = app.add_subcommand("demo", "Bake a scene, map it both ways, and show how close they are");
  auto options = std::make_shared<DemoOptions>();
  options->bake.usual_samples = 12;
  options->bake.patch_texels = 256;
  const auto scene = command.add_option("--scene", options->scene,
                                        "scene file (TOML); by default a small version of the paper's scene");
  command.add_option("--radar", options->radar, "radar file (TOML); by default the paper's view and a baked one");
  command.add_option("--out", options->folder, "folder for pictures, maps and the page").capture_default_str();
  command.add_option("--scale", options->scale, "size of the paper's scene, 1 being 2 km")
      .capture_default_str()
      .excludes(scene);
  command.add_option("--traced-samples", options->traced_samples, "rays a cell of the traced map")
      .capture_default_str()
      .check(count_within<std::uint32_t>(1, 1U << 24U));
  options->bake.add_to(command);
  command.add_flag("--json", output.json, "print the summary as JSON");
  command.footer(
      "Examples:\n  sigmascape demo\n  sigmascape demo --scene examples/bilbao/bilbao.toml --out out/bilbao");
  command.callback([options, &output] { run_demo(*options, output); });
}

}  // namespace sigmascape::cli
