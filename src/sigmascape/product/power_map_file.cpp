#include "sigmascape/product/power_map_file.h"

#include <charconv>
#include <limits>
#include <utility>

#include "sigmascape/product/map_geotiff.h"

namespace sigmascape::product {
namespace {

double number_of(const std::map<std::string, std::string>& metadata, const char* key) {
  double number = std::numeric_limits<double>::quiet_NaN();
  if (const auto found = metadata.find(key); found != metadata.end())
    std::from_chars(found->second.data(), found->second.data() + found->second.size(), number);
  return number;
}

}  // namespace

radar::PowerMap read_power_map(const std::filesystem::path& path) {
  MapContent content = read_map_geotiff(path, power_quantity());
  return {.grid = content.grid,
          .power_w = std::move(content.cells),
          .noise_w = number_of(content.metadata, "noise_w"),
          .crs = std::move(content.crs),
          .metadata = std::move(content.metadata)};
}

}  // namespace sigmascape::product
