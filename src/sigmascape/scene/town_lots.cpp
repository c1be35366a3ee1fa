#include "sigmascape/scene/town_lots.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"

namespace sigmascape::scene {
namespace {

/// Numbers drawn one after another from a key. Two draws of one call belong in braces, which fix their order, where
/// that of a function's arguments is the compiler's choice.
class Draws {
 public:
  explicit Draws(std::uint64_t key) : key_(key) {}
  double between(double from, double to) {
    return std::lerp(from, to, static_cast<double>(unit_float(hashed(key_, next_++))));
  }
  bool chance(double probability) { return between(0.0, 1.0) < probability; }

 private:
  std::uint64_t key_;
  unsigned next_ = 0;
};

/// One side of a block, seen from the street: `along` to the right, `inward` away from the street.
struct Frontage {
  Vec2d from, along, inward;
  double length_m = 0.0;

  [[nodiscard]] Vec2d at(double along_m, double inward_m) const { return from + along * along_m + inward * inward_m; }
};

std::vector<Frontage> frontages_of(const ConvexPolygon& lot) {
  std::vector<Frontage> frontages;
  for (std::size_t i = 0; i < lot.size(); ++i) {
    const Vec2d edge = lot[(i + 1) % lot.size()] - lot[i];
    const double run = length(edge);
    if (run < 12.0) continue;
    const Vec2d along = edge * (1.0 / run);
    frontages.push_back({lot[i], along, {-along.y, along.x}, run});
  }
  return frontages;
}

Frontage longest_frontage(const ConvexPolygon& lot) {
  const std::vector<Frontage> frontages = frontages_of(lot);
  return frontages.empty() ? Frontage{} : *std::ranges::max_element(frontages, {}, &Frontage::length_m);
}

struct Plan {
  double length_m, depth_m;
};

RoofedBuilding shaped(Vec2d centre, Vec2d along, Plan plan, WallAndRoof materials) {
  return {.centre = centre,
          .along = along,
          .length_m = plan.length_m,
          .depth_m = plan.depth_m,
          .walls = materials.walls,
          .roofing = materials.roof};
}

RoofForm house_roof(Draws& draws) {
  const double kind = draws.between(0.0, 1.0);
  if (kind < 0.68) return RoofForm::Gabled;
  if (kind < 0.84) return RoofForm::Hipped;
  return kind < 0.94 ? RoofForm::FlatLShaped : RoofForm::Flat;
}

RoofedBuilding house(Vec2d centre, const Frontage& street, WallAndRoof materials, Draws& draws) {
  const double length_m = draws.between(9.0, 11.8), depth_m = draws.between(8.0, 9.5);
  const bool gable_to_street = draws.chance(0.3);
  RoofedBuilding shape = shaped(centre, gable_to_street ? street.inward : street.along, {length_m, depth_m}, materials);
  shape.roof = house_roof(draws);
  shape.eaves_m = draws.chance(0.45) ? draws.between(5.2, 6.2) : draws.between(2.9, 3.8);
  shape.roof_rise_m = depth_m / 2.0 * std::tan(radians_from_deg(draws.between(28.0, 45.0)));
  return shape;
}

RoofedBuilding shed(Vec2d centre, const Frontage& street, WallAndRoof materials, Draws& draws) {
  RoofedBuilding shape = shaped(centre, street.inward, {draws.between(5.0, 6.5), draws.between(3.0, 4.0)}, materials);
  shape.roof = draws.chance(0.75) ? RoofForm::Flat : RoofForm::Gabled;
  shape.eaves_m = draws.between(2.3, 2.7);
  shape.roof_rise_m = 1.2;
  return shape;
}

void build_houses(BuildingSite& site, const ConvexPolygon& lot, const TownMaterials& materials, Draws& draws) {
  const double lot_width_m = draws.between(12.8, 16.0);
  for (const Frontage& street : frontages_of(lot)) {
    const double front_garden_m = draws.between(3.0, 5.5);
    const double count = std::floor((street.length_m - 2.0) / lot_width_m);
    for (double n = 0.5; n < count; n += 1.0) {
      const double along_m = n * street.length_m / count;
      const double aside_m = draws.between(-1.0, 1.0), back_m = draws.between(5.5, 6.5);
      const RoofedBuilding home =
          house(street.at(along_m + aside_m, front_garden_m + back_m), street, materials.house, draws);
      const bool built = site.put_up(home, lot);
      if (built && draws.chance(0.6))
        site.put_up(
            shed(street.at(along_m + 6.0, front_garden_m + draws.between(13.0, 21.0)), street, materials.house, draws),
            lot);
    }
  }
}

/// Town houses nearly wall to wall along the streets, and workshops in the courtyards.
void build_centre(BuildingSite& site, const ConvexPolygon& lot, const TownMaterials& materials, Draws& draws) {
  for (const Frontage& street : frontages_of(lot)) {
    double along_m = 1.0;
    while (along_m < street.length_m - 8.0) {
      const double width_m = draws.between(9.0, 17.0), depth_m = draws.between(10.5, 12.5);
      RoofedBuilding shape = shaped(street.at(along_m + width_m / 2.0, 1.5 + depth_m / 2.0), street.along,
                                    {width_m, depth_m}, materials.block);
      shape.eaves_m = 3.1 * std::floor(draws.between(2.6, 5.4)) + 0.8;
      shape.roof_rise_m = draws.between(3.0, 4.5);
      shape.roof = draws.chance(0.65) ? RoofForm::Gabled : draws.chance(0.5) ? RoofForm::FlatWithHouse : RoofForm::Flat;
      along_m += site.put_up(shape, lot) ? width_m + 1.6 : 2.0;
    }
    for (double yard_m = 14.0; yard_m < street.length_m - 14.0; yard_m += draws.between(18.0, 34.0)) {
      RoofedBuilding workshop = shed(street.at(yard_m, draws.between(20.0, 26.0)), street, materials.block, draws);
      workshop.length_m *= 1.5;
      workshop.depth_m *= 1.6;
      workshop.eaves_m = draws.between(3.0, 5.5);
      site.put_up(workshop, lot);
    }
  }
}

/// Parallel slabs with lawns between them.
void build_apartments(BuildingSite& site, const ConvexPolygon& lot, const TownMaterials& materials, Draws& draws) {
  const Frontage street = longest_frontage(lot);
  const double floors = std::floor(draws.between(4.0, 9.0));
  const bool slabs_across = draws.chance(0.5);
  const double pitch_across_m = slabs_across ? 46.0 : 27.0, pitch_along_m = slabs_across ? 26.0 : 46.0;
  for (double inward_m = slabs_across ? 24.0 : 12.0; inward_m < 160.0; inward_m += pitch_across_m) {
    for (double along_m = slabs_across ? 12.0 : 23.0; along_m < street.length_m; along_m += pitch_along_m) {
      RoofedBuilding slab = shaped(street.at(along_m, inward_m), slabs_across ? street.inward : street.along,
                                   {draws.between(30.0, 38.0), draws.between(11.0, 13.0)}, materials.block);
      slab.eaves_m = 2.9 * floors + 1.0;
      slab.roof = draws.chance(0.35) ? RoofForm::FlatWithHouse : RoofForm::Flat;
      if (!site.put_up(slab, lot)) {
        slab.length_m = 20.0;
        site.put_up(slab, lot);
      }
    }
  }
}

/// Large flat halls on paved ground.
void build_halls(BuildingSite& site, const ConvexPolygon& lot, const TownMaterials& materials, Draws& draws) {
  const Frontage street = longest_frontage(lot);
  for (double inward_m = 20.0; inward_m < 160.0; inward_m += 44.0) {
    for (double along_m = 26.0; along_m < street.length_m; along_m += 52.0) {
      RoofedBuilding hall = shaped(street.at(along_m, inward_m), street.along,
                                   {draws.between(32.0, 44.0), draws.between(20.0, 28.0)}, materials.hall);
      hall.eaves_m = draws.between(6.5, 10.0);
      hall.roof = draws.chance(0.25) ? RoofForm::FlatLShaped : draws.chance(0.3) ? RoofForm::Gabled : RoofForm::Flat;
      hall.roof_rise_m = 2.2;
      while (hall.length_m > 12.0 && !site.put_up(hall, lot)) {
        hall.length_m *= 0.75;
        hall.depth_m *= 0.85;
      }
    }
  }
}

}  // namespace

void build_block(BuildingSite& site, const TownBlock& block, const TownMaterials& materials, std::uint64_t key) {
  Draws draws(key);
  const bool paved = block.use == BlockUse::Halls || (block.use == BlockUse::Centre && draws.chance(0.6));
  site.ground().paint(block.interior, paved ? GroundClass::Concrete : GroundClass::Grass, soft_ground);
  switch (block.use) {
    case BlockUse::Centre:
      return build_centre(site, block.interior, materials, draws);
    case BlockUse::Houses:
      return build_houses(site, block.interior, materials, draws);
    case BlockUse::Apartments:
      return build_apartments(site, block.interior, materials, draws);
    case BlockUse::Halls:
      return build_halls(site, block.interior, materials, draws);
    case BlockUse::Park:
      return;
  }
}

void build_farm(BuildingSite& site, Vec2d place, const TownMaterials& materials, std::uint64_t key) {
  Draws draws(key);
  const double angle = draws.between(0.0, 2.0 * pi);
  const Vec2d along{std::cos(angle), std::sin(angle)};
  const ConvexPolygon yard = oriented_rectangle(place, along, 60.0, 50.0);
  if (!site.ground().is_free(yard, {GroundClass::Grass, GroundClass::Dirt})) return;
  site.ground().paint(yard, GroundClass::Grass);
  site.ground().paint(oriented_rectangle(place, along, 32.0, 18.0), GroundClass::Concrete);
  const Frontage side{yard[0], along, {-along.y, along.x}, 60.0};
  RoofedBuilding barn =
      shaped(side.at(26.0, 40.5), along, {draws.between(24.0, 32.0), draws.between(11.0, 13.0)}, materials.hall);
  barn.eaves_m = draws.between(4.5, 6.0);
  barn.roof_rise_m = 3.2;
  site.put_up(barn, yard);
  site.put_up(house(side.at(20.0, 9.0), side, materials.house, draws), yard);
  RoofedBuilding stable = shaped(side.at(52.5, 22.0), side.inward, {draws.between(14.0, 20.0), 8.0}, materials.house);
  stable.eaves_m = 3.2;
  site.put_up(stable, yard);
}

void build_cottage(BuildingSite& site, Vec2d place, const TownMaterials& materials, std::uint64_t key) {
  Draws draws(key);
  const double angle = draws.between(0.0, 2.0 * pi);
  const Vec2d along{std::cos(angle), std::sin(angle)};
  const ConvexPolygon garden = oriented_rectangle(place, along, 16.0, 14.0);
  if (!site.ground().is_free(garden, {GroundClass::Grass, GroundClass::Dirt})) return;
  site.ground().paint(garden, GroundClass::Grass);
  site.put_up(house(place, {place, along, {-along.y, along.x}, 16.0}, materials.house, draws), garden);
}

}  // namespace sigmascape::scene
