#include "layer_files.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sigmascape/base/error.h"
#include "sigmascape/product/ground_projection.h"
#include "sigmascape/product/layer_file.h"
#include "sigmascape/scene/obstacle_raster.h"
#include "sigmascape/simulate/layers.h"

namespace sigmascape::cli {
namespace {

constexpr const char* multibounce = "multibounce";

/// k of "bounce<k>", from 1 to 9; 0 for another name.
std::size_t bounce_order(const std::string& name) {
  const bool is_bounce = name.size() == 7 && name.starts_with("bounce") && name[6] >= '1' && name[6] <= '9';
  return is_bounce ? static_cast<std::size_t>(name[6] - '0') : 0;
}

bool needs_paths(const std::string& name) {
  return bounce_order(name) > 0 || name == multibounce;
}

std::vector<simulate::LayerKind> shapes_in(const std::vector<std::string>& names) {
  std::vector<simulate::LayerKind> kinds;
  for (const std::string& name : names) {
    if (!needs_paths(name)) kinds.push_back(simulate::layer_kind(name));
  }
  return kinds;
}

radar::LayerStack shape_layers(const std::vector<std::string>& names, const scene::Scene& scene,
                               const radar::Radar& radar, const radar::GroundGrid& grid, const LayerSource& source) {
  const auto kinds = shapes_in(names);
  if (source.atlas.empty()) {
    const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
    return simulate::traced_layers(scene, geometry, radar, grid, kinds, source.trace.threads);
  }
  const radar::GroundGrid whole{scene.extent.west_m, scene.extent.north_m, grid.cell_m,
                                static_cast<std::size_t>(scene.extent.width_m() / grid.cell_m),
                                static_cast<std::size_t>(scene.extent.height_m() / grid.cell_m)};
  const auto obstacles = scene::obstacles_of(scene, whole);
  return simulate::swept_layers({&scene.terrain, &obstacles, &scene.ground, scene.materials.size()}, radar, grid, kinds,
                                source.trace.threads);
}

/// σ0 by number of bounces in the radar's own polarization, and the part that came over more surfaces than one.
std::vector<radar::Layer> bounce_layers(const std::vector<std::string>& names, const scene::Scene& scene,
                                        const radar::Radar& radar, const radar::GroundGrid& grid,
                                        const LayerSource& source) {
  std::size_t orders = 2;
  for (const std::string& name : names) orders = std::max(orders, bounce_order(name) + 1);
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  simulate::TraceSettings settings = source.trace;
  settings.cell_m = grid.cell_m;
  trace::TraceCounts counts;
  std::vector<Array2D<float>> sigma0;
  for (const auto& image : simulate::traced_bounces(scene, geometry, radar, grid.extent(), settings, orders, counts)) {
    const auto map = product::ground_map(image, scene.terrain, grid);
    sigma0.emplace_back(grid.columns, grid.rows);
    std::ranges::transform(map.sigma0.values(), sigma0.back().values().begin(),
                           [&](const radar::Channels& cell) { return cell.power(radar.polarization); });
  }
  std::vector<radar::Layer> layers;
  for (const std::string& name : names) {
    if (const std::size_t order = bounce_order(name)) layers.push_back({name, "m2/m2", sigma0[order - 1]});
    if (name != multibounce) continue;
    Array2D<float> part(grid.columns, grid.rows);
    for (std::size_t i = 0; i < part.size(); ++i) {
      float all = 0.0F;
      for (const auto& order : sigma0) all += order.values()[i];
      part.values()[i] = all > 0.0F ? 1.0F - sigma0.front().values()[i] / all : 0.0F;
    }
    layers.push_back({name, "", std::move(part)});
  }
  return layers;
}

}  // namespace

void add_layer_options(CLI::App& command, LayerFiles& files) {
  command
      .add_option("--layers", files.names,
                  "layers over the map's cells: shadow, layover, incidence, range, class, height; at level of detail 0 "
                  "also bounce1, bounce2, ... (sigma0 by number of bounces) and multibounce (part of the power that "
                  "came over more than one)")
      ->delimiter(',');
  command.add_option("--layers-out", files.file, "GeoTIFF to write them to, a band for each");
}

void check(const LayerFiles& files, int level_of_detail) {
  if (files.names.empty() && files.file.empty()) return;
  if (files.names.empty()) throw Error("--layers", "is missing beside --layers-out", "name the layers to write");
  if (files.file.empty()) throw Error("--layers-out", "is missing beside --layers", "name the file to write");
  (void)shapes_in(files.names);
  for (const std::string& name : files.names) {
    if (level_of_detail > 0 && needs_paths(name))
      throw Error("layer \"" + name + "\"", "is not in an atlas, where all bounces are one sum", "use --lod 0");
  }
}

void write_layers(const LayerFiles& files, const scene::Scene& scene, const radar::Radar& radar,
                  const radar::GroundGrid& grid, const std::map<std::string, std::string>& metadata,
                  const LayerSource& source) {
  if (files.names.empty()) return;
  radar::LayerStack stack = shape_layers(files.names, scene, radar, grid, source);
  if (std::ranges::any_of(files.names, needs_paths)) {
    for (radar::Layer& layer : bounce_layers(files.names, scene, radar, grid, source))
      stack.layers.push_back(std::move(layer));
  }
  const auto order = [&](const radar::Layer& layer) { return std::ranges::find(files.names, layer.name); };
  std::ranges::stable_sort(stack.layers, {}, order);
  stack.crs = scene.frame.proj();
  stack.metadata = metadata;
  stack.metadata.erase("quantity");
  stack.metadata["classes"] = fmt::format("{}", fmt::join(simulate::class_names(scene), ", "));
  product::write_layers(files.file, stack);
}

}  // namespace sigmascape::cli
