#include "sigmascape/scene/paper_trees.h"

#include <algorithm>

#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scene/tree_mesh.h"
#include "sigmascape/scene/value_noise.h"

namespace sigmascape::scene {
namespace {

constexpr double clear_of_buildings_m = 2.2;
constexpr double largest_share_outside_forests = 0.3;

/// A place where a tree could grow; among too many, those of the lowest `order` are taken.
struct TreePlace {
  Vec2d position;
  float height_m = 0.0F;
  std::uint64_t order = 0;
};

Vec2d jitter(std::uint64_t key) {
  return {unit_float(hashed(key, 0)) - 0.5, unit_float(hashed(key, 1)) - 0.5};
}

void keep_first(std::vector<TreePlace>& places, std::size_t count) {
  if (places.size() > count) {
    std::ranges::nth_element(places, places.begin() + static_cast<std::ptrdiff_t>(count), {}, &TreePlace::order);
    places.resize(count);
  }
  std::ranges::sort(places, {}, &TreePlace::order);
}

class Planter {
 public:
  Planter(const PaintedGround& ground, std::uint64_t seed) : ground_(ground), seed_(seed) {}

  [[nodiscard]] std::vector<TreePlace>& places() { return places_; }

  /// Plants where the ground is soft, with a chance of `probability`.
  void plant(Vec2d p, double probability, double lowest_m, double highest_m) {
    const std::uint64_t key = hashed(seed_, ++asked_);
    if (unit_float(hashed(key, 2)) >= probability) return;
    if (!ground_.is_free_around(p, clear_of_buildings_m, {GroundClass::Grass, GroundClass::Dirt})) return;
    places_.push_back(
        {p, static_cast<float>(std::lerp(lowest_m, highest_m, unit_float(hashed(key, 3)))), hashed(key, 4)});
  }

  /// Plants on a loose grid over a polygon.
  void plant_over(const ConvexPolygon& polygon, double spacing_m, double probability, double lowest_m,
                  double highest_m) {
    const radar::GroundGrid extent = ground_.grid();
    const auto count = static_cast<std::size_t>(extent.extent().width_m() / spacing_m);
    const radar::GroundGrid coarse{
        .west_m = extent.west_m, .north_m = extent.north_m, .cell_m = spacing_m, .columns = count, .rows = count};
    for_each_cell(coarse, polygon, [&](std::size_t column, std::size_t row) {
      const Vec2d moved = jitter(hashed(seed_, 5, column, row)) * (0.9 * spacing_m);
      plant(coarse.centre_of(column, row) + moved, probability, lowest_m, highest_m);
    });
  }

 private:
  const PaintedGround& ground_;
  std::uint64_t seed_;
  std::uint64_t asked_ = 0;
  std::vector<TreePlace> places_;
};

void plant_town(Planter& planter, const PaperTown& town) {
  for (const TownBlock& block : town.blocks) {
    const bool is_park = block.use == BlockUse::Park;
    planter.plant_over(block.interior, is_park ? 7.5 : 9.0, is_park ? 0.75 : 0.3, is_park ? 8.0 : 4.0,
                       is_park ? 16.0 : 8.5);
  }
}

void plant_avenues(Planter& planter, const PaperLayout& layout) {
  for (const SmoothLine& road : layout.main_roads) {
    road.for_each_step(11.0, [&](Vec2d p, Vec2d direction) {
      for (const double side : {-1.0, 1.0})
        planter.plant(p + right_of(direction) * (side * (main_road_half_width_m + 2.9)), 0.85, 7.0, 11.0);
    });
  }
}

void plant_hedges(Planter& planter, const PaperLayout& layout, const std::vector<ConvexPolygon>& fields) {
  for (std::size_t field = 0; field < fields.size(); ++field) {
    for (std::size_t i = 0; i < fields[field].size(); ++i) {
      if (unit_float(hashed(layout.seed, 30, field, i)) > 0.4F) continue;
      const Vec2d from = fields[field][i], to = fields[field][(i + 1) % fields[field].size()];
      for (double along_m = 3.0; along_m < length(to - from); along_m += 5.5) {
        const Vec2d p = from + (to - from) * (along_m / length(to - from));
        planter.plant(p + jitter(hashed(layout.seed, 31, field, i, static_cast<std::uint64_t>(along_m))) * 1.6, 0.7,
                      5.0, 11.0);
      }
    }
  }
}

void plant_river_banks(Planter& planter, const PaperLayout& layout) {
  layout.river.for_each_step(6.0, [&](Vec2d p, Vec2d direction) {
    for (const double side : {-1.0, 1.0}) {
      const double away = layout.river_half_width_m + 5.0 + 6.0 * value_noise(layout.seed, p * 0.37);
      planter.plant(p + right_of(direction) * (side * away), 0.5, 7.0, 14.0);
    }
  });
}

/// Candidate places on a loose grid over the forests.
std::vector<TreePlace> forest_places(const PaperLayout& layout, const PaintedGround& ground, double spacing_m,
                                     GroundClasses wanted) {
  std::vector<TreePlace> places;
  const auto count = static_cast<std::size_t>(layout.size.side_m / spacing_m);
  const double west = ground.grid().west_m, north = ground.grid().north_m;
  for (std::size_t row = 0; row < count; ++row) {
    for (std::size_t column = 0; column < count; ++column) {
      const std::uint64_t key = hashed(layout.seed, 32, column, row);
      const Vec2d cell{static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5};
      const Vec2d p = Vec2d{west + cell.x * spacing_m, north - cell.y * spacing_m} + jitter(key) * (0.85 * spacing_m);
      if (!ground.is_free_around(p, clear_of_buildings_m, soft_ground) || !ground.is_free(p, wanted)) continue;
      const double stand = fractal_noise(hashed(layout.seed, 33), p * (1.0 / 120.0), 3);
      places.push_back({p, static_cast<float>(8.0 + 6.0 * stand + 4.0 * unit_float(hashed(key, 2))), hashed(key, 3)});
    }
  }
  return places;
}

/// As many forest trees as wanted, evenly spread: the grid is drawn closer until there are enough places, in the end
/// also on meadows.
std::vector<TreePlace> forest_of(const PaperLayout& layout, const PaintedGround& ground, std::size_t wanted) {
  constexpr double widest_m = 6.0, closest_m = 1.0, tightening = 0.96;
  std::vector<TreePlace> places;
  for (double spacing_m = widest_m; places.size() < wanted && spacing_m > closest_m; spacing_m *= tightening) {
    const GroundClasses where = spacing_m > 2.5 ? GroundClasses{GroundClass::ForestFloor} : soft_ground;
    places = forest_places(layout, ground, spacing_m, where);
  }
  keep_first(places, wanted);
  return places;
}

Instance planted(const TreePlace& place, const PaperLayout& layout, const TreePrototypes& prototypes) {
  const auto uniform = [&](unsigned n) { return unit_float(hashed(place.order, n)); };
  const double conifers =
      smooth_step(0.48, 0.6, fractal_noise(hashed(layout.seed, 34), place.position * (1.0 / 220.0), 4));
  const bool is_conifer = place.height_m > 8.0F && uniform(0) < 0.9 * conifers;
  const std::uint32_t first = is_conifer ? prototypes.first_conifer : prototypes.first_broadleaf;
  const std::uint32_t count = is_conifer ? prototypes.conifer_count : prototypes.broadleaf_count;
  const float crown_radius_m = place.height_m * (is_conifer ? 0.2F : 0.28F) * (0.85F + 0.3F * uniform(1));
  return {.prototype = first + static_cast<std::uint32_t>(uniform(2) * static_cast<float>(count)),
          .x_m = static_cast<float>(place.position.x),
          .y_m = static_cast<float>(place.position.y),
          .yaw_rad = static_cast<float>(2.0 * pi) * uniform(3),
          .scale = tree_scale(place.height_m, crown_radius_m)};
}

}  // namespace

std::vector<Instance> paper_trees(const PaperLayout& layout, const PaperLandscape& landscape, const PaperTown& town,
                                  const TreePrototypes& prototypes) {
  Planter planter(landscape.ground, hashed(layout.seed, 35));
  plant_town(planter, town);
  plant_avenues(planter, layout);
  plant_hedges(planter, layout, landscape.fields);
  plant_river_banks(planter, layout);
  std::vector<TreePlace> places = std::move(planter.places());
  keep_first(places, static_cast<std::size_t>(largest_share_outside_forests * static_cast<double>(layout.size.trees)));
  const std::vector<TreePlace> forest = forest_of(layout, landscape.ground, layout.size.trees - places.size());
  places.insert(places.end(), forest.begin(), forest.end());

  std::vector<Instance> trees;
  trees.reserve(places.size());
  for (const TreePlace& place : places) trees.push_back(planted(place, layout, prototypes));
  return trees;
}

}  // namespace sigmascape::scene
