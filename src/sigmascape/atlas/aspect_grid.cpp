#include "sigmascape/atlas/aspect_grid.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <numeric>
#include <string>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"

namespace sigmascape::atlas {
namespace {

/// Two neighbours on an axis and the part of the second.
struct Between {
  std::size_t first = 0;
  std::size_t second = 0;
  double fraction = 0.0;
};

/// Neighbours of `value` on an ascending axis, held beyond its ends, linear in `scale`(value).
template <typename Scale>
Between between(const std::vector<double>& axis, double value, Scale scale) {
  const auto above = std::ranges::upper_bound(axis, value);
  if (above == axis.begin()) return {};
  const auto first = static_cast<std::size_t>(above - axis.begin()) - 1;
  if (above == axis.end()) return {first, first, 0.0};
  const double start = scale(axis[first]);
  return {first, first + 1, (scale(value) - start) / (scale(*above) - start)};
}

Between between_azimuths(const std::vector<double>& axis, double azimuth_rad) {
  const double wrapped = wrapped_azimuth(azimuth_rad);
  const auto above = static_cast<std::size_t>(std::ranges::upper_bound(axis, wrapped) - axis.begin());
  const std::size_t first = (above + axis.size() - 1) % axis.size(), second = above % axis.size();
  if (first == second) return {};
  const double gap = wrapped_azimuth(axis[second] - axis[first]);
  return {first, second, part_of_second_azimuth(wrapped_azimuth(wrapped - axis[first]) / gap, gap)};
}

double cotangent(double angle_rad) {
  return std::cos(angle_rad) / std::sin(angle_rad);
}

void check_axis(const std::vector<double>& axis, std::string_view where, std::string_view name, double lowest,
                double highest, bool lowest_allowed) {
  const std::string place = fmt::format("{}, {}", where, name);
  if (axis.empty()) throw Error(place, "has no values", "give at least one");
  for (const double value : axis) {
    if (value > lowest ? value <= highest : lowest_allowed && value == lowest) continue;
    throw Error(place, fmt::format("{:g} is out of range", value),
                fmt::format("give values {} {:g} and up to {:g}", lowest_allowed ? "from" : "above", lowest, highest));
  }
  if (std::ranges::adjacent_find(axis, std::greater_equal{}) != axis.end()) {
    throw Error(place, "does not ascend", "list each value once, the smallest first");
  }
}

/// The chosen places on an axis, all of them when none is named.
std::vector<std::size_t> kept_places(const std::vector<std::size_t>& chosen, std::size_t axis_size,
                                     std::string_view name) {
  if (chosen.empty()) {
    std::vector<std::size_t> all(axis_size);
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
  }
  if (chosen.back() >= axis_size || std::ranges::adjacent_find(chosen, std::greater_equal{}) != chosen.end()) {
    throw Error(fmt::format("selected {}", name), "do not ascend or are not all on the axis",
                fmt::format("give places from 0 to {}, each once, the smallest first", axis_size - 1));
  }
  return chosen;
}

std::vector<double> values_at(const std::vector<double>& axis, const std::vector<std::size_t>& places) {
  std::vector<double> values;
  for (const std::size_t place : places) values.push_back(axis[place]);
  return values;
}

}  // namespace

std::vector<LookIndex> selected_looks(const AspectGrid& grid, const AspectSelection& selection) {
  const auto azimuths = kept_places(selection.azimuths, grid.azimuths_rad.size(), "azimuths");
  const auto elevations = kept_places(selection.elevations, grid.elevations_rad.size(), "elevations");
  std::vector<LookIndex> looks;
  for (std::size_t frequency = 0; frequency < grid.frequencies_hz.size(); ++frequency) {
    for (const std::size_t elevation : elevations) {
      for (const std::size_t azimuth : azimuths) looks.push_back(grid.index_of(azimuth, elevation, frequency));
    }
  }
  return looks;
}

AspectGrid selected_grid(const AspectGrid& grid, const AspectSelection& selection) {
  return {values_at(grid.azimuths_rad, kept_places(selection.azimuths, grid.azimuths_rad.size(), "azimuths")),
          values_at(grid.elevations_rad, kept_places(selection.elevations, grid.elevations_rad.size(), "elevations")),
          grid.frequencies_hz};
}

radar::Look AspectGrid::look(LookIndex index) const {
  const std::size_t azimuth = index % azimuths_rad.size();
  const std::size_t elevation = index / azimuths_rad.size() % elevations_rad.size();
  const std::size_t frequency = index / (azimuths_rad.size() * elevations_rad.size());
  return {{azimuths_rad[azimuth], elevations_rad[elevation]}, frequencies_hz[frequency]};
}

std::vector<double> even_azimuths(unsigned count) {
  if (count == 0 || count > most_azimuths)
    throw Error("azimuths", fmt::format("are {}", count), fmt::format("give a number from 1 to {}", most_azimuths));
  std::vector<double> azimuths_rad;
  for (unsigned i = 0; i < count; ++i) azimuths_rad.push_back(radians_from_deg(360.0 * i / count));
  return azimuths_rad;
}

AspectGrid paper_aspect_grid() {
  AspectGrid grid;
  grid.azimuths_rad = even_azimuths(8);
  for (int i = 0; i < 5; ++i) grid.elevations_rad.push_back(radians_from_deg(5.0 + 8.0 * i));
  grid.frequencies_hz = {10e9};
  return grid;
}

void check(const AspectGrid& grid, std::string_view where) {
  const double full_turn = std::nextafter(2.0 * pi, 0.0);
  check_axis(grid.azimuths_rad, where, "azimuths (radians)", 0.0, full_turn, true);
  check_axis(grid.elevations_rad, where, "elevations (radians)", 0.0, pi / 2.0, false);
  check_axis(grid.frequencies_hz, where, "frequencies (hertz)", 0.0, 1e12, false);
}

void check_frequency(const AspectGrid& grid, double frequency_hz) {
  const double lowest = grid.frequencies_hz.front(), highest = grid.frequencies_hz.back();
  if (frequency_hz >= lowest * 0.99 && frequency_hz <= highest * 1.01) return;
  throw Error("frequency", fmt::format("{:g} GHz is not in this atlas", frequency_hz / 1e9),
              lowest == highest ? fmt::format("it was baked at {:g} GHz: use that, or bake another", lowest / 1e9)
                                : fmt::format("it was baked from {:g} to {:g} GHz: stay there, or bake another",
                                              lowest / 1e9, highest / 1e9));
}

AspectWeights weights_for(const AspectGrid& grid, const radar::Aspect& aspect, double frequency_hz) {
  AspectWeights weights;
  if (!(aspect.elevation_rad > 0.0)) return weights;
  const double sine = std::sin(std::min(aspect.elevation_rad, grid.elevations_rad.back()));

  const Between azimuth = between_azimuths(grid.azimuths_rad, aspect.azimuth_rad);
  const Between elevation = between(grid.elevations_rad, aspect.elevation_rad, cotangent);
  const Between frequency = between(grid.frequencies_hz, frequency_hz, [](double hz) { return std::log(hz); });
  const auto part = [](const Between& axis, int side) { return side == 0 ? 1.0 - axis.fraction : axis.fraction; };
  const auto node = [](const Between& axis, int side) { return side == 0 ? axis.first : axis.second; };
  for (int f = 0; f < 2; ++f) {
    for (int e = 0; e < 2; ++e) {
      // What is blended is γ = σ0 / sin ψ.
      const double of_height = part(frequency, f) * part(elevation, e);
      if (of_height == 0.0) continue;
      const double baked_sine = std::sin(grid.elevations_rad[node(elevation, e)]);
      for (int a = 0; a < 2; ++a) {
        const double fraction = of_height * part(azimuth, a);
        if (fraction == 0.0) continue;
        const double weight = fraction * sine / baked_sine;
        weights.look[weights.count] = grid.index_of(node(azimuth, a), node(elevation, e), node(frequency, f));
        weights.weight[weights.count] = static_cast<float>(weight);
        ++weights.count;
      }
    }
  }
  return weights;
}

}  // namespace sigmascape::atlas
