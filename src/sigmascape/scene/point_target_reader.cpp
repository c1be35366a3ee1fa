#include "sigmascape/scene/point_target_reader.h"

#include <fmt/format.h>

#include "sigmascape/radar/rcs_section.h"
#include "sigmascape/scene/placements.h"

namespace sigmascape::scene {
namespace {

std::optional<std::array<double, 2>> single_position(const TomlSection& section, std::string_view key, Interval range) {
  const auto values = section.numbers(key, range);
  if (!section.has(key)) return std::nullopt;
  if (values.size() != 2)
    throw section.fault(key, fmt::format("holds {} number{}", values.size(), values.size() == 1 ? "" : "s"),
                        "give two");
  return std::array{values[0], values[1]};
}

}  // namespace

PointTargetSource read_point_target_source(const TomlSection& section) {
  PointTargetSource source;
  source.where = section.where();
  source.target.name = section.text_or("name", source.where);
  source.target.height_m = section.number_or("height_m", {0.0, 100000.0, "m"}, 0.0);
  source.target.rcs_m2 = radar::rcs_of_section(section);
  source.in_frame_m = single_position(section, "position_m", {-1e6, 1e6, "m"});
  source.lat_lon_deg = single_position(section, "position_lat_lon_deg", {-360.0, 360.0, "degrees"});
  if (source.lat_lon_deg) require_on_globe(section, "position_lat_lon_deg", {&*source.lat_lon_deg, 1});
  section.refuse_unknown_keys();
  if (source.in_frame_m.has_value() == source.lat_lon_deg.has_value()) {
    throw Error(section.where(), "states its position not once", "give either position_m or position_lat_lon_deg");
  }
  return source;
}

void add_point_target(Scene& scene, const PointTargetSource& source) {
  Placements placement;
  if (source.in_frame_m) placement.in_frame_m = {*source.in_frame_m};
  if (source.lat_lon_deg) placement.lat_lon_deg = {*source.lat_lon_deg};
  PointTarget target = source.target;
  target.position = places_in(scene, placement).positions.front();
  if (!scene.extent.contains(target.position)) {
    throw Error(source.where,
                fmt::format("stands at ({:.1f}, {:.1f}) m, outside the scene", target.position.x, target.position.y),
                "move it inside or make the extent larger");
  }
  scene.point_targets.push_back(target);
}

}  // namespace sigmascape::scene
