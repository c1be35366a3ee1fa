#include <cmath>
#include <map>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "array_view.h"
#include "gil.h"
#include "map_cells.h"
#include "parts.h"
#include "polarization.h"

#include "sigmascape/base/error.h"
#include "sigmascape/base/file_ending.h"
#include "sigmascape/product/ground_map_file.h"
#include "sigmascape/product/map_file.h"
#include "sigmascape/product/map_metrics.h"
#include "sigmascape/product/map_picture.h"
#include "sigmascape/product/map_view.h"

namespace sigmascape::python {
namespace {

namespace py = pybind11;
using radar::Channels;
using radar::GroundMap;

void save(const GroundMap& map, const std::filesystem::path& path, bool db,
          const std::optional<std::string>& polarization, double span_db, const std::optional<double>& top_db) {
  // Others may assign metadata while this writes without the GIL.
  const std::map<std::string, std::string> metadata = map.metadata;
  const WithoutGil released;
  const product::MapView view{map.grid, map.sigma0, map.crs, metadata, product::sigma0_quantity()};
  if (product::is_map_name(path)) {
    return product::write_map(path, view, db ? product::MapScale::Decibels : product::MapScale::Linear);
  }
  if (file_ending(path) != ".png") {
    throw Error(path.string(), "is no kind of file that maps are saved as", "end the name in .tif, .npy, .npz or .png");
  }
  product::write_map_picture(
      path, view, {.polarization = polarization_from(polarization, metadata), .span_db = span_db, .top_db = top_db});
}

py::array_t<float> decibels(const GroundMap& map, const std::optional<std::string>& polarization, double floor_db) {
  const radar::Polarization wanted = polarization_from(polarization, map.metadata);
  if (std::isnan(floor_db)) throw Error("floor_db", "is not a number", "give the darkest value in dB");
  py::array_t<float> result({map.grid.rows, map.grid.columns});
  float* db = result.mutable_data();
  for (const Channels& cell : map.sigma0.values()) {
    const float power = cell.power(wanted);
    *db++ = power != power ? power : std::max(static_cast<float>(floor_db), 10.0F * std::log10(power));
  }
  return result;
}

std::vector<product::CellComparison> compared(const GroundMap& tested, const GroundMap& truth,
                                              const std::vector<double>& cells_m, const std::string& polarization,
                                              double floor_db, double shadow_db) {
  const product::CompareOptions options{cells_m, polarization_from(polarization), floor_db, shadow_db};
  const WithoutGil released;
  return product::compare_maps(tested, truth, options).at;
}

GroundMap read(const std::filesystem::path& path, const std::optional<std::string>& polarization) {
  const std::optional<radar::Polarization> needed =
      polarization ? std::optional(polarization_from(*polarization)) : std::nullopt;
  const WithoutGil released;
  return needed ? product::read_ground_map(path, *needed) : product::read_ground_map(path);
}

void add_comparison(py::module_& module) {
  using product::CellComparison;
  py::class_<CellComparison>(module, "CellComparison", "How close one map comes to another at one cell size.")
      .def_readonly("cell_m", &CellComparison::cell_m)
      .def_readonly("cells", &CellComparison::cells, "Number of cells that both maps saw wholly.")
      .def_readonly("correlation_db", &CellComparison::correlation_db, "Pearson's correlation of decibels.")
      .def_readonly("rms_db", &CellComparison::rms_db, "Root mean square difference of decibels.")
      .def_readonly("bias_db", &CellComparison::bias_db, "10 lg of the ratio of total powers.")
      .def_readonly("l1", &CellComparison::l1, "Sum of absolute differences over the sum of the truth.")
      .def_readonly("shadow_iou", &CellComparison::shadow_iou, "Intersection over union of shadows.")
      .def("__repr__", [](const CellComparison& c) {
        return py::str("<cell_m={:g} correlation_db={:.3f} rms_db={:.2f} bias_db={:+.2f} l1={:.3f} shadow_iou={:.2f}>")
            .format(c.cell_m, c.correlation_db, c.rms_db, c.bias_db, c.l1, c.shadow_iou);
      });
  module.def(
      "compare", &compared, py::arg("tested"), py::arg("truth"), py::kw_only(),
      py::arg("cells_m") = std::vector<double>{}, py::arg("polarization") = "sum", py::arg("floor_db") = -45.0,
      py::arg("shadow_db") = -35.0,
      "How close the map `tested` comes to `truth`, at each of `cells_m` (empty: 2, 4, 8, 16, 32 where they can\n"
      "be, or where none can 1 to 16 times the maps' own): a list of CellComparison.");
}

}  // namespace

void add_ground_map(py::module_& module) {
  py::class_<GroundMap, std::shared_ptr<GroundMap>> binding(
      module, "GroundMap",
      "The ground as a radar measures it: sigma0, linear, with respect to horizontal area; NaN where the radar did "
      "not\n"
      "look. Arrays are [row, column], north up, and share the map's memory.");
  add_place(binding);
  binding
      .def_static(
          "read", &read, py::arg("path"), py::kw_only(), py::arg("polarization") = py::none(),
          "Reads a GeoTIFF that save() or `sigmascape render` wrote. With a polarization, vv, hh, hv or sum, only the\n"
          "bands of its power must be there; those that are not are NaN.")
      .def_property_readonly(
          "sigma0",
          [](const py::object& self) {
            return layers_view<float>(self.cast<const GroundMap&>().sigma0, self, Access::ReadWrite);
          },
          "float32 [row, column, 4]: VV, HH, HV (= VH), Re<S_VV S_HH*>.")
      .def_readwrite("metadata", &GroundMap::metadata,
                     "Where the map comes from, text by name. Assign a dict to change it.")
      .def("db", &decibels, py::arg("polarization") = py::none(), py::kw_only(), py::arg("floor_db") = -60.0,
           "10 lg sigma0, float32 [row, column]; not darker than `floor_db`, NaN where the radar did not look.\n"
           "polarization: None for the radar's, which the metadata tell.")
      .def("save", &save, py::arg("path"), py::kw_only(), py::arg("db") = false, py::arg("polarization") = py::none(),
           py::arg("span_db") = 50.0, py::arg("top_db") = py::none(),
           "Writes a cloud-optimised GeoTIFF (.tif: sigma0, CRS, metadata), NumPy files (.npy with .json, .npz), or a\n"
           "picture with its legend and world file (.png). db: sigma0 in decibels instead of linear; the other\n"
           "arguments are for pictures. polarization: None for the radar's.")
      .def("__repr__", [](const GroundMap& m) {
        return py::str("<sigmascape.GroundMap {} x {} cells of {:g} m>")
            .format(m.grid.rows, m.grid.columns, m.grid.cell_m);
      });
  add_channel(binding, "vv", &GroundMap::sigma0, offsetof(Channels, vv), "float32 [row, column].");
  add_channel(binding, "hh", &GroundMap::sigma0, offsetof(Channels, hh), "float32 [row, column].");
  add_channel(binding, "hv", &GroundMap::sigma0, offsetof(Channels, hv), "float32 [row, column]; equal to VH.");
  add_channel(binding, "re_vvhh", &GroundMap::sigma0, offsetof(Channels, re_vvhh),
              "float32 [row, column]: Re<S_VV S_HH*>, negative where an even number of bounces prevails.");
  add_comparison(module);
}

}  // namespace sigmascape::python
