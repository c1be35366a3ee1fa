#include "sigmascape/radar/radar_file.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <initializer_list>
#include <string>

#include "sigmascape/base/toml_reader.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/advised_number.h"
#include "sigmascape/radar/mode_words.h"
#include "sigmascape/radar/polarization_words.h"
#include "sigmascape/radar/radar_bounds.h"
#include "sigmascape/radar/radar_file_sections.h"
#include "sigmascape/radar/range_ambiguity.h"
#include "sigmascape/radar/range_response.h"

namespace sigmascape::radar {
namespace {

constexpr Interval anywhere_m{-1e7, 1e7, "m"};

Polarization polarization_of(const TomlSection& section) {
  return polarization_words().at(section.choice_or("polarization", {"vv", "hh", "hv", "vh", "sum"}, "vv"));
}

/// Whether a section below [radar] states what would otherwise be required there.
bool states(const TomlSection& file, std::string_view section, std::string_view key) {
  const auto found = file.section(section);
  return found && found->has(key);
}

/// Whether the antenna's beam is read from a table, which has a width of its own.
bool has_measured_beam(const TomlSection& file) {
  const auto antenna = file.section("antenna");
  return antenna && (antenna->has("azimuth_csv") || antenna->text_or("azimuth_shape", "") == "table");
}

/// What is wrong with a resolution whose band reaches below the frequency zero.
std::string too_fine(const Radar& radar, double resolution_m) {
  return fmt::format("is {:g}, which takes {:.6g} MHz about {:g} GHz, a band that reaches down to no frequency at all",
                     resolution_m, bandwidth_of(resolution_m, radar.waveform.window) / 1e6, radar.frequency_hz / 1e9);
}

/// What is advised, in six digits; a number that is whole in decimals is not rounded down for its last bits.
double advised(double most) {
  constexpr double rounding = 1e-14;
  return rounded_down(most * (1.0 + rounding), 6);
}

/// All that a file says of the radar itself, and nothing of place and map.
RadarFile described_radar(const TomlSection& file, const TomlSection& section) {
  RadarFile read;
  Radar& radar = read.radar;
  radar.name = section.text_or("name", "radar");
  radar.frequency_hz = section.number("frequency_ghz", bounds::frequencies_ghz) * 1e9;
  radar.polarization = polarization_of(section);
  if (!section.has("range_resolution_m") && !states(file, "waveform", "bandwidth_mhz"))
    throw section.missing("range_resolution_m", "give it in m, or waveform.bandwidth_mhz, from which it follows");
  radar.range_resolution_m = states(file, "waveform", "bandwidth_mhz")
                                 ? section.number_or("range_resolution_m", bounds::range_resolutions_m, 0.0)
                                 : section.number("range_resolution_m", bounds::range_resolutions_m);
  radar.beam_width_rad =
      radians_from_deg(has_measured_beam(file) ? section.number_or("beam_width_deg", bounds::beam_widths_deg, 0.0)
                                               : section.number("beam_width_deg", bounds::beam_widths_deg));
  radar.earth_refraction = section.optional_number("earth_refraction", bounds::refractions);
  radar.wind_mps = section.number_or("wind_mps", bounds::winds_mps, 0.0);
  radar.atmosphere_per_m =
      std::log(linear_from_db(section.number_or("atmosphere_db_per_km", bounds::atmospheres_db_per_km, 0.0))) / 1e3;
  section.refuse_unknown_keys();

  if (const auto waveform = file.section("waveform")) {
    read_waveform(*waveform, radar);
  } else {
    radar.waveform.pulse_length_s = 1.0 / bandwidth_of(radar.range_resolution_m, radar.waveform.window);
  }
  if (const double finest_m = finest_range_resolution_m(radar);
      section.has("range_resolution_m") && radar.range_resolution_m <= finest_m) {
    throw section.fault("range_resolution_m", too_fine(radar, radar.range_resolution_m),
                        fmt::format("give more than {:.6g}", finest_m));
  }
  read.has_shortest_pulse = !states(file, "waveform", "pulse_length_us");
  read.antenna_efficiency = read_antenna(file.section("antenna"), radar);
  if (const auto platform = file.section("platform")) read_platform(*platform, radar);
  if (const auto receiver = file.section("receiver")) read_receiver(*receiver, radar);
  if (const auto scan = file.section("scan")) read_scan(*scan, radar);
  if (const auto mode = file.section("mode")) read_mode(*mode, radar);
  return read;
}

bool has_any(const TomlSection& section, std::initializer_list<std::string_view> keys) {
  return std::ranges::any_of(keys, [&](std::string_view key) { return section.has(key); });
}

constexpr const char* ways_to_say_where =
    "give azimuth_deg, elevation_deg and slant_range_km, or altitude_m with latitude_deg and longitude_deg, or "
    "altitude_m with east_m and north_m";

/// Keys of other ways to say where the radar stands than that of `own`.
void refuse_other_places(const TomlSection& section, std::initializer_list<std::string_view> own,
                         std::initializer_list<std::string_view> others) {
  const auto is_there = [&](std::string_view key) { return section.has(key); };
  const auto other = std::ranges::find_if(others, is_there);
  if (other == others.end()) return;
  throw section.fault(
      *other, fmt::format("means nothing where {} says where the radar stands", *std::ranges::find_if(own, is_there)),
      fmt::format("leave it out, or {}", ways_to_say_where));
}

Place place_of(const TomlSection& section) {
  const auto altitude_m = [&] { return section.number("altitude_m", {-500.0, 1e6, "m above mean sea level"}); };
  Place place;
  if (has_any(section, {"azimuth_deg", "elevation_deg", "slant_range_km"})) {
    refuse_other_places(section, {"azimuth_deg", "elevation_deg", "slant_range_km"},
                        {"latitude_deg", "longitude_deg", "east_m", "north_m", "altitude_m"});
    SeenFrom seen{.azimuth_rad = radians_from_deg(section.number("azimuth_deg", {-360.0, 360.0, "degrees"})),
                  .elevation_rad = radians_from_deg(section.number("elevation_deg", {0.5, 89.0, "degrees"})),
                  .slant_range_m = section.number("slant_range_km", {0.1, 1000.0, "km"}) * 1e3,
                  .target = {}};
    const auto east = section.optional_number("target_east_m", anywhere_m),
               north = section.optional_number("target_north_m", anywhere_m);
    if (east.has_value() != north.has_value()) {
      throw section.fault(east ? "target_north_m" : "target_east_m", "is missing beside its partner",
                          "give both target_east_m and target_north_m, or neither for the centre of the scene");
    }
    if (east) seen.target = Vec2d{*east, *north};
    place = seen;
  } else if (has_any(section, {"latitude_deg", "longitude_deg"})) {
    refuse_other_places(section, {"latitude_deg", "longitude_deg"},
                        {"east_m", "north_m", "target_east_m", "target_north_m"});
    place = GeographicPlace{section.number("latitude_deg", {-90.0, 90.0, "degrees"}),
                            section.number("longitude_deg", {-180.0, 180.0, "degrees"}), altitude_m()};
  } else if (!has_any(section, {"east_m", "north_m", "altitude_m"})) {
    throw Error(section.where(), "does not say where the radar stands", ways_to_say_where);
  } else {
    refuse_other_places(section, {"east_m", "north_m", "altitude_m"}, {"target_east_m", "target_north_m"});
    place = LocalPlace{{section.number("east_m", anywhere_m), section.number("north_m", anywhere_m), altitude_m()}};
  }
  section.refuse_unknown_keys();
  return place;
}

MapRequest map_of(const TomlSection& section) {
  MapRequest map;
  map.cell_m = section.number_or("cell_m", bounds::cells_m, map.cell_m);
  if (section.has("west_m") || section.has("east_m") || section.has("south_m") || section.has("north_m")) {
    map.area = Rectangle{section.number("west_m", anywhere_m), section.number("south_m", anywhere_m),
                         section.number("east_m", anywhere_m), section.number("north_m", anywhere_m)};
    if (map.area->width_m() < map.cell_m)
      throw section.fault("east_m", "does not lie east of west_m by a cell", "exchange or widen the two");
    if (map.area->height_m() < map.cell_m)
      throw section.fault("north_m", "does not lie north of south_m by a cell", "exchange or widen the two");
  }
  section.refuse_unknown_keys();
  return map;
}

RadarFile radar_in(const TomlSection& file, PlaceOfRadar need) {
  RadarFile read = described_radar(file, file.required_section("radar"));
  const bool is_placed = need == PlaceOfRadar::Required || file.has("position");
  read.place = is_placed ? place_of(file.required_section("position")) : Unplaced{};
  if (const auto map = file.section("map")) read.map = map_of(*map);
  file.refuse_unknown_keys();
  return read;
}

/// Of an antenna whose gain follows from its beam.
void follow_beam(RadarFile& file) {
  Radar& radar = file.radar;
  if (file.antenna_efficiency)
    radar.antenna.gain = *file.antenna_efficiency * directivity(radar.antenna, radar.beam_width_rad);
}

}  // namespace

RadarFile read_radar_file(const std::filesystem::path& path, PlaceOfRadar need) {
  return radar_in(TomlSection::read_file(path), need);
}

RadarFile read_radar_text(const std::string& text, const std::filesystem::path& name, PlaceOfRadar need) {
  return radar_in(TomlSection::read_text(text, name), need);
}

void set_beam_width(RadarFile& file, double width_rad) {
  Radar& radar = file.radar;
  if (std::holds_alternative<TabulatedBeam>(radar.antenna.azimuth)) {
    throw Error("beam_width_deg", "is that of the antenna's table, antenna.azimuth_csv of the radar file",
                "give the file another table, or another azimuth_shape");
  }
  radar.beam_width_rad = width_rad;
  follow_beam(file);
}

void set_antenna_gain(RadarFile& file, double gain) {
  file.radar.antenna.gain = gain;
  file.antenna_efficiency.reset();
}

void set_tilt(RadarFile& file, double tilt_rad) {
  Antenna& antenna = file.radar.antenna;
  const auto fault = [&](const std::string& what, const std::string& remedy) {
    return Error("tilt_deg", fmt::format("is {:g}, {}", deg_from_radians(tilt_rad), what), remedy);
  };
  if (std::holds_alternative<EvenBeam>(antenna.elevation))
    throw fault("which means nothing to a beam that is even in elevation", "give the radar an elevation_shape");
  if (const auto* cosecant = std::get_if<CosecantSquaredBeam>(&antenna.elevation);
      cosecant != nullptr && !(tilt_rad < 0.0 && -tilt_rad < cosecant->steepest_depression_rad)) {
    throw fault("where no cosecant-squared beam has its peak",
                fmt::format("give a negative angle above {:g}", -deg_from_radians(cosecant->steepest_depression_rad)));
  }
  antenna.tilt_rad = tilt_rad;
  follow_beam(file);
}

void set_pulse_length(RadarFile& file, double length_s) {
  Waveform& waveform = file.radar.waveform;
  const double shortest_s = 1.0 / bandwidth_of(file.radar.range_resolution_m, waveform.window),
               longest_s = longest_pulse_s(waveform.pulse_repetition_hz);
  if (!(length_s >= shortest_s * (1.0 - 1e-9) && length_s <= longest_s)) {
    throw Error("pulse_length_s", fmt::format("is {:g}", length_s),
                fmt::format("give {:.6g}, of a pulse that is not coded, to {:.6g}, half of the time between pulses",
                            shortest_s, longest_s));
  }
  waveform.pulse_length_s = length_s;
  file.has_shortest_pulse = false;
}

double coarsest_range_resolution_m(const RadarFile& file) {
  const Waveform& waveform = file.radar.waveform;
  const double longest_s =
      file.has_shortest_pulse ? longest_pulse_s(waveform.pulse_repetition_hz) : waveform.pulse_length_s;
  return range_resolution_of(1.0 / longest_s, waveform.window);
}

double finest_range_resolution_m(const Radar& radar) {
  return range_resolution_of(widest_band_hz(radar.frequency_hz), radar.waveform.window);
}

void set_range_resolution(RadarFile& file, double resolution_m) {
  Waveform& waveform = file.radar.waveform;
  const double coarsest_m = coarsest_range_resolution_m(file);
  if (resolution_m > coarsest_m * (1.0 + 1e-9)) {
    const std::string fault =
        file.has_shortest_pulse
            ? fmt::format("is {:g}, whose shortest pulse leaves the receiver less than half of the time between pulses",
                          resolution_m)
            : fmt::format("is {:g}, coarser than a pulse of {:g} µs can be", resolution_m,
                          waveform.pulse_length_s * 1e6);
    throw Error("range_resolution_m", fault, fmt::format("give at most {:.6g}", advised(coarsest_m)));
  }
  if (const double finest_m = finest_range_resolution_m(file.radar); resolution_m <= finest_m) {
    throw Error("range_resolution_m", too_fine(file.radar, resolution_m),
                fmt::format("give more than {:.6g}", finest_m));
  }
  if (file.has_shortest_pulse) waveform.pulse_length_s = 1.0 / bandwidth_of(resolution_m, waveform.window);
  file.radar.range_resolution_m = resolution_m;
}

void set_pulse_repetition(RadarFile& file, double repetition_hz) {
  Waveform& waveform = file.radar.waveform;
  if (waveform.pulse_length_s > longest_pulse_s(repetition_hz)) {
    throw Error("pulse_repetition_hz",
                fmt::format("is {:g}, at which a pulse of {:g} µs leaves the receiver less than half of the time "
                            "between pulses",
                            repetition_hz, waveform.pulse_length_s * 1e6),
                fmt::format("give at most {:.6g}", advised(0.5 / waveform.pulse_length_s)));
  }
  waveform.pulse_repetition_hz = repetition_hz;
}

void set_frequency(RadarFile& file, double frequency_hz) {
  const double bandwidth_hz = bandwidth_of(file.radar.range_resolution_m, file.radar.waveform.window);
  if (bandwidth_hz >= widest_band_hz(frequency_hz)) {
    throw Error(
        "frequency_hz",
        fmt::format("is {:g}, about which a band of {:.6g} Hz, for a range_resolution_m of {:g}, reaches down to "
                    "no frequency at all",
                    frequency_hz, bandwidth_hz, file.radar.range_resolution_m),
        fmt::format("give more than {:.6g}, or first a coarser range_resolution_m", bandwidth_hz / 2.0));
  }
  file.radar.frequency_hz = frequency_hz;
}

void require_real_beam(const std::filesystem::path& radar_file, std::string_view what_serves) {
  const auto section = TomlSection::read_file(radar_file).section("mode");
  if (!section) return;
  const Mode mode = mode_asked(*section);
  if (mode == Mode::RealBeam) return;
  throw section->fault("kind", fmt::format("is {}, and {}", mode_word(mode), what_serves),
                       "take the [mode] out of the radar file, or name another radar file");
}

}  // namespace sigmascape::radar
