#include "sigmascape/scene/traffic.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scene/vehicle_mesh.h"

namespace sigmascape::scene {
namespace {

constexpr double gap_m = 1.5;

/// A point on a line and which way the line runs there.
struct Station {
  Vec2d position, along;
};

double length_of(std::span<const Vec2d> line) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) sum += length(line[i + 1] - line[i]);
  return sum;
}

Station station_at(std::span<const Vec2d> line, double distance_m) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2d edge = line[i + 1] - line[i];
    const double edge_m = length(edge);
    if (edge_m > 0.0 && (distance_m <= edge_m || i + 2 == line.size())) {
      return {line[i] + edge * (distance_m / edge_m), edge * (1.0 / edge_m)};
    }
    distance_m -= edge_m;
  }
  return {line.back(), {0.0, 1.0}};
}

/// Of ten vehicles seven are cars, two vans, one a truck.
std::size_t kind_drawn(std::uint64_t draw) {
  const std::uint64_t digit = draw % 10;
  return digit < 7 ? 0 : digit < 9 ? 1 : 2;
}

}  // namespace

/// The vehicles of one lane or one kerb.
struct TrafficFlow::Stream {
  double per_km = 0.0;
  double offset_m = 0.0;  ///< to the right of the line
  bool along_line = true;
  double speed_mps = 0.0;
  std::uint64_t key = 0;
};

/// The room that a vehicle takes of its line.
struct TrafficFlow::Standing {
  double middle_m = 0.0;  ///< along the line
  double offset_m = 0.0;  ///< to the right of it
  VehicleSize size;

  [[nodiscard]] double half_m() const { return static_cast<double>(size.length_m) / 2.0; }
  [[nodiscard]] double end_m() const { return middle_m + half_m(); }
  [[nodiscard]] bool is_within(const Standing& other) const {
    return std::abs(middle_m - other.middle_m) < half_m() + other.half_m() &&
           std::abs(offset_m - other.offset_m) < static_cast<double>(size.width_m + other.size.width_m) / 2.0;
  }
  /// Moves it on until it stands in none of those.
  void move_past(const StandingByEnd& others) {
    const auto longest_m = static_cast<double>(vehicle_size(VehicleKind::Truck).length_m);
    for (auto near = others.upper_bound(middle_m - half_m()); near != others.end(); ++near) {
      if (near->first - longest_m > end_m()) return;
      if (is_within(near->second)) middle_m = near->first + gap_m + half_m();
    }
  }
};

Traffic read_traffic(const TomlSection& section, const MaterialTable& materials) {
  Traffic traffic;
  traffic.moving_per_km = section.number_or("moving_per_km", {0.0, 500.0, "vehicles per km"}, 0.0);
  traffic.parked_per_km = section.number_or("parked_per_km", {0.0, 500.0, "vehicles per km"}, 0.0);
  traffic.speed_mps = section.number_or("speed_kmh", {0.0, 400.0, "km/h"}, 50.0) / 3.6;
  traffic.drive_on_left = section.choice_or("drive_on", {"left", "right"}, "right") == "left";
  traffic.seed = static_cast<std::uint64_t>(section.whole_number_or("seed", {0, 1e15, ""}, 1));
  traffic.body = materials.named_by(section, "material", "metal");
  section.refuse_unknown_keys();
  return traffic;
}

TrafficFlow::TrafficFlow(Scene& scene, const Traffic& traffic) : scene_(scene), traffic_(traffic) {
  const MaterialIndex body = scene.material_index(traffic.body);
  std::size_t next = 0;
  for (const VehicleKind kind : {VehicleKind::Car, VehicleKind::Van, VehicleKind::Truck}) {
    prototype_[next++] = static_cast<std::uint32_t>(scene.prototypes.size());
    scene.prototypes.push_back(vehicle_mesh(kind, body));
  }
}

void TrafficFlow::fill(std::span<const Vec2d> line, double width_m, Way way, const WaterMask& water) {
  const std::uint64_t key = hashed(traffic_.seed, lines_++);
  const double lane_m = width_m / 4.0, kerb_m = std::max(0.0, width_m / 2.0 - 1.1);
  const double side = traffic_.drive_on_left ? -1.0 : 1.0;
  const double moving_per_km = traffic_.moving_per_km / 2.0, parked_per_km = traffic_.parked_per_km / 2.0;
  const bool ours = way != Way::Against, theirs = way == Way::Along;  // along the line, on either side of it
  StandingByEnd standing;
  fill(line, {parked_per_km, side * kerb_m, ours, 0.0, hashed(key, 3)}, water, standing);
  fill(line, {parked_per_km, -side * kerb_m, theirs, 0.0, hashed(key, 4)}, water, standing);
  fill(line, {moving_per_km, side * lane_m, ours, traffic_.speed_mps, hashed(key, 1)}, water, standing);
  fill(line, {moving_per_km, -side * lane_m, theirs, traffic_.speed_mps, hashed(key, 2)}, water, standing);
}

void TrafficFlow::fill(std::span<const Vec2d> line, const Stream& stream, const WaterMask& water,
                       StandingByEnd& standing) {
  constexpr double none_per_km = 1e-9;
  if (stream.per_km <= none_per_km || line.size() < 2) return;
  const double end_m = length_of(line), mean_m = 1000.0 / stream.per_km;
  double distance_m = 0.0, last_half_m = 0.0;
  for (std::uint64_t number = 0;; ++number) {
    const std::uint64_t draw = hashed(stream.key, number);
    const std::size_t kind = kind_drawn(mixed(draw));
    Standing vehicle{.offset_m = stream.offset_m, .size = vehicle_size(static_cast<VehicleKind>(kind))};
    const double half_m = vehicle.half_m();
    const double free_m = -mean_m * std::log1p(-static_cast<double>(unit_float(draw)));
    distance_m += std::max(free_m, number == 0 ? half_m : last_half_m + gap_m + half_m);
    last_half_m = half_m;
    vehicle.middle_m = distance_m;
    vehicle.move_past(standing);
    distance_m = vehicle.middle_m;
    if (vehicle.end_m() > end_m) return;

    const auto [position, along] = station_at(line, distance_m);
    const Vec2d place = position + Vec2d{along.y, -along.x} * stream.offset_m;
    const Vec2d heading = stream.along_line ? along : along * -1.0;
    if (!scene_.extent.contains(place) || in_water(scene_.ground.grid, water, place)) continue;
    standing.emplace(vehicle.end_m(), vehicle);
    scene_.instances.push_back({.prototype = prototype_[kind],
                                .x_m = static_cast<float>(place.x),
                                .y_m = static_cast<float>(place.y),
                                .yaw_rad = static_cast<float>(wrapped_azimuth(azimuth_of(heading))),
                                .speed_mps = static_cast<float>(stream.speed_mps)});
  }
}

}  // namespace sigmascape::scene
