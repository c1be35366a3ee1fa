#include "sigmascape/product/range_azimuth_file.h"

#include <array>
#include <nlohmann/json.hpp>
#include <span>

#include "sigmascape/base/error.h"
#include "sigmascape/base/file_ending.h"
#include "sigmascape/base/units.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/product/json_text.h"
#include "sigmascape/product/npy_bytes.h"
#include "sigmascape/product/told_numbers.h"

namespace sigmascape::product {
namespace {

std::string description(const radar::RangeAzimuthGrid& grid, const RangeAzimuthLabel& label) {
  nlohmann::ordered_json json{
      {"quantity", label.quantity},
      {"axes", {"range", "azimuth"}},
      {"first_range_m", grid.first_range_m},
      {"range_step_m", grid.range_step_m},
      {"ranges", grid.ranges},
      {"first_azimuth_deg", deg_from_radians(grid.first_azimuth_rad)},
      {"azimuth_step_deg", deg_from_radians(grid.azimuth_step_rad)},
      {"azimuths", grid.azimuths},
      {"edges",
       "first_range_m, of slant range, and first_azimuth_deg, clockwise from the "
       "frame's north, are where bin 0 begins; its middle lies half a step further"},
      {"radar_position_m", {label.radar_position.x, label.radar_position.y, label.radar_position.z}}};
  std::map<std::string, std::string> words = label.words;
  std::map<std::string, double> numbers = label.numbers;
  numbers.merge(numbers_taken_from(words));
  for (const auto& [key, number] : numbers) json[key] = number;
  for (const auto& [key, word] : words) json[key] = word;
  return json_text(json, 2);
}

}  // namespace

void check_range_azimuth_name(const std::filesystem::path& path) {
  if (file_ending(path) != ".npy")
    throw Error(path.string(), "would not be known for a NumPy file", "give a name that ends in .npy");
}

void write_range_azimuth(const std::filesystem::path& path, const radar::RangeAzimuthGrid& grid,
                         const Array2D<float>& bins, const RangeAzimuthLabel& label) {
  check_range_azimuth_name(path);
  const std::array<std::size_t, 2> shape{bins.rows(), bins.columns()};
  const std::string words = description(grid, label), numbers = npy_bytes("<f4", shape, std::as_bytes(bins.values()));
  geo::write_together({{geo::companion_of(path, ".json"), words}, {path, numbers}});
}

}  // namespace sigmascape::product
