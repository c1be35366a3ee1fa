#include "sigmascape/scene/paper_town.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/hash.h"
#include "sigmascape/scene/building_site.h"
#include "sigmascape/scene/town_lots.h"
#include "sigmascape/scene/value_noise.h"

namespace sigmascape::scene {
namespace {

constexpr double block_area_m2 = 7500.0;
constexpr double smallest_interior_m2 = 700.0;
constexpr double clear_of_highway_m = 22.0;
constexpr double buildings_per_block = 20.0;

/// Splits the blocks that a road runs through along it, so that houses can face it.
std::vector<ConvexPolygon> cut_along(const SmoothLine& road, const std::vector<ConvexPolygon>& blocks) {
  std::vector<ConvexPolygon> parts;
  for (const ConvexPolygon& block : blocks) {
    const NearestOnLine nearest = road.nearest_to(middle_of(block));
    if (nearest.distance_m > std::sqrt(area_m2(block))) {
      parts.push_back(block);
      continue;
    }
    for (const Vec2d direction : {nearest.direction, nearest.direction * -1.0}) {
      const ConvexPolygon part = left_part(block, nearest.point, direction);
      if (!part.empty()) parts.push_back(part);
    }
  }
  return parts;
}

bool is_left_of(const SmoothLine& line, Vec2d p) {
  const NearestOnLine nearest = line.nearest_to(p);
  return cross(nearest.direction, p - nearest.point) > 0.0;
}

bool is_buildable(const ConvexPolygon& interior, const PaperLayout& layout, const PaintedGround& ground) {
  constexpr GroundClasses dry{GroundClass::Concrete, GroundClass::Asphalt, GroundClass::Grass, GroundClass::Dirt,
                              GroundClass::ForestFloor};
  if (interior.empty() || area_m2(interior) < smallest_interior_m2 || !ground.is_free(interior, dry)) return false;
  const bool is_left = is_left_of(layout.highway, interior.front());
  return std::ranges::all_of(interior, [&](Vec2d corner) {
    return is_left_of(layout.highway, corner) == is_left &&
           layout.highway.nearest_to(corner).distance_m > highway_half_width_m + clear_of_highway_m;
  });
}

/// Small where the town has stood longest: near its centre and along the main roads, unevenly in all directions.
double age_rank(const PaperLayout& layout, Vec2d p) {
  double to_main_road_m = layout.town_radius_m;
  for (const SmoothLine& road : layout.main_roads)
    to_main_road_m = std::min(to_main_road_m, road.nearest_to(p).distance_m);
  const double uneven = fractal_noise(hashed(layout.seed, 20), p * (1.0 / (0.55 * layout.town_radius_m)), 2) - 0.5;
  return (length(p - layout.town_centre) + 0.5 * to_main_road_m) / layout.town_radius_m + 0.9 * uneven;
}

BlockUse use_of(const PaperLayout& layout, Vec2d middle, double rank, std::uint64_t key) {
  const double draw = unit_float(key);
  if (rank < 0.1) return BlockUse::Centre;
  if (draw < 0.05) return BlockUse::Park;
  if (layout.highway.nearest_to(middle).distance_m < 0.11 * layout.size.side_m && draw < 0.7) return BlockUse::Halls;
  if (rank < 0.25 && draw < 0.5) return BlockUse::Centre;
  return draw < 0.16 ? BlockUse::Apartments : BlockUse::Houses;
}

/// All places for blocks, oldest first.
std::vector<TownBlock> blocks_by_age(const PaperLayout& layout, const PaintedGround& ground) {
  std::vector<ConvexPolygon> outlines =
      partitioned(layout.square(), 0.15, {.target_area_m2 = block_area_m2}, hashed(layout.seed, 21));
  for (const SmoothLine& road : layout.main_roads) outlines = cut_along(road, outlines);
  std::vector<TownBlock> blocks;
  for (const ConvexPolygon& outline : outlines) {
    const ConvexPolygon interior = inset(outline, street_half_width_m);
    if (is_buildable(interior, layout, ground)) blocks.push_back({outline, interior});
  }
  std::ranges::stable_sort(blocks, {},
                           [&](const TownBlock& block) { return age_rank(layout, middle_of(block.outline)); });
  const double expected = static_cast<double>(layout.size.buildings) / buildings_per_block;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    blocks[i].use =
        use_of(layout, middle_of(blocks[i].outline), static_cast<double>(i) / expected, hashed(layout.seed, 22, i));
  }
  return blocks;
}

void build_farms(BuildingSite& site, const PaperLayout& layout, const std::vector<ConvexPolygon>& fields,
                 const TownMaterials& materials) {
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::uint64_t key = hashed(layout.seed, 23, i);
    const Vec2d place = middle_of(fields[i]);
    const bool is_rural = length(place - layout.town_centre) > 1.3 * layout.town_radius_m;
    if (is_rural && unit_float(key) < 0.12F) build_farm(site, place, materials, mixed(key));
  }
}

void pave_streets(PaintedGround& ground, const std::vector<TownBlock>& blocks) {
  constexpr GroundClasses unpaved{GroundClass::Grass, GroundClass::Dirt, GroundClass::ForestFloor};
  const auto pave = [&](double half_width_m, GroundClass surface, GroundClasses over) {
    for (const TownBlock& block : blocks) {
      for (std::size_t i = 0; i < block.outline.size(); ++i) {
        const ConvexPolygon street =
            strip(block.outline[i], block.outline[(i + 1) % block.outline.size()], half_width_m);
        if (!street.empty()) ground.paint(street, surface, over);
      }
    }
  };
  pave(street_half_width_m, GroundClass::Concrete, unpaved);
  pave(roadway_half_width_m, GroundClass::Asphalt,
       {GroundClass::Concrete, GroundClass::Grass, GroundClass::Dirt, GroundClass::ForestFloor});
}

/// Cottages here and there, should the blocks not have had room for all.
void build_cottages(BuildingSite& site, const PaperLayout& layout, const TownMaterials& materials) {
  constexpr std::uint64_t patience = 200'000;
  for (std::uint64_t attempt = 0; attempt < patience && !site.is_done(); ++attempt) {
    const std::uint64_t key = hashed(layout.seed, 24, attempt);
    const Vec2d place{unit_float(hashed(key, 0)) - 0.5, unit_float(hashed(key, 1)) - 0.5};
    build_cottage(site, place * layout.size.side_m, materials, hashed(key, 2));
  }
}

}  // namespace

PaperTown paper_town(const PaperLayout& layout, PaperLandscape& landscape, const TownMaterials& materials) {
  BuildingSite site(landscape.ground, layout.size.buildings);
  build_farms(site, layout, landscape.fields, materials);
  PaperTown town;
  const std::vector<TownBlock> candidates = blocks_by_age(layout, landscape.ground);
  for (std::size_t i = 0; i < candidates.size() && !site.is_done(); ++i) {
    build_block(site, candidates[i], materials, hashed(layout.seed, 25, i));
    town.blocks.push_back(candidates[i]);
  }
  pave_streets(landscape.ground, town.blocks);
  build_cottages(site, layout, materials);
  town.buildings = std::move(site.buildings());
  return town;
}

}  // namespace sigmascape::scene
