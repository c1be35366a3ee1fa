#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "gil.h"
#include "map_cells.h"
#include "parts.h"
#include "polarization.h"

#include "sigmascape/base/error.h"
#include "sigmascape/product/decibels.h"
#include "sigmascape/product/map_file.h"
#include "sigmascape/product/power_map_file.h"

namespace sigmascape::python {
namespace {

namespace py = pybind11;
using radar::Channels;
using radar::PowerMap;

py::array_t<float> decibel_watts(const PowerMap& map, const std::optional<std::string>& polarization) {
  const radar::Polarization wanted = polarization_from(polarization, map.metadata);
  if (wanted == radar::Polarization::Sum)
    throw Error("polarization", "is 'sum', which no receiver has", "give 'vv', 'hh', 'hv' or 'vh'");
  py::array_t<float> result({map.grid.rows, map.grid.columns});
  float* dbw = result.mutable_data();
  for (const Channels& cell : map.power_w.values())
    *dbw++ = product::decibels_of(cell.power(wanted), product::darkest_dbw);
  return result;
}

}  // namespace

void add_power_map(py::module_& module) {
  py::class_<PowerMap, std::shared_ptr<PowerMap>> binding(
      module, "PowerMap",
      "What a radar receives from each place on the ground: mean power, in W, of one compressed pulse at the "
      "antenna's\n"
      "terminals; NaN where the radar did not look. Arrays are [row, column], north up, and share the map's memory.");
  add_place(binding);
  binding
      .def_static(
          "read", [](const std::filesystem::path& path) { return product::read_power_map(path); }, py::arg("path"),
          py::call_guard<WithoutGil>(), "Reads a GeoTIFF that save() or `sigmascape render --power` wrote.")
      .def_readonly("noise_w", &PowerMap::noise_w, "Mean noise beside the signal, in W: k T0 B F, the same everywhere.")
      .def_readonly("metadata", &PowerMap::metadata, "Where the map comes from, text by name.")
      .def("dbw", &decibel_watts, py::arg("polarization") = py::none(),
           "10 lg of the power over 1 W, float32 [row, column]; not darker than -300, NaN where the radar did not "
           "look.\n"
           "polarization: None for the radar's, which must not be 'sum'.")
      .def(
          "save",
          [](const PowerMap& map, const std::filesystem::path& path, bool db) {
            product::write_map(path, map, db ? product::MapScale::Decibels : product::MapScale::Linear);
          },
          py::arg("path"), py::kw_only(), py::arg("db") = false, py::call_guard<WithoutGil>(),
          "Writes a cloud-optimised GeoTIFF (.tif: bands VV, HH, HV with unit, CRS, metadata) or NumPy files (.npy\n"
          "with .json, .npz). db: dBW instead of W.")
      .def("__repr__", [](const PowerMap& m) {
        return py::str("<sigmascape.PowerMap {} x {} cells of {:g} m>")
            .format(m.grid.rows, m.grid.columns, m.grid.cell_m);
      });
  add_channel(binding, "vv", &PowerMap::power_w, offsetof(Channels, vv), "float32 [row, column], W.");
  add_channel(binding, "hh", &PowerMap::power_w, offsetof(Channels, hh), "float32 [row, column], W.");
  add_channel(binding, "hv", &PowerMap::power_w, offsetof(Channels, hv), "float32 [row, column], W; equal to VH.");
}

}  // namespace sigmascape::python
