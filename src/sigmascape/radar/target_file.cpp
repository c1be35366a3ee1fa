#include "sigmascape/radar/target_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <optional>

#include "sigmascape/base/toml_reader.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/radar_bounds.h"
#include "sigmascape/radar/rcs_section.h"
#include "sigmascape/radar/rcs_table.h"

namespace sigmascape::radar {
namespace {

std::variant<Channels, RcsTable> read_rcs(const TomlSection& section) {
  if (!section.has("rcs_csv")) return rcs_of_section(section);
  if (section.has("rcs_dbsm"))
    throw section.fault("rcs_csv", "and rcs_dbsm both give the cross-section", "leave out one of them");
  if (section.has("bounces"))
    throw section.fault("bounces", "means nothing beside rcs_csv, which gives VV and HH as they are", "leave it out");
  return read_rcs_table(section.file("rcs_csv"));
}

/// Some numbers in a row, or nothing when the key is absent.
template <std::size_t Count>
std::optional<std::array<double, Count>> row_of(const TomlSection& section, std::string_view key, Interval allowed) {
  const auto values = section.numbers(key, allowed);
  if (!section.has(key)) return std::nullopt;
  if (values.size() != Count)
    throw section.fault(key, fmt::format("holds {} number{}", values.size(), values.size() == 1 ? "" : "s"),
                        fmt::format("give {}", Count));
  std::array<double, Count> row{};
  std::copy(values.begin(), values.end(), row.begin());
  return row;
}

TargetPlace place_of(const TomlSection& section, double default_height_m) {
  TargetPlace place;
  const auto local = row_of<2>(section, "position_m", {-1e7, 1e7, "m"});
  const auto earth = row_of<2>(section, "position_lat_lon_deg", {-360.0, 360.0, "degrees"});
  if (local.has_value() == earth.has_value()) {
    throw section.fault("position_m", local ? "and position_lat_lon_deg both say where it is" : "is missing",
                        "give either position_m or position_lat_lon_deg");
  }
  if (local) {
    place.place = Vec2d{(*local)[0], (*local)[1]};
  } else {
    if (std::abs((*earth)[0]) > 90.0) {
      throw section.fault("position_lat_lon_deg", fmt::format("states a latitude of {:g}°", (*earth)[0]),
                          "give the latitude first, from -90 to 90");
    }
    place.place = LatitudeLongitude{(*earth)[0], (*earth)[1]};
  }
  const auto altitude_m = section.optional_number("altitude_m", {-500.0, 1e6, "m above mean sea level"});
  const auto height_m = section.optional_number("height_m", {0.0, 1e6, "m above the ground"});
  if (altitude_m && height_m)
    throw section.fault("altitude_m", "and height_m both say how high it is", "leave out one of them");
  place.above_ground = !altitude_m;
  place.height_m = altitude_m.value_or(height_m.value_or(default_height_m));
  return place;
}

void read_motion(const TomlSection& section, TargetSource& source) {
  const double default_height_m = source.target.size_m.z / 2.0;
  source.target.heading_rad =
      radians_from_deg(section.number_or("heading_deg", {-360.0, 360.0, "degrees clockwise from north"}, 0.0));
  const auto legs = section.sections("way_points");
  if (legs.empty()) {
    source.places = {place_of(section, default_height_m)};
    const double speed_mps = section.number_or("speed_mps", {0.0, 20'000.0, "m/s"}, 0.0);
    const double heading_rad = source.target.heading_rad;
    source.velocity_mps = {speed_mps * std::sin(heading_rad), speed_mps * std::cos(heading_rad),
                           section.number_or("climb_mps", {-1000.0, 1000.0, "m/s"}, 0.0)};
    return;
  }
  for (const char* key : {"position_m", "position_lat_lon_deg", "height_m", "altitude_m", "speed_mps", "climb_mps"}) {
    if (section.has(key)) throw section.fault(key, "and way_points both say how it moves", "leave out one of them");
  }
  for (const TomlSection& leg : legs) {
    const double time_s = leg.number("time_s", bounds::moments_s);
    if (!source.places.empty() && time_s <= source.places.back().time_s)
      throw leg.fault("time_s", "is not later than that of the way-point before", "put them in the order of time");
    source.places.push_back(place_of(leg, default_height_m));
    source.places.back().time_s = time_s;
    leg.refuse_unknown_keys();
  }
}

TargetSource read_target(const TomlSection& section, std::uint64_t number) {
  TargetSource source;
  source.where = section.where();
  source.target.name = section.text_or("name", fmt::format("target {}", number));
  source.target.rcs_m2 = read_rcs(section);
  source.target.fluctuation = static_cast<Swerling>(section.whole_number_or("swerling", {0.0, 4.0, "cases"}, 0));
  if (const auto size_m = row_of<3>(section, "size_m", {0.0, 10'000.0, "m"}))
    source.target.size_m = {(*size_m)[0], (*size_m)[1], (*size_m)[2]};
  read_motion(section, source);
  section.refuse_unknown_keys();
  return source;
}

}  // namespace

std::vector<TargetSource> read_target_file(const std::filesystem::path& path) {
  const TomlSection file = TomlSection::read_file(path);
  std::vector<TargetSource> targets;
  for (const TomlSection& section : file.sections("targets"))
    targets.push_back(read_target(section, targets.size() + 1));
  file.refuse_unknown_keys();
  if (targets.empty()) throw file.fault("targets", "is missing", "add a [[targets]] table for each target");
  return targets;
}

}  // namespace sigmascape::radar
