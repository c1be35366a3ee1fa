#pragma once

#include <cstddef>
#include <pybind11/pybind11.h>

#include "array_view.h"

#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/channels.h"

namespace sigmascape::python {

/// Where the cells of a map lie, of any that has a `grid` and a `crs`.
template <typename Map, typename... Options>
void add_place(pybind11::class_<Map, Options...>& binding) {
  namespace py = pybind11;
  binding
      .def_property_readonly(
          "west_m", [](const Map& m) { return m.grid.west_m; }, "Western edge of column 0.")
      .def_property_readonly(
          "north_m", [](const Map& m) { return m.grid.north_m; }, "Northern edge of row 0.")
      .def_property_readonly(
          "cell_m", [](const Map& m) { return m.grid.cell_m; }, "Side of a cell.")
      .def_property_readonly(
          "shape", [](const Map& m) { return py::make_tuple(m.grid.rows, m.grid.columns); }, "Rows, columns.")
      .def_property_readonly(
          "extent_m",
          [](const Map& m) {
            const auto e = m.grid.extent();
            return py::make_tuple(e.west_m, e.south_m, e.east_m, e.north_m);
          },
          "West, south, east, north.")
      .def_readonly("crs", &Map::crs, "The local frame, as PROJ understands it.");
}

/// One channel of a map's cells as an array that shares their memory.
template <typename Map, typename... Options>
void add_channel(pybind11::class_<Map, Options...>& binding, const char* name, Array2D<radar::Channels> Map::*cells,
                 std::size_t offset, const char* doc) {
  binding.def_property_readonly(
      name,
      [cells, offset](const pybind11::object& self) {
        return layer_view<float>(self.cast<const Map&>().*cells, offset, self, Access::ReadWrite);
      },
      doc);
}

}  // namespace sigmascape::python
