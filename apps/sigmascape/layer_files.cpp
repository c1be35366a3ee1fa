#include "layer_files.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>

#include "sigmascape/base/error.h"
#include "sigmascape/dataset/bounce_labels.h"
#include "sigmascape/product/layer_file.h"
#include "sigmascape/product/map_metrics.h"
#include "sigmascape/product/reprojection.h"
#include "sigmascape/radar/mode_words.h"
#include "sigmascape/scene/obstacle_raster.h"
#include "sigmascape/simulate/layers.h"

namespace sigmascape::cli {
namespace {

simulate::LayerKind shape_in(const std::string& name) {
  try {
    return simulate::layer_kind(name);
  } catch (const Error& unknown) {
    throw Error("--layers", unknown.what(), "at level of detail 0 there are bounce1 to bounce9 and multibounce too");
  }
}

std::vector<simulate::LayerKind> shapes_in(const std::vector<std::string>& names) {
  std::vector<simulate::LayerKind> kinds;
  for (const std::string& name : names) {
    if (!dataset::tells_bounces(name)) kinds.push_back(shape_in(name));
  }
  return kinds;
}

radar::LayerStack shape_layers(const std::vector<std::string>& names, const scene::Scene& scene,
                               const radar::Radar& radar, const radar::GroundGrid& grid, const LayerSource& source) {
  const auto kinds = shapes_in(names);
  if (source.atlas.empty()) {
    const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
    return simulate::traced_layers(scene, geometry, radar, grid, kinds, source.trace.threads, source.trace.targets);
  }
  std::optional<radar::ObstacleMap> of_scene;
  if (source.obstacles == nullptr) of_scene = scene::obstacles_of(scene, grid.cell_m);
  const radar::ObstacleMap* obstacles = of_scene ? &*of_scene : source.obstacles;
  return simulate::swept_layers({&scene.terrain, obstacles, &scene.ground, scene.materials.size()}, radar, grid, kinds,
                                source.trace.threads, source.trace.targets);
}

std::vector<radar::Layer> bounce_layers(const std::vector<std::string>& names, const scene::Scene& scene,
                                        const radar::Radar& radar, const radar::GroundGrid& grid,
                                        const LayerSource& source) {
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  simulate::TraceSettings settings = source.trace;
  settings.cell_m = grid.cell_m;
  return dataset::traced_bounce_layers(names, scene, geometry, radar, grid, settings);
}

}  // namespace

void add_layer_options(Command command, LayerFiles& files) {
  command
      .add_option("--layers", files.names,
                  "layers over the map's cells, with commas between: shadow, layover, incidence, range, class, height; "
                  "at level of detail 0 also bounce1 to bounce9 (sigma0 by number of bounces, no more than --bounces) "
                  "and multibounce (part of the power that came over more than one), of --polarization or else the "
                  "radar file's")
      .delimiter(',');
  command.add_option("--layers-out", files.file, "GeoTIFF to write them to, a band for each");
}

void check(const LayerFiles& files, int max_bounces) {
  if (files.names.empty() && files.file.empty()) return;
  if (files.names.empty()) throw Error("--layers", "is missing beside --layers-out", "name the layers to write");
  if (files.file.empty()) throw Error("--layers-out", "is missing beside --layers", "name the file to write");
  product::check_layer_name(files.file);
  (void)shapes_in(files.names);
  for (const std::string& name : files.names) {
    if (std::ranges::count(files.names, name) > 1) throw Error("--layers", "names " + name + " twice", "name it once");
    if (dataset::bounce_order(name) > static_cast<std::size_t>(max_bounces))
      throw Error("layer \"" + name + "\"", fmt::format("is of more bounces than are traced, {}", max_bounces),
                  "raise --bounces");
  }
}

void check(const LayerFiles& files, int level_of_detail, radar::Mode mode) {
  const auto told = std::ranges::find_if(files.names, dataset::tells_bounces);
  if (told == files.names.end()) return;
  const std::string where = "layer \"" + *told + "\"";
  if (mode != radar::Mode::RealBeam) {
    throw Error(where,
                fmt::format("is not in an atlas, where all bounces are one sum, and {} has no other source",
                            radar::mode_word(mode)),
                "leave it out, take the [mode] out of the radar file, or trace it by Python's sigmascape.layers");
  }
  if (level_of_detail > 0) throw Error(where, "is not in an atlas, where all bounces are one sum", "use --lod 0");
}

void write_layers(const LayerFiles& files, const scene::Scene& scene, const radar::Radar& radar,
                  const radar::GroundGrid& grid, const std::string& crs,
                  const std::map<std::string, std::string>& metadata, const LayerSource& source) {
  if (files.names.empty()) return;
  radar::LayerStack stack = shape_layers(files.names, scene, radar, grid, source);
  if (std::ranges::any_of(files.names, dataset::tells_bounces)) {
    for (radar::Layer& layer : bounce_layers(files.names, scene, radar, grid, source))
      stack.layers.push_back(std::move(layer));
  }
  const auto order = [&](const radar::Layer& layer) { return std::ranges::find(files.names, layer.name); };
  std::ranges::stable_sort(stack.layers, {}, order);
  stack.crs = scene.frame.proj();
  stack.metadata = metadata;
  stack.metadata.erase("quantity");
  if (std::ranges::any_of(files.names, dataset::tells_bounces))
    stack.metadata["bounce_polarization"] = product::polarization_name(radar.polarization);
  stack.metadata["classes"] = fmt::format("{}", fmt::join(simulate::class_names(scene), ", "));
  product::write_layers(files.file, crs.empty() ? stack : product::reprojected(stack, scene.frame, crs));
}

}  // namespace sigmascape::cli
