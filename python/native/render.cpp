#include <fmt/format.h>
#include <optional>
#include <pybind11/stl.h>

#include "given_number.h"
#include "loaded_atlas.h"
#include "loaded_scene.h"
#include "long_call.h"
#include "parts.h"
#include "python_progress.h"
#include "python_warnings.h"
#include "trace_arguments.h"
#include "whole_number.h"

#include "sigmascape/base/error.h"
#include "sigmascape/product/described_map.h"
#include "sigmascape/product/ground_projection.h"
#include "sigmascape/product/slant_projection.h"
#include "sigmascape/radar/mode_words.h"
#include "sigmascape/radar/radar_bounds.h"
#include "sigmascape/radar/radar_file.h"
#include "sigmascape/radar/radar_title.h"
#include "sigmascape/radar/radar_warnings.h"
#include "sigmascape/receiver/receive_chain.h"
#include "sigmascape/simulate/map_provenance.h"
#include "sigmascape/simulate/map_warnings.h"
#include "sigmascape/simulate/mode_image.h"
#include "sigmascape/simulate/part_seen.h"
#include "sigmascape/simulate/placement.h"
#include "sigmascape/simulate/simulate.h"
#include "sigmascape/simulate/targets_seen.h"

namespace sigmascape::python {
namespace {

namespace py = pybind11;

/// The ground that a map is made of: that of a scene, or the one that an atlas brings along.
struct Ground {
  std::string name, hash, attribution;
  const geo::LocalFrame* frame;
  const terrain::HeightField* terrain;
  radar::Rectangle extent;
};

Ground ground_of(const LoadedScene* loaded, const LoadedAtlas* atlas) {
  if (loaded != nullptr) {
    const scene::Scene& scene = loaded->scene();
    if (atlas != nullptr) atlas->check_baked_from(*loaded);
    return {scene.name, loaded->hash(), scene.attribution, &scene.frame, &scene.terrain, scene.extent};
  }
  if (atlas == nullptr) throw Error("scene", "is None, and so is atlas", "give a Scene, an Atlas, or both");
  const atlas::AtlasDescription& description = atlas->description();
  return {description.name,   description.scene_hash, description.attribution,
          &description.frame, &atlas->terrain(),      description.extent};
}

/// What was seen, on its way to a map.
struct Seen {
  std::optional<radar::RangeAzimuthImage> image;  ///< by a real beam
  radar::GroundMap coherent;                      ///< by the other modes, instead
  product::Provenance provenance;
};

/// What is put into an image, and what it may cost.
struct Effort {
  std::optional<int> lod;
  std::vector<radar::TargetSource> targets;
  std::uint32_t samples;
  int bounces;
  std::uint64_t seed;
  double time_s;
  std::uint64_t dwell;
  unsigned threads;
};

/// What is asked of either way to a map.
struct Wish {
  const Ground& ground;
  const radar::Radar& radar;
  const radar::GroundGrid& grid;
  const std::vector<radar::Target>& targets;
};

Seen traced(const LoadedScene* scene, const Wish& wish, const simulate::TraceSettings& settings,
            ProgressListener& progress) {
  if (scene == nullptr) throw Error("scene", "is None at level of detail 0", "give the Scene that is to be traced");
  if (wish.radar.mode != radar::Mode::RealBeam) {
    throw Error("lod", fmt::format("0 traces power alone, and {} needs amplitudes", radar::mode_word(wish.radar.mode)),
                "give the atlas that bake() made, or set the radar's mode to 'real-beam'");
  }
  const auto seen =
      simulate::targets_in_traced(scene->scene(), scene->geometry(), settings.targets, wish.radar, wish.grid.extent());
  warn_of(wish.radar, seen.warnings);
  trace::TraceCounts counts;
  auto image = simulate::traced_image(scene->scene(), scene->geometry(), wish.radar, wish.grid.extent(), settings,
                                      counts, &progress);
  return {std::move(image), {}, simulate::provenance_of_traced(settings, scene->scene(), seen.count)};
}

Seen coherent(const atlas::Atlas& textures, const Wish& wish, const LoadedScene* scene, int level_of_detail,
              const Effort& effort) {
  const simulate::ModeRequest request{.atlas = textures,
                                      .terrain = *wish.ground.terrain,
                                      .radar = wish.radar,
                                      .grid = wish.grid,
                                      .texture_frequency_hz = wish.radar.frequency_hz,
                                      .targets = wish.targets,
                                      .windblown = scene != nullptr && wish.radar.wind_mps > 0.0
                                                       ? simulate::windblown_of(scene->scene())
                                                       : simulate::Windblown{},
                                      .level_of_detail = level_of_detail,
                                      .seed = effort.seed,
                                      .dwell = effort.dwell,
                                      .moment_s = effort.time_s,
                                      .threads = effort.threads};
  const simulate::ModePlan planned = simulate::mode_plan(request);
  warn_of(wish.radar, planned.warnings);
  product::LooksOnGround looks(*wish.ground.terrain, wish.grid, effort.threads);
  simulate::mode_looks(request, planned.plan, [&](const simulate::ModeImage& look) {
    std::visit([&](const auto& image) { looks.add(image); }, look);
  });
  return {std::nullopt, looks.map(), simulate::provenance_of(request, planned)};
}

Seen baked(const LoadedAtlas* atlas, const Wish& wish, const render::RenderSettings& settings, const Effort& effort,
           const LoadedScene* scene) {
  if (atlas == nullptr) {
    throw Error("atlas", fmt::format("is None at level of detail {}", settings.level_of_detail),
                "give the Atlas that bake() made, or lod=0");
  }
  if (wish.radar.mode != radar::Mode::RealBeam)
    return coherent(atlas->textures(), wish, scene, settings.level_of_detail, effort);
  const auto seen = simulate::targets_in_map(wish.targets, wish.radar, wish.grid.extent(), *wish.ground.terrain,
                                             simulate::obstacles_of(atlas->textures()));
  warn_of(wish.radar, seen.warnings);
  render::RenderCounts counts;
  auto image = simulate::baked_image(atlas->textures(), *wish.ground.terrain, wish.radar, wish.grid.extent(), settings,
                                     counts, effort.dwell);
  return {
      std::move(image),
      {},
      simulate::provenance_of_baked(atlas->description(), wish.radar, settings, effort.seed, effort.dwell, seen.count)};
}

/// Sees, and makes of it what `map_of(seen, wish)` does.
template <typename MapOf>
auto mapped(const std::shared_ptr<LoadedScene>& scene, const radar::RadarFile& radar_file,
            const std::shared_ptr<LoadedAtlas>& atlas, const Effort& effort, const py::object& progress,
            const MapOf& map_of) {
  const radar::RadarFile asked = radar_file;
  within("time_s", effort.time_s, radar::bounds::moments_s);
  const int level_of_detail = checked_lod(effort.lod.value_or(atlas ? 1 : 0));
  PythonProgress listener(progress);
  return long_call([&] {
    if (scene == nullptr && level_of_detail == 0)
      throw Error("scene", "is None, and level of detail 0 traces it", "give a Scene, or lod=1 with an Atlas");
    const Ground ground = ground_of(scene.get(), level_of_detail > 0 ? atlas.get() : nullptr);
    const auto radar = simulate::placed_radar(asked, *ground.frame, *ground.terrain, ground.extent, effort.time_s);
    radar::check_earth(radar, radar::title_of(radar));
    const auto grid = simulate::map_grid(asked.map, ground.extent);
    warn_of(radar, simulate::map_warnings(radar, asked.map, *ground.terrain, ground.extent));
    // Those of the scene answer to rays by themselves.
    const scene::Scene* owner = scene && level_of_detail > 0 ? &scene->scene() : nullptr;
    const auto targets =
        simulate::all_targets(owner, effort.targets, *ground.frame, *ground.terrain, effort.seed, effort.time_s);
    const Wish wish{ground, radar, grid, targets};
    Seen seen = level_of_detail == 0
                    ? traced(scene.get(), wish,
                             {.cell_m = grid.cell_m,
                              .samples_per_cell = effort.samples,
                              .max_bounces = effort.bounces,
                              .seed = effort.seed,
                              .threads = effort.threads,
                              .targets = targets,
                              .dwell = effort.dwell},
                             listener)
                    : baked(atlas.get(), wish,
                            {.level_of_detail = level_of_detail, .threads = effort.threads, .targets = targets}, effort,
                            scene.get());
    seen.provenance["scene"] = ground.name;
    seen.provenance["scene_hash"] = ground.hash;
    seen.provenance["time_s"] = fmt::format("{}", effort.time_s);
    if (!ground.attribution.empty()) seen.provenance["attribution"] = ground.attribution;
    return product::described_map(map_of(seen, wish), radar, *ground.frame, seen.provenance);
  });
}

radar::GroundMap rendered(const std::shared_ptr<LoadedScene>& scene, const radar::RadarFile& radar,
                          std::optional<LevelOfDetail> lod, const std::shared_ptr<LoadedAtlas>& atlas,
                          const std::vector<radar::TargetSource>& targets, RaysACell samples, Bounces bounces,
                          Seed seed, double time_s, Dwell dwell, Threads threads, const py::object& progress) {
  return mapped(scene, radar, atlas, {lod, targets, samples, bounces, seed, time_s, dwell, threads}, progress,
                [&](Seen& seen, const Wish& wish) {
                  return seen.image ? product::ground_map(*seen.image, *wish.ground.terrain, wish.grid, threads)
                                    : std::move(seen.coherent);
                });
}

radar::PowerMap received(const std::shared_ptr<LoadedScene>& scene, const radar::RadarFile& radar,
                         std::optional<LevelOfDetail> lod, const std::shared_ptr<LoadedAtlas>& atlas,
                         const std::vector<radar::TargetSource>& targets, RaysACell samples, Bounces bounces, Seed seed,
                         double time_s, Dwell dwell, Threads threads, const py::object& progress) {
  if (radar.radar.mode != radar::Mode::RealBeam) {
    throw Error("radar.mode",
                fmt::format("is {}, which works on many pulses, and received power is of single ones",
                            radar::mode_word(radar.radar.mode)),
                "call render() for sigma0, or set the mode to 'real-beam'");
  }
  return mapped(scene, radar, atlas, {lod, targets, samples, bounces, seed, time_s, dwell, threads}, progress,
                [&](const Seen& seen, const Wish& wish) {
                  return product::power_map(receiver::received_image(wish.radar, *seen.image), *wish.ground.terrain,
                                            wish.grid, threads);
                });
}

}  // namespace

void add_render(py::module_& module) {
  const simulate::TraceSettings settings;
  module.def(
      "render", &rendered, py::arg("scene").none(true), py::arg("radar"), py::kw_only(), py::arg("lod") = py::none(),
      py::arg("atlas") = py::none(), py::arg("targets") = std::vector<radar::TargetSource>{},
      py::arg("samples") = settings.samples_per_cell, py::arg("bounces") = settings.max_bounces,
      py::arg("seed") = settings.seed, py::arg("time_s") = 0.0, py::arg("dwell") = settings.dwell,
      py::arg("threads") = 0, py::arg("progress") = py::none(),
      "The GroundMap that `radar` sees.\n\n"
      "lod: level of detail; 0 path-traces the scene with `samples` rays a cell, 1 and up use `atlas`. Without it,\n"
      "1 where an atlas is given, else 0. With an atlas `scene` may be None: the atlas knows its terrain, but not the\n"
      "point targets of the scene. The radar's mode decides what is made of the echoes; others than 'real-beam' need "
      "an\n"
      "atlas and a radar that moves. targets: of Target, to add.\n"
      "samples, bounces: at level of detail 0. seed: of the rays there, else of speckle. time_s, dwell: as for\n"
      "phase_history(). threads: 0 for one a processor; has no effect on the result.\n"
      "progress: as for bake().");
  module.def(
      "received_power", &received, py::arg("scene").none(true), py::arg("radar"), py::kw_only(),
      py::arg("lod") = py::none(), py::arg("atlas") = py::none(),
      py::arg("targets") = std::vector<radar::TargetSource>{}, py::arg("samples") = settings.samples_per_cell,
      py::arg("bounces") = settings.max_bounces, py::arg("seed") = settings.seed, py::arg("time_s") = 0.0,
      py::arg("dwell") = settings.dwell, py::arg("threads") = 0, py::arg("progress") = py::none(),
      "The PowerMap that `radar` receives: float32 [row, column] in W for VV, HH and HV over the cells of render()'s\n"
      "map. The mean power, without speckle, of one compressed pulse at the antenna's terminals when the beam points "
      "at\n"
      "the cell and the receiver samples there: the radar equation over the bin at the cell, the loss of the\n"
      "pulse's window included (1.15 dB of the usual one). A real beam's alone; in\n"
      "other modes Error. Arguments as for render().");
}

}  // namespace sigmascape::python
