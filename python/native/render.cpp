#include <fmt/format.h>
#include <pybind11/stl.h>

#include "loaded_atlas.h"
#include "loaded_scene.h"
#include "parts.h"
#include "python_progress.h"

#include "sigmascape/base/error.h"
#include "sigmascape/product/described_map.h"
#include "sigmascape/radar/radar_file.h"
#include "sigmascape/radar/radar_warnings.h"
#include "sigmascape/simulate/placement.h"
#include "sigmascape/simulate/simulate.h"

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
    if (atlas != nullptr && atlas->description().scene_hash != loaded->hash()) {
      throw Error(atlas->store().folder().string(), "was baked from another scene than '" + scene.name + "'",
                  "bake this scene, or give the scene that the atlas was made from");
    }
    return {scene.name, loaded->hash(), scene.attribution, &scene.frame, &scene.terrain, scene.extent};
  }
  if (atlas == nullptr) throw Error("scene", "is None, and so is atlas", "give a Scene, an Atlas, or both");
  const atlas::AtlasDescription& description = atlas->description();
  return {description.name,   description.scene_hash, description.attribution,
          &description.frame, &atlas->terrain(),      description.extent};
}

struct Rendered {
  radar::RangeAzimuthImage image;
  product::Provenance provenance;
};

Rendered traced(const LoadedScene* scene, const radar::Radar& radar, const radar::Rectangle& area,
                const simulate::TraceSettings& settings, ProgressListener& progress) {
  if (scene == nullptr) throw Error("scene", "is None at level of detail 0", "give the Scene that is to be traced");
  trace::TraceCounts counts;
  return {simulate::traced_image(scene->scene(), scene->geometry(), radar, area, settings, counts, &progress),
          {{"processing", "level of detail 0: path-traced"},
           {"seed", std::to_string(settings.seed)},
           {"samples_per_cell", std::to_string(settings.samples_per_cell)}}};
}

Rendered baked(const LoadedAtlas* atlas, const Ground& ground, const radar::Radar& radar, const radar::Rectangle& area,
               const render::RenderSettings& settings) {
  if (atlas == nullptr) {
    throw Error("atlas", fmt::format("is None at level of detail {}", settings.level_of_detail),
                "give the Atlas that bake() made, or lod=0");
  }
  render::RenderCounts counts;
  return {simulate::baked_image(atlas->textures(), *ground.terrain, radar, area, settings, counts),
          {{"processing", fmt::format("level of detail {}: from terrain and atlas", settings.level_of_detail)}}};
}

void warn_of(const radar::Radar& radar, const radar::RangeAzimuthGrid& bins, double cell_m) {
  for (const std::string& warning : radar::radar_warnings(radar, bins, cell_m)) {
    const std::string text = fmt::format("radar {}: {}", radar.name, warning);
    const py::gil_scoped_acquire gil;
    if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) != 0) throw py::error_already_set();
  }
}

radar::GroundMap rendered(const std::shared_ptr<LoadedScene>& scene, const radar::RadarFile& radar_file,
                          std::optional<int> lod, const std::shared_ptr<LoadedAtlas>& atlas, std::uint32_t samples,
                          int bounces, std::uint64_t seed, unsigned threads, const py::object& progress) {
  const radar::RadarFile asked = radar_file;
  const int level_of_detail = lod.value_or(atlas ? 1 : 0);
  if (level_of_detail < 0) throw Error("lod", "is negative", "give 0 to trace the scene, 1 and up to use the atlas");
  PythonProgress listener(progress);
  const py::gil_scoped_release release;
  const Ground ground = ground_of(scene.get(), level_of_detail > 0 ? atlas.get() : nullptr);
  const auto radar = simulate::placed_radar(asked, *ground.frame, *ground.terrain, ground.extent);
  const auto grid = simulate::map_grid(asked.map, ground.extent);
  warn_of(radar, simulate::bins_for(radar, grid.extent(), *ground.terrain), grid.cell_m);
  Rendered result = level_of_detail == 0 ? traced(scene.get(), radar, grid.extent(),
                                                  {.cell_m = grid.cell_m,
                                                   .samples_per_cell = samples,
                                                   .max_bounces = bounces,
                                                   .seed = seed,
                                                   .threads = threads},
                                                  listener)
                                         : baked(atlas.get(), ground, radar, grid.extent(),
                                                 {.level_of_detail = level_of_detail, .threads = threads});
  result.provenance["scene"] = ground.name;
  result.provenance["scene_hash"] = ground.hash;
  if (!ground.attribution.empty()) result.provenance["attribution"] = ground.attribution;
  return product::described_map(result.image, radar, *ground.terrain, grid, *ground.frame, result.provenance);
}

}  // namespace

void add_render(py::module_& module) {
  const simulate::TraceSettings settings;
  module.def(
      "render", &rendered, py::arg("scene").none(true), py::arg("radar"), py::kw_only(), py::arg("lod") = py::none(),
      py::arg("atlas") = py::none(), py::arg("samples") = settings.samples_per_cell,
      py::arg("bounces") = settings.max_bounces, py::arg("seed") = settings.seed, py::arg("threads") = 0,
      py::arg("progress") = py::none(),
      "The GroundMap that `radar` sees.\n\n"
      "lod: level of detail; 0 path-traces the scene with `samples` rays a cell, 1 and up use `atlas`. Without it,\n"
      "1 where an atlas is given, else 0. With an atlas `scene` may be None: the atlas knows its terrain.\n"
      "samples, bounces, seed: at level of detail 0. threads: 0 for one a processor; has no effect on the result.\n"
      "progress: as for bake().");
}

}  // namespace sigmascape::python
