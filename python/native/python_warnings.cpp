#include "python_warnings.h"

#include <fmt/format.h>
#include <pybind11/pybind11.h>

#include "gil.h"
#include "text_with_file_names.h"

#include "sigmascape/radar/radar_title.h"
#include "sigmascape/scene/scene_warnings.h"

namespace sigmascape::python {

namespace py = pybind11;

namespace {

void warn(const std::string& text) {
  const WithGil gil;
  // Shown by that module, a warning lets Ctrl-C through; what Python has inside for want of it swallows it.
  py::module_::import("warnings");
  if (PyErr_WarnFormat(PyExc_UserWarning, 1, "%U", text_with_file_names(text).ptr()) != 0)
    throw py::error_already_set();
}

}  // namespace

void warn_of(const radar::Radar& radar, std::span<const std::string> warnings) {
  for (const std::string& warning : warnings) warn(fmt::format("{}: {}", radar::title_of(radar), warning));
}

void warn_of(const scene::Scene& scene) {
  for (const std::string& warning : scene::warnings_of(scene)) warn(warning);
}

}  // namespace sigmascape::python
