#include "sigmascape/scene/paper_traffic.h"

#include <algorithm>

#include "sigmascape/base/hash.h"

namespace sigmascape::scene {
namespace {

/// One direction of driving: `offset_m` to the right of the middle of the road.
struct Lane {
  double offset_m, speed_mps, headway_m, truck_share;
};

constexpr Lane highway_lanes[] = {{9.0, 25.0, 62.0, 0.35}, {4.8, 34.0, 85.0, 0.0}};
constexpr Lane main_road_lane{1.75, 13.0, 70.0, 0.08};

class Fleet {
 public:
  Fleet(const PaintedGround& ground, const VehiclePrototypes& prototypes, std::uint64_t seed)
      : ground_(ground), prototypes_(prototypes), seed_(seed) {}

  [[nodiscard]] std::vector<Instance>& vehicles() { return vehicles_; }
  /// The next number in [0, 1).
  double draw() { return unit_float(hashed(seed_, ++drawn_)); }

  /// Adds a vehicle if all of its ground is paved and free.
  void add(Vec2d p, Vec2d heading, double truck_share, double speed_mps) {
    const double kind = draw();
    const std::uint32_t prototype = kind < truck_share          ? prototypes_.truck
                                    : kind < truck_share + 0.14 ? prototypes_.van
                                                                : prototypes_.car;
    if (!ground_.is_free(oriented_rectangle(p, heading, 5.0, 2.0), {GroundClass::Asphalt, GroundClass::Concrete}))
      return;
    vehicles_.push_back({.prototype = prototype,
                         .x_m = static_cast<float>(p.x),
                         .y_m = static_cast<float>(p.y),
                         .yaw_rad = static_cast<float>(azimuth_of(heading)),
                         .speed_mps = static_cast<float>(speed_mps)});
  }

 private:
  const PaintedGround& ground_;
  VehiclePrototypes prototypes_;
  std::uint64_t seed_;
  std::uint64_t drawn_ = 0;
  std::vector<Instance> vehicles_;
};

void drive(Fleet& fleet, const SmoothLine& road, const Lane& lane) {
  constexpr double slot_m = 18.0;  // longer than any vehicle, so that none touch
  for (const double sense : {-1.0, 1.0}) {
    road.for_each_step(slot_m, [&](Vec2d p, Vec2d direction) {
      if (fleet.draw() * lane.headway_m > slot_m) return;
      const Vec2d heading = direction * sense;
      const Vec2d place = p + right_of(heading) * lane.offset_m + heading * (4.0 * fleet.draw());
      fleet.add(place, heading, lane.truck_share, lane.speed_mps * (0.9 + 0.2 * fleet.draw()));
    });
  }
}

/// Cars at the kerb on the block's side of each of its streets, but not in the lanes of a main road.
void park_at_kerbs(Fleet& fleet, const TownBlock& block, const std::vector<SmoothLine>& main_roads) {
  constexpr double clear_of_corner_m = 12.0, slot_m = 6.2;
  constexpr double from_middle_m = roadway_half_width_m - 1.1;
  const double occupancy = block.use == BlockUse::Centre ? 0.5 : 0.2;
  const auto is_in_traffic = [&](Vec2d p) {
    return std::ranges::any_of(main_roads, [&](const SmoothLine& road) {
      return road.nearest_to(p).distance_m < main_road_half_width_m + 1.0;
    });
  };
  for (std::size_t i = 0; i < block.outline.size(); ++i) {
    const Vec2d from = block.outline[i], to = block.outline[(i + 1) % block.outline.size()];
    const double run_m = length(to - from);
    const Vec2d along = (to - from) * (1.0 / std::max(run_m, 1e-9));
    for (double along_m = clear_of_corner_m; along_m < run_m - clear_of_corner_m; along_m += slot_m) {
      const Vec2d p = from + along * along_m - right_of(along) * from_middle_m;
      if (fleet.draw() < occupancy && !is_in_traffic(p)) fleet.add(p, along, 0.0, 0.0);
    }
  }
}

/// Two rows of parking bays along one side of a paved yard.
void park_in_yard(Fleet& fleet, const TownBlock& block) {
  constexpr double bay_m = 2.7;
  const Vec2d edge = block.interior[1] - block.interior[0];
  const Vec2d along = edge * (1.0 / length(edge)), inward = right_of(along) * -1.0;
  for (const double inward_m : {4.0, 15.0}) {
    for (double along_m = 4.0; along_m < length(edge) - 4.0; along_m += bay_m) {
      if (fleet.draw() < 0.45) fleet.add(block.interior[0] + along * along_m + inward * inward_m, inward, 0.0, 0.0);
    }
  }
}

}  // namespace

std::vector<Instance> paper_traffic(const PaperLayout& layout, const PaperLandscape& landscape, const PaperTown& town,
                                    const VehiclePrototypes& prototypes) {
  Fleet fleet(landscape.ground, prototypes, hashed(layout.seed, 40));
  for (const Lane& lane : highway_lanes) drive(fleet, layout.highway, lane);
  for (const SmoothLine& road : layout.main_roads) drive(fleet, road, main_road_lane);
  for (const TownBlock& block : town.blocks) {
    park_at_kerbs(fleet, block, layout.main_roads);
    if (block.use == BlockUse::Halls) park_in_yard(fleet, block);
  }
  return std::move(fleet.vehicles());
}

}  // namespace sigmascape::scene
