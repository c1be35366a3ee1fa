#include "sigmascape/simulate/live_flight.h"

#include "drawn_live.h"
#include "gil.h"
#include "long_call.h"
#include "parts.h"

namespace sigmascape::python {
namespace {

namespace py = pybind11;

using SceneFlight = DrawnLive<simulate::LiveFlight>;

std::unique_ptr<Held<SceneFlight>> made_flight(std::shared_ptr<LoadedScene> scene, const Held<live::LiveGround>& ground,
                                               const std::string& content, Beams beams, Ranges ranges,
                                               double beam_step_rad, double range_step_m, double cells_per_bin,
                                               Seed seed, Threads threads, double refraction, RaysPerCell rays_per_cell,
                                               Bounces bounces) {
  const auto settings =
      settings_from(content, beams, ranges, beam_step_rad, range_step_m, cells_per_bin, seed, threads, refraction);
  // What rays meet takes longest to build, and is built where signals are heard.
  long_call([&] { static_cast<void>(scene->geometry()); });
  // Until it is made, not while Python writes down what it is: its table of instances is the GIL's.
  const WithoutGil working;
  const simulate::LiveFlightSettings flight{.tracing = {.rays_per_cell = rays_per_cell, .max_bounces = bounces}};
  const auto& loaded = *scene;
  const scene::Scene& seen = loaded.scene();
  std::shared_ptr<SceneFlight> made(
      new SceneFlight{.seed = seed,
                      .words = origin_words("live frame, path-traced or from terrain and atlas", seen.frame, seen.name,
                                            loaded.hash(), seen.attribution, seed),
                      .frame = seen.frame,
                      .scene = std::move(scene),
                      .ground = seen.terrain,
                      .drawer = {seen, loaded.geometry(), ground.here(), settings, flight},
                      .targets = simulate::targets_of(seen)});
  return std::make_unique<Held<SceneFlight>>("LiveFlight", std::move(made));
}

/// What the flight tells of its last frame.
template <typename Tell>
auto told(const Held<SceneFlight>& held, const Tell& tell) {
  return long_call([&] { return held.in_turn([&](const SceneFlight& live) { return tell(live.drawer); }); });
}

}  // namespace

void add_live_flight(py::module_& module) {
  const live::LiveSettings settings;
  const simulate::LiveTraceSettings tracing;
  py::class_<Held<SceneFlight>> binding(
      module, "LiveFlight",
      "Live frames along a flight path at the level of detail that they need: traced as by LiveTracer where a small\n"
      "area is looked at closely, from the textures of an atlas of the same scene elsewhere. One gives way to the\n"
      "other over some frames, so that no step shows. Poses that LiveRenderer refuses are refused where textures are\n"
      "drawn. Threads and processes share it as they do a LiveRenderer.");
  binding
      .def(py::init(&made_flight), py::arg("scene").none(false), py::arg("ground"), py::kw_only(),
           py::arg("content") = "amplitudes", py::arg("beams") = settings.beams, py::arg("ranges") = settings.ranges,
           py::arg("beam_step_rad") = settings.beam_step_rad, py::arg("range_step_m") = settings.range_step_m,
           py::arg("cells_per_bin") = settings.cells_per_bin, py::arg("seed") = settings.seed, py::arg("threads") = 0,
           py::arg("refraction") = settings.refraction, py::arg("rays_per_cell") = tracing.rays_per_cell,
           py::arg("bounces") = tracing.max_bounces,
           "rays_per_cell, bounces: of traced frames, as in LiveTracer. The rest as in LiveRenderer.")
      .def_property_readonly(
          "textured_share",
          [](const Held<SceneFlight>& held) {
            return told(held, [](const simulate::LiveFlight& flight) { return flight.textured_share(); });
          },
          "Part of the last frame's power, or of the last step's, that comes from textures:\n"
          "0 where it is traced, 1 from textures.")
      .def(
          "explained",
          [](const Held<SceneFlight>& held) {
            return told(held, [](const simulate::LiveFlight& flight) { return flight.explained(); });
          },
          "What the last pose asked for, and why, in a few lines for people.");
  bind_drawing(
      binding, "A Frame of all beams, as LiveRenderer.render gives it.",
      "Renders `count` beams from `first_beam` anew, at the level that they need, and leaves the others: one step\n"
      "of a scanning antenna. A change between levels goes on from step to step.");
}

}  // namespace sigmascape::python
