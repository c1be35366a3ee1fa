#include "sigmascape/scene/point_target_reader.h"

#include <cmath>
#include <fmt/format.h>

#include "sigmascape/base/units.h"
#include "sigmascape/scene/placements.h"

namespace sigmascape::scene {
namespace {

constexpr Interval rcs_range{-100.0, 100.0, "dBm²"};

radar::Channels read_rcs(const TomlSection& section) {
  double vv = 0.0, hh = 0.0, hv = 0.0;
  if (!section.is_table("rcs_dbsm")) {
    vv = hh = linear_from_db(section.number("rcs_dbsm", rcs_range));
  } else {
    const auto table = section.section("rcs_dbsm");
    const auto power = [&table](std::string_view key) {
      const auto rcs_dbsm = table->optional_number(key, rcs_range);
      return rcs_dbsm ? linear_from_db(*rcs_dbsm) : 0.0;
    };
    vv = power("vv");
    hh = power("hh");
    hv = power("hv");
    table->refuse_unknown_keys();
  }
  const double sign = section.choice_or("bounces", {"odd", "even"}, "odd") == "odd" ? 1.0 : -1.0;
  return {static_cast<float>(vv), static_cast<float>(hh), static_cast<float>(hv),
          static_cast<float>(sign * std::sqrt(vv * hh))};
}

std::optional<std::array<double, 2>> single_position(const TomlSection& section, std::string_view key, Interval range) {
  const auto values = section.numbers(key, range);
  if (!section.has(key)) return std::nullopt;
  if (values.size() != 2) throw section.fault(key, fmt::format("holds {} numbers", values.size()), "give two");
  return std::array{values[0], values[1]};
}

}  // namespace

PointTargetSource read_point_target_source(const TomlSection& section) {
  PointTargetSource source;
  source.where = section.where();
  source.target.name = section.text_or("name", source.where);
  source.target.height_m = section.number_or("height_m", {0.0, 100000.0, "m"}, 0.0);
  source.target.rcs_m2 = read_rcs(section);
  source.in_frame_m = single_position(section, "position_m", {-1e6, 1e6, "m"});
  source.lat_lon_deg = single_position(section, "position_lat_lon_deg", {-360.0, 360.0, "degrees"});
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
  target.position = positions_in(scene, placement).front();
  if (!scene.extent.contains(target.position)) {
    throw Error(source.where,
                fmt::format("stands at ({:.1f}, {:.1f}) m, outside the scene", target.position.x, target.position.y),
                "move it inside or make the extent larger");
  }
  scene.point_targets.push_back(target);
}

}  // namespace sigmascape::scene
