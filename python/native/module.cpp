#include "parts.h"

#include "sigmascape/base/error.h"

PYBIND11_MODULE(_native, module) {
  namespace python = sigmascape::python;
  // Classes and signatures name the package, not the file that holds them.
  const pybind11::object file_name = module.attr("__name__");
  module.attr("__name__") = "sigmascape";
  module.attr("__version__") = SIGMASCAPE_VERSION;
  auto& error = pybind11::register_exception<sigmascape::Error>(module, "Error", PyExc_ValueError);
  error.doc() =
      "What Sigmascape raises for files and arguments that cannot be used: one sentence that says where, what is "
      "wrong,\n"
      "and what would be right.";
  python::add_scene(module);
  python::add_targets(module);
  python::add_radar(module);
  python::add_ground_map(module);
  python::add_power_map(module);
  python::add_bake(module);
  python::add_atlas(module);
  python::add_render(module);
  python::add_iq(module);
  python::add_layers(module);
  python::add_dataset(module);
  python::add_curves(module);
  python::add_live(module);
  python::add_live_tracer(module);
  python::add_live_flight(module);
  module.attr("__name__") = file_name;
}
