#include "sigmascape/simulate/live_tracer.h"

#include "drawn_live.h"
#include "gil.h"
#include "long_call.h"
#include "parts.h"

#include "sigmascape/render/level_of_detail.h"

namespace sigmascape::python {
namespace {

namespace py = pybind11;

using SceneTracer = DrawnLive<simulate::LiveTracer>;

std::unique_ptr<Held<SceneTracer>> made_tracer(std::shared_ptr<LoadedScene> scene, const std::string& content,
                                               Beams beams, Ranges ranges, double beam_step_rad, double range_step_m,
                                               double cells_per_bin, Seed seed, Threads threads, double refraction,
                                               double frequency_ghz, RaysPerCell rays_per_cell, Bounces bounces,
                                               double lattice_m) {
  const auto settings =
      settings_from(content, beams, ranges, beam_step_rad, range_step_m, cells_per_bin, seed, threads, refraction);
  // What rays meet takes longest to build, and is built where signals are heard.
  long_call([&] { static_cast<void>(scene->geometry()); });
  // Until it is made, not while Python writes down what it is: its table of instances is the GIL's.
  const WithoutGil working;
  const auto& loaded = *scene;
  const scene::Scene& seen = loaded.scene();
  std::shared_ptr<SceneTracer> made(new SceneTracer{
      .seed = seed,
      .words = origin_words("live frame, path-traced", seen.frame, seen.name, loaded.hash(), seen.attribution, seed),
      .frame = seen.frame,
      .scene = std::move(scene),
      .ground = seen.terrain,
      .drawer = {seen, loaded.geometry(), settings, {frequency_ghz * 1e9, rays_per_cell, bounces, lattice_m}},
      .targets = simulate::targets_of(seen)});
  return std::make_unique<Held<SceneTracer>>("LiveTracer", std::move(made));
}

}  // namespace

void add_live_tracer(py::module_& module) {
  const live::LiveSettings settings;
  const simulate::LiveTraceSettings tracing;
  py::class_<Held<SceneTracer>> binding(
      module, "LiveTracer",
      "Level of detail 0 of live frames: the whole scene, path-traced, in the bins of LiveRenderer and with its\n"
      "speckle. For small areas: a frame fails for a radar that is less than a metre above the scene's highest\n"
      "point, and for bins that look at more than 2**24 cells of the lattice or too flatly, where a LiveFlight shows\n"
      "textures. While the pose stays the same each call adds rays to those before. Threads and processes share it\n"
      "as they do a LiveRenderer.");
  binding.def(
      py::init(&made_tracer), py::arg("scene").none(false), py::kw_only(), py::arg("content") = "amplitudes",
      py::arg("beams") = settings.beams, py::arg("ranges") = settings.ranges,
      py::arg("beam_step_rad") = settings.beam_step_rad, py::arg("range_step_m") = settings.range_step_m,
      py::arg("cells_per_bin") = settings.cells_per_bin, py::arg("seed") = settings.seed, py::arg("threads") = 0,
      py::arg("refraction") = settings.refraction, py::arg("frequency_ghz") = tracing.frequency_hz / 1e9,
      py::arg("rays_per_cell") = tracing.rays_per_cell, py::arg("bounces") = tracing.max_bounces,
      py::arg("lattice_m") = tracing.lattice_m,
      "rays_per_cell: that each call adds. lattice_m: side of the finest cells of the scatterers; with that of an\n"
      "atlas' texels both levels draw the same ones. The rest as in LiveRenderer.");
  bind_drawing(
      binding,
      "A Frame of all beams, as LiveRenderer.render gives it; its rays_per_cell and median_error_db say how\n"
      "clear it has become.",
      "Traces `count` beams from `first_beam` anew, and their ground alone, and leaves the others: one step of a\n"
      "scanning antenna. The same beams of the same pose get rays added when they come again.");
  binding.def(
      "advised_detail",
      [](const Held<SceneTracer>& held, const Triple& position_m, double first_azimuth_rad, double first_range_m) {
        const auto pose = pose_from(position_m, first_azimuth_rad, first_range_m);
        return render::choose_detail(held.here()->drawer.question(pose)).level;
      },
      py::arg("position_m"), py::kw_only(), py::arg("first_azimuth_rad"), py::arg("first_range_m"),
      "The level of detail that the resolution cell asks for at this pose: 0 where the scene should be traced.");
}

}  // namespace sigmascape::python
