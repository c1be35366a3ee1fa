#include "sigmascape/radar/rcs_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <map>
#include <optional>
#include <string>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/csv_lines.h"

namespace sigmascape::radar {
namespace {

struct Part {
  std::size_t lower, upper;
  float upper_weight;
};

Part part_of(const std::vector<double>& axis, double value) {
  const auto above = std::upper_bound(axis.begin(), axis.end(), value);
  if (above == axis.begin()) return {0, 0, 0.0F};
  if (above == axis.end()) return {axis.size() - 1, axis.size() - 1, 0.0F};
  const auto upper = static_cast<std::size_t>(above - axis.begin());
  return {upper - 1, upper, static_cast<float>((value - axis[upper - 1]) / (axis[upper] - axis[upper - 1]))};
}

Part part_of_circle(const std::vector<double>& axis, double value) {
  const double turn = 2.0 * pi, azimuth = wrapped_azimuth(value);
  if (azimuth >= axis.front() && azimuth < axis.back()) return part_of(axis, azimuth);
  const double gap = axis.front() + turn - axis.back();
  const double into = azimuth >= axis.back() ? azimuth - axis.back() : azimuth + turn - axis.back();
  return {axis.size() - 1, 0, static_cast<float>(into / gap)};
}

// Of the columns below. Decibels reach from nothing to what a float holds as power.
struct Allowed {
  double lowest, highest;
};
constexpr Allowed allowed[] = {{-720.0, 720.0}, {-90.0, 90.0},   {0.001, 1000.0}, {-300.0, 300.0},
                               {-300.0, 300.0}, {-300.0, 300.0}, {-1.0, 1.0}};
constexpr const char* names[] = {"azimuth_deg", "elevation_deg", "frequency_ghz",    "vv_dbsm",
                                 "hh_dbsm",     "hv_dbsm",       "vv_hh_correlation"};
enum Column : std::size_t { Azimuth, Elevation, Frequency, Vv, Hh, Hv, Correlation, Columns };

using RcsRow = std::array<std::optional<double>, Columns>;

struct Reader {
  const std::filesystem::path& path;
  std::vector<std::size_t> columns = {};

  [[nodiscard]] std::string at_line(std::size_t line) const { return fmt::format("{}, line {}", path.string(), line); }

  void read_names(const std::string& line, std::size_t number) {
    for (const std::string& field : csv_fields(line)) {
      const auto* const found = std::find(std::begin(names), std::end(names), field);
      if (found == std::end(names)) {
        throw Error(at_line(number), "has an unknown column \"" + field + "\"",
                    fmt::format("name columns {}", fmt::join(names, ", ")));
      }
      columns.push_back(static_cast<std::size_t>(found - std::begin(names)));
    }
    for (std::size_t column = 0; column < Columns; ++column) {
      const auto times = std::count(columns.begin(), columns.end(), column);
      const bool is_needed = column == Azimuth || column == Vv || column == Hh;
      if (times > 1 || (is_needed && times == 0))
        throw Error(at_line(number), fmt::format("must have one column {}", names[column]), "name it once");
    }
  }

  [[nodiscard]] RcsRow read_row(const std::string& line, std::size_t number) const {
    const auto fields = csv_fields(line);
    if (fields.size() != columns.size()) {
      throw Error(at_line(number), fmt::format("has {} fields", fields.size()),
                  fmt::format("give {}, one a column", columns.size()));
    }
    RcsRow row;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const auto value = csv_number(fields[i]);
      if (!value)
        throw Error(at_line(number), fmt::format("{} is \"{}\"", names[columns[i]], fields[i]), "give a number");
      const auto [lowest, highest] = allowed[columns[i]];
      if (*value < lowest || *value > highest) {
        throw Error(at_line(number), fmt::format("{} is {}", names[columns[i]], fields[i]),
                    fmt::format("give a number from {:g} to {:g}", lowest, highest));
      }
      row[columns[i]] = value;
    }
    return row;
  }
};

/// What is told of one side alone, as of a ship that is alike on both, would be drawn straight across the other.
void check_all_round(const std::vector<double>& azimuths_rad, const std::filesystem::path& path) {
  constexpr double widest_in_steps = 2.5;
  if (azimuths_rad.size() < 2) return;
  double first_gap = azimuths_rad.front() + 2.0 * pi - azimuths_rad.back(), widest = first_gap, second = 0.0;
  double from = azimuths_rad.back(), to = azimuths_rad.front();
  for (std::size_t i = 1; i < azimuths_rad.size(); ++i) {
    const double gap = azimuths_rad[i] - azimuths_rad[i - 1];
    if (gap > widest) {
      second = widest;
      widest = gap;
      from = azimuths_rad[i - 1];
      to = azimuths_rad[i];
    } else {
      second = std::max(second, gap);
    }
  }
  // Bow and stern alone are told all round; of both and a broadside half is missing.
  constexpr double half_turn = pi * (1.0 - 1e-9);
  const bool lacks_a_side = widest >= half_turn && second < half_turn;
  if (!lacks_a_side && widest <= widest_in_steps * second) return;
  throw Error(
      path.string(),
      fmt::format("tells nothing between azimuths of {:g}° and {:g}°", deg_from_radians(from), deg_from_radians(to)),
      fmt::format("tell it all round, in steps of at most {:g}°",
                  (lacks_a_side ? 1.0 : widest_in_steps) * deg_from_radians(second)));
}

/// From 0 on. Of degrees no whole turn leaves a rounding, as it would of radians.
double within_a_turn_deg(double azimuth_deg) {
  const double rest_deg = std::fmod(azimuth_deg, 360.0);
  return rest_deg < 0.0 ? rest_deg + 360.0 : rest_deg;
}

Channels channels_of(const RcsRow& row) {
  const double vv = linear_from_db(*row[Vv]), hh = linear_from_db(*row[Hh]);
  const double correlation = row[Correlation].value_or(1.0);
  return {static_cast<float>(vv), static_cast<float>(hh), row[Hv] ? static_cast<float>(linear_from_db(*row[Hv])) : 0.0F,
          static_cast<float>(correlation * std::sqrt(vv * hh))};
}

}  // namespace

Channels RcsTable::at(const Look& look) const {
  const Part azimuth = part_of_circle(azimuths_rad, look.aspect.azimuth_rad);
  const Part elevation = part_of(elevations_rad, look.aspect.elevation_rad);
  const Part frequency = part_of(frequencies_hz, look.frequency_hz);
  Channels sum;
  for (const int f : {0, 1}) {
    for (const int e : {0, 1}) {
      for (const int a : {0, 1}) {
        const auto weight = [](const Part& part, int upper) {
          return upper == 1 ? part.upper_weight : 1.0F - part.upper_weight;
        };
        const auto place = [](const Part& part, int upper) { return upper == 1 ? part.upper : part.lower; };
        const std::size_t index =
            (place(frequency, f) * elevations_rad.size() + place(elevation, e)) * azimuths_rad.size() +
            place(azimuth, a);
        sum += rcs_m2[index] * (weight(frequency, f) * weight(elevation, e) * weight(azimuth, a));
      }
    }
  }
  return sum;
}

RcsTable read_rcs_table(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file || std::filesystem::is_directory(path))
    throw Error(path.string(), "cannot be read", "name a file of comma-separated values");
  Reader reader{path};
  // Ordered as the table is: frequency, elevation, azimuth.
  struct Entry {
    Channels rcs_m2;
    double stated_azimuth_deg;
  };
  std::map<std::array<double, 3>, Entry> entries;
  for_each_csv_line(file, [&](const std::string& line, std::size_t number) {
    if (reader.columns.empty()) return reader.read_names(line, number);
    const RcsRow row = reader.read_row(line, number);
    const std::array<double, 3> key{row[Frequency].value_or(0.0) * 1e9, radians_from_deg(row[Elevation].value_or(0.0)),
                                    radians_from_deg(within_a_turn_deg(*row[Azimuth]))};
    // Tables often close the circle and tell 360° as well as 0°.
    const auto [place, is_new] = entries.emplace(key, Entry{channels_of(row), *row[Azimuth]});
    const Entry& before = place->second;
    if (!is_new && !(before.rcs_m2 == channels_of(row) && before.stated_azimuth_deg != *row[Azimuth])) {
      throw Error(reader.at_line(number),
                  fmt::format("tells a second time what is returned at an azimuth of {:g}°", *row[Azimuth]),
                  "give each azimuth, elevation and frequency once; whole turns make no difference");
    }
  });
  if (entries.empty()) throw Error(path.string(), "holds no cross-sections", "give at least one line of numbers");

  RcsTable table;
  const auto insert = [](std::vector<double>& axis, double value) {
    const auto place = std::lower_bound(axis.begin(), axis.end(), value);
    if (place == axis.end() || *place != value) axis.insert(place, value);
  };
  for (const auto& [key, entry] : entries) {
    insert(table.frequencies_hz, key[0]);
    insert(table.elevations_rad, key[1]);
    insert(table.azimuths_rad, key[2]);
    table.rcs_m2.push_back(entry.rcs_m2);
  }
  const std::size_t whole = table.frequencies_hz.size() * table.elevations_rad.size() * table.azimuths_rad.size();
  if (whole != entries.size()) {
    throw Error(path.string(),
                fmt::format("holds {} of the {} combinations of its angles and frequencies", entries.size(), whole),
                "give every azimuth with every elevation and frequency");
  }
  check_all_round(table.azimuths_rad, path);
  return table;
}

}  // namespace sigmascape::radar
