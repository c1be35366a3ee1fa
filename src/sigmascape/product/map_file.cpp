#include "sigmascape/product/map_file.h"

#include <array>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/base/file_ending.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/geo/axis_units.h"
#include "sigmascape/geo/geo_raster.h"
#include "sigmascape/product/decibels.h"
#include "sigmascape/product/json_text.h"
#include "sigmascape/product/map_geotiff.h"
#include "sigmascape/product/npy_bytes.h"
#include "sigmascape/product/zip_bytes.h"

namespace sigmascape::product {
namespace {

bool holds_correlation(const MapView& map, MapScale scale) {
  return map.quantity.has_correlation && scale == MapScale::Linear;
}

std::string numbers_bytes(const MapView& map, MapScale scale) {
  const bool is_linear = scale == MapScale::Linear, with_correlation = holds_correlation(map, scale);
  std::vector<float> numbers;
  for (const radar::Channels& cell : map.cells.values()) {
    for (const float power : {cell.vv, cell.hh, cell.hv})
      numbers.push_back(is_linear ? power : decibels_of(power, map.quantity.darkest_db));
    if (with_correlation) numbers.push_back(cell.re_vvhh);
  }
  const std::array<std::size_t, 3> shape{map.grid.rows, map.grid.columns, with_correlation ? 4U : 3U};
  return npy_bytes("<f4", shape, std::as_bytes(std::span(numbers)));
}

std::string description_of(const MapView& map, MapScale scale) {
  const bool is_linear = scale == MapScale::Linear;
  const std::string place = geo::axis_unit(map.crs);
  const std::string unit = is_linear ? map.quantity.unit : map.quantity.decibel_unit;
  nlohmann::ordered_json json{{"quantity", is_linear ? map.quantity.words : map.quantity.decibel_words},
                              {"axes", {"row", "column", "channel"}},
                              {"channels", {"VV", "HH", "HV"}},
                              {"west_" + place, map.grid.west_m},
                              {"north_" + place, map.grid.north_m},
                              {"cell_" + place, map.grid.cell_m},
                              {"rows", map.grid.rows},
                              {"columns", map.grid.columns},
                              {"edges", "west and north are those of the north-western cell; rows go south"},
                              {"crs", map.crs}};
  if (holds_correlation(map, scale)) json["channels"].push_back("RE_VVHH");
  if (!unit.empty()) json["unit"] = unit;
  for (const auto& [key, word] : map.metadata) {
    if (!json.contains(key)) json[key] = word;
  }
  return json_text(json, 1);
}

ZipEntry axis_entry(const std::string& name, double first, double step, std::size_t count) {
  std::vector<double> places(count);
  for (std::size_t i = 0; i < count; ++i) places[i] = first + step * static_cast<double>(i);
  const std::array shape{count};
  return {name + ".npy", npy_bytes("<f8", shape, std::as_bytes(std::span(places)))};
}

std::string archive_of(const MapView& map, MapScale scale, const std::string& where) {
  const std::string name = scale == MapScale::Linear ? map.quantity.name : map.quantity.decibel_name;
  const std::string place = geo::axis_unit(map.crs);
  const Vec2d corner = map.grid.centre_of(0, 0);
  return zip_bytes({{name + ".npy", numbers_bytes(map, scale)},
                    axis_entry("x_" + place, corner.x, map.grid.cell_m, map.grid.columns),
                    axis_entry("y_" + place, corner.y, -map.grid.cell_m, map.grid.rows),
                    {"description_json.npy", npy_text(description_of(map, scale))}},
                   where, "write GeoTIFF (.tif) or .npy");
}

}  // namespace

bool is_map_name(const std::filesystem::path& path) {
  const std::string ending = file_ending(path);
  return geo::is_geotiff_name(path) || ending == ".npy" || ending == ".npz";
}

void check_map_name(const std::filesystem::path& path) {
  if (is_map_name(path)) return;
  throw Error(path.string(), "is no kind of file that maps are written as", "end the name in .tif, .npy or .npz");
}

void write_map(const std::filesystem::path& path, const MapView& map, MapScale scale) {
  check_map_name(path);
  if (geo::is_geotiff_name(path)) return write_map_geotiff(path, map, scale);
  if (file_ending(path) == ".npz") return geo::write_atomically(path, archive_of(map, scale, path.string()));
  const std::string description = description_of(map, scale), numbers = numbers_bytes(map, scale);
  geo::write_together({{geo::companion_of(path, ".json"), description}, {path, numbers}});
}

void write_map(const std::filesystem::path& path, const radar::GroundMap& map, MapScale scale) {
  write_map(path, view_of(map), scale);
}

void write_map(const std::filesystem::path& path, const radar::PowerMap& map, MapScale scale) {
  write_map(path, view_of(map), scale);
}

}  // namespace sigmascape::product
