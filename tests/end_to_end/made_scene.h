#pragma once

#include <filesystem>
#include <fmt/format.h>
#include <fstream>

namespace sigmascape::end_to_end {

/// Writes a scene file of level grassland with houses all over it, `width_m` × `height_m` about the origin, and what it
/// needs; small enough to be baked in seconds.
inline std::filesystem::path write_made_scene(const std::filesystem::path& folder, double width_m, double height_m) {
  constexpr const char* frame = "+proj=tmerc +lat_0=43 +lon_0=-3 +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m";
  std::filesystem::create_directories(folder);
  std::ofstream heights(folder / "heights.asc");
  heights << "ncols 24\nnrows 24\nxllcorner -600\nyllcorner -600\ncellsize 50\n";
  for (int i = 0; i < 24 * 24; ++i) heights << "10 ";
  std::ofstream houses(folder / "houses.csv");
  houses << "WKT,height\n";
  for (int x = -600; x < 600; x += 40) {
    for (int y = -600; y < 600; y += 50) {
      houses << fmt::format("\"POLYGON (({0} {1}, {2} {1}, {2} {3}, {0} {3}, {0} {1}))\",{4}\n", x, y, x + 17, y + 12,
                            5 + (x + 3 * y) / 10 % 4);
    }
  }
  std::ofstream(folder / "scene.toml") << fmt::format(
      "[scene]\norigin_lat_deg = 43\norigin_lon_deg = -3\n"
      "extent = {{west_m = {}, south_m = {}, east_m = {}, north_m = {}}}\n"
      "[terrain]\nfile = \"heights.asc\"\ncrs = \"{}\"\n"
      "[[buildings]]\nfile = \"houses.csv\"\ncrs = \"{}\"\nheight_attribute = \"height\"\n",
      -width_m / 2, -height_m / 2, width_m / 2, height_m / 2, frame, frame);
  return folder / "scene.toml";
}

}  // namespace sigmascape::end_to_end
