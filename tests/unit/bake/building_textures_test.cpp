// What buildings that are kept apart return, in textures of their own beside those of the atlas.
#include "sigmascape/atlas/building_textures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <memory>
#include <utility>
#include <vector>

#include "keep_worst.h"
#include "scratch_folder.h"

#include "sigmascape/atlas/atlas_summary.h"
#include "sigmascape/atlas/levels_above.h"
#include "sigmascape/atlas/tile_reader.h"
#include "sigmascape/atlas/verify.h"
#include "sigmascape/bake/bake.h"
#include "sigmascape/bake/plan.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scene/building_extrusion.h"

namespace sigmascape::bake {
namespace {

/// A house and a taller one behind it on nine patches, where four of them meet.
scene::Scene two_houses() {
  scene::Scene scene;
  scene.name = "two houses";
  scene.extent = {0, 0, 520, 520};
  scene.terrain = {0, 520, 520, Array2D<float>(2, 2, 50.0F)};
  const scatter::Material ground{
      .name = "ground", .model = scatter::ConstantGammaParameters{0.03, {0.1, 0.5}}, .source = {}};
  const scatter::Material wall{.name = "wall", .model = scatter::LambertParameters{0.5, {0.1, 0.5}}, .source = {}};
  scene.ground = {{0, 520, 520, 1, 1}, Array2D<scene::MaterialIndex>(1, 1, scene.material_index(ground))};
  const scene::MaterialIndex of_wall = scene.material_index(wall);
  const auto put = [&](Vec2d middle, double height_m) {
    geo::Polygon outline;
    for (const Vec2d corner : {Vec2d{-12, -8}, {12, -8}, {12, 8}, {-12, 8}}) outline.outer.push_back(middle + corner);
    scene::append_building(scene.buildings, outline, height_m, 50.0, of_wall, of_wall);
  };
  put({256.0, 236.0}, 9.0);
  put({261.0, 271.0}, 22.0);
  return scene;
}

BakeSettings settings_of(Buildings buildings) {
  BakeSettings settings;
  settings.aspects = {{radians_from_deg(130.0)}, {radians_from_deg(20.0)}, {9e9, 10e9}};
  settings.patches = {1.0, 256};
  settings.sampling.samples_per_texel = 2;
  settings.max_bounces = 2;
  settings.digits = atlas::Digits::All;
  settings.buildings = buildings;
  return settings;
}

/// Bakes a share into a folder.
atlas::Store baked_atlas(Buildings buildings, const std::filesystem::path& folder, const Shard& shard = {}) {
  SilentProgress silent;
  bake(two_houses(), settings_of(buildings), folder, silent, {shard});
  return atlas::Store::open(folder);
}

/// Baked once for all tests.
class BuildingTextures : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<ScratchFolder>();
    for (const auto& [buildings, name] : {std::pair{Buildings::Baked, "baked"}, {Buildings::Both, "both"}})
      static_cast<void>(baked_atlas(buildings, folder_->path(name)));
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static atlas::Store with() { return atlas::Store::open(folder_->path("baked")); }
  static atlas::Store both() { return atlas::Store::open(folder_->path("both")); }
  /// One to be damaged.
  static atlas::Store copy_of_both(const ScratchFolder& folder) {
    std::filesystem::copy(both().folder(), folder.path("copy"), std::filesystem::copy_options::recursive);
    return atlas::Store::open(folder.path("copy"));
  }

 private:
  static inline std::unique_ptr<ScratchFolder> folder_;
};

double power_of(const radar::Channels& texel) {
  return static_cast<double>(texel.power(radar::Polarization::Sum));
}

TEST_F(BuildingTextures, AddUpWithTheOthersToThoseThatHaveAll) {
  const ScratchFolder folder;
  const atlas::Store apart = baked_atlas(Buildings::Apart, folder.path("apart"));
  ASSERT_TRUE(atlas::keeps_building_textures(both().description()));
  EXPECT_FALSE(atlas::keeps_building_textures(apart.description()));
  const atlas::Store alone = atlas::open_building_textures(both());
  double of_buildings = 0.0, of_all = 0.0;
  for (const atlas::Unit& unit : with().units()) {
    const auto whole = with().read(unit.patch, unit.look).front(), rest = both().read(unit.patch, unit.look).front(),
               houses = alone.read(unit.patch, unit.look).front();
    EXPECT_TRUE(std::ranges::equal(rest.values(), apart.read(unit.patch, unit.look).front().values()));
    for (std::size_t i = 0; i < whole.size(); ++i) {
      const double all = power_of(whole.values()[i]), house = power_of(houses.values()[i]);
      // Each is told to the last bit of a half.
      EXPECT_NEAR(power_of(rest.values()[i]) + house, all, 2e-3 * all + 1e-7);
      of_buildings += house;
      of_all += all;
    }
  }
  EXPECT_GT(of_buildings, 0.2 * of_all);
  EXPECT_LT(of_buildings, 0.99 * of_all) << "from wall to ground and back it goes over several surfaces";
}

// Of every level, as frames read them.
TEST_F(BuildingTextures, AreAddedToTilesAsTheyAreRead) {
  const atlas::TileReader of_all(with()), summed(both());
  ASSERT_EQ(summed.levels(), 3U) << "two above the patches";
  const auto sigma0_of = [](const atlas::TileReader& tiles, const atlas::TileAddress& tile, atlas::LookIndex look) {
    std::vector<atlas::Half> halves(atlas::TileReader::tile_halves);
    const double unit = tiles.read(tile, look, std::span<atlas::Half, atlas::TileReader::tile_halves>(halves));
    EXPECT_GT(unit, 0.0);
    std::vector<double> sigma0;
    for (const atlas::Half half : halves)
      sigma0.push_back(unit * static_cast<double>(atlas::float_from_finite_half(half)));
    return sigma0;
  };
  for (const atlas::TileAddress& tile :
       {atlas::TileAddress{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 2, 2}, {1, 0, 0}, {2, 0, 0}}) {
    for (atlas::LookIndex look = 0; look < 2; ++look) {
      const auto expected = sigma0_of(of_all, tile, look), found = sigma0_of(summed, tile, look);
      const double brightest = std::ranges::max(expected);
      double worst = 0.0;
      for (std::size_t i = 0; i < expected.size(); ++i)
        keep_worst(worst, std::abs(found[i] - expected[i]) / (std::abs(expected[i]) + 1e-4 * brightest + 1e-30));
      EXPECT_LT(worst, 5e-3) << tile.level << ": " << tile.x << ", " << tile.y << ", look " << look;
    }
  }
  EXPECT_EQ(summed.damaged(), 0U);
}

TEST_F(BuildingTextures, AreNotLeftOutOfTilesWithoutAWord) {
  const ScratchFolder folder;
  const atlas::Store store = copy_of_both(folder);
  std::filesystem::resize_file(store.folder() / "buildings" / store.texture_path({1, 1}, 0), 100);
  const atlas::TileReader tiles(store);
  std::vector<atlas::Half> halves(atlas::TileReader::tile_halves);
  const auto unit_of = [&](const atlas::TileAddress& tile) {
    return tiles.read(tile, 0, std::span<atlas::Half, atlas::TileReader::tile_halves>(halves));
  };
  EXPECT_EQ(unit_of({0, 1, 1}), 0.0);
  EXPECT_GT(unit_of({0, 0, 0}), 0.0);
  EXPECT_EQ(tiles.damaged(), 1U);
}

TEST_F(BuildingTextures, AreBakedTheSameInSharesAndAfterALoss) {
  const ScratchFolder folder;
  for (const std::size_t index : {1U, 0U}) baked_atlas(Buildings::Both, folder.path("two"), {index, 2});
  const auto whole = files_of(both().folder());
  EXPECT_EQ(difference_of(whole, files_of(folder.path("two"))), "");

  const atlas::Store store = atlas::Store::open(folder.path("two"));
  const std::filesystem::path lost = std::filesystem::path("buildings") / store.texture_path({1, 0}, 1);
  std::filesystem::remove(store.folder() / lost);
  const auto faults = atlas::verify(store);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults.front().file, lost);
  SilentProgress silent;
  const std::size_t looks = store.unit_count();
  EXPECT_EQ(atlas::summary_of(store).looks_done, looks - 1);
  EXPECT_EQ(plan(two_houses(), settings_of(Buildings::Both), store.folder(), silent).already, looks - 1);
  const BakeReport again = bake(two_houses(), settings_of(Buildings::Both), store.folder(), silent);
  EXPECT_EQ(again.already, looks - 1);
  ASSERT_EQ(again.mended.size(), 1U);
  EXPECT_EQ(again.mended.front().file, lost);
  EXPECT_EQ(difference_of(whole, files_of(store.folder())), "");
}

// Though the textures lack it, rays go by what buildings return as well: it is in the map.
TEST(BuildingsApartFromTextures, NeedNoMoreRays) {
  const ScratchFolder folder;
  scene::Scene scene = two_houses();
  scene.extent = {200, 200, 312, 312};
  const auto report_of = [&](Buildings buildings, const char* name) {
    BakeSettings settings = settings_of(buildings);
    settings.sampling = {};
    SilentProgress silent;
    return bake(scene, settings, folder.path(name), silent);
  };
  const BakeReport with = report_of(Buildings::Baked, "baked"), apart = report_of(Buildings::Apart, "apart"),
                   both = report_of(Buildings::Both, "both");
  EXPECT_LE(apart.counts.paths, with.counts.paths);
  EXPECT_EQ(both.counts.paths, apart.counts.paths);
  // Of all that returns; what maps make of buildings has no noise.
  EXPECT_LT(*apart.errors.relative(), *with.errors.relative());
  EXPECT_EQ(*both.errors.relative(), *apart.errors.relative());
  EXPECT_NEAR(*apart.errors.part_of_all(), *with.errors.part_of_all(), 1e-3);
}

atlas::AtlasSummary::Layer textures_told_of(const atlas::Store& store) {
  return atlas::summary_of(store).buildings.value().textures.value();
}

TEST_F(BuildingTextures, AreCountedAndTheirLevelsMadeAnew) {
  const ScratchFolder folder;
  const atlas::Store store = copy_of_both(folder);
  const atlas::AtlasSummary::Files all = textures_told_of(store).textures;
  EXPECT_EQ(all.planned, (9U + 4U + 1U) * 2U) << "nine patches, and the tiles of two levels above them";
  EXPECT_EQ(all.done, all.planned);
  for (const char* level : {"pyramid_1", "pyramid_2"})
    std::filesystem::remove_all(store.folder() / "buildings" / level);
  EXPECT_EQ(textures_told_of(store).textures.done, 9U * 2U);
  const atlas::LevelsAbove made = atlas::make_levels_above(store);
  EXPECT_EQ(made.written.buildings, (4U + 1U) * 2U);
  EXPECT_EQ(made.written.all(), made.written.buildings);
  EXPECT_EQ(difference_of(files_of(both().folder()), files_of(store.folder())), "");

  std::filesystem::remove(store.folder() / "buildings" / "collection.json");
  ASSERT_TRUE(textures_told_of(store).fault);
  EXPECT_EQ(atlas::verify(store).front().file, "buildings/collection.json");
}

}  // namespace
}  // namespace sigmascape::bake
