#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "given_number.h"
#include "loaded_scene.h"
#include "parts.h"
#include "polarization.h"
#include "whole_number.h"

#include "sigmascape/base/units.h"
#include "sigmascape/radar/mode_words.h"
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

void set_mode(RadarFile& file, const std::string& word) {
  const auto mode = radar::mode_of(word);
  if (!mode) {
    const auto words = radar::words_of_modes();
    throw Error("mode", "is '" + word + "'", fmt::format("give '{}'", fmt::join(words, "', '")));
  }
  file.radar.mode = *mode;
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
RadarFile made_radar(const std::string& name, double frequency_hz, double range_resolution_m, double beam_width_deg,
                     const std::string& polarization, double cell_m) {
  RadarFile file;
  file.antenna_efficiency = 1.0;
  file.has_shortest_pulse = true;
  file.radar.name = name;
  file.radar.polarization = polarization_from(polarization);
  file.place = radar::Unplaced{};
  set_frequency_hz(file, frequency_hz);
  set_range_resolution_m(file, range_resolution_m);
  set_beam_width_deg(file, beam_width_deg);
  set_cell_m(file, cell_m);
  return file;
}

/// A word as TOML quotes it.
std::string quoted(const std::string& word) {
  std::string text = "\"";
  for (const char letter : word) {
    if (static_cast<unsigned char>(letter) < 0x20 || letter == '"' || letter == '\\') {
      text += fmt::format("\\u{:04x}", static_cast<unsigned>(letter));
    } else {
      text += letter;
    }
  }
  return text + '"';
}

/// Whether it is true or false, of Python or of NumPy.
bool is_truth(const py::handle& value) {
  return py::isinstance<py::bool_>(value) ||
         (py::hasattr(value, "dtype") && py::str(value.attr("dtype").attr("kind")).cast<std::string>() == "b");
}

/// A key's value as a file would state it. NumPy's numbers are numbers, single ones in arrays too.
std::string stated(const std::string& key, const py::handle& value) {
  if (is_truth(value)) return py::bool_(py::reinterpret_borrow<py::object>(value)) ? "true" : "false";
  if (py::isinstance<py::str>(value)) return quoted(py::reinterpret_borrow<py::str>(value));
  if (py::hasattr(value, "__fspath__")) return quoted(py::str(value.attr("__fspath__")()).cast<std::string>());
  // Arrays of fractions have the means to be an index too, and refuse it when they are asked.
  if (const auto whole = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()))) return py::str(whole);
  PyErr_Clear();
  if (py::hasattr(value, "__float__"))
    return fmt::format("{}", py::float_(py::reinterpret_borrow<py::object>(value)).cast<double>());
  throw Error(key, fmt::format("is of type {}", std::string(py::str(py::type::of(value).attr("__name__")))),
              "give a number, a text, a path, True or False");
}

/// What a file states that has these keys, by section.
std::string text_of(const py::dict& sections) {
  std::string text;
  for (const auto& [section, keys] : sections) {
    const std::string name = py::str(section);
    if (!py::isinstance<py::dict>(keys))
      throw Error(name, "is no section",
                  "give {\"radar\": {\"frequency_ghz\": 10.0, ...}, ...}, as a radar file has it");
    text += fmt::format("[{}]\n", quoted(name));
    for (const auto& [key, value] : py::reinterpret_borrow<py::dict>(keys)) {
      const std::string word = py::str(key);
      if (!value.is_none()) text += fmt::format("{} = {}\n", quoted(word), stated(name + "." + word, value));
    }
  }
  return text;
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

/// A number of the file's bounds.
template <typename Get, typename Set>
void number(py::class_<RadarFile>& binding, const char* name, const Interval& allowed, Get get, Set set,
            const char* doc) {
  binding.def_property(
      name, get, [name, allowed, set](RadarFile& f, double value) { set(f, within(name, value, allowed)); }, doc);
}

/// The same of powers in decibels.
template <typename Member>
void decibels(py::class_<RadarFile>& binding, const char* name, const Interval& allowed, Member member,
              const char* doc) {
  number(
      binding, name, allowed, [member](const RadarFile& f) { return db_from_linear(f.radar.receiver.*member); },
      [member](RadarFile& f, double db) { f.radar.receiver.*member = linear_from_db(db); }, doc);
}

void flag(py::class_<RadarFile>& binding, const char* name, bool radar::Processing::*member, const char* doc) {
  binding.def_property(
      name, [member](const RadarFile& f) { return f.radar.processing.*member; },
      [member](RadarFile& f, bool value) { f.radar.processing.*member = value; }, doc);
}

/// Opens or closes the range gate, which closes after it opens.
void set_gate(RadarFile& file, const char* name, std::optional<double> radar::Receiver::*end,
              const std::optional<double>& range_m) {
  constexpr double m_per_km = 1e3;
  radar::Receiver receiver = file.radar.receiver;
  receiver.*end = range_m ? std::optional(within(name, *range_m, bounds::gate_ranges_km, m_per_km)) : std::nullopt;
  if (receiver.last_range_m && *receiver.last_range_m <= receiver.first_range_m.value_or(0.0)) {
    throw Error(name, fmt::format("is {:g}, and the gate closes before it opens", *range_m),
                "give a first_range_m below last_range_m");
  }
  file.radar.receiver = receiver;
}

void gate_range(py::class_<RadarFile>& binding, const char* name, std::optional<double> radar::Receiver::*end,
                const char* doc) {
  binding.def_property(
      name, [end](const RadarFile& f) { return f.radar.receiver.*end; },
      [name, end](RadarFile& f, const std::optional<double>& range_m) { set_gate(f, name, end, range_m); }, doc);
}

void add_antenna_and_pulse(py::class_<RadarFile>& binding) {
  number(
      binding, "gain_dbi", bounds::gains_dbi, [](const RadarFile& f) { return db_from_linear(f.radar.antenna.gain); },
      [](RadarFile& f, double dbi) { radar::set_antenna_gain(f, linear_from_db(dbi)); },
      "Gain of the antenna at its peak, one way over isotropic. Set, it goes with the beam no longer.");
  number(
      binding, "tilt_deg", bounds::tilts_deg,
      [](const RadarFile& f) { return deg_from_radians(f.radar.antenna.tilt_rad); },
      [](RadarFile& f, double deg) { radar::set_tilt(f, radians_from_deg(deg)); },
      "Of the peak above the horizontal; negative looks down. Not of a beam that is even in elevation.");
  number(
      binding, "peak_power_w", bounds::peak_powers_w, [](const RadarFile& f) { return f.radar.waveform.peak_power_w; },
      [](RadarFile& f, double value) { f.radar.waveform.peak_power_w = value; }, "Of the transmitter.");
  constexpr double s_per_us = 1e-6;
  number(
      binding, "pulse_length_s",
      {bounds::pulse_lengths_us.lowest * s_per_us, bounds::pulse_lengths_us.highest * s_per_us, "s"},
      [](const RadarFile& f) { return f.radar.waveform.pulse_length_s; }, &radar::set_pulse_length,
      "Of the transmitted pulse. Set, it goes with the range resolution no longer.");
}

void add_receiver(py::class_<RadarFile>& binding) {
  decibels(binding, "losses_db", bounds::losses_db, &radar::Receiver::losses, "Of the whole system.");
  decibels(binding, "noise_figure_db", bounds::noise_figures_db, &radar::Receiver::noise_figure, "Of the receiver.");
  decibels(binding, "receiver_gain_db", bounds::receiver_gains_db, &radar::Receiver::gain,
           "From the antenna's terminals to the converter: gain_db of the file's [receiver].");
  gate_range(binding, "first_range_m", &radar::Receiver::first_range_m,
             "Where the range gate opens; None: with what is mapped.");
  gate_range(binding, "last_range_m", &radar::Receiver::last_range_m,
             "Where the range gate closes; None: with what is mapped.");
}

void add_surroundings(py::class_<RadarFile>& binding) {
  number(
      binding, "atmosphere_db_per_km", bounds::atmospheres_db_per_km,
      [](const RadarFile& f) { return db_from_linear(std::exp(f.radar.atmosphere_per_m * 1e3)); },
      [](RadarFile& f, double db) { f.radar.atmosphere_per_m = std::log(linear_from_db(db)) / 1e3; },
      "What air and rain take on the way, one way.");
  number(
      binding, "wind_mps", bounds::winds_mps, [](const RadarFile& f) { return f.radar.wind_mps; },
      [](RadarFile& f, double value) { f.radar.wind_mps = value; },
      "That moves leaves, as Doppler sees them; of render() over a scene alone, for atlases know none.");
  binding.def_property(
      "earth_refraction", [](const RadarFile& f) { return f.radar.earth_refraction; },
      [](RadarFile& f, const std::optional<double>& k) {
        if (k) within("earth_refraction", *k, bounds::refractions);
        f.radar.earth_refraction = k;
      },
      "k of the k-Earth under coherent maps and pulses; None: flat.");
}

}  // namespace

void add_radar(py::module_& module) {
  py::class_<RadarFile> binding(
      module, "Radar",
      "A mapping radar, where it stands, and what it maps. Everything that a radar file can say\n"
      "(docs/radar_file.md) is kept; what is changed most often are attributes.");
  binding
      .def(py::init(&made_radar), py::kw_only(), py::arg("name") = "radar", py::arg("frequency_hz") = 10e9,
           py::arg("range_resolution_m") = 2.0, py::arg("beam_width_deg") = 0.5, py::arg("polarization") = "vv",
           py::arg("cell_m") = 2.0,
           "All else is what a radar file leaves out: the gain follows from the beam, and the radar is yet to be "
           "placed.")
      .def_static(
          "read",
          [](const std::filesystem::path& path) { return radar::read_radar_file(path, radar::PlaceOfRadar::Optional); },
          py::arg("path"), "Reads a radar file (TOML). Without its [position] the radar is yet to be placed.")
      .def_static(
          "parse",
          [](const std::string& text, const std::optional<std::filesystem::path>& folder) {
            return radar::read_radar_text(text, folder.value_or("") / "radar text", radar::PlaceOfRadar::Optional);
          },
          py::arg("text"), py::kw_only(), py::arg("folder") = py::none(),
          "The same of the text of a radar file. Files that it names lie in `folder`, or where the program runs.")
      .def_static(
          "from_keys",
          [](const py::dict& sections, const std::optional<std::filesystem::path>& folder) {
            return radar::read_radar_text(text_of(sections), folder.value_or("") / "radar keys",
                                          radar::PlaceOfRadar::Optional);
          },
          py::arg("sections"), py::kw_only(), py::arg("folder") = py::none(),
          "The same of the keys themselves, {section: {key: value}}; what is None is left out.")
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
          "East, north, up: by true north at the radar while its file's latitude and longitude place it, else in the\n"
          "local frame.")
      .def_property(
          "mode", [](const RadarFile& f) { return radar::mode_word(f.radar.mode); }, &set_mode,
          "'real-beam', 'doppler-beam-sharpening', 'stripmap' or 'spotlight'.")
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
          py::arg("position_m"),
          "Puts the radar at x, y of the local frame and an altitude above mean sea level. Its velocity, heading and\n"
          "scan are then of the frame too: of a radar that its file places by latitude and longitude they are by true\n"
          "north, and position_over with this after it turns them by the angle between the two norths.")
      .def(
          "see_from", &see_from, py::kw_only(), py::arg("azimuth_deg"), py::arg("elevation_deg"),
          py::arg("slant_range_m"), py::arg("target_m") = py::none(),
          "Puts the radar where the ground point `target_m` (x, y; None: the middle of the scene) sees it: azimuth\n"
          "clockwise from the frame's north, elevation above the horizontal. Azimuths of the radar itself are then of\n"
          "the frame as well, as after stand_at.")
      .def(
          "position_over",
          [](const RadarFile& f, const LoadedScene& loaded, double time_s) {
            within("time_s", time_s, bounds::moments_s);
            const scene::Scene& scene = loaded.scene();
            return tuple_of(simulate::placed_radar(f, scene.frame, scene.terrain, scene.extent, time_s).position);
          },
          py::arg("scene"), py::arg("time_s") = 0.0,
          "Where the radar is over a scene at a moment: x, y of the local frame and altitude, in metres.")
      .def("__copy__", [](const RadarFile& f) { return RadarFile(f); })
      .def(
          "__deepcopy__", [](const RadarFile& f, const py::dict&) { return RadarFile(f); }, py::arg("memo"))
      .def("__repr__", [](const RadarFile& f) { return "<sigmascape.Radar '" + f.radar.name + "'>"; });
  optional_number(binding, "interval_s", &radar::Processing::interval_s, bounds::intervals_s,
                  "Time over which coherent modes add up pulses; None: what the resolution asks for.");
  optional_number(
      binding, "along_resolution_m", &radar::Processing::along_resolution_m, bounds::along_resolutions_m,
      "Half-power width across range that spotlight and stripmap process to; None: as fine as in range, and of a\n"
      "strip no finer than its beam gives.");
  optional_number(binding, "sharpening", &radar::Processing::sharpening, bounds::sharpenings,
                  "By what factor Doppler beam sharpening narrows the beam; None: 16.");
  flag(binding, "ambiguities", &radar::Processing::ambiguities, "Strips show ghosts of what folds over azimuth.");
  flag(binding, "antenna_pattern", &radar::Processing::antenna_pattern,
       "Maps of coherent modes keep the pattern of the beam.");
  flag(binding, "thermal_noise", &radar::Processing::thermal_noise,
       "Maps of coherent modes have the receiver's noise.");
  add_antenna_and_pulse(binding);
  add_receiver(binding);
  add_surroundings(binding);
  binding.def_property(
      "looks", [](const RadarFile& f) { return f.radar.processing.looks; },
      [](RadarFile& f, AnyWhole<"looks"> looks) {
        f.radar.processing.looks = static_cast<int>(within("looks", static_cast<int>(looks), bounds::looks));
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
