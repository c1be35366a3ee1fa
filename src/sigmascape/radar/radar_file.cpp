#include "sigmascape/radar/radar_file.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "sigmascape/base/toml_reader.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/polarization_words.h"
#include "sigmascape/radar/radar_file_sections.h"
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

Radar radar_of(const TomlSection& file, const TomlSection& section) {
  Radar radar;
  radar.name = section.text_or("name", "radar");
  radar.frequency_hz = section.number("frequency_ghz", {0.1, 300.0, "GHz"}) * 1e9;
  radar.polarization = polarization_of(section);
  constexpr Interval resolutions_m{0.005, 10'000.0, "m"};
  constexpr Interval widths_deg{1e-5, 90.0, "degrees"};
  radar.range_resolution_m = states(file, "waveform", "bandwidth_mhz")
                                 ? section.number_or("range_resolution_m", resolutions_m, 0.0)
                                 : section.number("range_resolution_m", resolutions_m);
  radar.beam_width_rad =
      radians_from_deg(states(file, "antenna", "azimuth_csv") ? section.number_or("beam_width_deg", widths_deg, 0.0)
                                                              : section.number("beam_width_deg", widths_deg));
  radar.earth_refraction = section.optional_number("earth_refraction", {0.1, 1e3, ": k of the k-Earth, 4/3 as a rule"});
  radar.wind_mps = section.number_or("wind_mps", {0.0, 40.0, "m/s"}, 0.0);
  radar.atmosphere_per_m =
      std::log(linear_from_db(section.number_or("atmosphere_db_per_km", {0.0, 50.0, "dB/km, one way"}, 0.0))) / 1e3;
  section.refuse_unknown_keys();

  if (const auto waveform = file.section("waveform")) {
    read_waveform(*waveform, radar);
  } else {
    radar.waveform.pulse_length_s = 1.0 / bandwidth_of(radar.range_resolution_m, radar.waveform.window);
  }
  read_antenna(file.section("antenna"), radar);
  if (const auto platform = file.section("platform")) read_platform(*platform, radar);
  if (const auto receiver = file.section("receiver")) read_receiver(*receiver, radar);
  if (const auto scan = file.section("scan")) read_scan(*scan, radar);
  if (const auto mode = file.section("mode")) read_mode(*mode, radar);
  return radar;
}

bool has_any(const TomlSection& section, std::initializer_list<std::string_view> keys) {
  return std::ranges::any_of(keys, [&](std::string_view key) { return section.has(key); });
}

std::variant<SeenFrom, LocalPlace, GeographicPlace> place_of(const TomlSection& section) {
  const auto altitude_m = [&] { return section.number("altitude_m", {1.0, 1e6, "m above mean sea level"}); };
  std::variant<SeenFrom, LocalPlace, GeographicPlace> place;
  if (has_any(section, {"slant_range_km", "azimuth_deg", "elevation_deg"})) {
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
    place = GeographicPlace{section.number("latitude_deg", {-90.0, 90.0, "degrees"}),
                            section.number("longitude_deg", {-180.0, 180.0, "degrees"}), altitude_m()};
  } else if (!has_any(section, {"east_m", "north_m", "altitude_m"})) {
    throw Error(
        section.where(), "does not say where the radar stands",
        "give azimuth_deg, elevation_deg and slant_range_km, or altitude_m with latitude_deg and longitude_deg, "
        "or altitude_m with east_m and north_m");
  } else {
    place = LocalPlace{{section.number("east_m", anywhere_m), section.number("north_m", anywhere_m), altitude_m()}};
  }
  section.refuse_unknown_keys();
  return place;
}

MapRequest map_of(const TomlSection& section) {
  MapRequest map;
  map.cell_m = section.number_or("cell_m", {0.05, 10'000.0, "m"}, map.cell_m);
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

TomlSection required_section(const TomlSection& file, std::string_view key) {
  if (auto section = file.section(key)) return *section;
  throw file.fault(key, "is missing", "add a [" + std::string(key) + "] section");
}

}  // namespace

RadarFile read_radar_file(const std::filesystem::path& path, PlaceOfRadar need) {
  const TomlSection file = TomlSection::read_file(path);
  RadarFile read{.radar = radar_of(file, required_section(file, "radar")), .place = SeenFrom{}, .map = {}};
  if (need == PlaceOfRadar::Required || file.has("position")) read.place = place_of(required_section(file, "position"));
  if (const auto map = file.section("map")) read.map = map_of(*map);
  file.refuse_unknown_keys();
  return read;
}

}  // namespace sigmascape::radar
