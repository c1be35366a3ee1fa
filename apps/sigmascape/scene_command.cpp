#include <algorithm>
#include <cstddef>
#include <fmt/format.h>

#include "command.h"

#include "sigmascape/geo/coordinate_transform.h"
#include "sigmascape/scene/mesh_counts.h"
#include "sigmascape/scene/scene_file.h"
#include "sigmascape/trace/scene_geometry.h"

namespace sigmascape::cli {
namespace {

bool has_multiple_scatter(const scatter::Material& material) {
  const auto* mirrors = std::get_if<scatter::CookTorranceParameters>(&material.model);
  return mirrors != nullptr && mirrors->multiple_scatter;
}

std::ptrdiff_t moving(const scene::Scene& scene) {
  return std::ranges::count_if(scene.instances,
                               [](const scene::Instance& instance) { return instance.speed_mps > 0.0F; });
}

nlohmann::ordered_json summary_of(const scene::Scene& scene, const scene::MeshCounts& counts,
                                  std::size_t geometry_bytes) {
  nlohmann::ordered_json json;
  json["name"] = scene.name;
  json["crs"] = scene.frame.proj();
  json["extent_m"] = {scene.extent.west_m, scene.extent.south_m, scene.extent.east_m, scene.extent.north_m};
  json["heights_m"] = {scene.terrain.lowest_m(), scene.terrain.highest_m()};
  json["tallest_object_m"] = scene::tallest_object_m(scene);
  json["buildings"] = scene.buildings.items.size();
  json["instances"] = scene.instances.size();
  json["instances_with_speed"] = moving(scene);
  json["point_targets"] = scene.point_targets.size();
  json["vertices"] = {{"unique", counts.unique_vertices}, {"instanced", counts.instanced_vertices}};
  json["triangles"] = {{"unique", counts.unique_triangles}, {"instanced", counts.instanced_triangles}};
  json["geometry_mib"] = static_cast<double>(geometry_bytes) / (1024.0 * 1024.0);
  json["scene_hash"] = scene::scene_hash(scene);
  for (const auto& material : scene.materials) {
    json["materials"].push_back(
        {{"name", material.name}, {"verified", material.verified}, {"source", material.source}});
    if (has_multiple_scatter(material)) json["materials"].back()["multi_scatter"] = true;
  }
  json["remarks"] = nlohmann::ordered_json::array();
  for (const auto& remark : scene.remarks) {
    json["remarks"].push_back({{"what", remark.what}, {"count", remark.count}, {"first", remark.first}});
  }
  json["attribution"] = scene.attribution;
  return json;
}

std::string text_of(const scene::Scene& scene, const scene::MeshCounts& counts, std::size_t geometry_bytes) {
  std::string text = fmt::format("{}\n", scene.name);
  const auto line = [&text](std::string_view name, const std::string& value) {
    text += fmt::format("  {:<16}{}\n", name, value);
  };
  const geo::GeographicPosition middle = geo::place_on_globe(scene.frame, scene.extent.centre());
  line("extent", fmt::format("x {:.1f} to {:.1f} m, y {:.1f} to {:.1f} m", scene.extent.west_m, scene.extent.east_m,
                             scene.extent.south_m, scene.extent.north_m));
  line("size", fmt::format("{:.0f} m x {:.0f} m about {:.5f} N, {:.5f} E", scene.extent.width_m(),
                           scene.extent.height_m(), middle.latitude_deg, middle.longitude_deg));
  line("terrain", fmt::format("{} x {} heights every {:.2f} m, {:.1f} to {:.1f} m", scene.terrain.height_m.columns(),
                              scene.terrain.height_m.rows(), scene.terrain.spacing_m, scene.terrain.lowest_m(),
                              scene.terrain.highest_m()));
  line("land cover", fmt::format("{} x {} cells of {:.2f} m", scene.ground.grid.columns, scene.ground.grid.rows,
                                 scene.ground.grid.cell_m));
  line("buildings", fmt::format("{}", scene.buildings.items.size()));
  line("instances", fmt::format("{} of {} prototypes", scene.instances.size(), scene.prototypes.size()));
  line("point targets", fmt::format("{}", scene.point_targets.size()));
  if (const auto count = moving(scene); count > 0)
    line("with a speed", fmt::format("{}, which are seen at rest: movers come from a targets file", count));
  line("tallest object", fmt::format("{:.1f} m", scene::tallest_object_m(scene)));
  line("vertices", fmt::format("{} unique, {} instanced", counts.unique_vertices, counts.instanced_vertices));
  line("triangles", fmt::format("{} unique, {} instanced", counts.unique_triangles, counts.instanced_triangles));
  line("ray structures", fmt::format("{:.1f} MiB", static_cast<double>(geometry_bytes) / (1024.0 * 1024.0)));
  for (const auto& material : scene.materials) {
    line("material", fmt::format("{}{}{}", material.name, has_multiple_scatter(material) ? " (with multi_scatter)" : "",
                                 material.verified ? "" : " (UNVERIFIED constants)"));
  }
  for (const auto& remark : scene.remarks)
    line("note", fmt::format("{}: {}, first {}", remark.what, remark.count, remark.first));
  if (!scene.attribution.empty()) line("data", scene.attribution);
  text.pop_back();
  return text;
}

}  // namespace

void add_scene_command(Command app, Output& output) {
  const auto command = app.add_subcommand("scene", "Look at a scene file");
  command.require_subcommand(1);
  const auto info =
      command.add_subcommand("info", "Print extent, counts, memory, materials, and what was skipped or mended");
  auto file = std::make_shared<std::string>();
  info.add_option("SCENE", *file, "scene file (TOML)").required();
  info.add_flag("--json", output.json, "print as JSON");
  info.footer("Example:\n  sigmascape scene info examples/bilbao/bilbao.toml");
  info.callback([file, &output] {
    const scene::Scene scene = scene::read_scene(*file);
    const scene::MeshCounts counts = scene::mesh_counts(scene);
    const std::size_t bytes = trace::SceneGeometry(scene, trace::Footing::Terrain).memory_bytes();
    output.finish(text_of(scene, counts, bytes), summary_of(scene, counts, bytes));
  });
}

}  // namespace sigmascape::cli
