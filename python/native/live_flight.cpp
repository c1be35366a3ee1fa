#include "sigmascape/simulate/live_flight.h"

#include <pybind11/stl.h>

#include "held_frame.h"
#include "loaded_scene.h"
#include "long_call.h"
#include "parts.h"

namespace sigmascape::python {
namespace {

namespace py = pybind11;

/// A flight and the scene that it traces.
struct SceneFlight {
  std::shared_ptr<LoadedScene> scene;
  simulate::LiveFlight flight;
};

std::unique_ptr<SceneFlight> made_flight(std::shared_ptr<LoadedScene> scene,
                                         const std::shared_ptr<render::LiveGround>& ground, const std::string& content,
                                         std::size_t beams, std::size_t ranges, double beam_step_rad,
                                         double range_step_m, double cells_per_bin, std::uint64_t seed,
                                         unsigned threads, double refraction, std::uint32_t rays_per_cell,
                                         int bounces) {
  const auto settings =
      settings_from(content, beams, ranges, beam_step_rad, range_step_m, cells_per_bin, seed, threads, refraction);
  const simulate::LiveFlightSettings flight{.tracing = {.rays_per_cell = rays_per_cell, .max_bounces = bounces}};
  const auto& loaded = *scene;
  return std::unique_ptr<SceneFlight>(new SceneFlight{
      .scene = std::move(scene), .flight = {loaded.scene(), loaded.geometry(), ground, settings, flight}});
}

HeldFrame flown(const py::object& self, const Triple& position_m, double first_azimuth_rad, double first_range_m,
                const Triple& velocity_mps) {
  auto& held = self.cast<SceneFlight&>();
  const auto pose = pose_from(position_m, first_azimuth_rad, first_range_m, velocity_mps);
  const render::Frame* const frame = long_call([&] { return &held.flight.render(pose); });
  return {*frame, pose, self};
}

HeldFrame swept(const py::object& self, const Triple& position_m, double first_azimuth_rad, double first_range_m,
                std::size_t first_beam, std::size_t count, const Triple& velocity_mps) {
  auto& held = self.cast<SceneFlight&>();
  const auto pose = pose_from(position_m, first_azimuth_rad, first_range_m, velocity_mps);
  const render::Frame* const frame = long_call([&] { return &held.flight.scan(pose, first_beam, count); });
  return {*frame, pose, self};
}

}  // namespace

void add_live_flight(py::module_& module) {
  const render::LiveSettings settings;
  const simulate::LiveTraceSettings tracing;
  py::class_<SceneFlight>(
      module, "LiveFlight",
      "Live frames along a flight path at the level of detail that they need: traced as by LiveTracer where a small\n"
      "area is looked at closely, from the textures of an atlas of the same scene elsewhere. One gives way to the\n"
      "other over some frames, so that no step shows.")
      .def(py::init(&made_flight), py::arg("scene"), py::arg("ground"), py::kw_only(),
           py::arg("content") = "amplitudes", py::arg("beams") = settings.beams, py::arg("ranges") = settings.ranges,
           py::arg("beam_step_rad") = settings.beam_step_rad, py::arg("range_step_m") = settings.range_step_m,
           py::arg("cells_per_bin") = settings.cells_per_bin, py::arg("seed") = settings.seed, py::arg("threads") = 0,
           py::arg("refraction") = settings.refraction, py::arg("rays_per_cell") = tracing.rays_per_cell,
           py::arg("bounces") = tracing.max_bounces, py::call_guard<py::gil_scoped_release>(),
           "rays_per_cell, bounces: of traced frames, as in LiveTracer. The rest as in LiveRenderer.")
      .def("render", &flown, py::arg("position_m"), py::kw_only(), py::arg("first_azimuth_rad"),
           py::arg("first_range_m"), py::arg("velocity_mps") = Triple{}, "A Frame of all beams.")
      .def(
          "scan", &swept, py::arg("position_m"), py::kw_only(), py::arg("first_azimuth_rad"), py::arg("first_range_m"),
          py::arg("first_beam"), py::arg("count"), py::arg("velocity_mps") = Triple{},
          "Renders `count` beams from `first_beam` anew, at the level that they need, and leaves the others: one step\n"
          "of a scanning antenna. A change between levels goes on from step to step.")
      .def_property_readonly(
          "textured_share", [](const SceneFlight& held) { return held.flight.textured_share(); },
          "Part of the last frame's power, or of the last step's, that comes from textures:\n"
          "0 where it is traced, 1 from textures.")
      .def(
          "explained", [](const SceneFlight& held) { return held.flight.explained(); },
          "What the last pose asked for, and why, in a few lines for people.");
}

}  // namespace sigmascape::python
