#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "given_number.h"
#include "loaded_scene.h"
#include "parts.h"
#include "polarization.h"

#include "sigmascape/base/units.h"
#include "sigmascape/radar/radar_file.h"
#include "sigmascape/simulate/placement.h"

namespace sigmascape::python {
namespace {

namespace py = pybind11;
using radar::RadarFile;
using Triple = std::array<double, 3>;
using Area = std::array<double, 4>;

Triple triple_of(const Vec3d& v) {
  return {v.x, v.y, v.z};
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

constexpr double furthest_m = 1e7, fastest_mps = 2e4;

RadarFile made(const std::string& name, double frequency_hz, double range_resolution_m, double beam_width_deg,
               const std::string& polarization, double cell_m) {
  positive("frequency_hz", frequency_hz);
  positive("range_resolution_m", range_resolution_m);
  positive("beam_width_deg", beam_width_deg);
  positive("cell_m", cell_m);
  RadarFile file;
  file.radar.name = name;
  file.radar.frequency_hz = frequency_hz;
  file.radar.range_resolution_m = range_resolution_m;
  file.radar.beam_width_rad = radians_from_deg(beam_width_deg);
  file.radar.polarization = polarization_from(polarization);
  file.place = radar::LocalPlace{};
  file.map.cell_m = cell_m;
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

/// A property of the radar that is a plain number with its unit in its name.
template <typename Class>
void number(Class& binding, const char* name, double radar::Radar::*member, const char* doc) {
  binding.def_property(
      name, [member](const RadarFile& f) { return f.radar.*member; },
      [member, name](RadarFile& f, double value) {
        positive(name, value);
        f.radar.*member = value;
      },
      doc);
}

template <typename Class>
void optional_number(Class& binding, const char* name, std::optional<double> radar::Processing::*member,
                     const char* doc) {
  binding.def_property(
      name, [member](const RadarFile& f) { return f.radar.processing.*member; },
      [member, name](RadarFile& f, const std::optional<double>& value) {
        if (value) positive(name, *value);
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
           py::arg("cell_m") = 2.0)
      .def_static(
          "read", [](const std::filesystem::path& path) { return radar::read_radar_file(path); }, py::arg("path"),
          "Reads a radar file (TOML).")
      .def_property(
          "name", [](const RadarFile& f) { return f.radar.name; },
          [](RadarFile& f, const std::string& name) { f.radar.name = name; })
      .def_property(
          "beam_width_deg", [](const RadarFile& f) { return deg_from_radians(f.radar.beam_width_rad); },
          [](RadarFile& f, double value) {
            positive("beam_width_deg", value);
            f.radar.beam_width_rad = radians_from_deg(value);
          },
          "One-way half-power width of the real beam in azimuth.")
      .def_property(
          "polarization", [](const RadarFile& f) { return word_of(f.radar.polarization); },
          [](RadarFile& f, const std::string& word) { f.radar.polarization = polarization_from(word); },
          "What pictures show; maps hold all: 'vv', 'hh', 'hv', 'vh' or 'sum'.")
      .def_property(
          "velocity_mps", [](const RadarFile& f) { return triple_of(f.radar.velocity_mps); },
          [](RadarFile& f, const Triple& v) {
            f.radar.velocity_mps = vec_of(all_within("velocity_mps", v, -fastest_mps, fastest_mps));
          },
          "East, north, up.")
      .def_property("mode", &mode_word, &set_mode, "'real-beam', 'doppler-beam-sharpening', 'stripmap' or 'spotlight'.")
      .def_property(
          "pulse_repetition_hz", [](const RadarFile& f) { return f.radar.waveform.pulse_repetition_hz; },
          [](RadarFile& f, double value) {
            positive("pulse_repetition_hz", value);
            f.radar.waveform.pulse_repetition_hz = value;
          })
      .def_property(
          "cell_m", [](const RadarFile& f) { return f.map.cell_m; },
          [](RadarFile& f, double value) {
            positive("cell_m", value);
            f.map.cell_m = value;
          },
          "Side of the map's cells.")
      .def_property(
          "area_m",
          [](const RadarFile& f) -> std::optional<Area> {
            if (!f.map.area) return std::nullopt;
            return Area{f.map.area->west_m, f.map.area->south_m, f.map.area->east_m, f.map.area->north_m};
          },
          [](RadarFile& f, const std::optional<Area>& a) {
            f.map.area.reset();
            if (a) f.map.area = radar::Rectangle{(*a)[0], (*a)[1], (*a)[2], (*a)[3]};
          },
          "What is mapped: west, south, east, north; None for the whole scene.")
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
          [](const RadarFile& f, const LoadedScene& loaded) {
            const scene::Scene& scene = loaded.scene();
            return triple_of(simulate::placed_radar(f, scene.frame, scene.terrain, scene.extent).position);
          },
          py::arg("scene"), "Where the radar stands over a scene: x, y, altitude in metres.")
      .def("__copy__", [](const RadarFile& f) { return RadarFile(f); })
      .def("__repr__", [](const RadarFile& f) { return "<sigmascape.Radar '" + f.radar.name + "'>"; });
  optional_number(binding, "interval_s", &radar::Processing::interval_s,
                  "Time over which coherent modes add up pulses; None: what the resolution asks for.");
  optional_number(binding, "along_resolution_m", &radar::Processing::along_resolution_m,
                  "Half-power width across range that spotlight and stripmap process to; None: as fine as in range.");
  optional_number(binding, "sharpening", &radar::Processing::sharpening,
                  "By what factor Doppler beam sharpening narrows the beam; None: 16.");
  binding.def_property(
      "looks", [](const RadarFile& f) { return f.radar.processing.looks; },
      [](RadarFile& f, int looks) { f.radar.processing.looks = static_cast<int>(within("looks", looks, 1, 1000)); },
      "Images of coherent modes whose powers are averaged.");
  number(binding, "frequency_hz", &radar::Radar::frequency_hz, "Carrier frequency.");
  number(binding, "range_resolution_m", &radar::Radar::range_resolution_m,
         "Half-power width of the pulse after compression.");
}

}  // namespace sigmascape::python
