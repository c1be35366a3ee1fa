#pragma once

#include <cmath>
#include <fmt/format.h>
#include <string>

#include "scratch_folder.h"
#include "unit/geo/ascii_grid.h"

#include "sigmascape/scene/scene_file.h"

namespace sigmascape::scene {

/// What write_houses has written, in a scene file.
inline const std::string houses_section = "[[buildings]]\nfile = \"houses.geojson\"\nheight_attribute = \"h\"\n";

/// Files of a made-up place: 1 km × 0.8 km at 43.312° N, a slope that falls to a sea in its south, a wood in its
/// north-east. Frame coordinates of the corner are about (−500, −400) m, because the terrain's middle is the origin.
class MadeUpPlace {
 public:
  static constexpr geo::AsciiGrid grid{500'600.0, 4'795'000.0, 10.0, 100, 80};
  static constexpr double east_of_origin_m = 501'100.0, north_of_origin_m = 4'795'400.0;
  static constexpr double shore_m = 4'795'200.0;

  MadeUpPlace() {
    write("heights.asc", grid.text([](double, double y) { return y > shore_m ? 0.05 * (y - shore_m) : -2.0; }));
    write("cover.asc", grid.text([](double x, double y) {
      return y < shore_m ? 80.0 : x > 501'300.0 && y > 4'795'600.0 ? 10.0 : 30.0;
    }));
  }

  std::filesystem::path write(const std::string& file, const std::string& text) const {
    return folder.write(file, text);
  }

  /// A building footprint (metres from the middle) as a GeoJSON feature.
  static std::string house(double west, double south, double east, double north, const std::string& properties) {
    const double w = east_of_origin_m + west, s = north_of_origin_m + south, e = east_of_origin_m + east,
                 n = north_of_origin_m + north;
    return fmt::format(
        R"({{"type":"Feature","properties":{{{}}},"geometry":{{"type":"Polygon","coordinates":[[[{},{}],[{},{}],[{},{}],[{},{}],[{},{}]]]}}}})",
        properties, w, s, e, s, e, n, w, n, w, s);
  }
  void write_houses(const std::string& features) const {
    write(
        "houses.geojson",
        R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::25830"}},"features":[)" +
            features + "]}");
  }

  /// A scene file with terrain and land cover, and what a test adds to it.
  [[nodiscard]] Scene read(const std::string& more = "", const std::string& in_scene = "") const {
    return read_scene(write(
        "place.toml", in_scene + "\n[terrain]\nfile = \"heights.asc\"\ncrs = \"EPSG:25830\"\nwater_level_m = 0\n" +
                          "[land_cover]\nfile = \"cover.asc\"\ncrs = \"EPSG:25830\"\n" + more));
  }
  [[nodiscard]] std::string fault(const std::string& more, const std::string& in_scene = "") const {
    return message_of_error([&] { static_cast<void>(read(more, in_scene)); });
  }

  ScratchFolder folder;
};

inline std::string material_at(const Scene& scene, Vec2d point) {
  return scene.materials[scene.ground.at(point)].name;
}

inline std::size_t remark_count(const Scene& scene, const std::string& what) {
  for (const Remark& remark : scene.remarks) {
    if (remark.what.find(what) != std::string::npos) return remark.count;
  }
  return 0;
}

}  // namespace sigmascape::scene
