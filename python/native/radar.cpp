#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "given_number.h"
#include "loaded_scene.h"
#include "parts.h"
#include "polarization.h"

#include "sigmascape/base/units.h"
#include "sigmascape/radar/radar_bounds.h"
#include "sigmascape/radar/radar_file.h"
#include "sigmascape/simulate/placement.h"

namespace sigmascape::python {
namespace {

namespace py = pybind11;
using radar::RadarFile;
using Triple = std::array<double, 3>;
using Area = std::array<double, 4>;
namespace bounds = radar::bounds;

/// Not to be changed in place, as what is got of a radar is a copy.
py::tuple tuple_of(const Vec3d& v) {
  return py::make_tuple(v.x, v.y, v.z);
}
Vec3d vec_of(const Triple& v) {
  return {v[0], v[1], v[2]};
}

const std::map<std::string, radar::Mode>& mode_words() {
  static const std::map<std::string, radar::Mode> words{{"real-beam", radar::Mode::RealBeam},
                                                        {"doppler-beam-sharpening", radar::Mode::DopplerBeamSharpening},
                                                        {"stripmap", radar::Mode::Stripmap},
                                                        {"spotlight", radar::Mode::Spotlight}};
  return words;
}

std::string mode_word(const RadarFile& file) {
  for (const auto& [word, mode] : mode_words()) {
    if (mode == file.radar.mode) return word;
  }
  return "";
}

void set_mode(RadarFile& file, const std::string& word) {
  const auto found = mode_words().find(word);
  if (found == mode_words().end()) {
    throw Error("mode", "is '" + word + "'", "give 'real-beam', 'doppler-beam-sharpening', 'stripmap' or 'spotlight'");
  }
  file.radar.mode = found->second;
}

constexpr double furthest_m = 1e7, fastest_mps = 2e4, hz_per_ghz = 1e9;

void set_frequency_hz(RadarFile& file, double frequency_hz) {
  radar::set_frequency(file, within("frequency_hz", frequency_hz, bounds::frequencies_ghz, hz_per_ghz));
}

void set_range_resolution_m(RadarFile& file, double range_resolution_m) {
  radar::set_range_resolution(file, within("range_resolution_m", range_resolution_m, bounds::range_resolutions_m));
}

void set_beam_width_deg(RadarFile& file, double beam_width_deg) {
  radar::set_beam_width(file, radians_from_deg(within("beam_width_deg", beam_width_deg, bounds::beam_widths_deg)));
}

void set_cell_m(RadarFile& file, double cell_m) {
  file.map.cell_m = within("cell_m", cell_m, bounds::cells_m);
}

void set_area_m(RadarFile& file, const std::optional<Area>& area_m) {
  if (!area_m) {
    file.map.area.reset();
    return;
  }
  const auto [west_m, south_m, east_m, north_m] = all_within("area_m", *area_m, -furthest_m, furthest_m);
  if (!(east_m > west_m && north_m > south_m)) {
    throw Error("area_m",
                fmt::format("reaches from {:g} m to {:g} m east and from {:g} m to {:g} m north", west_m, east_m,
                            south_m, north_m),
                "give west, south, east, north");
  }
  file.map.area = radar::Rectangle{west_m, south_m, east_m, north_m};
}

/// What a file that states no more than this says.
RadarFile made(const std::string& name, double frequency_hz, double range_resolution_m, double beam_width_deg,
               const std::string& polarization, double cell_m) {
  RadarFile file;
  file.antenna_efficiency = 1.0;
  file.has_shortest_pulse = true;
  file.radar.name = name;
  file.radar.polarization = polarization_from(polarization);
  file.place = radar::LocalPlace{};
  set_frequency_hz(file, frequency_hz);
  set_range_resolution_m(file, range_resolution_m);
  set_beam_width_deg(file, beam_width_deg);
  set_cell_m(file, cell_m);
  return file;
}

void see_from(RadarFile& file, double azimuth_deg, double elevation_deg, double slant_range_m,
              const std::optional<std::array<double, 2>>& target_m) {
  radar::SeenFrom seen{radians_from_deg(within("azimuth_deg", azimuth_deg, -1e6, 1e6)),
                       radians_from_deg(within("elevation_deg", elevation_deg, 0.5, 89.0)),
                       positive("slant_range_m", slant_range_m),
                       {}};
  if (target_m) {
    all_within("target_m", *target_m, -furthest_m, furthest_m);
    seen.target = Vec2d{(*target_m)[0], (*target_m)[1]};
  }
  file.place = seen;
}

template <typename Class>
void optional_number(Class& binding, const char* name, std::optional<double> radar::Processing::*member,
                     const Interval& allowed, const char* doc) {
  binding.def_property(
      name, [member](const RadarFile& f) { return f.radar.processing.*member; },
      [member, name, allowed](RadarFile& f, const std::optional<double>& value) {
        if (value) within(name, *value, allowed);
        f.radar.processing.*member = value;
      },
      doc);
}

}  // namespace

void add_radar(py::module_& module) {
  py::class_<RadarFile> binding(
      module, "Radar",
      "A mapping radar, where it stands, and what it maps. Everything that a radar file can say\n"
      "(docs/radar_file.md) is kept; what is changed most often are attributes.");
  binding
      .def(py::init(&made), py::kw_only(), py::arg("name") = "radar", py::arg("frequency_hz") = 10e9,
           py::arg("range_resolution_m") = 2.0, py::arg("beam_width_deg") = 0.5, py::arg("polarization") = "vv",
           py::arg("cell_m") = 2.0, "All else is what a radar file leaves out: the gain follows from the beam.")
      .def_static(
          "read", [](const std::filesystem::path& path) { return radar::read_radar_file(path); }, py::arg("path"),
          "Reads a radar file (TOML).")
      .def_property(
          "name", [](const RadarFile& f) { return f.radar.name; },
          [](RadarFile& f, const std::string& name) { f.radar.name = name; })
      .def_property(
          "beam_width_deg", [](const RadarFile& f) { return deg_from_radians(f.radar.beam_width_rad); },
          &set_beam_width_deg,
          "One-way half-power width of the real beam in azimuth. The antenna's gain goes with it where the radar file\n"
          "states none. Not to be set where the file names a table of the beam.")
      .def_property(
          "polarization", [](const RadarFile& f) { return radar::polarization_word(f.radar.polarization); },
          [](RadarFile& f, const std::string& word) { f.radar.polarization = polarization_from(word); },
          "What pictures and decibels show unless told otherwise; maps hold all: 'vv', 'hh', 'hv', 'vh' or 'sum'.")
      .def_property(
          "velocity_mps", [](const RadarFile& f) { return tuple_of(f.radar.velocity_mps); },
          [](RadarFile& f, const Triple& v) {
            f.radar.velocity_mps = vec_of(all_within("velocity_mps", v, -fastest_mps, fastest_mps));
          },
          "East, north, up.")
      .def_property("mode", &mode_word, &set_mode, "'real-beam', 'doppler-beam-sharpening', 'stripmap' or 'spotlight'.")
      .def_property(
          "pulse_repetition_hz", [](const RadarFile& f) { return f.radar.waveform.pulse_repetition_hz; },
          [](RadarFile& f, double value) {
            radar::set_pulse_repetition(f, within("pulse_repetition_hz", value, bounds::pulse_repetitions_hz));
          })
      .def_property(
          "cell_m", [](const RadarFile& f) { return f.map.cell_m; }, &set_cell_m, "Side of the map's cells.")
      .def_property(
          "area_m",
          [](const RadarFile& f) -> std::optional<py::tuple> {
            if (!f.map.area) return std::nullopt;
            return py::make_tuple(f.map.area->west_m, f.map.area->south_m, f.map.area->east_m, f.map.area->north_m);
          },
          &set_area_m, "What is mapped: west, south, east, north; None for the whole scene.")
      .def(
          "stand_at",
          [](RadarFile& f, const Triple& position) {
            f.place = radar::LocalPlace{vec_of(all_within("position_m", position, -furthest_m, furthest_m))};
          },
          py::arg("position_m"), "Puts the radar at x, y of the local frame and an altitude above mean sea level.")
      .def("see_from", &see_from, py::kw_only(), py::arg("azimuth_deg"), py::arg("elevation_deg"),
           py::arg("slant_range_m"), py::arg("target_m") = py::none(),
           "Puts the radar where the ground point `target_m` (x, y; None: the middle of the scene) sees it: azimuth\n"
           "clockwise from true north, elevation above the horizontal.")
      .def(
          "position_over",
          [](const RadarFile& f, const LoadedScene& loaded, double time_s) {
            within("time_s", time_s, bounds::moments_s);
            const scene::Scene& scene = loaded.scene();
            return tuple_of(simulate::placed_radar(f, scene.frame, scene.terrain, scene.extent, time_s).position);
          },
          py::arg("scene"), py::arg("time_s") = 0.0,
          "Where the radar is over a scene at a moment: x, y, altitude in metres.")
      .def("__copy__", [](const RadarFile& f) { return RadarFile(f); })
      .def(
          "__deepcopy__", [](const RadarFile& f, const py::dict&) { return RadarFile(f); }, py::arg("memo"))
      .def("__repr__", [](const RadarFile& f) { return "<sigmascape.Radar '" + f.radar.name + "'>"; });
  optional_number(binding, "interval_s", &radar::Processing::interval_s, bounds::intervals_s,
                  "Time over which coherent modes add up pulses; None: what the resolution asks for.");
  optional_number(binding, "along_resolution_m", &radar::Processing::along_resolution_m, bounds::along_resolutions_m,
                  "Half-power width across range that spotlight and stripmap process to; None: as fine as in range.");
  optional_number(binding, "sharpening", &radar::Processing::sharpening, bounds::sharpenings,
                  "By what factor Doppler beam sharpening narrows the beam; None: 16.");
  binding.def_property(
      "looks", [](const RadarFile& f) { return f.radar.processing.looks; },
      [](RadarFile& f, int looks) {
        f.radar.processing.looks = static_cast<int>(within("looks", looks, bounds::looks));
      },
      "Images of coherent modes whose powers are averaged.");
  binding.def_property(
      "frequency_hz", [](const RadarFile& f) { return f.radar.frequency_hz; }, &set_frequency_hz, "Carrier frequency.");
  binding.def_property(
      "range_resolution_m", [](const RadarFile& f) { return f.radar.range_resolution_m; }, &set_range_resolution_m,
      "Half-power width of the pulse after compression. A pulse whose length the radar file does not state is as "
      "short\n"
      "as the bandwidth for it allows.");
}

}  // namespace sigmascape::python
