#include "sigmascape/live/stand_in_ground.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <string>

#include "frame_numbers.h"
#include "keep_worst.h"
#include "live_ground_example.h"

#include "sigmascape/base/error.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/terrain/terrain_pyramid.h"

namespace sigmascape::live {
namespace {

/// γ in VV as seen from an azimuth.
double gamma_from(double azimuth_rad) {
  return 0.1 * (1.0 + 0.5 * std::cos(azimuth_rad));
}

radar::Channels sigma0_by_azimuth(const radar::Look& look) {
  return constant_gamma(gamma_from(look.aspect.azimuth_rad), look);
}

/// The paper's five elevations; four tiles of the coarsest level meet in the middle. Every other texel of a
/// chessboard returns three times as much as the rest, 1 in the mean.
ExampleGround ground_about_the_origin(int azimuths) {
  ExampleGround ground;
  ground.about_origin = true;
  ground.azimuths = azimuths;
  ground.elevations_deg = {5.0, 13.0, 21.0, 29.0, 37.0};
  ground.sigma0 = sigma0_by_azimuth;
  ground.pattern = [texel_m = ground.texel_m](const radar::Look&, Vec2d p) {
    const auto parity = static_cast<long>(std::floor(p.x / texel_m)) + static_cast<long>(std::floor(p.y / texel_m));
    return parity % 2 == 0 ? 1.5F : 0.5F;
  };
  return ground;
}

/// The same of an atlas that keeps the ground apart, with nothing on it.
ExampleGround apart_about_the_origin(int azimuths) {
  ExampleGround ground = ground_about_the_origin(azimuths);
  ground.pattern = [](const radar::Look&, Vec2d) { return 1.0F; };
  // Half of what returns is the ground's own, whatever the azimuth.
  ground.sigma0 = [](const radar::Look& look) {
    return constant_gamma(gamma_from(look.aspect.azimuth_rad) - gamma_from(pi / 2.0) / 2.0, look);
  };
  ground.bare_sigma0 = [](const radar::Look& look) { return constant_gamma(gamma_from(pi / 2.0) / 2.0, look); };
  return ground;
}

/// From a baked azimuth, so that γ is that of its look; of the beams in the middle, over level ground: σ0 times the
/// area of each bin, in decibels off.
double error_of_middle_db(const Frame& frame, const ExampleView& view, double ground_m = 0.0) {
  double sum = 0.0, expected = 0.0;
  const radar::RangeAzimuthGrid& grid = frame.grid;
  for (std::size_t range = 4; range + 4 < view.ranges; ++range) {
    const double near = grid.first_range_m + static_cast<double>(range) * grid.range_step_m;
    const double middle = near + grid.range_step_m / 2.0;
    for (std::size_t beam = view.beams / 2 - 4; beam < view.beams / 2 + 4; ++beam) {
      sum += static_cast<double>(frame.powers_m2[(beam * view.ranges + range) * 4]);
      expected += gamma_from(radians_from_deg(view.azimuth_deg)) * (view.pose().position.z - ground_m) / middle *
                  middle * grid.range_step_m * grid.azimuth_step_rad;
    }
  }
  return db_from_linear(sum / expected);
}

/// First frames from these azimuths, each of a ground of which nothing was asked before.
void expect_light(const ExampleGround& example, const atlas::Store& store, std::initializer_list<double> azimuths_deg) {
  for (const double azimuth_deg : azimuths_deg) {
    const auto ground = example.over(store);
    ExampleView view{.target = example.middle(), .azimuth_deg = azimuth_deg, .elevation_deg = 18.0};
    view.beams = 32;
    LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
    const Frame& frame = renderer.render(view.pose());
    EXPECT_EQ(frame.report.dark, 0U) << azimuth_deg;
    EXPECT_GE(frame.report.coarse, frame.report.cells) << azimuth_deg;
    EXPECT_NEAR(error_of_middle_db(frame, view), 0.0, 0.05) << azimuth_deg;
  }
}

TEST(StandInGround, LightsTheFirstFrameBetweenThePapersLooksAboutTheOrigin) {
  const ScratchFolder folder;
  const ExampleGround example = ground_about_the_origin(8);
  expect_light(example, example.store(folder.path("atlas")), {0.0, 45.0, 180.0, 225.0, 315.0});
}

TEST(StandInGround, LightsTheFirstFrameOfGroundKeptApart) {
  const ScratchFolder folder;
  const ExampleGround example = apart_about_the_origin(8);
  expect_light(example, example.store(folder.path("atlas")), {0.0, 45.0, 180.0, 225.0, 315.0});
}

ExampleGround of_thirty_two_azimuths() {
  ExampleGround example = ground_about_the_origin(32);
  example.elevations_deg = {5.0, 37.0};
  return example;
}

class StandInGroundOfManyLooks : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<ScratchFolder>();
    store_ = std::make_unique<atlas::Store>(of_thirty_two_azimuths().store(folder_->path("atlas")));
  }
  static void TearDownTestSuite() {
    store_.reset();
    folder_.reset();
  }
  static inline std::unique_ptr<ScratchFolder> folder_;
  static inline std::unique_ptr<atlas::Store> store_;
};

TEST_F(StandInGroundOfManyLooks, LightsTheFirstFrameBetweenThirtyTwoAzimuths) {
  expect_light(of_thirty_two_azimuths(), *store_, {0.0, 11.25, 202.5, 348.75});
}

// Its coarsest level alone is five times what the cache holds.
TEST_F(StandInGroundOfManyLooks, LeavesTheCacheToWhatIsLookedAt) {
  ExampleGround example = of_thirty_two_azimuths();
  example.cache.budget_bytes = std::size_t{64} << 20U;
  const auto ground = example.over(*store_);
  ASSERT_GT(128U, 5 * ground->pages().most_pages());
  for (double azimuth_deg = 0.0; azimuth_deg < 360.0; azimuth_deg += 30.0) {
    const ExampleView view{.target = example.middle(), .azimuth_deg = azimuth_deg};
    LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
    (void)settled_frame(renderer, *ground, view.pose());
    // Pages of the last two frames make no room.
    (void)settled_frame(renderer, *ground, view.pose());
    EXPECT_EQ(renderer.render(view.pose()).report.coarse, 0U) << azimuth_deg;
  }
  EXPECT_GT(ground->pages().report().evicted, 0U);
}

TEST_F(StandInGroundOfManyLooks, TakesMoreThanItsPartOfASmallBudgetAndTellsOfOneThatIsTooSmall) {
  ExampleGround example = of_thirty_two_azimuths();
  const atlas::Store& store = *store_;
  // 128 pages of 16² texels are 1.2 MB, an eighth of the first budget 0.8 MB.
  example.cache.budget_bytes = 6'000'000;
  EXPECT_EQ(example.over(store)->stand_in().side(), StandInGround::least_side);
  expect_light(example, store, {11.25});
  example.cache.budget_bytes = 3'800'000;
  try {
    (void)example.over(store);
    FAIL() << "a budget that holds no page beside the coarsest ground";
  } catch (const Error& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("has a budget of 3800000 bytes"), std::string::npos) << said;
    EXPECT_NE(said.find("the coarsest ground of all looks 12"), std::string::npos) << said;
    EXPECT_NE(said.find("give enough"), std::string::npos) << said;
  }
}

/// Ground whose texels are all unlike.
ExampleGround unlike_texels() {
  ExampleGround example;
  example.about_origin = true;
  example.patches_a_side = 4;
  example.elevations_deg = {5.0, 37.0};
  example.sigma0 = sigma0_by_azimuth;
  example.pattern = [](const radar::Look& look, Vec2d p) {
    return static_cast<float>(1.0 + 0.5 * std::sin(p.x / 70.0 + look.aspect.azimuth_rad) * std::cos(p.y / 110.0) +
                              (p.x < 0.0 ? 0.25 : 0.0) + (p.y < 0.0 ? 0.2 : 0.0));
  };
  return example;
}

/// σ0 of one channel of one look of a page.
float sigma0_of(const GroundPage& page, std::size_t row, std::size_t column, std::size_t look, std::size_t channel) {
  const std::size_t lane = column % GroundPage::vector;
  return page.scale[look] * atlas::float_from_half(page.block_of(
                                row, column)[look * GroundPage::look_halves + channel * GroundPage::vector + lane]);
}

/// Every texel of every page, look and channel of pages with so many texels a side, against the mean of all texels of
/// level 0 under it.
void expect_means(const atlas::Store& store, std::size_t side) {
  const PageSource source(
      store,
      [](const radar::GroundGrid&, std::span<float> height_m) {
        std::ranges::fill(height_m, 7.0F);
        return Shortage();
      },
      10e9);
  const StandInGround stand_in(source, side);
  const atlas::PatchGrid& patches = store.description().patches;
  const auto& aspects = store.description().aspects;
  std::map<std::tuple<int, int, atlas::LookIndex>, Array2D<radar::Channels>> level_0;
  for (const atlas::Unit& unit : store.units()) {
    level_0[{unit.patch.x, unit.patch.y, unit.look}] = store.read(unit.patch, unit.look)[0];
  }
  double worst = 0.0;
  for (int y = -1; y <= 0; ++y) {
    for (int x = -1; x <= 0; ++x) {
      for (std::uint32_t azimuth = 0; azimuth < 4; ++azimuth) {
        const GroundPage* const page = stand_in.find({{1, x, y}, {azimuth, 0}});
        ASSERT_NE(page, nullptr);
        EXPECT_EQ(page->height_m, std::vector<float>(side * side, 7.0F));
        const radar::GroundGrid texels = page->texels(patches);
        EXPECT_EQ(texels.extent().west_m, x * 2048.0);
        EXPECT_EQ(texels.extent().south_m, y * 2048.0);
        EXPECT_EQ(texels.extent().width_m(), 2048.0);
        const std::size_t each = 512 / side;
        for (std::size_t row = 0; row < side; row += 3) {
          for (std::size_t column = 0; column < side; column += 5) {
            for (std::size_t look = 0; look < 4; ++look) {
              const atlas::LookIndex index = aspects.index_of((azimuth + look % 2) % 4, look / 2, 0);
              const atlas::PatchIndex patch = patches.patch_at(texels.centre_of(column, row));
              const Array2D<radar::Channels>& finest = level_0.at({patch.x, patch.y, index});
              double vv = 0.0, re_vvhh = 0.0;
              for (std::size_t r = 0; r < each; ++r) {
                for (std::size_t c = 0; c < each; ++c) {
                  const radar::Channels& here = finest((column * each + c) % 256, (row * each + r) % 256);
                  vv += static_cast<double>(here.vv) / static_cast<double>(each * each);
                  re_vvhh += static_cast<double>(here.re_vvhh) / static_cast<double>(each * each);
                }
              }
              const double got_vv = static_cast<double>(sigma0_of(*page, row, column, look, 0));
              const double got_re = static_cast<double>(sigma0_of(*page, row, column, look, 3));
              for (const double ratio : {got_vv / vv, got_re / re_vvhh}) keep_worst(worst, ratio - 1.0);
            }
          }
        }
      }
    }
  }
  // Halves have eleven bits; two of them are rounded one after the other.
  EXPECT_LT(std::abs(worst), 2.0 / 2048.0);
  EXPECT_EQ(stand_in.find({{1, 1, 0}, {0, 0}}), nullptr);
  EXPECT_EQ(stand_in.find({{1, 0, -2}, {0, 0}}), nullptr);
  EXPECT_EQ(stand_in.find({{0, 0, 0}, {0, 0}}), nullptr);
}

TEST(StandInGround, HasTheMeanOfWhatItsTexelsCover) {
  const ScratchFolder folder;
  const atlas::Store store = unlike_texels().store(folder.path("atlas"));
  const atlas::Pyramid pyramid(store);
  pyramid.make_above(store.units());
  ASSERT_EQ(pyramid.levels(), 1U);
  for (const std::size_t side : {16U, 64U, 256U}) expect_means(store, side);

  // Of a tile that is not there it is that of the four under it.
  std::filesystem::remove(store.folder() / pyramid.texture_path(pyramid.tiles(1)[1], 2));
  for (const std::size_t side : {16U, 256U}) expect_means(store, side);
  for (atlas::LookIndex look = 0; look < store.description().aspects.look_count(); ++look) {
    for (const atlas::PyramidTile& tile : pyramid.tiles(1)) {
      std::filesystem::remove(store.folder() / pyramid.texture_path(tile, look));
    }
  }
  expect_means(store, 64);
}

TEST(StandInGround, HasTheReliefUnderItsTexels) {
  const ScratchFolder folder;
  const atlas::Store store = apart_about_the_origin(2).store(folder.path("atlas"));
  const auto height_at = [](Vec2d p) { return static_cast<float>(p.x + 3.0 * p.y); };
  const auto slope_at = [](Vec2d p) {
    return terrain::PackedSlope{static_cast<std::int16_t>(p.x), static_cast<std::int16_t>(p.y)};
  };
  // As high as what comes from afar is taken to be, among others.
  const auto top_at = [](const atlas::TileAddress& tile, std::size_t texel) {
    return texel % 64 == 0 ? radar::from_afar_m
                           : 20.0F * unit_float(hashed(tile.x, tile.y, static_cast<std::int64_t>(texel)));
  };
  const auto fill = [](const radar::GroundGrid& cells, auto numbers, const auto& at) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      numbers[i] = at(cells.centre_of(i % cells.columns, i / cells.columns));
    }
  };
  const atlas::Store ground = atlas::open_ground_store(store);
  const PageSource source(
      store,
      [&](const radar::GroundGrid& cells, std::span<float> height_m) {
        fill(cells, height_m, height_at);
        return Shortage();
      },
      10e9,
      BareGround{ground,
                 [&](const radar::GroundGrid& cells, std::span<terrain::PackedSlope> slope) {
                   fill(cells, slope, slope_at);
                   return Shortage();
                 },
                 [&](const atlas::TileAddress& tile, std::span<float> top_m) {
                   for (std::size_t i = 0; i < top_m.size(); ++i) top_m[i] = top_at(tile, i);
                   return Shortage();
                 }});
  const StandInGround stand_in(source, 32);
  ASSERT_EQ(source.ground_pages(), 2U);
  std::size_t wrong = 0;
  for (const atlas::TileAddress& tile : {atlas::TileAddress{0, -1, 0}, atlas::TileAddress{0, 0, -1}}) {
    for (const std::uint32_t number : {0U, 1U}) {
      const GroundPage* const page = stand_in.find(PageKey::bare_ground(tile, number));
      ASSERT_NE(page, nullptr);
      EXPECT_EQ(page->key, PageKey::bare_ground(tile, number));
      const radar::GroundGrid texels = page->texels(store.description().patches);
      for (std::size_t texel = 0; texel < page->side * page->side; ++texel) {
        const std::size_t row = texel / 32, column = texel % 32;
        const Vec2d centre = texels.centre_of(column, row);
        float greatest = 0.0F;
        for (std::size_t r = 8 * row; r < 8 * row + 8; ++r) {
          for (std::size_t c = 8 * column; c < 8 * column + 8; ++c)
            greatest = std::max(greatest, top_at(tile, r * 256 + c));
        }
        const terrain::PackedSlope slope = slope_at(centre);
        if (page->height_m[texel] != height_at(centre) || page->top_m[texel] != greatest ||
            page->slope[texel].east != slope.east || page->slope[texel].north != slope.north)
          ++wrong;
      }
    }
  }
  EXPECT_EQ(wrong, 0U);
}

// Texels of 32 m over hills 50 m wide: what is seen of them is a matter of the terrain and not of the texels.
TEST(StandInGround, IsSeenWhereTheTerrainLetsItBeSeen) {
  const ScratchFolder folder;
  ExampleGround example = ground_about_the_origin(2);
  example.sigma0 = [](const radar::Look& look) { return constant_gamma(0.1, look); };
  example.height_m = [](Vec2d p) { return 5.0 * std::sin(2.0 * pi * p.x / 100.0) * std::sin(2.0 * pi * p.y / 100.0); };
  const atlas::Store store = example.store(folder.path("atlas"));
  const ExampleView view{.target = example.middle()};
  const auto whole = example.over(store);
  LiveRenderer settled(whole, view.settings(FrameContent::Powers));
  const Frame& fine = settled_frame(settled, *whole, view.pose());
  ASSERT_EQ(fine.report.coarse, 0U);

  example.cache.budget_bytes = 10'000'000;
  const auto ground = example.over(store);
  ASSERT_EQ(ground->stand_in().side(), 32U);
  // Nothing but what has been read when it was opened.
  std::filesystem::remove_all(store.folder());
  LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
  const Frame& coarse = settled_frame(renderer, *ground, view.pose());
  EXPECT_EQ(coarse.report.coarse, coarse.report.cells);
  EXPECT_EQ(coarse.report.terrain_error_m, 0.0);
  EXPECT_LT(static_cast<double>(fine.report.lit), 0.95 * static_cast<double>(fine.report.cells));
  EXPECT_NEAR(static_cast<double>(coarse.report.lit) / static_cast<double>(fine.report.lit), 1.0, 0.01);
  EXPECT_NEAR(db_from_linear(total_vv(coarse) / total_vv(fine)), 0.0, 0.05);
}

/// Level ground 100 m high, of which the coarsest level of the terrain knows nothing.
std::shared_ptr<terrain::TerrainPyramid> plateau() {
  constexpr float height_m = 100.0F;
  const double spacing_m = 8.0, side_m = spacing_m * terrain::HeightTile::cells * 64;
  const terrain::PyramidLayout layout{-side_m / 2.0, side_m / 2.0, spacing_m, 64, 64};
  std::vector<Array2D<terrain::TileSummary>> summaries;
  const auto summary_of = [&layout, height_m](int level) {
    return terrain::TileSummary{0.0F, height_m, level + 1 == layout.levels() ? height_m : 0.0F};
  };
  for (int level = 0; level < layout.levels(); ++level) {
    summaries.emplace_back(layout.across(level), layout.down(level), summary_of(level));
  }
  return std::make_shared<terrain::TerrainPyramid>(
      layout, layout.extent(), std::move(summaries),
      [coarsest = layout.levels() - 1, height_m](terrain::TileKey key) {
        auto tile = std::make_shared<terrain::HeightTile>();
        tile->height_m.assign(terrain::HeightTile::nodes * terrain::HeightTile::nodes,
                              key.level == coarsest ? 0.0F : height_m);
        tile->summary = {0.0F, height_m, key.level == coarsest ? height_m : 0.0F};
        return std::shared_ptr<const terrain::HeightTile>(tile);
      },
      std::size_t{8} << 20U);
}

TEST(StandInGround, StandsAtItsOwnHeightsUntilTheTerrainIsThere) {
  const ScratchFolder folder;
  ExampleGround example = ground_about_the_origin(8);
  const auto ground = std::make_shared<LiveGround>(example.store(folder.path("atlas")), plateau(), 10e9);
  const ExampleView view{.target = example.middle(), .azimuth_deg = 45.0, .elevation_deg = 18.0};
  LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
  const Frame& frame = renderer.render(view.pose());
  EXPECT_EQ(frame.report.coarse, frame.report.cells);
  EXPECT_EQ(frame.report.terrain_error_m, 100.0);
  EXPECT_NEAR(error_of_middle_db(frame, view, 100.0), 0.0, 0.05);
}

TEST(StandInGround, LacksThePagesOfALookThatCannotBeRead) {
  const ScratchFolder folder;
  ExampleGround example = ground_about_the_origin(4);
  example.elevations_deg = {5.0, 37.0};
  const atlas::Store store = example.store(folder.path("atlas"));
  std::filesystem::remove(store.folder() / store.texture_path({0, -1}, store.description().aspects.index_of(1, 0, 0)));
  const auto ground = example.over(store);
  for (std::uint32_t azimuth = 0; azimuth < 4; ++azimuth) {
    for (const atlas::TileAddress& tile :
         {atlas::TileAddress{0, 0, 0}, {0, -1, 0}, {0, 0, -1}, atlas::TileAddress{0, -1, -1}}) {
      const bool lacks = tile == atlas::TileAddress{0, 0, -1} && azimuth <= 1;
      EXPECT_EQ(ground->stand_in().find({tile, {azimuth, 0}}) == nullptr, lacks) << azimuth;
    }
  }
}

}  // namespace
}  // namespace sigmascape::live
