#include <exception>

#include "gil.h"
#include "parts.h"
#include "text_with_file_names.h"

#include "sigmascape/base/error.h"

namespace {

/// sigmascape.Error, which lives as long as the process.
pybind11::handle error_class;

void raise_error(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const sigmascape::Error& error) {
    PyErr_SetObject(error_class.ptr(), sigmascape::python::text_with_file_names(error.what()).ptr());
  }
}

}  // namespace

PYBIND11_MODULE(_native, module) {
  namespace python = sigmascape::python;
  // Classes and signatures name the package, not the file that holds them.
  const pybind11::object file_name = module.attr("__name__");
  module.attr("__name__") = "sigmascape";
  module.attr("__version__") = SIGMASCAPE_VERSION;
  pybind11::exception<sigmascape::Error> error(module, "Error", PyExc_ValueError);
  error.doc() =
      "What Sigmascape raises for files and arguments that cannot be used: one sentence that says where, what is "
      "wrong,\n"
      "and what would be right.";
  error_class = error.release();
  pybind11::register_exception_translator(&raise_error);
  python::look_after_threads();
  python::add_scene(module);
  python::add_radar(module);
  python::add_ground_map(module);
  python::add_power_map(module);
  python::add_bake(module);
  python::add_atlas(module);
  python::add_targets(module);
  python::add_render(module);
  python::add_iq(module);
  python::add_layers(module);
  python::add_dataset(module);
  python::add_curves(module);
  python::add_live(module);
  python::add_live_tracer(module);
  python::add_live_flight(module);
  python::add_live_receiver(module);
  module.attr("__name__") = file_name;
}
