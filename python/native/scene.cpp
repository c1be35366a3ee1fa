#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "array_view.h"
#include "given_number.h"
#include "loaded_scene.h"
#include "long_call.h"
#include "parts.h"
#include "python_warnings.h"
#include "whole_number.h"

#include "sigmascape/base/error.h"
#include "sigmascape/scene/paper_scene.h"
#include "sigmascape/scene/scene_file.h"
#include "sigmascape/scene/simple_scene.h"

namespace sigmascape::python {
namespace {

namespace py = pybind11;

py::tuple tuple_of(const radar::Rectangle& extent) {
  return py::make_tuple(extent.west_m, extent.south_m, extent.east_m, extent.north_m);
}

py::list materials_of(const scene::Scene& scene) {
  py::list list;
  for (const auto& material : scene.materials) {
    py::dict entry;
    entry["name"] = material.name;
    entry["verified"] = material.verified;
    entry["source"] = material.source;
    list.append(entry);
  }
  return list;
}

py::list remarks_of(const scene::Scene& scene) {
  py::list list;
  for (const auto& remark : scene.remarks) {
    py::dict entry;
    entry["what"] = remark.what;
    entry["count"] = remark.count;
    entry["first"] = remark.first;
    list.append(entry);
  }
  return list;
}

/// Another thread that makes it may want the GIL meanwhile.
std::string hash_of(const LoadedScene& loaded) {
  return long_call([&] { return loaded.hash(); });
}

py::dict scene_info(const LoadedScene& loaded) {
  const scene::Scene& scene = loaded.scene();
  py::dict info;
  info["name"] = scene.name;
  info["crs"] = scene.frame.proj();
  info["extent_m"] = tuple_of(scene.extent);
  info["heights_m"] = py::make_tuple(scene.terrain.lowest_m(), scene.terrain.highest_m());
  info["tallest_object_m"] = scene::tallest_object_m(scene);
  info["buildings"] = scene.buildings.items.size();
  info["instances"] = scene.instances.size();
  info["point_targets"] = scene.point_targets.size();
  info["materials"] = materials_of(scene);
  info["remarks"] = remarks_of(scene);
  info["scene_hash"] = hash_of(loaded);
  info["attribution"] = scene.attribution;
  return info;
}

std::shared_ptr<LoadedScene> made_up_town(double scale, Seed seed, const std::string& materials) {
  if (materials != "paper" && materials != "itu")
    throw Error("materials", "is '" + materials + "'", "give 'paper' or 'itu'");
  const auto constants = materials == "itu" ? scene::PaperMaterials::Itu : scene::PaperMaterials::Paper;
  return long_call([&] {
    return std::make_shared<LoadedScene>(scene::paper_scene({.scale = scale, .seed = seed, .materials = constants}));
  });
}

}  // namespace

void add_scene(py::module_& module) {
  py::class_<LoadedScene, std::shared_ptr<LoadedScene>>(module, "Scene",
                                                        "A landscape: terrain, land cover, buildings, trees, vehicles, "
                                                        "materials. Its local frame has x east and y north\n"
                                                        "in metres; heights are above mean sea level.")
      .def_static(
          "read",
          [](const std::filesystem::path& path) {
            return long_call([&] {
              auto loaded = std::make_shared<LoadedScene>(scene::read_scene(path));
              warn_of(loaded->scene());
              return loaded;
            });
          },
          py::arg("path"),
          "Reads a scene file (TOML, docs/scene_file.md) and all data that it names. Warns (UserWarning) of what is\n"
          "likely a mistake, such as a file of which nothing is used; info()['remarks'] tells all that was mended or "
          "left out.")
      .def_static(
          "simple",
          [](double side_m, const std::string& ground, const std::string& objects) {
            return long_call([&] {
              return std::make_shared<LoadedScene>(
                  scene::simple_scene({.side_m = side_m, .ground_material = ground, .object_material = objects}));
            });
          },
          py::kw_only(), py::arg("side_m") = 128.0, py::arg("ground_material") = "concrete",
          py::arg("object_material") = "concrete",
          "A box and a cylinder on a plane. Materials are named as in the material library.")
      .def_static("paper", &made_up_town, py::kw_only(), py::arg("scale") = 1.0, py::arg("seed") = 1,
                  py::arg("materials") = "paper",
                  "A made-up town by a river with fields, forests and hills; `scale` (0.1 to 5) times 2 km a side.\n"
                  "`materials`: 'paper' or 'itu'.")
      .def_property_readonly("name", [](const LoadedScene& s) { return s.scene().name; })
      .def_property_readonly(
          "crs", [](const LoadedScene& s) { return s.scene().frame.proj(); }, "The local frame as a PROJ string.")
      .def_property_readonly(
          "origin_deg",
          [](const LoadedScene& s) {
            return py::make_tuple(s.scene().frame.latitude_deg(), s.scene().frame.longitude_deg());
          },
          "Latitude and longitude of the frame's origin.")
      .def_property_readonly(
          "extent_m", [](const LoadedScene& s) { return tuple_of(s.scene().extent); }, "West, south, east, north.")
      .def_property_readonly("attribution", [](const LoadedScene& s) { return s.scene().attribution; })
      .def_property_readonly("hash", &hash_of, "A digest of everything that affects how the scene scatters.")
      .def_property_readonly(
          "terrain_m",
          [](const py::object& self) {
            return layer_view<float>(self.cast<const LoadedScene&>().scene().terrain.height_m, 0, self,
                                     Access::ReadOnly);
          },
          "Heights, float32 [row, column], north up; no copy. Node (row i, column j) stands at\n"
          "(west + j * spacing, north - i * spacing) of `terrain_grid_m`.")
      .def_property_readonly(
          "terrain_grid_m",
          [](const LoadedScene& s) {
            const auto& terrain = s.scene().terrain;
            return py::make_tuple(terrain.west_m, terrain.north_m, terrain.spacing_m);
          },
          "West, north, spacing of the nodes of `terrain_m`.")
      .def_property_readonly(
          "ground_material",
          [](const py::object& self) {
            return layer_view<std::uint8_t>(self.cast<const LoadedScene&>().scene().ground.material, 0, self,
                                            Access::ReadOnly);
          },
          "Index into info()['materials'] of the bare ground, uint8 [row, column], north up; no copy.")
      .def_property_readonly(
          "ground_grid_m",
          [](const LoadedScene& s) {
            const auto& grid = s.scene().ground.grid;
            return py::make_tuple(grid.west_m, grid.north_m, grid.cell_m);
          },
          "West edge, north edge and cell side of `ground_material`.")
      .def(
          "height_at",
          [](const LoadedScene& s, double x_m, double y_m) {
            return s.scene().terrain.height_at(checked_place(x_m, y_m));
          },
          py::arg("x_m"), py::arg("y_m"),
          "Height of the bare ground at a point, in metres; beyond the terrain that of its nearest edge.")
      .def("info", &scene_info, "Extent, counts, materials and what was mended while reading, as a dict.")
      .def("__repr__", [](const LoadedScene& s) { return "<sigmascape.Scene '" + s.scene().name + "'>"; });
}

}  // namespace sigmascape::python
