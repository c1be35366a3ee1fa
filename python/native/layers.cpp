#include "sigmascape/simulate/layers.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <span>

#include "array_view.h"
#include "gil.h"
#include "given_number.h"
#include "loaded_atlas.h"
#include "loaded_scene.h"
#include "long_call.h"
#include "parts.h"
#include "python_progress.h"
#include "python_warnings.h"
#include "trace_arguments.h"
#include "whole_number.h"

#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/base/error.h"
#include "sigmascape/dataset/bounce_labels.h"
#include "sigmascape/product/layer_file.h"
#include "sigmascape/product/map_metrics.h"
#include "sigmascape/radar/radar_bounds.h"
#include "sigmascape/radar/radar_file.h"
#include "sigmascape/scene/obstacle_raster.h"
#include "sigmascape/simulate/map_warnings.h"
#include "sigmascape/simulate/placement.h"

namespace sigmascape::python {
namespace {

namespace py = pybind11;
using radar::LayerStack;

std::vector<simulate::LayerKind> shapes_in(const std::vector<std::string>& names) {
  std::vector<simulate::LayerKind> kinds;
  for (const std::string& name : names) {
    if (dataset::tells_bounces(name)) continue;
    try {
      kinds.push_back(simulate::layer_kind(name));
    } catch (const Error& unknown) {
      throw Error("names", unknown.what(), "at level of detail 0 there are bounce1 to bounce9 and multibounce too");
    }
  }
  return kinds;
}

void check_names(const std::vector<std::string>& names) {
  if (names.empty()) throw Error("names", "is empty", "name the layers that are wanted");
  for (std::size_t i = 1; i < names.size(); ++i) {
    if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]) !=
        names.begin() + static_cast<std::ptrdiff_t>(i))
      throw Error("names", "has '" + names[i] + "' twice", "name each layer once");
  }
}

LayerStack traced(const LoadedScene& scene, const std::vector<std::string>& names, const radar::Radar& radar,
                  const radar::GroundGrid& grid, const simulate::TraceSettings& settings, ProgressListener& progress) {
  LayerStack stack = simulate::traced_layers(scene.scene(), scene.geometry(), radar, grid, shapes_in(names),
                                             settings.threads, settings.targets);
  if (std::ranges::none_of(names, dataset::tells_bounces)) return stack;
  for (radar::Layer& layer :
       dataset::traced_bounce_layers(names, scene.scene(), scene.geometry(), radar, grid, settings, &progress))
    stack.layers.push_back(std::move(layer));
  return stack;
}

LayerStack swept(const LoadedScene& loaded, const LoadedAtlas* atlas, const std::vector<std::string>& names,
                 const radar::Radar& radar, const radar::GroundGrid& grid, std::span<const radar::Target> targets,
                 unsigned threads) {
  for (const std::string& name : names) {
    if (dataset::tells_bounces(name))
      throw Error("layer '" + name + "'", "is not known without rays, where all bounces are one sum", "use lod=0");
  }
  const scene::Scene& scene = loaded.scene();
  const atlas::GroundLayers* baked = atlas != nullptr ? atlas->textures().ground_layers() : nullptr;
  std::optional<radar::ObstacleMap> of_scene;
  if (baked == nullptr) of_scene = scene::obstacles_of(scene, grid.cell_m);
  const radar::ObstacleMap* obstacles = of_scene ? &*of_scene : &baked->obstacles;
  return simulate::swept_layers({&scene.terrain, obstacles, &scene.ground, scene.materials.size()}, radar, grid,
                                shapes_in(names), threads, targets);
}

LayerStack layers(const LoadedScene& scene, const radar::RadarFile& radar_file, const std::vector<std::string>& names,
                  std::optional<LevelOfDetail> lod, const std::shared_ptr<LoadedAtlas>& atlas,
                  const std::vector<radar::TargetSource>& targets, RaysACell samples, Bounces bounces, Seed seed,
                  double time_s, Dwell dwell, Threads threads, const py::object& progress) {
  within("time_s", time_s, radar::bounds::moments_s);
  check_names(names);
  const int level_of_detail = checked_lod(std::optional<int>(lod).value_or(atlas ? 1 : 0));
  const radar::RadarFile asked = radar_file;
  PythonProgress listener(progress);
  return long_call([&] {
    const scene::Scene& ground = scene.scene();
    if (atlas && level_of_detail > 0) atlas->check_baked_from(scene);
    const auto radar = simulate::placed_radar(asked, ground.frame, ground.terrain, ground.extent, time_s);
    const auto grid = simulate::map_grid(asked.map, ground.extent);
    warn_of(radar, simulate::map_warnings(radar, asked.map, ground.terrain, ground.extent));
    const auto placed = simulate::placed_targets(targets, ground.frame, ground.terrain, seed, time_s);
    const simulate::TraceSettings settings{.cell_m = grid.cell_m,
                                           .samples_per_cell = samples,
                                           .max_bounces = bounces,
                                           .seed = seed,
                                           .threads = threads,
                                           .targets = placed,
                                           .dwell = dwell};
    LayerStack stack = level_of_detail == 0 ? traced(scene, names, radar, grid, settings, listener)
                                            : swept(scene, atlas.get(), names, radar, grid, placed, threads);
    std::ranges::stable_sort(stack.layers, {},
                             [&](const radar::Layer& layer) { return std::ranges::find(names, layer.name); });
    stack.crs = ground.frame.proj();
    stack.metadata = {{"radar", radar.name},
                      {"scene", ground.name},
                      {"scene_hash", scene.hash()},
                      {"classes", fmt::format("{}", fmt::join(simulate::class_names(ground), ", "))},
                      {"time_s", fmt::format("{}", time_s)}};
    if (!ground.attribution.empty()) stack.metadata["attribution"] = ground.attribution;
    if (std::ranges::any_of(names, dataset::tells_bounces))
      stack.metadata["bounce_polarization"] = product::polarization_name(radar.polarization);
    return stack;
  });
}

const radar::Layer& layer_of(const LayerStack& stack, const std::string& name) {
  const auto found = std::ranges::find(stack.layers, name, &radar::Layer::name);
  if (found == stack.layers.end()) throw py::key_error(name);
  return *found;
}

/// As of a dict, any key may be asked for.
bool contains(const LayerStack& stack, const py::object& key) {
  return py::isinstance<py::str>(key) &&
         std::ranges::find(stack.layers, key.cast<std::string>(), &radar::Layer::name) != stack.layers.end();
}

std::vector<std::string> names_of(const LayerStack& stack) {
  std::vector<std::string> names;
  for (const radar::Layer& layer : stack.layers) names.push_back(layer.name);
  return names;
}

}  // namespace

void add_layers(py::module_& module) {
  py::class_<LayerStack, std::shared_ptr<LayerStack>>(
      module, "Layers",
      "What lies where in a map, cell for cell; layers[name] is float32 [row, column], north up. Goes through its\n"
      "names as a dict does.")
      .def(
          "__getitem__",
          [](const py::object& self, const std::string& name) {
            return layer_view<float>(layer_of(self.cast<const LayerStack&>(), name).values, 0, self, Access::ReadWrite);
          },
          py::arg("name"), "float32 [row, column], sharing the stack's memory; angles in radians.")
      .def("__contains__", &contains, py::arg("name"))
      .def("__len__", [](const LayerStack& stack) { return stack.layers.size(); })
      .def("__iter__", [](const LayerStack& stack) { return py::iter(py::cast(names_of(stack))); })
      .def("keys", &names_of, "The names, as `names` has them: with them dict(layers) holds all arrays.")
      .def_property_readonly("names", &names_of)
      .def_property_readonly(
          "units",
          [](const LayerStack& stack) {
            py::dict units;
            for (const radar::Layer& layer : stack.layers) units[py::str(layer.name)] = layer.unit;
            return units;
          },
          "By name; empty for masks and classes.")
      .def(
          "save",
          [](const LayerStack& stack, const std::filesystem::path& path) {
            product::check_layer_name(path);
            product::write_layers(path, stack);
          },
          py::arg("path"), py::call_guard<WithoutGil>(),
          "Writes a GeoTIFF (.tif) with a band a layer, angles in degrees.");
  module.def(
      "layers", &layers, py::arg("scene"), py::arg("radar"), py::arg("names"), py::kw_only(),
      py::arg("lod") = py::none(), py::arg("atlas") = nullptr, py::arg("targets") = std::vector<radar::TargetSource>{},
      py::arg("samples") = simulate::TraceSettings{}.samples_per_cell, py::arg("bounces") = 8, py::arg("seed") = 1,
      py::arg("time_s") = 0.0, py::arg("dwell") = 0, py::arg("threads") = 0, py::arg("progress") = py::none(),
      "The Layers called `names` over the cells of the radar's map: 'shadow', 'layover', 'incidence', 'range',\n"
      "'class', 'height', and at level of detail 0 'bounce1', 'bounce2', ... (sigma0 by number of bounces) and\n"
      "'multibounce' (the part that came over more than one). lod: 0 asks rays over the full scene, 1 terrain\n"
      "and obstacles; 1 with an atlas, whose obstacles these then are, so that shadows are those of its maps, "
      "else 0. targets: of Target, whose boxes throw shadows, and which answer in the layers of bounces.\n"
      "Other arguments as for render(); docs/datasets.md says what each layer is.");
  module.def(
      "class_names", [](const LoadedScene& scene) { return simulate::class_names(scene.scene()); }, py::arg("scene"),
      "Names of the numbers in the layer 'class', as a list.");
}

}  // namespace sigmascape::python
