#include "python_warnings.h"

#include <fmt/format.h>
#include <pybind11/pybind11.h>

#include "sigmascape/radar/radar_title.h"

namespace sigmascape::python {

namespace py = pybind11;

void warn_of(const radar::Radar& radar, std::span<const std::string> warnings) {
  for (const std::string& warning : warnings) {
    const std::string text = fmt::format("{}: {}", radar::title_of(radar), warning);
    const py::gil_scoped_acquire gil;
    if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) != 0) throw py::error_already_set();
  }
}

}  // namespace sigmascape::python
