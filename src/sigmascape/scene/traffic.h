#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>

#include "sigmascape/base/toml_reader.h"
#include "sigmascape/scene/land_cover_reader.h"
#include "sigmascape/scene/material_reader.h"
#include "sigmascape/scene/scene.h"

namespace sigmascape::scene {

/// Vehicles on roads, as a density.
struct Traffic {
  double moving_per_km = 0.0;  ///< both directions together
  double parked_per_km = 0.0;  ///< both sides together
  double speed_mps = 13.9;
  bool drive_on_left = false;
  std::uint64_t seed = 1;
  scatter::Material body;
};

/// Which way the moving vehicles of a line go.
enum class Way { Both, Along, Against };

/// Reads the table `traffic` of a [[roads]].
[[nodiscard]] Traffic read_traffic(const TomlSection& section, const MaterialTable& materials);

/// Sets vehicles on the roads of a scene one line after the other.
///
/// Places are drawn from the seed and the line's number: the distance between one vehicle and the next is exponential
/// about the density's mean, but never less than a vehicle's length and a gap. Moving vehicles keep to the middle of
/// their half of the road, parked ones to its edge; of a road of one way both halves go that way. None stands in water
/// or outside the scene, nor within another of its line: where a road is too narrow for both, a moving vehicle is moved
/// on past the parked ones beside it.
class TrafficFlow {
 public:
  /// Adds the vehicle meshes to the scene.
  TrafficFlow(Scene& scene, const Traffic& traffic);
  void fill(std::span<const Vec2d> line, double width_m, Way way, const WaterMask& water);

 private:
  struct Stream;
  struct Standing;
  using StandingByEnd = std::multimap<double, Standing>;  ///< by how far along the line they reach
  void fill(std::span<const Vec2d> line, const Stream& stream, const WaterMask& water, StandingByEnd& standing);

  Scene& scene_;
  Traffic traffic_;
  std::array<std::uint32_t, 3> prototype_{};  ///< car, van, truck
  std::uint64_t lines_ = 0;
};

}  // namespace sigmascape::scene
