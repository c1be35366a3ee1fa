#pragma once

#include <pybind11/pybind11.h>

namespace sigmascape::python {

/// Each adds its classes and functions to the module; order matters where one names the types of another.
void add_scene(pybind11::module_& module);
void add_targets(pybind11::module_& module);
void add_radar(pybind11::module_& module);
void add_ground_map(pybind11::module_& module);
void add_power_map(pybind11::module_& module);
void add_bake(pybind11::module_& module);
void add_atlas(pybind11::module_& module);
void add_render(pybind11::module_& module);
void add_iq(pybind11::module_& module);
void add_layers(pybind11::module_& module);
void add_dataset(pybind11::module_& module);
void add_curves(pybind11::module_& module);
void add_live(pybind11::module_& module);
void add_live_tracer(pybind11::module_& module);
void add_live_flight(pybind11::module_& module);
void add_live_receiver(pybind11::module_& module);

}  // namespace sigmascape::python
