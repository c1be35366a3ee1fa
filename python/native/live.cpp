#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "array_view.h"
#include "drawn_live.h"
#include "gil.h"
#include "given_number.h"
#include "long_call.h"
#include "parts.h"

#include "sigmascape/base/error.h"
#include "sigmascape/live/live_renderer.h"
#include "sigmascape/product/iq_file.h"

namespace sigmascape::python {
namespace {

namespace py = pybind11;
using live::LiveGround;

using GroundRenderer = DrawnLive<live::LiveRenderer>;
using CacheMib = Whole<"cache_mib", std::size_t, 0, std::numeric_limits<std::size_t>::max() / (std::size_t{1} << 20U)>;
using Loaders = Whole<"loaders", unsigned, 1, live::most_loaders>;

std::unique_ptr<Held<GroundRenderer>> made_renderer(const Held<LiveGround>& held, const std::string& content,
                                                    Beams beams, Ranges ranges, double beam_step_rad,
                                                    double range_step_m, double cells_per_bin, Seed seed,
                                                    Threads threads, double refraction) {
  // Until it is made, not while Python writes down what it is: its table of instances is the GIL's.
  const WithoutGil working;
  const auto settings =
      settings_from(content, beams, ranges, beam_step_rad, range_step_m, cells_per_bin, seed, threads, refraction);
  const std::shared_ptr<LiveGround>& ground = held.here();
  const atlas::AtlasDescription& atlas = ground->description();
  std::shared_ptr<GroundRenderer> made(
      new GroundRenderer{.seed = seed,
                         .words = origin_words("live frame from terrain and atlas", atlas.frame, atlas.name,
                                               atlas.scene_hash, atlas.attribution, seed),
                         .frame = atlas.frame,
                         .scene = nullptr,
                         .ground = ground->terrain(),
                         .drawer = {ground, settings},
                         .targets = {}});
  return std::make_unique<Held<GroundRenderer>>("LiveRenderer", std::move(made));
}

py::dict report_of(const Held<LiveGround>& ground) {
  const live::GroundReport told = ground.here()->report();
  py::dict report;
  report["pages"] = told.pages.pages;
  report["page_bytes"] = told.pages.bytes;
  report["loaded"] = told.pages.loaded;
  report["evicted"] = told.pages.evicted;
  report["renewed"] = told.pages.renewed;
  report["refused"] = told.pages.refused;
  report["absent"] = told.pages.absent;
  report["damaged"] = told.pages.damaged;
  report["obstacle_bytes"] = told.obstacles.bytes;
  report["damaged_obstacles"] = told.obstacles.damaged;
  report["terrain_bytes"] = told.terrain_bytes;
  report["terrain_faults"] = told.terrain_faults;
  return report;
}

template <typename Number>
py::object numbers_of(const HeldFrame& held, std::span<const Number> numbers) {
  if (numbers.empty()) return py::none();
  const auto beams = static_cast<py::ssize_t>(held.frame.grid.azimuths);
  const auto ranges = static_cast<py::ssize_t>(held.frame.grid.ranges);
  return array_view(numbers.data(), {beams, ranges, 4}, held.renderer, Access::ReadOnly);
}

/// Where the radar was as each beam was drawn, or once where that was the same for all. Of beams that were never drawn,
/// which are dark, where it was last.
std::vector<radar::Motion> platforms_of(const HeldFrame& held) {
  std::vector<radar::Motion> platforms;
  bool are_the_same = true;
  for (const live::DrawnBeam& beam : held.frame.beams) {
    platforms.push_back(beam.drawing == 0 ? radar::Motion{held.pose.position, held.pose.velocity_mps}
                                          : radar::Motion{beam.radar, beam.velocity_mps});
    are_the_same = are_the_same && platforms.back().position == platforms.front().position &&
                   platforms.back().velocity_mps == platforms.front().velocity_mps;
  }
  if (are_the_same) platforms.resize(1);
  return platforms;
}

/// The bins are the renderer's: nobody is to draw into them meanwhile.
void save(const HeldFrame& held, const std::filesystem::path& path, std::optional<double> frequency_ghz) {
  const double own_ghz = held.frame.frequency_hz / 1e9;
  constexpr double as_rounded = 1e-9;
  if (frequency_ghz && !(std::abs(*frequency_ghz - own_ghz) <= as_rounded * own_ghz))
    throw Error("frequency_ghz", fmt::format("is {:g}, and the frame is of {:g}", *frequency_ghz, own_ghz),
                "leave it out");
  if (held.frame.amplitudes_m.empty())
    throw Error(path.string(), "cannot hold powers", "make the renderer with content='amplitudes'");
  const std::scoped_lock turn(*held.turns);
  live::check_holds(held.frame, path.string());
  Words words = held.words;
  words["time_s"] = fmt::format("{}", held.pose.moment.time_s);
  words["dwell"] = std::to_string(held.pose.moment.dwell);
  words["pulse"] = std::to_string(held.pose.moment.pulse);
  words["targets_seen"] = std::to_string(held.frame.report.targets);
  product::write_iq(path, product::iq_record(held.frame.grid, held.frame.amplitudes_m, platforms_of(held),
                                             held.frame.frequency_hz, held.frame.earth, std::move(words)));
}

/// Whoever has the turn may be at a long frame.
void save_in_turn(const HeldFrame& held, const std::filesystem::path& path, std::optional<double> frequency_ghz) {
  long_call([&] { save(held, path, frequency_ghz); });
}

template <typename Class>
void count(Class& binding, const char* name, std::size_t live::FrameReport::*member, const char* doc) {
  binding.def_property_readonly(
      name, [member](const HeldFrame& f) { return f.frame.report.*member; }, doc);
}

void add_frame(py::module_& module) {
  py::class_<HeldFrame> binding(
      module, "Frame",
      "What the receiver has in its bins. The arrays share the renderer's memory and change with\n"
      "its next frame: copy what is to be kept.");
  binding
      .def_property_readonly(
          "amplitudes_m", [](const HeldFrame& f) { return numbers_of(f, f.frame.amplitudes_m); },
          "complex64 [beam, range, 4]: VV, HH, HV, VH in metres; |a|^2 is a cross-section in m^2. A point is shared\n"
          "by the bins about it: their |a|^2 add up to its cross-section, and the brightest has up to 6 dB less. None\n"
          "when powers were asked for.")
      .def_property_readonly(
          "powers_m2", [](const HeldFrame& f) { return numbers_of(f, f.frame.powers_m2); },
          "float32 [beam, range, 4]: VV, HH, HV, Re VV HH* in m^2. None when amplitudes were asked for.")
      .def("save", &save_in_turn, py::arg("path"), py::kw_only(), py::arg("frequency_ghz") = py::none(),
           "Writes the amplitudes as .npy (with .json), .npz, .h5 or .sigmf-meta, before the renderer draws its next\n"
           "frame; docs/iq_files.md. A frequency that is not the frame's own is refused.")
      .def_property_readonly(
          "first_range_m", [](const HeldFrame& f) { return f.frame.grid.first_range_m; },
          "Near edge of range bin 0, slant range in m.")
      .def_property_readonly(
          "range_step_m", [](const HeldFrame& f) { return f.frame.grid.range_step_m; },
          "Slant range from bin to bin, m.")
      .def_property_readonly(
          "first_azimuth_rad", [](const HeldFrame& f) { return f.frame.grid.first_azimuth_rad; },
          "Left edge of beam 0, clockwise from the frame's north.")
      .def_property_readonly(
          "beam_step_rad", [](const HeldFrame& f) { return f.frame.grid.azimuth_step_rad; },
          "Azimuth from beam to beam, clockwise.");
  using Report = live::FrameReport;
  count(binding, "cells", &Report::cells, "Lattice cells looked at.");
  count(binding, "lit", &Report::lit, "Of them seen by the radar.");
  count(binding, "coarse", &Report::coarse,
        "Of them shown more coarsely than wanted, for the finer was not there yet.");
  count(binding, "dark", &Report::dark, "Cells for which there was nothing at all.");
  count(binding, "level", &Report::level, "Of the textures, 0 the finest.");
  count(binding, "targets", &Report::targets, "That stand in the bins and are seen, by a step's beams of a scan.");
  binding.def_property_readonly(
      "terrain_error_m", [](const HeldFrame& f) { return f.frame.report.terrain_error_m; },
      "By how much the terrain that hides may be wrong, for finer tiles were not there yet or cannot be had.");
  binding.def_property_readonly(
      "below_ground_m", [](const HeldFrame& f) { return f.frame.report.below_ground_m; },
      "By how much the radar lies below the ground, as far as the terrain that is there tells for sure; beyond the\n"
      "terrain below the lowest of it, or below mean sea level where that is lower; 0 above it.");
  binding.def_property_readonly(
      "beams_a_cell", [](const HeldFrame& f) { return f.frame.report.beams_a_cell; },
      "How many beams a cell is wide at the nearest ground, where they are narrowest; 1 where none is narrower than a\n"
      "cell, 0 of a traced frame.");
  count(
      binding, "coarse_obstacles", &Report::coarse_obstacles,
      "Tiles of what stands on the ground that are coarser than the bins ask for, for finer ones were not there yet,\n"
      "cannot be had or are more than the budget holds.");
  binding.def_property_readonly(
      "rays_per_cell", [](const HeldFrame& f) { return f.frame.report.rays_per_cell; },
      "Of a traced frame: rays a cell that it is made of.");
  binding.def_property_readonly(
      "median_error_db", [](const HeldFrame& f) { return f.frame.report.median_error_db; },
      "Of a traced frame: standard error of a bin's mean power, in the median over the bins that answer; infinite\n"
      "while too few rays tell.");
}

}  // namespace

void add_live(py::module_& module) {
  py::class_<Held<LiveGround>>(module, "LiveGround",
                               "An atlas with its terrain as live renderers share it: pages come and go within a bound "
                               "on memory. Of the process\n"
                               "that made it: others, forked ones too, make their own.")
      .def(py::init([](const std::filesystem::path& folder, double frequency_ghz, CacheMib cache_mib, Loaders loaders) {
             return long_call([&] {
               return std::make_unique<Held<LiveGround>>(
                   "LiveGround", LiveGround::open(folder, frequency_ghz * 1e9,
                                                  {.budget_bytes = std::size_t{cache_mib} << 20U, .loaders = loaders}));
             });
           }),
           py::arg("folder"), py::kw_only(), py::arg("frequency_ghz") = 10.0, py::arg("cache_mib") = 512,
           py::arg("loaders") = 1,
           "folder: of the atlas, with its terrain. frequency_ghz: of the renderers over it. cache_mib: what pages,\n"
           "terrain and obstacles may take together, MiB. loaders: threads that read and decode.")
      .def(
          "wait", [](const Held<LiveGround>& ground) { long_call([&] { ground.here()->wait_until_loaded(); }); },
          "Returns when all pages and all terrain that frames have asked for are there.")
      .def("report", &report_of,
           "What of it is in memory, and what could not be had: a dict of numbers. Where `evicted` goes on rising "
           "while\n"
           "the view stays, cache_mib is less than what renderers look at, and where `refused` is above 0, less than "
           "one\n"
           "frame does; docs/live.md, \"What a frame reports\".")
      .def_property_readonly("frequency_ghz", [](const Held<LiveGround>& g) { return g.here()->frequency_hz() / 1e9; })
      .def(
          "height_at",
          [](const Held<LiveGround>& g, double x, double y) {
            return g.here()->terrain().height_at(checked_place(x, y));
          },
          py::arg("x_m"), py::arg("y_m"),
          "Height of the finest ground at a place of the local frame, m above mean sea level; beyond the terrain\n"
          "that of its nearest edge. May read a tile.")
      .def_property_readonly(
          "extent_m",
          [](const Held<LiveGround>& g) {
            const radar::Rectangle& e = g.here()->description().extent;
            return py::make_tuple(e.west_m, e.south_m, e.east_m, e.north_m);
          },
          "What the atlas covers: west, south, east, north.")
      .def_property_readonly(
          "crs", [](const Held<LiveGround>& g) { return g.here()->description().frame.proj(); },
          "The local frame as a PROJ string.")
      .def(
          "place_in_frame",
          [](const Held<LiveGround>& g, double latitude_deg, double longitude_deg) {
            const Vec2d place = g.here()->place_in_frame({latitude_deg, longitude_deg});
            return py::make_tuple(place.x, place.y);
          },
          py::arg("latitude_deg"), py::arg("longitude_deg"),
          "Where a place on the globe, WGS 84, lies in the local frame: x, y.")
      .def(
          "place_on_globe",
          [](const Held<LiveGround>& g, double x_m, double y_m) {
            const auto place = g.here()->place_on_globe({x_m, y_m});
            return py::make_tuple(place.latitude_deg, place.longitude_deg);
          },
          py::arg("x_m"), py::arg("y_m"), "Where a place of the local frame lies on the globe: latitude, longitude.");

  add_frame(module);

  const live::LiveSettings settings;
  py::class_<Held<GroundRenderer>> binding(
      module, "LiveRenderer",
      "The live radar picture of a wide area: hand it a pose, get what the receiver has in its bins.\n"
      "It never waits for pages; what was not there in time is shown from a coarser level. Calls of several threads\n"
      "queue up, and a process that was forked off the one that made it makes its own.\n"
      "A radar below all ground of the tile of terrain under it raises Error, and the frame stays as it was.");
  binding.def(py::init(&made_renderer), py::arg("ground"), py::kw_only(), py::arg("content") = "amplitudes",
              py::arg("beams") = settings.beams, py::arg("ranges") = settings.ranges,
              py::arg("beam_step_rad") = settings.beam_step_rad, py::arg("range_step_m") = settings.range_step_m,
              py::arg("cells_per_bin") = settings.cells_per_bin, py::arg("seed") = settings.seed,
              py::arg("threads") = 0, py::arg("refraction") = settings.refraction,
              "content: 'amplitudes' (I/Q with speckle) or 'powers' (their mean). refraction: k of the k-Earth, 0.1 at "
              "least.");
  bind_drawing(binding,
               "A Frame of all beams. position_m: x, y of the local frame, altitude above mean sea level.\n"
               "first_azimuth_rad: left edge of beam 0, clockwise from the frame's north.\n"
               "first_range_m: near edge of range bin 0. velocity_mps: says which ground to fetch ahead of time.\n"
               "time_s, dwell, pulse: of the targets.",
               "Renders `count` beams from `first_beam` anew and leaves the others: one step of a scanning antenna.");
}

}  // namespace sigmascape::python
