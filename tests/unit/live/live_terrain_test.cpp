#include "sigmascape/live/live_terrain.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <numeric>
#include <thread>
#include <vector>

#include "frame_numbers.h"
#include "keep_worst.h"
#include "live_ground_example.h"
#include "terrain_short_of_tiles.h"
#include "unit/terrain/round_hills.h"

#include "sigmascape/atlas/pyramid.h"
#include "sigmascape/base/error.h"
#include "sigmascape/terrain/pyramid_builder.h"
#include "sigmascape/terrain/pyramid_files.h"
#include "sigmascape/terrain/pyramid_levels.h"

namespace sigmascape::live {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

double hills(Vec2d p) {
  return 40.0 + 30.0 * std::sin(0.012 * p.x + 0.005 * p.y) + 12.0 * std::cos(0.031 * p.y - 0.013 * p.x) +
         3.0 * std::sin(0.17 * p.x) * std::cos(0.11 * p.y);
}

ExampleGround hilly() {
  ExampleGround ground = even_example();
  ground.height_m = hills;
  return ground;
}

std::shared_ptr<terrain::TerrainPyramid> opened(const std::filesystem::path& folder, std::size_t budget_bytes) {
  return std::shared_ptr<terrain::TerrainPyramid>(
      new terrain::TerrainPyramid(terrain::open_pyramid(folder, budget_bytes)));
}

/// All tests look at one atlas; its own ground is hilly.
class LiveTerrainTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<ScratchFolder>();
    store_ = std::make_unique<atlas::Store>(example_.store(folder_->path("atlas")));
    atlas::Pyramid(*store_).make_above(store_->units());
    terrain::build_pyramid(folder_->path("terrain"), example_.terrain(), {43.0, -3.0});
  }
  static void TearDownTestSuite() {
    store_.reset();
    folder_.reset();
  }
  [[nodiscard]] static std::filesystem::path terrain_folder() { return folder_->path("terrain"); }
  static inline const ExampleGround example_ = hilly();
  static inline std::unique_ptr<ScratchFolder> folder_;
  static inline std::unique_ptr<atlas::Store> store_;
};

TEST_F(LiveTerrainTest, APyramidOnDiskGivesTheFrameOfTheTerrainInMemory) {
  const auto whole = example_.over(*store_);
  const auto in_pieces = std::make_shared<LiveGround>(*store_, opened(terrain_folder(), 1U << 20U), 10e9);
  for (const double bin_m : {12.0, 40.0}) {
    ExampleView view;
    view.bin_m = bin_m;
    LiveRenderer expected(whole, view.settings(FrameContent::Amplitudes));
    LiveRenderer renderer(in_pieces, view.settings(FrameContent::Amplitudes));
    const Frame& there = settled_frame(expected, *whole, view.pose());
    const Frame& here = settled_frame(renderer, *in_pieces, view.pose());
    EXPECT_EQ(here.report.terrain_error_m, 0.0);
    EXPECT_LT(here.report.lit, here.report.cells) << "hills hide ground";
    EXPECT_TRUE(std::ranges::equal(here.amplitudes_m, there.amplitudes_m)) << bin_m;
  }
}

/// Tiles of level ground with a wall every 4 km, made when they are asked for: as much of it as one likes.
std::shared_ptr<terrain::TerrainPyramid> walls(std::uint32_t tiles_a_side, std::size_t budget_bytes,
                                               const std::shared_ptr<std::size_t>& made) {
  const double spacing_m = 8.0, side_m = spacing_m * terrain::HeightTile::cells * tiles_a_side;
  const terrain::PyramidLayout layout{-side_m / 2.0, side_m / 2.0, spacing_m, tiles_a_side, tiles_a_side};
  std::vector<Array2D<terrain::TileSummary>> summaries;
  for (int level = 0; level < layout.levels(); ++level) {
    summaries.emplace_back(layout.across(level), layout.down(level),
                           terrain::TileSummary{0.0F, 30.0F, level == 0 ? 0.0F : 30.0F});
  }
  return std::make_shared<terrain::TerrainPyramid>(
      layout, layout.extent(), std::move(summaries),
      [layout, made](terrain::TileKey key) {
        ++*made;
        auto tile = std::make_shared<terrain::HeightTile>();
        tile->summary = {0.0F, 30.0F, key.level == 0 ? 0.0F : 30.0F};
        const radar::Rectangle extent = layout.extent_of(key);
        for (std::size_t row = 0; row < terrain::HeightTile::nodes; ++row) {
          const double north_m = extent.north_m - layout.spacing_at(key.level) * static_cast<double>(row);
          const float height_m = std::abs(std::remainder(north_m, 4096.0)) < 20.0 ? 30.0F : 0.0F;
          tile->height_m.insert(tile->height_m.end(), terrain::HeightTile::nodes, height_m);
        }
        return std::shared_ptr<const terrain::HeightTile>(tile);
      },
      budget_bytes);
}

TEST(LiveTerrainSlopes, AreThoseOfRoundHillsUnderEveryTexel) {
  const terrain::RoundHills hills;
  const LiveTerrain ground(std::shared_ptr<terrain::TerrainPyramid>(
                               new terrain::TerrainPyramid(terrain::pyramid_in_memory(hills.field(1800, 1600)))),
                           std::size_t{1} << 20U);
  for (const double texel_m : {5.0, 10.0, 20.0}) {
    const radar::GroundGrid texels{.west_m = 100.0, .north_m = 1500.0, .cell_m = texel_m, .columns = 256, .rows = 256};
    const int level = ground.level_for(texel_m);
    ASSERT_GE(level, 1);
    std::vector<terrain::PackedSlope> slopes(texels.columns * texels.rows);
    ground.fill_slopes(texels, slopes);
    double worst = 0.0;
    for (std::size_t row = 0; row < texels.rows; ++row) {
      for (std::size_t column = 0; column < texels.columns; ++column) {
        const Vec2d expected = hills.slope_at(texels.centre_of(column, row));
        const terrain::PackedSlope found = slopes[row * texels.columns + column];
        constexpr auto per_unit = static_cast<double>(terrain::PackedSlope::steps_per_unit);
        keep_worst(worst, std::abs(found.east / per_unit - expected.x));
        keep_worst(worst, std::abs(found.north / per_unit - expected.y));
      }
    }
    // Packed once more.
    const double half_a_step = 0.5 / static_cast<double>(terrain::PackedSlope::steps_per_unit);
    EXPECT_LT(worst, hills.slope_error(level) + half_a_step) << "texels of " << texel_m << " m";
  }
}

TEST_F(LiveTerrainTest, MayBeFarLargerThanMemory) {
  const auto made = std::make_shared<std::size_t>(0);
  // 1,049 km a side, 69 GB of heights.
  constexpr std::size_t tile_budget = std::size_t{8} << 20U;
  const auto pyramid = walls(512, tile_budget, made);
  const auto ground = std::make_shared<LiveGround>(*store_, pyramid, 10e9, CacheOptions{.budget_bytes = 64U << 20U});
  const ExampleView view;
  LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
  const Frame& frame = settled_frame(renderer, *ground, view.pose());
  EXPECT_EQ(frame.report.terrain_error_m, 0.0);
  EXPECT_EQ(frame.report.dark, 0U);
  EXPECT_LT(*made, 500U);
  EXPECT_LE(pyramid->resident_bytes(), tile_budget);
  EXPECT_LE(ground->terrain().windows().bytes(), std::size_t{64} << 20U);
}

TEST_F(LiveTerrainTest, AWallBeforeTheBinsHidesThem) {
  const auto ground =
      std::make_shared<LiveGround>(*store_, walls(8, std::size_t{8} << 20U, std::make_shared<std::size_t>(0)), 10e9);
  // The wall stands at y = 0 and a radar 105 m high, 2.4 km south of it, sees no ground nearer than 940 m behind it.
  ExampleView view{.target = {1024.0, 600.0}, .azimuth_deg = 180.0, .elevation_deg = 2.0, .slant_range_m = 3000.0};
  view.ranges = 32;
  LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
  const Frame& frame = settled_frame(renderer, *ground, view.pose());
  EXPECT_EQ(frame.report.terrain_error_m, 0.0);
  EXPECT_EQ(frame.report.dark, 0U);
  EXPECT_EQ(frame.report.lit, 0U);
}

/// Horizons all around a radar that stands off every node, over a surface.
HorizonMap horizons_over(const terrain::TerrainView& surface) {
  const Vec3d radar{1003.37, 991.13, 150.0};
  HorizonMap map({.azimuth_step_rad = 0.05, .azimuths = 125, .near_m = 60.3, .step_m = 3.1, .distances = 170});
  for (std::size_t azimuth = 0; azimuth < map.grid().azimuths; ++azimuth) {
    map.sweep(azimuth, radar, {.terrain = surface});
  }
  return map;
}

TEST_F(LiveTerrainTest, WhichWindowCoversTheGroundMakesNoDifferenceToABit) {
  const radar::Rectangle area{400.0, 400.0, 1600.0, 1600.0};
  std::vector<HorizonMap> maps;
  std::vector<terrain::HeightBounds> bounds;
  std::vector<double> west_m;
  for (const radar::Rectangle& asked_for : {area, radar::Rectangle{213.0, 371.0, 1820.0, 1710.0}}) {
    LiveTerrain terrain(opened(terrain_folder(), 8U << 20U), std::size_t{64} << 20U);
    terrain.windows().load(std::vector<WindowWish>{{0, asked_for}});
    std::vector<WindowWish> wanted;
    wanted.reserve(4);
    const TerrainWindows::View there = terrain.windows().view();
    const LiveTerrain::Surface surface = terrain.surface(there, 0, area, wanted);
    ASSERT_TRUE(wanted.empty());
    maps.push_back(horizons_over(surface.view));
    bounds.push_back({surface.view.lowest_m, surface.view.highest_m});
    west_m.push_back(surface.view.extent().west_m);
  }
  ASSERT_NE(west_m[0], west_m[1]);
  // How far frames look for what hides follows from these.
  EXPECT_EQ(bounds[0].lowest_m, bounds[1].lowest_m);
  EXPECT_EQ(bounds[0].highest_m, bounds[1].highest_m);
  const HorizonGrid& grid = maps[0].grid();
  for (std::size_t azimuth = 0; azimuth < grid.azimuths; ++azimuth) {
    EXPECT_TRUE(std::equal(maps[0].slopes(azimuth), maps[0].slopes(azimuth) + grid.distances, maps[1].slopes(azimuth)))
        << azimuth;
  }
}

TEST_F(LiveTerrainTest, WhatStandsInIsLoweredBelowWhatPagesStandOn) {
  LiveTerrain terrain(opened(terrain_folder(), 8U << 20U), std::size_t{8} << 20U);
  const radar::Rectangle area{400.0, 400.0, 1600.0, 1600.0};
  std::vector<WindowWish> wanted;
  wanted.reserve(4);
  const auto surface_now = [&] { return terrain.surface(terrain.windows().view(), 0, area, wanted); };
  const auto highest_above_pages_m = [&](const LiveTerrain::Surface& surface) {
    double most_m = -1e9;
    for (double x = area.west_m; x < area.east_m; x += 7.0) {
      for (double y = area.south_m; y < area.north_m; y += 7.0) {
        most_m = std::max(most_m, terrain::height_at(surface.view, {x, y}) - terrain.height_at({x, y}));
      }
    }
    return most_m;
  };
  const LiveTerrain::Surface first = surface_now();
  EXPECT_GT(highest_above_pages_m(first), 1.0);
  EXPECT_LE(highest_above_pages_m(first), static_cast<double>(first.above_pages_m));
  ASSERT_EQ(wanted.size(), 1U);
  terrain.windows().load(wanted);
  const LiveTerrain::Surface second = surface_now();
  EXPECT_EQ(second.above_pages_m, 0.0F);
  EXPECT_EQ(second.error_m, 0.0F);
  EXPECT_NEAR(highest_above_pages_m(second), 0.0, 1e-4);
  EXPECT_EQ(wanted.size(), 1U) << "nothing more is wanted";
}

TEST(HorizonMap, LoweredTerrainHidesAsIfItLayLower) {
  terrain::HeightField field{.spacing_m = 10.0, .height_m = Array2D<float>(101, 101)};
  for (std::size_t i = 0; i < field.height_m.size(); ++i) field.height_m.values()[i] = static_cast<float>(i % 37);
  const HorizonGrid grid{.azimuths = 2, .near_m = 400.0, .step_m = 5.0, .distances = 80};
  const Vec3d radar{500.0, -1000.0, 120.0};
  HorizonMap lowered(grid), lower(grid);
  lowered.sweep(0, radar, {.terrain = terrain::view_of(field), .lowered_m = 8.0F});
  for (float& height : field.height_m.values()) height -= 8.0F;
  lower.sweep(0, radar, {.terrain = terrain::view_of(field)});
  for (std::size_t k = 0; k < grid.distances; ++k) ASSERT_NEAR(lowered.slopes(0)[k], lower.slopes(0)[k], 1e-6) << k;
}

TEST_F(LiveTerrainTest, HidesNothingByWhatItDoesNotKnowYet) {
  const auto ground = std::make_shared<LiveGround>(*store_, opened(terrain_folder(), 8U << 20U), 10e9);
  const ExampleView view{.target = example_.middle(), .elevation_deg = 5.0};
  LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
  const FrameReport first = renderer.render(view.pose()).report;
  EXPECT_GT(first.terrain_error_m, 1.0);
  ground->wait_until_loaded();
  const FrameReport second = renderer.render(view.pose()).report;
  EXPECT_EQ(second.terrain_error_m, 0.0);
  EXPECT_GE(first.lit, second.lit);
  EXPECT_LT(second.lit, second.cells);
}

TEST(TerrainSectors, AreNoWiderThanAQuarterTurnAndHoldEveryEdgeOnce) {
  for (const std::size_t beams : {1U, 3U, 7U, 512U}) {
    for (const double width_rad : {0.01, 0.5 * pi, 0.51 * pi, pi, 1.7 * pi, 2.0 * pi}) {
      const TerrainSectors sectors(beams, width_rad / static_cast<double>(beams), 1);
      EXPECT_EQ(sectors.count(),
                std::min<std::size_t>(beams, static_cast<std::size_t>(std::ceil(2.0 * width_rad / pi))));
      EXPECT_EQ(sectors.first_edge(0), 0U);
      EXPECT_EQ(sectors.first_edge(sectors.count()), beams);
      for (std::size_t edge = 0; edge <= beams; ++edge) {
        const std::size_t sector = sectors.of_edge(edge);
        EXPECT_GE(edge, sectors.first_edge(sector));
        EXPECT_LE(edge, sectors.first_edge(sector + 1));
      }
    }
  }
}

TEST(TerrainSectors, PartNoBeamsThatAreFilledTogether) {
  const TerrainSectors sectors(500, 2.0 * pi / 500.0, 64);
  ASSERT_EQ(sectors.count(), 4U);
  for (std::size_t sector = 0; sector < 4; ++sector) EXPECT_EQ(sectors.first_edge(sector), sector * 125 / 64 * 64);
  EXPECT_EQ(sectors.of_edge(63), 0U);
  EXPECT_EQ(sectors.of_edge(64), 1U);
  EXPECT_EQ(sectors.of_edge(500), 3U);
}

TEST(LiveTurn, HasTheTerrainOfItsTexelsThoughNoWindowHoldsItWhole) {
  ExampleGround example = hilly();
  example.patches_a_side = 4;
  example.azimuths = 1;
  example.elevations_deg = {2.0, 37.0};
  example.terrain_spacing_m = 5.0;
  const ScratchFolder folder;
  const atlas::Store store = example.store(folder.path("atlas"));
  const LiveSettings settings{.content = FrameContent::Powers,
                              .beams = 128,
                              .ranges = 125,
                              .beam_step_rad = 2.0 * pi / 128.0,
                              .range_step_m = 16.0,
                              .cells_per_bin = 4.0};
  const Pose pose{.position = {example.middle().x + 3.0, example.middle().y - 8.0, 140.0}, .first_range_m = 0.0};
  std::vector<float> powers;
  // A window may hold 3100² nodes, or 480²; the turn has 800², a quarter of it, and some beams, 400 by 520.
  for (const std::size_t budget_mib : {2750U, 64U}) {
    example.cache.budget_bytes = budget_mib << 20U;
    const auto ground = example.over(store);
    LiveRenderer renderer(ground, settings);
    const Frame& frame = settled_frame(renderer, *ground, pose);
    EXPECT_EQ(frame.report.terrain_error_m, 0.0) << budget_mib;
    EXPECT_EQ(frame.report.coarse, 0U) << budget_mib;
    EXPECT_LT(frame.report.lit, frame.report.cells - frame.report.cells / 20) << "hills hide ground";
    if (!powers.empty()) {
      EXPECT_TRUE(std::ranges::equal(frame.powers_m2, powers));
    }
    powers.assign(frame.powers_m2.begin(), frame.powers_m2.end());
  }
}

TEST_F(LiveTerrainTest, ATileThatIsNotThereCostsItsPlaceAndIsReported) {
  const auto altered = folder_->path("altered");
  std::filesystem::copy(terrain_folder(), altered, std::filesystem::copy_options::recursive);
  std::filesystem::resize_file(altered / "level_0/0_0.tif", 1000);
  const auto ground = std::make_shared<LiveGround>(*store_, opened(altered, 8U << 20U), 10e9);
  const ExampleView view{.target = example_.middle(), .elevation_deg = 13.0};
  LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
  const Frame& frame = settled_frame(renderer, *ground, view.pose());
  EXPECT_GT(frame.report.terrain_error_m, 0.0);
  EXPECT_EQ(frame.report.dark, 0U);
  EXPECT_EQ(ground->terrain().pyramid().faults().size(), 1U);
  const double with_fault = total_vv(frame);
  const auto sound = example_.over(*store_);
  LiveRenderer expected(sound, view.settings(FrameContent::Powers));
  EXPECT_NEAR(db_from_linear(with_fault / total_vv(settled_frame(expected, *sound, view.pose()))), 0.0, 1.0);
}

/// 9 km of the example's hills: their coarsest level is coarser than any texels of the atlas ask for.
terrain::HeightField wide_hills(const ExampleGround& example) {
  constexpr std::size_t nodes = 1120;
  const double half_m = 0.5 * example.terrain_spacing_m * static_cast<double>(nodes - 1);
  terrain::HeightField field{.west_m = example.middle().x - half_m,
                             .north_m = example.middle().y + half_m,
                             .spacing_m = example.terrain_spacing_m,
                             .height_m = Array2D<float>(nodes, nodes)};
  for (std::size_t row = 0; row < nodes; ++row) {
    for (std::size_t column = 0; column < nodes; ++column) {
      const Vec2d node{field.west_m + field.spacing_m * static_cast<double>(column),
                       field.north_m - field.spacing_m * static_cast<double>(row)};
      field.height_m(column, row) = static_cast<float>(example.height_m(node - example.middle()));
    }
  }
  return field;
}

/// Frames of bins of a size over terrain that is there, over terrain that was short of tiles when the atlas was opened
/// and first looked at, and of the same ground when they have come.
void expect_pages_to_be_made_anew(const ExampleGround& example, const atlas::Store& store, double bin_m) {
  const terrain::HeightField field = wide_hills(example);
  ExampleView view{.target = example.middle()};
  view.bin_m = bin_m;
  view.beams = view.ranges = 40;
  const auto whole = std::make_shared<LiveGround>(store, field, 10e9);
  LiveRenderer expected(whole, view.settings(FrameContent::Powers));
  const Frame& sound = settled_frame(expected, *whole, view.pose());
  ASSERT_EQ(sound.report.terrain_error_m, 0.0);
  EXPECT_EQ(whole->pages().report().renewed, 0U);

  std::atomic<bool> is_short = true;
  const auto ground = std::make_shared<LiveGround>(store, short_of(field, is_short), 10e9);
  LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
  const Frame& frame = settled_frame(renderer, *ground, view.pose());
  EXPECT_GT(frame.report.terrain_error_m, 1.0);
  EXPECT_FALSE(std::ranges::equal(frame.powers_m2, sound.powers_m2));
  EXPECT_EQ(ground->pages().report().renewed, 0U) << "there was nothing better";
  is_short = false;
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  settled_frame(renderer, *ground, view.pose());
  EXPECT_EQ(frame.report.terrain_error_m, 0.0);
  EXPECT_GT(ground->pages().report().renewed, 0U);
  EXPECT_TRUE(std::ranges::equal(frame.powers_m2, sound.powers_m2));
  // What is whole is left as it is.
  const std::uint64_t renewed = ground->pages().report().renewed;
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  settled_frame(renderer, *ground, view.pose());
  EXPECT_EQ(ground->pages().report().renewed, renewed);
}

TEST_F(LiveTerrainTest, PagesAreMadeAnewWhenTheirTerrainHasCome) {
  // The wider bins are of the coarsest level, which is made when the atlas is opened.
  for (const double bin_m : {12.0, 40.0}) expect_pages_to_be_made_anew(example_, *store_, bin_m);
}

TEST(LiveTerrainApart, PagesOfBareGroundAreMadeAnewWithItsSlopes) {
  ExampleGround example = hilly();
  example.bare_sigma0 = [](const radar::Look& look) { return constant_gamma(0.1, look); };
  example.sigma0 = [](const radar::Look&) { return radar::Channels{}; };
  const ScratchFolder folder;
  const atlas::Store store = example.store(folder.path("atlas"));
  atlas::Pyramid(store).make_above(store.units());
  for (const double bin_m : {12.0, 40.0}) expect_pages_to_be_made_anew(example, store, bin_m);
}

TEST_F(LiveTerrainTest, ThePapersPictureShowsTheFrameOfTheSweep) {
  const auto ground = example_.over(*store_);
  for (const double elevation_deg : {5.0, 13.0}) {
    ExampleView view;
    view.elevation_deg = elevation_deg;
    LiveSettings settings = view.settings(FrameContent::Powers);
    LiveRenderer swept(ground, settings);
    settings.visibility = {.method = VisibilityMethod::Rasterization, .raster = {.pixels_per_triangle = 64.0}};
    LiveRenderer drawn(ground, settings);
    const Frame& sweep = settled_frame(swept, *ground, view.pose());
    const Frame& raster = settled_frame(drawn, *ground, view.pose());
    const double hidden = 1.0 - static_cast<double>(sweep.report.lit) / static_cast<double>(sweep.report.cells);
    EXPECT_GT(hidden, 0.05) << elevation_deg;
    double differ = 0.0;
    for (std::size_t i = 0; i < sweep.powers_m2.size(); i += 4) {
      differ += std::abs(static_cast<double>(sweep.powers_m2[i]) - static_cast<double>(raster.powers_m2[i]));
    }
    EXPECT_NEAR(db_from_linear(total_vv(raster) / total_vv(sweep)), 0.0, 0.1) << elevation_deg;
    EXPECT_LT(differ / total_vv(sweep), 0.05) << elevation_deg;
  }
}

TEST_F(LiveTerrainTest, ThePapersPictureIsRefusedWhereItCannotBeDrawn) {
  const auto ground = example_.over(*store_);
  const ExampleView view;
  LiveSettings settings = view.settings(FrameContent::Powers);
  settings.visibility = {.method = VisibilityMethod::Rasterization};
  LiveRenderer drawn(ground, settings);
  const Frame& frame = drawn.render(view.pose());
  const std::vector<float> powers(frame.powers_m2.begin(), frame.powers_m2.end());
  Pose among_hills = view.pose();
  among_hills.position.z = 60.0;
  EXPECT_THAT(message_of_error([&] { drawn.render(among_hills); }),
              AllOf(HasSubstr("stands at 60 m"), HasSubstr("horizon sweep")));
  EXPECT_TRUE(std::ranges::equal(frame.powers_m2, powers)) << "stays as it was";
  settings.visibility.method = VisibilityMethod::HorizonSweep;
  EXPECT_NO_THROW(LiveRenderer(ground, settings).render(among_hills));

  settings.visibility.method = VisibilityMethod::Rasterization;
  for (const double pixels :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    settings.visibility.raster.pixels_per_triangle = pixels;
    EXPECT_THAT(message_of_error([&] { LiveRenderer(ground, settings); }), HasSubstr("pixels a triangle"));
  }
  settings.visibility.raster.pixels_per_triangle = 16.0;
  for (const std::size_t side : {std::size_t{0}, std::size_t{3}, std::size_t{1} << 40U}) {
    settings.visibility.raster.longest_side = side;
    EXPECT_THAT(message_of_error([&] { LiveRenderer(ground, settings); }), HasSubstr("pixels a side"));
  }
}

// The last tiles reach 1856 m further east than the heights, and no tile further west.
TEST_F(LiveTerrainTest, GroundEndsInTheEastWhereItsHeightsEnd) {
  ExampleGround rimmed = even_example();
  rimmed.height_m = [](Vec2d way) { return std::abs(way.x) > 1060.0 ? 200.0 : std::max(300.0 - std::abs(way.x), 0.0); };
  const auto ground = rimmed.over(*store_);
  const auto seen_from = [&](double azimuth_deg, double range_m, double height_m) {
    ExampleView view{.azimuth_deg = azimuth_deg, .slant_range_m = range_m};
    view.elevation_deg = deg_from_radians(std::asin(height_m / range_m));
    LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
    return settled_frame(renderer, *ground, view.pose()).report;
  };
  // Over the rim, at 1.2° from 3.5 km away, the crest stands out; over a rim that goes on to 530 m from the radar, at
  // 5.4°, it would not.
  const FrameReport east = seen_from(90.0, 3500.0, 150.0), west = seen_from(270.0, 3500.0, 150.0);
  EXPECT_GT(west.lit, 100U);
  EXPECT_NEAR(static_cast<double>(east.lit), static_cast<double>(west.lit), 0.1 * static_cast<double>(west.lit));
  // And 400 m beside the heights nothing is known that a radar lower than the rim could be below.
  EXPECT_EQ(seen_from(270.0, 1500.0, 100.0).below_ground_m, 0.0);
  EXPECT_EQ(seen_from(90.0, 1500.0, 100.0).below_ground_m, 0.0);
}

TEST_F(LiveTerrainTest, ATurnShowsTheSameWhereverItBegins) {
  const auto ground = example_.over(*store_);
  for (const std::size_t beams : {16U, 360U}) {
    const std::size_t later = beams / 4, a_step = beams / 8;
    LiveSettings settings;
    settings.content = FrameContent::Powers;
    settings.beams = beams;
    settings.ranges = 40;
    settings.beam_step_rad = 2.0 * pi / static_cast<double>(beams);
    settings.range_step_m = 20.0;
    Pose pose{.position = {example_.middle().x, example_.middle().y, 95.0}, .first_range_m = 100.0};
    LiveRenderer renderer(ground, settings);
    pose.first_azimuth_rad = 0.3 + settings.beam_step_rad * static_cast<double>(later);
    const std::vector<float> powers = numbers_of(settled_frame(renderer, *ground, pose));
    LiveRenderer scanning(ground, settings);
    const Frame* swept = nullptr;
    for (std::size_t beam = 0; beam < beams; beam += a_step) swept = &scanning.scan(pose, beam, a_step);
    EXPECT_TRUE(numbers_of(*swept) == powers) << beams;

    pose.first_azimuth_rad = 0.3;
    const Frame& sooner = settled_frame(renderer, *ground, pose);
    EXPECT_LT(sooner.report.lit, sooner.report.cells) << "hills hide ground";
    const std::size_t a_beam = 4 * settings.ranges;
    for (std::size_t beam = 0; beam < beams; ++beam) {
      double here = 0.0, there = 0.0;
      for (std::size_t i = 0; i < a_beam; i += 4) {
        here += static_cast<double>(powers[beam * a_beam + i]);
        there += static_cast<double>(sooner.powers_m2[(beam + later) % beams * a_beam + i]);
      }
      EXPECT_NEAR(db_from_linear(here / there), 0.0, 0.01) << beam << " of " << beams;
    }
  }
}

TEST_F(LiveTerrainTest, NoStepShowsOverHillsWhereTheLevelsChange) {
  const auto ground = example_.over(*store_);
  ExampleView view{.target = example_.middle()};
  view.bin_m = 30.0;
  view.beams = 40;
  view.ranges = 40;
  LiveSettings settings = view.settings(FrameContent::Powers);
  settings.beam_step_rad *= 0.4;
  LiveRenderer renderer(ground, settings);
  const Pose first = view.pose();
  const Vec3d target{view.target.x, view.target.y, 0.0};
  std::size_t first_level = 0, last_level = 0;
  double last = 0.0;
  for (int step = 0; step < 42; ++step) {
    Pose pose = first;
    pose.first_range_m += 120.0 * step;
    pose.position = target + (first.position - target) * (1.0 + 120.0 * step / 4000.0);
    renderer.render(pose);
    ground->wait_until_loaded();
    const Frame& frame = renderer.render(pose);
    EXPECT_EQ(frame.report.terrain_error_m, 0.0) << step;
    const double sum = total_vv(frame);
    // What a step makes of grazing angles and of the width of the beams is less than this.
    if (step > 0) {
      EXPECT_NEAR(db_from_linear(sum / last), 0.0, 0.2) << step;
    }
    last = sum;
    if (step == 0) first_level = frame.report.level;
    last_level = frame.report.level;
  }
  EXPECT_GT(last_level, first_level);
}

}  // namespace
}  // namespace sigmascape::live
