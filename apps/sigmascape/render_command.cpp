#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <optional>
#include <span>

#include "coherent_render.h"
#include "command.h"
#include "files_to_write.h"
#include "idle_options.h"
#include "iq_files.h"
#include "layer_files.h"
#include "map_files.h"
#include "number_within.h"
#include "polarization_option.h"
#include "received_files.h"
#include "scene_warnings.h"
#include "scope_files.h"
#include "seed_option.h"
#include "standard_error.h"
#include "stopwatch.h"
#include "terminal_progress.h"
#include "threads_option.h"
#include "word_option.h"

#include "sigmascape/atlas/store.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/file_ending.h"
#include "sigmascape/base/units.h"
#include "sigmascape/geo/coordinate_reference_system.h"
#include "sigmascape/geo/coordinate_transform.h"
#include "sigmascape/geo/geo_raster.h"
#include "sigmascape/product/iq_file.h"
#include "sigmascape/product/map_file.h"
#include "sigmascape/product/png_file.h"
#include "sigmascape/product/reprojection.h"
#include "sigmascape/radar/mode_words.h"
#include "sigmascape/radar/radar_bounds.h"
#include "sigmascape/radar/radar_file.h"
#include "sigmascape/radar/radar_warnings.h"
#include "sigmascape/radar/target_file.h"
#include "sigmascape/receiver/equivalent_noise.h"
#include "sigmascape/render/level_of_detail.h"
#include "sigmascape/scene/scene_file.h"
#include "sigmascape/simulate/coherent.h"
#include "sigmascape/simulate/looks_of_map.h"
#include "sigmascape/simulate/map_provenance.h"
#include "sigmascape/simulate/map_question.h"
#include "sigmascape/simulate/map_warnings.h"
#include "sigmascape/simulate/part_seen.h"
#include "sigmascape/simulate/placement.h"
#include "sigmascape/simulate/simulate.h"
#include "sigmascape/simulate/targets_seen.h"

namespace sigmascape::cli {
namespace {

struct RenderOptions {
  std::string radar, scene, atlas, targets, map_file, power_file, picture_file, style = "grey";
  int level_of_detail = 0;
  bool explain = false;
  render::DetailRule detail_rule = render::DetailRule::LayoverAndShadow;
  double span_db = 50.0;
  std::optional<double> top_db;
  bool extrapolate = false;
  ReceivedFiles received;
  IqFiles iq;
  ScopeFiles scopes;
  std::string crs;
  bool in_decibels = false;
  LayerFiles layers;
  double time_s = 0.0;
  simulate::TraceSettings trace;  ///< and the seed and dwell of all else
};

/// What was rendered and at what cost.
struct Rendered {
  radar::RangeAzimuthImage image = {};            ///< of the real beam
  std::optional<radar::GroundMap> coherent = {};  ///< of the other modes, instead
  double seconds = 0.0;
  nlohmann::ordered_json cost = {};
  Provenance provenance = {};
  std::optional<radar::ObstacleMap> obstacles = {};  ///< of the atlas, for the layers that are asked for
};

Rendered traced(const RenderOptions& options, const scene::Scene& scene, const radar::Radar& radar,
                const radar::GroundGrid& grid) {
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  simulate::TraceSettings settings = options.trace;
  settings.cell_m = grid.cell_m;
  const auto seen = simulate::targets_in_traced(scene, geometry, settings.targets, radar, grid.extent());
  warn_of(radar, seen.warnings);
  trace::TraceCounts counts;
  TerminalProgress progress;
  const Stopwatch watch;
  Rendered rendered{.image =
                        simulate::traced_image(scene, geometry, radar, grid.extent(), settings, counts, &progress)};
  rendered.seconds = watch.seconds();
  rendered.cost = {{"paths", counts.paths}, {"rays", counts.rays}};
  rendered.provenance = simulate::provenance_of_traced(settings, scene, seen.count);
  return rendered;
}

/// What every file says of the scene and the moment.
Provenance origin_of(const scene::Scene& scene, const std::string& hash, double time_s) {
  Provenance origin{{"scene", scene.name}, {"scene_hash", hash}, {"time_s", fmt::format("{}", time_s)}};
  if (!scene.attribution.empty()) origin["attribution"] = scene.attribution;
  return origin;
}

/// The atlas that was named, held against the scene; none when none is needed.
std::optional<atlas::Store> atlas_of(const RenderOptions& options, const std::string& scene_hash) {
  if (options.level_of_detail > 0 && options.atlas.empty()) {
    throw Error("--atlas", fmt::format("is missing for level of detail {}", options.level_of_detail),
                "name the atlas that `sigmascape bake` made, or use --lod 0");
  }
  if (options.atlas.empty()) return std::nullopt;
  auto store = atlas::Store::open(options.atlas);
  if (store.description().scene_hash != scene_hash) {
    throw Error(options.atlas,
                fmt::format("was baked from another scene than {}, or by a program that reads that file otherwise",
                            options.scene),
                "bake this scene with this program, or name the scene that the atlas was made from");
  }
  return store;
}

/// What throws the shadows of the map; nothing where no layers are asked for, or the atlas holds them with its
/// textures.
std::optional<radar::ObstacleMap> obstacles_for_layers(const RenderOptions& options, const atlas::Atlas& textures) {
  if (options.layers.names.empty() || textures.ground_layers() == nullptr) return std::nullopt;
  return textures.ground_layers()->obstacles;
}

Rendered baked(const RenderOptions& options, const scene::Scene& scene, const atlas::Store& store,
               const radar::Radar& radar, const radar::GroundGrid& grid, const std::vector<radar::Target>& targets,
               const Provenance& origin) {
  const bool is_real_beam = radar.mode == radar::Mode::RealBeam;
  const atlas::Atlas textures = atlas::load_atlas(
      store, {.aspects = is_real_beam
                             ? simulate::looks_of_map(store.description().aspects, radar, grid.extent(), scene.terrain)
                             : atlas::AspectSelection{},
              .reading = atlas::Reading::AsAsked});
  if (!is_real_beam) {
    auto made =
        coherent_map({scene, textures, radar, texture_frequency_hz(textures.aspects(), radar, options.extrapolate),
                      grid, options.level_of_detail, targets, options.trace.seed, options.trace.dwell, options.time_s,
                      options.trace.threads, origin, options.iq.slant_image});
    return {.coherent = std::move(made.map),
            .seconds = made.seconds,
            .cost = std::move(made.cost),
            .provenance = std::move(made.provenance),
            .obstacles = obstacles_for_layers(options, textures)};
  }
  render::RenderCounts counts;
  const Stopwatch watch;
  const render::RenderSettings settings{
      .level_of_detail = options.level_of_detail,
      .threads = options.trace.threads,
      .texture_frequency_hz = texture_frequency_hz(textures.aspects(), radar, options.extrapolate),
      .targets = targets};
  Rendered rendered{.image = simulate::baked_image(textures, scene.terrain, radar, grid.extent(), settings, counts,
                                                   options.trace.dwell)};
  rendered.seconds = watch.seconds();
  rendered.obstacles = obstacles_for_layers(options, textures);
  rendered.cost = {{"ground_samples", counts.ground_samples}, {"visible", counts.visible}};
  const auto seen =
      simulate::targets_in_map(targets, radar, grid.extent(), scene.terrain, simulate::obstacles_of(textures));
  warn_of(radar, seen.warnings);
  rendered.provenance = simulate::provenance_of_baked(store.description(), radar, settings, options.trace.seed,
                                                      options.trace.dwell, seen.count);
  return rendered;
}

/// What may be written, by option and by the word that a summary has for it.
struct Written {
  const char* option;
  const char* word;
  const std::string& file;
};

std::array<Written, 10> files_of(const RenderOptions& options) {
  return {{{"--out", "map", options.map_file},
           {"--power", "power", options.power_file},
           {"--png", "picture", options.picture_file},
           {"--ppi", "ppi", options.scopes.ppi},
           {"--b-scope", "b_scope", options.scopes.b_scope},
           {"--layers-out", "layers", options.layers.file},
           {"--snr", "snr", options.received.snr},
           {"--video", "video", options.received.video},
           {"--iq", "iq", options.iq.file},
           {"--slant-image", "slant_image", options.iq.slant_image}}};
}

bool writes_a_file(const RenderOptions& options) {
  return std::ranges::any_of(files_of(options), [](const Written& written) { return !written.file.empty(); });
}

/// Of which level suits a map, and nothing is to be made.
bool asks_for_advice_alone(const RenderOptions& options) {
  return options.explain && !writes_a_file(options);
}

/// What only the real beam has is refused in the other modes.
void check_coherent(const RenderOptions& options, const radar::Radar& radar) {
  if (!options.iq.slant_image.empty()) product::check_iq_name(options.iq.slant_image);
  if (radar.mode == radar::Mode::RealBeam) {
    if (!options.iq.slant_image.empty()) {
      throw Error("--slant-image", "is a complex image, and a real beam has power alone",
                  "give the radar file another [mode], or take --snr for power over range and azimuth");
    }
    radar::check_earth(radar, options.radar);
    return;
  }
  if (options.level_of_detail == 0 && !asks_for_advice_alone(options)) {
    throw Error(
        "--lod", fmt::format("0 traces power alone, and {} needs amplitudes", radar::mode_word(radar.mode)),
        "bake the scene and give --lod 1 and --atlas, or take the [mode] out of the radar file for a real beam");
  }
  if (!options.power_file.empty()) {
    throw Error("--power", fmt::format("is of single pulses, and {} works on many", radar::mode_word(radar.mode)),
                "take --out for sigma0, or take the [mode] out of the radar file for a real beam");
  }
  const auto refuse = [&](const char* option, const std::string& file) {
    if (file.empty()) return;
    throw Error(option, fmt::format("is of range and azimuth, which {} does not have", radar::mode_word(radar.mode)),
                "leave it out, or take the [mode] out of the radar file for a real beam");
  };
  refuse("--snr", options.received.snr);
  refuse("--video", options.received.video);
  refuse("--ppi", options.scopes.ppi);
  refuse("--b-scope", options.scopes.b_scope);
}

/// What names alone tell, before the work.
void check_files(const RenderOptions& options) {
  check(options.layers, options.trace.max_bounces);
  check(options.received);
  check(options.iq, !options.atlas.empty());
  for (const std::string& map : {options.map_file, options.power_file})
    if (!map.empty()) product::check_map_name(map);
  for (const std::string& picture : {options.picture_file, options.scopes.ppi, options.scopes.b_scope})
    if (!picture.empty()) product::check_png_name(picture);
  std::vector<NamedFile> named;
  for (const Written& written : files_of(options)) named.push_back({written.option, written.file});
  std::vector<std::filesystem::path> read;
  for (const std::string& toml : {options.scene, options.radar, options.targets}) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(toml, ignored)) continue;  // told when it is read
    const auto named_there = TomlSection::read_file(toml).named_files();
    read.insert(read.end(), named_there.begin(), named_there.end());
  }
  // A folder that is no atlas has nothing to lose, and is told when it is opened.
  std::error_code ignored;
  if (const std::filesystem::path atlas = options.atlas; std::filesystem::exists(atlas / "collection.json", ignored))
    read.push_back(atlas);
  check_files_to_write(named, read);
}

/// Where pulses alone are asked for there is no map beside them: it would take its time, and it wants the radar to
/// stand higher.
bool makes_map(const RenderOptions& options) {
  return options.iq.file.empty() || std::ranges::any_of(files_of(options), [&](const Written& written) {
           return &written.file != &options.iq.file && !written.file.empty();
         });
}

void check_crs(const RenderOptions& options, const geo::LocalFrame& frame, const radar::GroundGrid& grid) {
  if (options.crs.empty()) return;
  static_cast<void>(geo::CoordinateTransform(options.crs, frame, "--crs"));
  static_cast<void>(product::reprojected(grid, frame, options.crs));
  for (const std::string& file : {options.map_file, options.power_file, options.layers.file}) {
    if (geo::is_geotiff_name(file)) return geo::require_geotiff_keys(options.crs, "--crs");
  }
}

/// The radar of the file, whose polarization an option may have changed.
radar::RadarFile radar_file_of(const RenderOptions& options, std::optional<radar::Polarization> polarization) {
  radar::RadarFile file = radar::read_radar_file(options.radar);
  if (polarization) file.radar.polarization = *polarization;
  return file;
}

product::PictureOptions look_of(const RenderOptions& options, radar::Polarization polarization) {
  product::PictureOptions look = options.style == "scope" ? product::scope_look() : product::PictureOptions{};
  look.polarization = polarization;
  look.span_db = options.span_db;
  look.top_db = options.top_db;
  return look;
}

/// The map as GeoTIFF, arrays and picture, and the power and the layers over its cells. The cells of the map as
/// written.
radar::GroundGrid write_maps(const RenderOptions& options, const scene::Scene& scene, const radar::Radar& radar,
                             const radar::GroundGrid& grid, Rendered& rendered, const product::PictureOptions& look) {
  auto map = rendered.coherent
                 ? described_map(std::move(*rendered.coherent), radar, scene.frame, rendered.provenance)
                 : described_map(rendered.image, radar, scene.terrain, grid, scene.frame, rendered.provenance);
  if (!options.crs.empty()) map = product::reprojected(map, scene.frame, options.crs);
  const auto scale = options.in_decibels ? product::MapScale::Decibels : product::MapScale::Linear;
  if (!options.map_file.empty()) product::write_map(options.map_file, map, scale);
  if (!options.power_file.empty()) {
    const auto power = received_map(radar, rendered.image, scene.terrain, grid, scene.frame, rendered.provenance,
                                    options.trace.threads);
    product::write_map(options.power_file,
                       options.crs.empty() ? power : product::reprojected(power, scene.frame, options.crs), scale);
  }
  write_layers(options.layers, scene, radar, grid, options.crs, map.metadata,
               {.atlas = options.level_of_detail == 0 ? "" : options.atlas,
                .obstacles = rendered.obstacles ? &*rendered.obstacles : nullptr,
                .trace = options.trace});
  if (!options.picture_file.empty()) write_map_picture(options.picture_file, map, look);
  return map.grid;
}

/// What of the work is told when it is done.
struct Told {
  std::string words;
  nlohmann::ordered_json numbers;
};

/// Makes the map and writes all that is asked for of it.
Told made_map(const RenderOptions& options, const scene::Scene& scene, const atlas::Store* store,
              const radar::Radar& radar, const radar::GroundGrid& grid, const std::vector<radar::Target>& targets,
              const Provenance& origin, const product::PictureOptions& look) {
  Rendered rendered = options.level_of_detail == 0 ? traced(options, scene, radar, grid)
                                                   : baked(options, scene, *store, radar, grid, targets, origin);
  rendered.provenance.insert(origin.begin(), origin.end());
  const bool is_real_beam = !rendered.coherent;
  if (is_real_beam) {
    write_received(options.received, radar, rendered.image, look.polarization,
                   receiver::noise_seed(options.trace.seed, options.trace.dwell, look.polarization),
                   options.trace.threads, rendered.provenance);
  }
  const radar::GroundGrid cells = write_maps(options, scene, radar, grid, rendered, look);
  if (is_real_beam) write_scopes(options.scopes, radar, rendered.image, look, rendered.provenance);
  Told told{.words = {},
            .numbers = {{"level_of_detail", options.level_of_detail},
                        {"columns", cells.columns},
                        {"rows", cells.rows},
                        {"seconds", rendered.seconds}}};
  told.numbers.update(rendered.cost);
  const std::string size = options.crs.empty() ? fmt::format("of {} m", cells.cell_m)
                                               : fmt::format("in {}, from cells of {} m,", options.crs, grid.cell_m);
  told.words = fmt::format("{} x {} cells {} at level of detail {} in {:.3f} s", cells.columns, cells.rows, size,
                           options.level_of_detail, rendered.seconds);
  return told;
}

void render(RenderOptions options, std::optional<radar::Polarization> polarization, const Output& output) {
  check_files(options);
  const auto radar_file = radar_file_of(options, polarization);
  const auto look = look_of(options, radar_file.radar.polarization);
  check(options.received, look.polarization);
  check(options.layers, options.level_of_detail, radar_file.radar.mode);
  const scene::Scene scene = scene::read_scene(options.scene);
  const auto added =
      options.targets.empty() ? std::vector<radar::TargetSource>() : radar::read_target_file(options.targets);
  const std::vector<radar::Target> targets =
      simulate::all_targets(&scene, added, scene.frame, scene.terrain, options.trace.seed, options.time_s);
  // Those of the scene come first, and a tracer knows them by itself.
  options.trace.targets = std::span(targets).subspan(scene.point_targets.size());
  const auto radar = simulate::placed_radar(radar_file, scene.frame, scene.terrain, scene.extent, options.time_s);
  const auto grid = simulate::map_grid(radar_file.map, scene.extent);
  check_crs(options, scene.frame, grid);
  const bool has_map = makes_map(options);
  if (has_map) check_coherent(options, radar);
  if (!options.explain && !writes_a_file(options))
    warn("no file is written; name one with --out, --png or another option");
  warn_of_scene(scene);
  warn_of(radar, (has_map ? simulate::map_warnings : simulate::area_warnings)(radar, radar_file.map, scene.terrain,
                                                                              scene.extent));
  const std::string hash = scene::scene_hash(scene);
  const std::optional<atlas::Store> store = atlas_of(options, hash);
  const std::string advice =
      options.explain
          ? render::explained(render::choose_detail(
                simulate::map_question(scene, radar, grid, store ? &*store : nullptr), {.rule = options.detail_rule}))
          : "";
  if (asks_for_advice_alone(options))
    return output.finish("The resolution cell asks for " + advice, {{"advised_detail", advice}});
  const Provenance origin = origin_of(scene, hash, options.time_s);
  const radar::Rectangle area = grid.extent();
  const IqRequest pulses{store ? &*store : nullptr,
                         scene,
                         targets,
                         radar,
                         area,
                         options.level_of_detail,
                         options.extrapolate,
                         options.trace.seed,
                         options.trace.dwell,
                         options.time_s,
                         options.trace.threads,
                         origin};
  check(options.iq, pulses);
  nlohmann::ordered_json summary;
  for (const Written& written : files_of(options)) summary[written.word] = written.file;
  std::vector<std::string> words;
  if (has_map) {
    const Told map = made_map(options, scene, pulses.atlas, radar, grid, targets, origin, look);
    summary.update(map.numbers);
    words.push_back(map.words);
  }
  if (const auto recorded = write_iq_files(options.iq, pulses)) {
    summary.update(recorded->numbers);
    words.push_back(recorded->words);
  }
  if (options.explain) summary["advised_detail"] = advice;
  output.finish(
      fmt::format("{}{}", options.explain ? "The resolution cell asks for " + advice : "", fmt::join(words, "; ")),
      summary);
}

}  // namespace

void add_render_command(Command app, Output& output) {
  const auto command = app.add_subcommand("render", "Make the ground map that a radar sees");
  auto options = std::make_shared<RenderOptions>();
  auto polarization = std::make_shared<radar::Polarization>(radar::Polarization::VV);
  command.add_option("RADAR", options->radar, "radar file (TOML)").required();
  command.add_option("--scene", options->scene, "scene file (TOML)").required();
  command.add_option("--atlas", options->atlas, "folder of the atlas that was baked from the scene");
  command.add_option("--targets", options->targets, "targets and movers to add (TOML); see docs/target_file.md");
  const auto level =
      command
          .add_option("--lod", options->level_of_detail,
                      "level of detail: 0 traces the scene, 1 and up use the atlas; when nothing is said 1 "
                      "with an atlas, 0 without")
          .check(count_within(0, 16));
  const auto explain = command.add_flag("--explain", options->explain,
                                        "say which level of detail the resolution cell asks for, and why");
  add_word_option(
      command, "--detail-rule", options->detail_rule,
      {{"cell", render::DetailRule::LayoverAndShadow}, {"paper", render::DetailRule::PixelsPerTriangle}},
      "what that goes by: cell, how far layover and shadow reach over the resolution cell (when nothing is said), or "
      "paper, 16 pixels a triangle")
      .needs(explain);
  command.add_option("--out", options->map_file,
                     "ground map to write: sigma0 as cloud-optimised GeoTIFF (.tif) or for NumPy (.npy, .npz)");
  command.add_option("--power", options->power_file,
                     "mean power of one pulse at the antenna's terminals to write, over the ground map's cells, in W "
                     "(.tif, .npy, .npz)");
  const auto decibels =
      command.add_flag("--db", options->in_decibels, "write maps in dB, power in dBW, instead of linear");
  command.add_option("--png", options->picture_file, "picture to write");
  const auto style = command.add_option("--style", options->style, "grey or scope")
                         .capture_default_str()
                         .check(one_of({"grey", "scope"}));
  const auto span = command.add_option("--span-db", options->span_db, "span of the picture from dark to bright")
                        .capture_default_str()
                        .check(number_within(0.01, 1000.0));
  const auto top =
      command
          .add_option("--top-db", options->top_db, "sigma0 shown brightest; by default that of the brightest few cells")
          .check(number_within(-1000.0, 1000.0));
  const auto stated = add_polarization_option(command, *polarization, "that of the radar file");
  const auto crs =
      command.add_option("--crs", options->crs, "coordinate system of maps and layers: EPSG code, PROJ string or WKT");
  const auto up = add_scope_options(command, options->scopes);
  add_received_options(command, options->received);
  add_layer_options(command, options->layers);
  const auto of_pulses = add_iq_options(command, options->iq);
  const auto extrapolate = command.add_flag("--extrapolate", options->extrapolate,
                                            "at a frequency that was not baked, use the nearest that was");
  const auto samples =
      command.add_option("--samples", options->trace.samples_per_cell, "rays a map cell, at level of detail 0")
          .capture_default_str()
          .check(count_within(1, 1 << 24));
  const auto bounces =
      command.add_option("--bounces", options->trace.max_bounces, "surfaces a path may meet, at level of detail 0")
          .capture_default_str()
          .check(count_within(1, 255));
  add_seed_option(command, options->trace.seed,
                  "names the random numbers: rays at level of detail 0, speckle of coherent modes");
  command
      .add_option("--time-s", options->time_s,
                  "moment in seconds: how long radar and targets have moved since time zero")
      .capture_default_str()
      .check(number_within(radar::bounds::moments_s.lowest, radar::bounds::moments_s.highest));
  command
      .add_option(
          "--dwell", options->trace.dwell,
          "which look at the same ground this is: each has thermal noise and fluctuating targets of its own, and "
          "all the same speckle")
      .capture_default_str()
      .check(count_within<std::uint64_t>(0, std::numeric_limits<std::uint64_t>::max()));
  add_threads_option(command, options->trace.threads);
  command.add_flag("--json", output.json, "print the summary as JSON");
  command.footer(
      "Examples:\n"
      "  sigmascape render radar.toml --scene town.toml --out traced.tif --png traced.png\n"
      "  sigmascape render radar.toml --scene town.toml --atlas atlas --lod 1 --out baked.tif --png baked.png --style "
      "scope\n"
      "  sigmascape render radar.toml --scene town.toml --layers shadow,layover,bounce1,bounce2 --layers-out "
      "layers.tif");
  const auto has_map = [options] { return !options->map_file.empty() || !options->power_file.empty(); };
  const auto has_picture = [options] {
    return !options->picture_file.empty() || !options->scopes.ppi.empty() || !options->scopes.b_scope.empty();
  };
  const auto has_cells = [options, has_map] {
    return has_map() || !options->picture_file.empty() || !options->layers.file.empty();
  };
  const auto is_traced = [options] { return options->level_of_detail == 0; };
  const auto asks_atlas = [options] { return options->level_of_detail > 0 || !options->iq.file.empty(); };
  std::vector<MannerOption> manners = of_pulses;
  manners.insert(manners.end(), {up,
                                 {decibels, "--db", "--out or --power", has_map},
                                 {style, "--style", "--png, --ppi or --b-scope", has_picture},
                                 {span, "--span-db", "--png, --ppi or --b-scope", has_picture},
                                 {top, "--top-db", "--png, --ppi or --b-scope", has_picture},
                                 {crs, "--crs", "--out, --power, --png or --layers-out", has_cells},
                                 {extrapolate, "--extrapolate", "--lod 1 and up and of --iq", asks_atlas},
                                 {samples, "--samples", "--lod 0", is_traced},
                                 {bounces, "--bounces", "--lod 0", is_traced}});
  command.callback([level, stated, manners, options, polarization, &output] {
    if (!level.is_given()) options->level_of_detail = options->atlas.empty() ? 0 : 1;
    refuse_idle(manners);
    render(*options, stated.is_given() ? std::optional(*polarization) : std::nullopt, output);
  });
}

}  // namespace sigmascape::cli
