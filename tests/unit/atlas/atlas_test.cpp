#include "sigmascape/atlas/atlas.h"

#include <cmath>
#include <filesystem>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <unistd.h>

#include "example_texels.h"

#include "sigmascape/base/error.h"

namespace sigmascape::atlas {
namespace {

/// Powers of two times small integers, so that halves hold them exactly.
radar::Channels exact(std::size_t number) {
  const auto value = static_cast<float>(1 + number % 1024) / 64.0F;
  return {value, 2.0F * value, 0.5F * value, -value};
}

class AtlasTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("sigmascape_atlas_") + test->name() + "_" + std::to_string(::getpid()));
    std::filesystem::remove_all(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  using Texel = std::function<radar::Channels(Vec2d point_m, const radar::Look& look)>;

  [[nodiscard]] Store store_of(const AtlasDescription& description, const Texel& texel) const {
    Store store = Store::create(folder_, description);
    for (const Unit& unit : store.units()) {
      const radar::GroundGrid grid = description.patches.texels_of(unit.patch);
      Array2D<radar::Channels> texels(grid.columns, grid.rows);
      for (std::size_t row = 0; row < grid.rows; ++row) {
        for (std::size_t column = 0; column < grid.columns; ++column) {
          texels(column, row) = texel(grid.centre_of(column, row), store.description().aspects.look(unit.look));
        }
      }
      store.write(unit.patch, unit.look, texels, {});
    }
    return store;
  }

  std::filesystem::path folder_;
};

/// Two by two small patches around the origin.
AtlasDescription four_patches() {
  AtlasDescription description = example_description();
  description.extent = {-256.0, -256.0, 256.0, 256.0};
  description.patches = {1.0, 256};
  return description;
}

TEST_F(AtlasTest, ConstantGammaReturnsItselfEverywhere) {
  const radar::Channels gamma{0.75F, 1.5F, 0.125F, -0.5F};
  const Atlas atlas = load_atlas(store_of(example_description(), [&](Vec2d, const radar::Look& look) {
    return gamma * static_cast<float>(std::sin(look.aspect.elevation_rad));
  }));
  EXPECT_EQ(atlas.coarsest_level(), 9U);
  const double highest = atlas.aspects().elevations_rad.back();
  for (int i = 0; i < 3000; ++i) {
    const Vec2d point{-512.0 + 1024.0 * ((i * 37) % 1009) / 1009.0, 512.0 * ((i * 101) % 2003) / 2003.0};
    const radar::Aspect aspect{0.01 * i, radians_from_deg(0.5 + 0.02 * i)};
    const radar::Channels found = atlas.sigma0_at(point, aspect, 10e9, 0.0037 * i - 0.5);
    // Stored halves are within 2⁻¹¹ of what they stand for.
    const auto sine = static_cast<float>(std::sin(std::min(aspect.elevation_rad, highest)));
    ASSERT_NEAR(found.vv, 0.75F * sine, 5e-4F * 0.75F * sine) << i;
    ASSERT_NEAR(found.hh, 1.5F * sine, 5e-4F * 1.5F * sine) << i;
    ASSERT_NEAR(found.hv, 0.125F * sine, 5e-4F * 0.125F * sine) << i;
    ASSERT_NEAR(found.re_vvhh, -0.5F * sine, 5e-4F * 0.5F * sine) << i;
  }
}

TEST_F(AtlasTest, BakedLooksComeBackExactlyAtTexelCentres) {
  const auto texel = [](Vec2d point, const radar::Look& look) {
    return exact(static_cast<std::size_t>(point.x + 1000.0) * 7 + static_cast<std::size_t>(point.y + 1000.0) * 13 +
                 static_cast<std::size_t>(deg_from_radians(look.aspect.azimuth_rad + look.aspect.elevation_rad) + 0.5));
  };
  const AtlasDescription description = four_patches();
  const Atlas atlas = load_atlas(store_of(description, texel));
  for (LookIndex index = 0; index < description.aspects.look_count(); ++index) {
    const radar::Look look = description.aspects.look(index);
    for (double y = -255.5; y < 256.0; y += 3.0) {
      for (double x = -255.5; x < 256.0; x += 5.0) {
        ASSERT_EQ(atlas.sigma0_at({x, y}, look.aspect, look.frequency_hz, 0.0), texel({x, y}, look)) << x << " " << y;
      }
    }
  }
}

TEST_F(AtlasTest, AzimuthIsInterpolatedAcrossNorth) {
  AtlasDescription description = four_patches();
  description.aspects = paper_aspect_grid();
  description.aspects.elevations_rad = {radians_from_deg(13.0)};
  description.extent = {0.0, 0.0, 256.0, 256.0};
  const Atlas atlas = load_atlas(store_of(description, [](Vec2d, const radar::Look& look) {
    const bool north = look.aspect.azimuth_rad == 0.0;
    const bool north_west = std::abs(deg_from_radians(look.aspect.azimuth_rad) - 315.0) < 1e-6;
    return radar::Channels{north ? 9.0F : (north_west ? 4.5F : 100.0F), 0.0F, 0.0F, 0.0F};
  }));
  const radar::Aspect aspect{radians_from_deg(340.5), radians_from_deg(13.0)};
  EXPECT_NEAR(atlas.sigma0_at({100.0, 100.0}, aspect, 10e9, 0.0).vv, 7.875F, 1e-5F);
}

TEST_F(AtlasTest, PowerIsInterpolatedLinearlyAndNotInDecibels) {
  AtlasDescription description = four_patches();
  description.aspects.azimuths_rad = {0.0, radians_from_deg(90.0)};
  description.aspects.elevations_rad = {radians_from_deg(13.0)};
  const Atlas atlas = load_atlas(store_of(description, [](Vec2d, const radar::Look& look) {
    return radar::Channels{look.aspect.azimuth_rad == 0.0 ? 1.0F : 100.0F, 0.0F, 0.0F, 0.0F};
  }));
  const radar::Aspect aspect{radians_from_deg(45.0), radians_from_deg(13.0)};
  EXPECT_NEAR(atlas.sigma0_at({7.0, 7.0}, aspect, 10e9, 0.0).vv, 50.5F, 1e-4F);
}

TEST_F(AtlasTest, BelowTheLowestElevationPowerGoesWithTheSine) {
  const Atlas atlas = load_atlas(store_of(four_patches(), [](Vec2d, const radar::Look&) {
    return radar::Channels{1.0F, 1.0F, 1.0F, -1.0F};
  }));
  const auto sigma0 = [&](double elevation_deg) {
    return atlas.sigma0_at({3.0, 3.0}, {0.0, radians_from_deg(elevation_deg)}, 10e9, 0.0);
  };
  const double expected = std::sin(radians_from_deg(1.0)) / std::sin(radians_from_deg(5.0));
  EXPECT_NEAR(static_cast<double>(sigma0(1.0).vv), expected, 1e-6);
  EXPECT_NEAR(static_cast<double>(sigma0(1.0).re_vvhh), -expected, 1e-6);
  EXPECT_EQ(sigma0(0.0), radar::Channels{});
  EXPECT_EQ(sigma0(-4.0), radar::Channels{});
  EXPECT_EQ(sigma0(60.0).vv, 1.0F);
}

/// A coordinate as texels of that width show it: their middles, with steps over half a texel about the edges.
double in_steps(double coordinate_m, double texel_m) {
  const double way = coordinate_m / texel_m - 0.5, before = std::floor(way);
  return texel_m * (before + 0.5 + std::clamp(2.0 * (way - before) - 0.5, 0.0, 1.0));
}

TEST_F(AtlasTest, BordersBetweenPatchesDoNotShow) {
  const auto ramp = [](Vec2d p) { return static_cast<float>(4.0 + (p.x + 2.0 * p.y) / 512.0); };
  const Atlas atlas = load_atlas(store_of(four_patches(), [&](Vec2d point, const radar::Look&) {
    return radar::Channels{ramp(point), 0.0F, 0.0F, 0.0F};
  }));
  const AspectWeights weights = atlas.weights_for({0.0, radians_from_deg(5.0)}, 10e9);
  for (const double level : {0.0, 1.0, 2.0, 4.0}) {
    const double texel_m = std::exp2(level);
    for (double offset = -20.0; offset <= 20.0; offset += 0.37) {
      for (const Vec2d point : {Vec2d{offset, 33.3}, Vec2d{-71.1, offset}, Vec2d{offset, offset}}) {
        const Vec2d shown{in_steps(point.x, texel_m), in_steps(point.y, texel_m)};
        ASSERT_NEAR(atlas.sigma0_at(point, weights, level).vv, ramp(shown), 4e-3F) << level << " " << offset;
      }
    }
  }
}

// Power that is read evenly over the ground is the texels' own, wherever the reading begins.
TEST_F(AtlasTest, ReadTwiceATexelKeepsALoneTexelsPower) {
  const Atlas atlas = load_atlas(store_of(four_patches(), [](Vec2d point, const radar::Look&) {
    return radar::Channels{point == Vec2d{20.5, 30.5} ? 8.0F : 0.0F, 0.0F, 0.0F, 0.0F};
  }));
  const AspectWeights weights = atlas.weights_for({0.0, radians_from_deg(5.0)}, 10e9);
  for (const double from : {0.0, 0.1, 0.23, 0.37}) {
    float sum = 0.0F, widest = 0.0F;
    for (double y = 26.0 + from; y < 35.0; y += 0.5) {
      for (double x = 16.0 + from; x < 25.0; x += 0.5) {
        const float here = atlas.sigma0_at({x, y}, weights, 0.0).vv;
        sum += here;
        if (here > 0.0F) widest = std::max(widest, static_cast<float>(std::abs(x - 20.5)));
      }
    }
    EXPECT_NEAR(sum * 0.25F, 8.0F, 1e-3F) << from;
    EXPECT_LT(widest, 0.75F) << from << ": it reaches no farther than a quarter of a texel beyond its edges";
  }
}

TEST_F(AtlasTest, OutsideThereIsNothing) {
  const Atlas atlas = load_atlas(store_of(four_patches(), [](Vec2d, const radar::Look&) {
    return radar::Channels{1.0F, 1.0F, 1.0F, 1.0F};
  }));
  const AspectWeights weights = atlas.weights_for({0.0, radians_from_deg(5.0)}, 10e9);
  for (const Vec2d inside : {Vec2d{0.0, 0.0}, Vec2d{-255.99, 255.99}, Vec2d{255.99, -255.99}}) {
    EXPECT_TRUE(atlas.covers(inside));
    for (const double level : {0.0, 3.0, 8.0}) EXPECT_NEAR(atlas.sigma0_at(inside, weights, level).vv, 1.0F, 1e-6F);
  }
  for (const Vec2d outside : {Vec2d{-256.5, 0.0}, Vec2d{0.0, 256.5}, Vec2d{1e9, 0.0}, Vec2d{0.0, -1e12},
                              Vec2d{std::nan(""), 0.0}, Vec2d{0.0, INFINITY}}) {
    EXPECT_FALSE(atlas.covers(outside));
    EXPECT_EQ(atlas.sigma0_at(outside, weights, 0.0), radar::Channels{});
  }
}

TEST_F(AtlasTest, CoarserLevelsAreAreaMeansDownToOneTexelAPatch) {
  const auto texel = [](Vec2d point, const radar::Look&) {
    const bool bright = std::fmod(std::floor(point.x + 4096.0) + std::floor(point.y + 4096.0), 2.0) == 0.0;
    return radar::Channels{bright ? 3.0F : 1.0F, 0.0F, 0.0F, 0.0F};
  };
  const Atlas atlas = load_atlas(store_of(four_patches(), texel));
  const AspectWeights weights = atlas.weights_for({0.0, radians_from_deg(5.0)}, 10e9);
  EXPECT_EQ(atlas.sigma0_at({0.5, 0.5}, weights, 0.0).vv, 3.0F);
  EXPECT_EQ(atlas.sigma0_at({1.5, 0.5}, weights, 0.0).vv, 1.0F);
  for (const double level : {1.0, 2.0, 5.5, 8.0, 30.0}) {
    EXPECT_NEAR(atlas.sigma0_at({17.3, -44.4}, weights, level).vv, 2.0F, 2e-3F) << level;
  }
  EXPECT_NEAR(atlas.sigma0_at({0.5, 0.5}, weights, 0.25).vv, 0.75F * 3.0F + 0.25F * 2.0F, 2e-3F);
}

TEST_F(AtlasTest, LeavingOutFineLevelsSavesMemoryAndChangesNothingElse) {
  const Store store = store_of(example_description(), [](Vec2d point, const radar::Look&) {
    return exact(static_cast<std::size_t>(point.x + 1000.0) * 31 + static_cast<std::size_t>(point.y));
  });
  const Atlas whole = load_atlas(store);
  const Atlas coarse = load_atlas(store, {2, 1});
  EXPECT_LT(coarse.memory_bytes() * 15, whole.memory_bytes());
  EXPECT_EQ(coarse.level_for(1.0), 2.0);
  const AspectWeights weights = whole.weights_for({1.0, radians_from_deg(7.0)}, 10e9);
  for (const double level : {2.0, 2.7, 9.0}) {
    EXPECT_EQ(coarse.sigma0_at({77.7, 200.0}, weights, level), whole.sigma0_at({77.7, 200.0}, weights, level));
  }
  EXPECT_EQ(coarse.sigma0_at({77.7, 200.0}, weights, 0.0), whole.sigma0_at({77.7, 200.0}, weights, 2.0));
  EXPECT_THROW(static_cast<void>(load_atlas(store, {10, 1})), Error);
}

TEST_F(AtlasTest, TheLevelFollowsTheSideOfTheCell) {
  const Atlas atlas = load_atlas(store_of(four_patches(), [](Vec2d, const radar::Look&) {
    return radar::Channels{1.0F, 1.0F, 1.0F, 1.0F};
  }));
  EXPECT_DOUBLE_EQ(atlas.level_for(8.0), 3.0);
  EXPECT_DOUBLE_EQ(atlas.level_for(0.1), 0.0);
  EXPECT_DOUBLE_EQ(atlas.level_for(1e6), 8.0);
  EXPECT_DOUBLE_EQ(atlas.level_for(-1.0), 0.0);
}

TEST_F(AtlasTest, OtherFrequenciesAreRefusedAtTheDoor) {
  const Atlas atlas = load_atlas(store_of(four_patches(), [](Vec2d, const radar::Look&) {
    return radar::Channels{1.0F, 1.0F, 1.0F, 1.0F};
  }));
  EXPECT_NO_THROW(atlas.check_frequency(10e9));
  EXPECT_THROW(atlas.check_frequency(9e9), Error);
  EXPECT_THROW(atlas.check_frequency(std::nan("")), Error);
}

TEST_F(AtlasTest, AnUnfinishedBakeIsRefusedByName) {
  const Store store = store_of(four_patches(), [](Vec2d, const radar::Look&) {
    return radar::Channels{1.0F, 1.0F, 1.0F, 1.0F};
  });
  std::filesystem::remove(folder_ / store.texture_path({-1, -1}, 2));
  try {
    static_cast<void>(load_atlas(store));
    FAIL() << "loaded all the same";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(store.texture_path({-1, -1}, 2).string()));
    EXPECT_THAT(error.what(), testing::HasSubstr("1 of 16"));
  }
}

/// A coarser grid read out of a finer store is the store that would have been baked on it.
TEST_F(AtlasTest, SelectedLooksMakeTheAtlasOfTheCoarserGrid) {
  const auto texel = [](Vec2d point, const radar::Look& look) {
    const double angle_deg = deg_from_radians(look.aspect.azimuth_rad + 3.0 * look.aspect.elevation_rad);
    return exact(static_cast<std::size_t>(1000.5 + point.x + 7.0 * point.y + angle_deg));
  };
  AtlasDescription fine = four_patches();
  fine.extent = {-256.0, 0.0, 256.0, 256.0};
  fine.aspects.azimuths_rad = {0.0, 0.5 * pi, pi, 1.5 * pi};
  fine.aspects.elevations_rad = {radians_from_deg(5.0), radians_from_deg(13.0), radians_from_deg(21.0)};
  const Store fine_store = store_of(fine, texel);
  const Atlas selected = load_atlas(fine_store, {.aspects = {.azimuths = {0, 2}, .elevations = {1, 2}}});

  AtlasDescription coarse = fine;
  coarse.aspects.azimuths_rad = {0.0, pi};
  coarse.aspects.elevations_rad = {radians_from_deg(13.0), radians_from_deg(21.0)};
  std::filesystem::remove_all(folder_);
  const Atlas baked = load_atlas(store_of(coarse, texel));

  EXPECT_EQ(selected.aspects(), coarse.aspects);
  EXPECT_EQ(selected.memory_bytes(), baked.memory_bytes());
  for (int i = 0; i < 500; ++i) {
    const Vec2d point{-250.0 + i, 1.0 + 0.5 * i};
    const radar::Aspect aspect{0.013 * i, radians_from_deg(3.0 + 0.05 * i)};
    const double level = 0.003 * i;
    ASSERT_EQ(selected.sigma0_at(point, aspect, 10e9, level), baked.sigma0_at(point, aspect, 10e9, level)) << i;
  }
}

TEST_F(AtlasTest, OnlySelectedLooksNeedToBeThere) {
  const AtlasDescription description = four_patches();
  const Store store = store_of(description, [](Vec2d, const radar::Look&) {
    return radar::Channels{1.0F, 1.0F, 1.0F, 1.0F};
  });
  std::filesystem::remove(folder_ / store.texture_path({-1, -1}, description.aspects.index_of(1, 0, 0)));
  EXPECT_NO_THROW(static_cast<void>(load_atlas(store, {.aspects = {.azimuths = {0}, .elevations = {}}})));
  EXPECT_THROW(static_cast<void>(load_atlas(store, {.aspects = {.azimuths = {1}, .elevations = {}}})), Error);
}

/// Of four patches those alone that a point's texels lie on, at the levels that are asked for; finer ones when they
/// are.
TEST_F(AtlasTest, WhatIsReadAsAskedIsWhatWouldBeReadAtOnce) {
  const Store store = store_of(four_patches(), [](Vec2d point, const radar::Look& look) {
    return exact(static_cast<std::size_t>(1000.5 + point.x + 7.0 * point.y + 40.0 * look.aspect.elevation_rad));
  });
  const Atlas whole = load_atlas(store);
  const Atlas asked = load_atlas(store, {.reading = Reading::AsAsked});
  EXPECT_EQ(asked.memory_bytes(), 0U);
  const AspectWeights weights = whole.weights_for({1.0, radians_from_deg(7.0)}, 10e9);
  const auto expect_same = [&](const radar::Rectangle& area, double level) {
    for (const double x : {area.west_m, area.east_m}) {
      for (const double y : {area.south_m, area.north_m})
        EXPECT_EQ(asked.sigma0_at({x, y}, weights, level), whole.sigma0_at({x, y}, weights, level)) << x << " " << y;
    }
  };
  const radar::Rectangle within{40.0, 40.0, 200.0, 200.0};
  asked.prepare(within, 3.5);
  EXPECT_LT(asked.memory_bytes() * 4 * 60, whole.memory_bytes());
  expect_same(within, 3.5);
  EXPECT_EQ(asked.sigma0_at({100.0, 100.0}, weights, 0.0), radar::Channels{});
  asked.prepare(within, 0.0);
  EXPECT_EQ(asked.memory_bytes() * 4, whole.memory_bytes());
  expect_same(within, 0.0);
  const radar::Rectangle at_the_border{0.25, 40.0, 200.0, 200.0};
  asked.prepare(at_the_border, 0.0);
  EXPECT_EQ(asked.memory_bytes() * 2, whole.memory_bytes());
  expect_same(at_the_border, 0.0);
  asked.prepare({-1e9, -1e9, 1e9, 1e9}, 0.0);
  EXPECT_EQ(asked.memory_bytes(), whole.memory_bytes());
  asked.prepare({1e4, 1e4, 2e4, 2e4}, 0.0);
}

TEST_F(AtlasTest, WhatIsNotAskedForNeedNotBeThere) {
  const Store store = store_of(four_patches(), [](Vec2d, const radar::Look&) {
    return radar::Channels{1.0F, 1.0F, 1.0F, 1.0F};
  });
  std::filesystem::remove(folder_ / store.texture_path({-1, -1}, 2));
  const Atlas atlas = load_atlas(store, {.reading = Reading::AsAsked});
  EXPECT_NO_THROW(atlas.prepare({40.0, 40.0, 200.0, 200.0}, 0.0));
  EXPECT_THROW(atlas.prepare({-200.0, -200.0, 200.0, 200.0}, 0.0), Error);
  EXPECT_THROW(atlas.check_whole(), Error);
  const AspectWeights weights = atlas.weights_for({1.0, radians_from_deg(7.0)}, 10e9);
  EXPECT_GT(atlas.sigma0_at({100.0, 100.0}, weights, 0.0).vv, 0.5F);
}

TEST_F(AtlasTest, SelectionsThatAreNotOnTheAxesAreRefused) {
  const AspectGrid grid = paper_aspect_grid();
  EXPECT_THROW(static_cast<void>(selected_grid(grid, {.azimuths = {8}, .elevations = {}})), Error);
  EXPECT_THROW(static_cast<void>(selected_looks(grid, {.azimuths = {}, .elevations = {2, 1}})), Error);
  EXPECT_THROW(static_cast<void>(selected_looks(grid, {.azimuths = {3, 3}, .elevations = {}})), Error);
  EXPECT_EQ(selected_looks(grid, {}).size(), grid.look_count());
}

}  // namespace
}  // namespace sigmascape::atlas
