#include "python_progress.h"

#include "gil.h"

namespace sigmascape::python {
namespace {

namespace py = pybind11;

constexpr auto telling_time = std::chrono::milliseconds(200);

}  // namespace

PythonProgress::PythonProgress(const py::object& progress)
    : listener_(py::module_::import("sigmascape._progress").attr("listener")(progress)) {}

PythonProgress::~PythonProgress() {
  const py::error_scope keeps_what_was_raised;
  try {
    if (py::hasattr(listener_, "close")) listener_.attr("close")();
  } catch (py::error_already_set& failure) {
    failure.discard_as_unraisable("closing a progress listener");
  }
}

void PythonProgress::advanced(std::string_view task, double done, double total, std::string_view unit) {
  const auto now = Clock::now();
  if (done < total && now - told_ < telling_time) return;
  told_ = now;
  const WithGil gil;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  if (!listener_.is_none()) listener_(task, done, total, unit);
}

}  // namespace sigmascape::python
