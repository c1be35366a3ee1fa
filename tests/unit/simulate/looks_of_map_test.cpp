#include "sigmascape/simulate/looks_of_map.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "scratch_folder.h"

#include "sigmascape/atlas/atlas.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::simulate {
namespace {

constexpr double atlas_side_m = 1024.0;

/// Four patches about the origin of numbers that no two looks share.
atlas::Store made_up_store(const ScratchFolder& folder) {
  atlas::AtlasDescription description;
  description.name = "made up";
  description.extent = {-atlas_side_m / 2.0, -atlas_side_m / 2.0, atlas_side_m / 2.0, atlas_side_m / 2.0};
  description.patches = {2.0, 256};
  description.aspects = atlas::paper_aspect_grid();
  description.scene_hash = "none";
  auto store = atlas::Store::create(folder.path("atlas"), description);
  for (const atlas::Unit& unit : store.units()) {
    Array2D<radar::Channels> texels(256, 256);
    for (std::size_t i = 0; i < texels.size(); ++i) {
      const float power = unit_float(hashed(unit.look, i, static_cast<std::uint64_t>(unit.patch.x - 2 * unit.patch.y)));
      texels.values()[i] = {power, 0.5F * power, 0.1F * power, 0.2F * power};
    }
    store.write(unit.patch, unit.look, texels, {});
  }
  return store;
}

terrain::HeightField hills() {
  Array2D<float> heights(65, 65);
  for (std::size_t row = 0; row < 65; ++row) {
    for (std::size_t column = 0; column < 65; ++column)
      heights(column, row) =
          30.0F * std::sin(0.3F * static_cast<float>(column)) * std::cos(0.2F * static_cast<float>(row));
  }
  return {-atlas_side_m / 2.0, atlas_side_m / 2.0, atlas_side_m / 64.0, heights};
}

radar::RangeAzimuthImage map_of(const atlas::Atlas& atlas, const terrain::HeightField& terrain,
                                const radar::Radar& radar, const radar::Rectangle& area) {
  render::RenderCounts counts;
  return baked_image(atlas, terrain, radar, area, {}, counts);
}

// Whatever the map is blended from is among them, also where azimuths close, beyond the outermost elevations, under a
// radar over its map and in directions that were baked.
TEST(LooksOfMap, GiveTheMapOfAllLooksToTheBit) {
  const ScratchFolder folder;
  const atlas::Store store = made_up_store(folder);
  const terrain::HeightField terrain = hills();
  const atlas::Atlas all = atlas::load_atlas(store);
  std::size_t read = 0, looks = 0, maps = 0;
  for (const double azimuth_deg : {0.0, 44.9, 352.0}) {
    for (const double elevation_deg : {3.0, 8.6, 60.0, 89.0}) {
      for (const double range_m : {400.0, 20e3}) {
        radar::Radar radar;
        radar.position =
            radar::position_seeing({}, radians_from_deg(azimuth_deg), radians_from_deg(elevation_deg), range_m);
        if (radar.position.z < 40.0) continue;
        radar.range_resolution_m = 12.0;
        radar.beam_width_rad = 0.02;
        const radar::Rectangle area{-100.0, -150.0, 120.0, 60.0};
        const atlas::AspectSelection selection = looks_of_map(store.description().aspects, radar, area, terrain);
        const atlas::Atlas some = atlas::load_atlas(store, {.aspects = selection, .reading = atlas::Reading::AsAsked});
        const radar::RangeAzimuthImage of_some = map_of(some, terrain, radar, area),
                                       of_all = map_of(all, terrain, radar, area);
        ASSERT_TRUE(std::ranges::equal(of_some.rcs_m2.values(), of_all.rcs_m2.values()))
            << azimuth_deg << "°, " << elevation_deg << "°, " << range_m << " m";
        ++maps;
        looks += some.aspects().look_count();
        read += some.memory_bytes();
      }
    }
  }
  EXPECT_LT(2 * looks, maps * all.aspects().look_count());
  EXPECT_LT(3 * read, maps * all.memory_bytes());
}

TEST(LooksOfMap, AreTheFourAboutADistantRadar) {
  const terrain::HeightField terrain = hills();
  radar::Radar radar;
  radar.position = radar::position_seeing({}, radians_from_deg(130.0), radians_from_deg(9.0), 20e3);
  radar.beam_width_rad = 1e-3;
  const radar::Rectangle area{-100.0, -100.0, 100.0, 100.0};
  const atlas::AspectSelection looks = looks_of_map(atlas::paper_aspect_grid(), radar, area, terrain);
  EXPECT_EQ(looks.azimuths, (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(looks.elevations, (std::vector<std::size_t>{0, 1}));
  radar.position = radar::position_seeing({}, radians_from_deg(350.0), radians_from_deg(60.0), 20e3);
  const atlas::AspectSelection north = looks_of_map(atlas::paper_aspect_grid(), radar, area, terrain);
  EXPECT_EQ(north.azimuths, (std::vector<std::size_t>{0, 7}));
  EXPECT_EQ(north.elevations, (std::vector<std::size_t>{4}));
}

}  // namespace
}  // namespace sigmascape::simulate
