#include "sigmascape/simulate/map_warnings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

#include "sigmascape/radar/radar_warnings.h"
#include "sigmascape/simulate/placement.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::simulate {
namespace {

/// "20 m in the east", for each side on which a cell or more of what is asked for is missing.
std::vector<std::string> cut_sides(const radar::Rectangle& asked, const radar::Rectangle& extent, double cell_m) {
  std::vector<std::string> sides;
  for (const auto& [beyond_m, side] : {std::pair(extent.west_m - asked.west_m, "west"),
                                       {asked.east_m - extent.east_m, "east"},
                                       {extent.south_m - asked.south_m, "south"},
                                       {asked.north_m - extent.north_m, "north"}}) {
    if (beyond_m >= cell_m) sides.push_back(fmt::format("{:.6g} m in the {}", beyond_m, side));
  }
  return sides;
}

}  // namespace

std::vector<std::string> map_warnings(const radar::Radar& radar, const radar::MapRequest& request,
                                      const terrain::HeightField& terrain, const radar::Rectangle& extent) {
  const radar::GroundGrid grid = map_grid(request, extent);
  auto warnings = radar::radar_warnings(radar, bins_for(radar, grid.extent(), terrain), grid.cell_m);
  const auto sides = cut_sides(request.area.value_or(extent), extent, request.cell_m);
  if (!sides.empty()) {
    warnings.push_back(
        fmt::format("the map's area reaches beyond the scene, {}, and is cut off there; {} x {} cells of it are left",
                    fmt::join(sides, " and "), grid.columns, grid.rows));
  }
  return warnings;
}

}  // namespace sigmascape::simulate
