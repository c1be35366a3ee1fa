#include "sigmascape/live/live_obstacles.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "live_ground_example.h"

#include "sigmascape/base/hash.h"
#include "sigmascape/radar/answering_tops.h"

namespace sigmascape::live {
namespace {

/// Houses of many heights among trees, blocks of 8 m.
radar::Obstacle town(Vec2d point) {
  const auto key = hashed(static_cast<std::int64_t>(std::floor(point.x / 8.0)),
                          static_cast<std::int64_t>(std::floor(point.y / 8.0)));
  if (key % 16 == 0) return {.solid_top_m = 4.0F + static_cast<float>(key / 16 % 8)};
  if (key % 16 < 12) return {};
  return {.crown_base_m = 2.0F, .crown_top_m = 10.0F, .crown_extinction_per_m = 0.0625F};
}

/// What stands on 4 km × 4 km of squares of 2 m, in 64 patches, and nothing else.
atlas::Store town_alone(const std::filesystem::path& folder) {
  atlas::AtlasDescription description;
  description.name = "example";
  description.patches = {2.0, atlas::tile_side};
  description.extent = {0.0, 0.0, 4096.0, 4096.0};
  description.aspects = {{0.0}, {radians_from_deg(13.0)}, {10e9}};
  description.scene_hash = "none";
  description.settings[atlas::shadows_setting] = atlas::shadows_at_run_time;
  description.settings[atlas::footing_setting] = atlas::footing_on_terrain;
  atlas::Store store = atlas::Store::create(folder, description);
  ExampleGround example;
  example.texel_m = 2.0;
  example.patches_a_side = 8;
  example.obstacle = [middle = example.middle()](Vec2d from_middle) { return town(from_middle + middle); };
  example.write_obstacles(store);
  return store;
}

class LiveObstaclesTest : public testing::Test {
 protected:
  static constexpr std::size_t tile_bytes = ObstacleSource::most_bytes();

  static void SetUpTestSuite() {
    folder_ = std::make_unique<ScratchFolder>();
    store_ = std::make_unique<atlas::Store>(town_alone(folder_->path("atlas")));
  }
  static void TearDownTestSuite() {
    store_.reset();
    folder_.reset();
  }

  /// Looks at obstacles as a renderer does.
  struct Looker {
    explicit Looker(LiveObstacles& at) : obstacles(at), asker(at.cache().asker(256)) {}

    /// Lays out what is there and asks for the rest. Returns how many tiles are coarser than wished for.
    std::size_t lay_out(const LiveObstacles::Wish& wish) {
      std::vector<atlas::TileAddress> wanted;
      wanted.reserve(256);
      there = obstacles.cache().view();
      const std::size_t coarser = obstacles.lay_out(there, wish, LiveObstacles::Part::UnderBins, mosaic, wanted);
      asker.request(wanted);
      return coarser;
    }

    LiveObstacles& obstacles;
    LiveObstacles::Cache::Asker asker;
    LiveObstacles::Cache::View there;
    ObstacleMosaic mosaic;
  };

  /// Of 2000 places in a sector, those that are not shown as they are at level 0, and those where something is shown.
  struct Places {
    std::size_t wrong = 0, with_something = 0;
  };
  static Places places_of(const ObstacleMosaic& mosaic, const GroundSector& sector) {
    Places places;
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const double azimuth =
          sector.first_azimuth_rad + sector.width_rad * static_cast<double>(unit_float(hashed(i, 1)));
      const double distance_m =
          sector.near_m + (sector.far_m - sector.near_m) * static_cast<double>(unit_float(hashed(i, 2)));
      const Vec2d point = sector.radar + radar::horizontal_direction(azimuth) * distance_m;
      const radar::Obstacle shown = mosaic.at(point).unpacked();
      if (shown != town(point)) ++places.wrong;
      if (shown.top_m() > 0.0F) ++places.with_something;
    }
    return places;
  }

  static inline std::unique_ptr<ScratchFolder> folder_;
  static inline std::unique_ptr<atlas::Store> store_;
};

TEST_F(LiveObstaclesTest, ComeWhereASectorLooksAndStayInTheBudget) {
  constexpr std::size_t budget_bytes = 24 * tile_bytes;
  LiveObstacles obstacles(*store_, budget_bytes);
  EXPECT_EQ(obstacles.cache().report().loaded, 1U) << "the coarsest level is one tile";
  EXPECT_EQ(obstacles.tallest_m(), 11.0F);
  Looker looker(obstacles);
  for (double east_m = 300.0; east_m < 3500.0; east_m += 100.0) {
    const LiveObstacles::Wish wish{0, {{east_m, 100.0}, -0.2, 0.4, 500.0, 1400.0}};
    for (int turn = 0; turn < 3; ++turn) {
      looker.lay_out(wish);
      looker.there = {};
      obstacles.cache().wait_until_loaded();
    }
    ASSERT_EQ(looker.lay_out(wish), 0U) << east_m;
    ASSERT_EQ(places_of(looker.mosaic, wish.ground).wrong, 0U) << east_m;
    looker.there = {};
    ASSERT_LE(obstacles.cache().report().bytes, budget_bytes);
  }
  EXPECT_GT(obstacles.cache().report().evicted, 0U);
  EXPECT_EQ(obstacles.cache().report().refused, 0U);
}

TEST_F(LiveObstaclesTest, AJumpIsShownCoarselyAtOnceAndThenAsItIs) {
  LiveObstacles obstacles(*store_, 24 * tile_bytes);
  Looker looker(obstacles);
  const LiveObstacles::Wish here{0, {{300.0, 100.0}, -0.2, 0.4, 500.0, 1400.0}},
      far_away{0, {{3500.0, 3900.0}, 3.0, 0.4, 500.0, 1400.0}};
  looker.lay_out(here);
  obstacles.cache().wait_until_loaded();
  EXPECT_GT(looker.lay_out(far_away), 0U);
  // Four blocks together, of which more have something on them than of single ones.
  EXPECT_NEAR(static_cast<double>(places_of(looker.mosaic, far_away.ground).with_something) / 2000.0,
              1.0 - std::pow(11.0 / 16.0, 4.0), 0.1);
  EXPECT_GT(places_of(looker.mosaic, far_away.ground).wrong, 1000U);
  obstacles.cache().wait_until_loaded();
  EXPECT_EQ(looker.lay_out(far_away), 0U);
  EXPECT_EQ(places_of(looker.mosaic, far_away.ground).wrong, 0U);
}

TEST_F(LiveObstaclesTest, WhatTheBudgetDoesNotHoldIsShownCoarser) {
  LiveObstacles obstacles(*store_, 8 * tile_bytes);
  Looker looker(obstacles);
  // Half of the town: 35 of 64 tiles, or 12 of the next level's, or 4.
  const LiveObstacles::Wish wish{0, {{2048.0, 0.0}, -1.6, 3.2, 100.0, 2500.0}};
  for (int turn = 0; turn < 3; ++turn) {
    looker.lay_out(wish);
    obstacles.cache().wait_until_loaded();
  }
  EXPECT_GT(looker.lay_out(wish), 0U) << "is told";
  EXPECT_EQ(looker.mosaic.block().level, 2U);
  EXPECT_EQ(obstacles.cache().report().refused, 0U);
  EXPECT_LE(obstacles.cache().report().bytes, obstacles.budget_bytes());
}

TEST_F(LiveObstaclesTest, LevelsFollowFromSteps) {
  const LiveObstacles obstacles(*store_, 8 * tile_bytes);
  // 2, 4, 8 and 16 m.
  EXPECT_EQ(obstacles.level_for(1.0), 0U);
  EXPECT_EQ(obstacles.level_for(3.9), 0U);
  EXPECT_EQ(obstacles.level_for(4.0), 1U);
  EXPECT_EQ(obstacles.level_for(500.0), 3U);
}

// Beside the edges of a tile what stands on the next one answers as well.
TEST_F(LiveObstaclesTest, TopsOfATileKnowOfItsNeighbours) {
  const ObstacleSource source(*store_);
  std::vector<float> tops(ObstaclePage::squares);
  const atlas::TileAddress tile{0, 3, 2};
  source.fill_tops(tile, tops);
  const radar::GroundGrid texels = atlas::texels_of(source.description().patches, tile);
  constexpr std::size_t margin = 16;
  const double margin_m = static_cast<double>(margin) * texels.cell_m;
  radar::ObstacleMap about{{texels.west_m - margin_m, texels.north_m + margin_m, texels.cell_m,
                            texels.columns + 2 * margin, texels.rows + 2 * margin},
                           {}};
  about.obstacles = Array2D<radar::Obstacle>(about.grid.columns, about.grid.rows);
  for (std::size_t row = 0; row < about.grid.rows; ++row) {
    for (std::size_t column = 0; column < about.grid.columns; ++column)
      about.obstacles(column, row) = town(about.grid.centre_of(column, row));
  }
  const radar::AnsweringTops expected = radar::answering_tops(about, radar::FromAfar::Hidden);
  for (std::size_t row = 0; row < texels.rows; ++row) {
    for (std::size_t column = 0; column < texels.columns; ++column) {
      ASSERT_EQ(tops[row * texels.columns + column], expected.at(texels.centre_of(column, row)))
          << column << " " << row;
    }
  }
}

TEST_F(LiveObstaclesTest, AFileThatCannotBeReadIsReplacedByItsParent) {
  const auto altered = folder_->path("altered");
  std::filesystem::copy(store_->folder(), altered, std::filesystem::copy_options::recursive);
  std::filesystem::resize_file(altered / "patch_+001_+001" / "obstacles.tif", 1000);
  const atlas::Store store = atlas::Store::open(altered);
  const ObstacleSource sound(*store_), source(store);
  ObstaclePage page, parent;
  page.key = {0, 1, 1};
  parent.key = page.key.parent();
  ASSERT_TRUE(source.fill(page));
  ASSERT_TRUE(sound.fill(parent));
  EXPECT_EQ(page.levels_lacking, 1U);
  EXPECT_EQ(source.damaged(), 1U);
  const PartOfTile part = PartOfTile::of(page.key, parent.key);
  for (std::uint32_t row = 0; row < 256; row += 5) {
    for (std::uint32_t column = 0; column < 256; column += 3) {
      const radar::Obstacle expected = parent.of[part.index_of(row, column)].unpacked();
      ASSERT_EQ(page.of[row * 256 + column].unpacked(), expected);
    }
  }

  LiveObstacles obstacles(store, 24 * tile_bytes);
  Looker looker(obstacles);
  const LiveObstacles::Wish wish{0, {{768.0, 768.0}, 0.0, 2.0 * pi, 0.0, 200.0}};
  looker.lay_out(wish);
  obstacles.cache().wait_until_loaded();
  EXPECT_EQ(looker.lay_out(wish), 1U) << "is told";
  EXPECT_GT(places_of(looker.mosaic, wish.ground).with_something, 500U);
}

TEST_F(LiveObstaclesTest, AFileThatIsMendedTakesItsPlaceAgain) {
  const auto mended = folder_->path("mended");
  std::filesystem::copy(store_->folder(), mended, std::filesystem::copy_options::recursive);
  // Without an item, which is looked for again each time.
  const auto item = mended / "patch_+001_+001" / "obstacles.json", aside = folder_->path("aside.json");
  ASSERT_TRUE(std::filesystem::exists(item));
  std::filesystem::rename(item, aside);
  const atlas::Store store = atlas::Store::open(mended);
  const auto source = std::make_shared<const ObstacleSource>(store);
  std::vector<float> tops(ObstaclePage::squares), sound_tops(ObstaclePage::squares);
  const Shortage shortage = source->fill_tops({0, 1, 1}, tops);
  ASSERT_TRUE(shortage);
  EXPECT_FALSE(shortage());
  EXPECT_TRUE(source->fill_tops({0, 0, 1}, tops)) << "a neighbour";

  LiveObstacles::Cache cache(source, 8 * tile_bytes, 1, std::chrono::milliseconds(0));
  const std::array<atlas::TileAddress, 1> wanted{atlas::TileAddress{0, 1, 1}};
  for (int again = 0; again < 3; ++again) cache.load(wanted);
  ASSERT_NE(cache.view().find(wanted[0]), nullptr);
  EXPECT_EQ(cache.view().find(wanted[0])->levels_lacking, 1U);
  EXPECT_EQ(cache.report().renewed, 0U);

  std::filesystem::rename(aside, item);
  EXPECT_TRUE(shortage());
  EXPECT_FALSE(source->fill_tops(wanted[0], tops));
  EXPECT_FALSE(ObstacleSource(*store_).fill_tops(wanted[0], sound_tops));
  EXPECT_EQ(tops, sound_tops);
  cache.load(wanted);
  ASSERT_NE(cache.view().find(wanted[0]), nullptr);
  EXPECT_EQ(cache.view().find(wanted[0])->levels_lacking, 0U);
  EXPECT_EQ(cache.report().renewed, 1U);
}

TEST_F(LiveObstaclesTest, WhereNoneCanBeReadNothingStands) {
  const auto altered = folder_->path("without");
  std::filesystem::copy(store_->folder(), altered, std::filesystem::copy_options::recursive);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(altered)) {
    if (entry.path().filename() == "obstacles.tif") std::filesystem::resize_file(entry.path(), 100);
  }
  const ObstacleSource source(atlas::Store::open(altered));
  ObstaclePage page;
  page.key = {1, 0, 0};
  ASSERT_TRUE(source.fill(page));
  EXPECT_EQ(page.levels_lacking, 3U);
  EXPECT_TRUE(std::ranges::all_of(page.of, [](const PackedObstacle& o) { return o.unpacked() == radar::Obstacle{}; }));
}

ExampleGround town_ground() {
  ExampleGround example;
  example.sigma0 = [](const radar::Look& look) { return constant_gamma(0.02, look); };
  example.bare_sigma0 = [](const radar::Look& look) { return constant_gamma(0.1, look); };
  example.obstacle = town;
  return example;
}

std::vector<std::complex<float>> kept(const Frame& frame) {
  return {frame.amplitudes_m.begin(), frame.amplitudes_m.end()};
}

TEST(LiveGroundApartStreamed, TheFirstFrameIsThereAtOnceAndTheNextOnesAreRight) {
  const ScratchFolder folder;
  const ExampleGround example = town_ground();
  const atlas::Store store = example.store(folder.path("atlas"));
  atlas::Pyramid(store).make_above(store.units());
  const auto ground = example.over(store);
  const ExampleView view{.elevation_deg = 8.6};
  LiveRenderer renderer(ground, view.settings(FrameContent::Amplitudes));
  const FrameReport first = renderer.render(view.pose()).report;
  EXPECT_GT(first.coarse_obstacles, 0U);
  EXPECT_EQ(first.dark, 0U);
  const Frame& frame = settled_frame(renderer, *ground, view.pose());
  EXPECT_EQ(frame.report.coarse_obstacles, 0U);
  const auto last = kept(frame);

  // Neither the number of threads nor what else has been looked at shows.
  ExampleView elsewhere = view;
  elsewhere.azimuth_deg = 200.0;
  LiveRenderer one_thread(ground, view.settings(FrameContent::Amplitudes, 1));
  settled_frame(one_thread, *ground, elsewhere.pose());
  EXPECT_EQ(kept(settled_frame(one_thread, *ground, view.pose())), last);
}

}  // namespace
}  // namespace sigmascape::live
