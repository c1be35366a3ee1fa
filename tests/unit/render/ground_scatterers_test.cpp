#include "sigmascape/render/ground_scatterers.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

#include "scratch_folder.h"

#include "sigmascape/atlas/store.h"
#include "sigmascape/base/units.h"

namespace sigmascape::render {
namespace {

constexpr radar::Rectangle whole_area{0.0, 0.0, 512.0, 512.0};

radar::Channels of_constant_gamma(Vec2d, const radar::Aspect& aspect) {
  const auto sigma0 = static_cast<float>(0.1 * std::sin(aspect.elevation_rad));
  return {sigma0, sigma0, 0.0F, sigma0};
}

/// Of constant gamma, without anything baked.
atlas::Atlas gamma_atlas() {
  const ScratchFolder folder;
  atlas::AtlasDescription description;
  description.name = "made up";
  description.extent = whole_area;
  description.patches = {2.0, 256};
  description.aspects.azimuths_rad = {0.0, pi};
  for (const double degrees : {5.0, 15.0, 25.0, 35.0, 45.0, 60.0})
    description.aspects.elevations_rad.push_back(radians_from_deg(degrees));
  description.aspects.frequencies_hz = {10e9};
  description.scene_hash = "none";
  const auto store = atlas::Store::create(folder.path("atlas"), description);
  for (const atlas::Unit& unit : store.units()) {
    const radar::GroundGrid grid = description.patches.texels_of(unit.patch);
    const radar::Channels sigma0 = of_constant_gamma({}, description.aspects.look(unit.look).aspect);
    const Array2D<radar::Channels> texels(grid.columns, grid.rows, sigma0);
    store.write(unit.patch, unit.look, texels, {});
  }
  return atlas::load_atlas(store);
}

/// Level but for a tower of 20 m, 8 m wide, about (404, 200).
terrain::HeightField ground_with_tower(float height_m = 20.0F) {
  terrain::HeightField terrain{
      .west_m = 0.0, .north_m = 512.0, .spacing_m = 2.0, .height_m = Array2D<float>(257, 257, 0.0F)};
  for (std::size_t row = 154; row <= 158; ++row)
    for (std::size_t column = 200; column <= 204; ++column) terrain.height_m(column, row) = height_m;
  return terrain;
}

/// 300 m high and 500 m south of the tower, 304 m before it on the way east.
const radar::PassingBeam abeam{
    .position = {100.0, -300.0, 300.0}, .velocity_mps = {100.0, 0.0, 0.0}, .outwards = {0.0, 1.0}};

/// One way and the other to what the ground returns.
class StripGround : public ::testing::TestWithParam<bool> {
 protected:
  [[nodiscard]] std::vector<radar::Scatterer> seen(const radar::Vantage& vantage, const radar::Rectangle& area,
                                                   const terrain::HeightField& terrain,
                                                   std::span<const radar::Target> targets = {}) const {
    const Reflectivity sigma0 = GetParam() ? of_atlas() : Reflectivity(ReflectivityField(of_constant_gamma));
    const radar::ScattererLattice lattice({.seed = 3, .cell_m = 1.0, .levels = 1});
    return ground_scatterers(terrain, sigma0, lattice, {.vantage = vantage, .area = area}, targets);
  }

 private:
  static Reflectivity of_atlas() {
    static const atlas::Atlas atlas = gamma_atlas();
    return reflectivity_of(atlas, 10e9, 1.0);
  }
};

std::size_t count_in(const std::vector<radar::Scatterer>& scatterers, const radar::Rectangle& part) {
  return static_cast<std::size_t>(std::ranges::count_if(scatterers, [&](const radar::Scatterer& scatterer) {
    return part.contains({scatterer.position.x, scatterer.position.y});
  }));
}

/// Its shadow is 20 m · 500 m / 280 m = 36 m long and falls north, and not along the line from (100, -300).
TEST_P(StripGround, HasShadowsAlongTheBeamThatPasses) {
  const auto terrain = ground_with_tower();
  const radar::Rectangle area{380.0, 150.0, 450.0, 260.0};
  const radar::Rectangle behind{401.0, 210.0, 407.0, 230.0}, aslant{415.0, 220.0, 420.0, 232.0};
  const auto passing = seen(radar::Vantage(abeam), area, terrain);
  EXPECT_EQ(count_in(passing, behind), 0U);
  EXPECT_EQ(count_in(passing, aslant), 60U);
  const auto still = seen(radar::Vantage(abeam.position), area, terrain);
  EXPECT_GT(count_in(still, behind), 30U);
  EXPECT_EQ(count_in(still, {415.5, 222.0, 418.5, 230.0}), 0U);
}

TEST_P(StripGround, HasShadowsAlongASquintedBeam) {
  const auto terrain = ground_with_tower();
  radar::PassingBeam squinted = abeam;
  squinted.outwards = {-0.6, 0.8};
  const auto scatterers = seen(radar::Vantage(squinted), {350.0, 150.0, 450.0, 260.0}, terrain);
  // 20 m behind the tower's middle, along the beam.
  EXPECT_EQ(count_in(scatterers, {390.0, 214.0, 394.0, 218.0}), 0U);
  EXPECT_EQ(count_in(scatterers, {404.0, 214.0, 408.0, 218.0}), 16U);
}

/// 290 m along as at broadside: γ sin ψ of the least distance, and not 0.6 dB less.
TEST_P(StripGround, HasTheGrazingAngleOfClosestRange) {
  const auto terrain = ground_with_tower(0.0F);
  const auto mean_db = [&](const radar::Vantage& vantage, const radar::Rectangle& area) {
    double sum = 0.0;
    for (const radar::Scatterer& scatterer : seen(vantage, area, terrain))
      sum += static_cast<double>(std::norm(scatterer.amplitude_m.vv));
    return db_from_linear(sum / (area.width_m() * area.height_m()));
  };
  // The same cells drawn alike, so that what differs is σ0 alone.
  const radar::Rectangle far_along{380.0, 90.0, 400.0, 110.0};
  radar::PassingBeam later = abeam;
  later.position.x = 390.0;
  const double broadside_db = mean_db(radar::Vantage(later.position), far_along);
  EXPECT_NEAR(mean_db(radar::Vantage(abeam), far_along), broadside_db, 0.01);
  EXPECT_LT(mean_db(radar::Vantage(abeam.position), far_along), broadside_db - 0.5);
}

TEST_P(StripGround, AnswersOnBothSidesOfTheTrack) {
  radar::PassingBeam across = abeam;
  across.position = {100.0, 256.0, 400.0};
  across.outwards = {0.6, 0.8};
  const radar::Rectangle area{150.0, 156.0, 350.0, 356.0};
  EXPECT_EQ(seen(radar::Vantage(across), area, ground_with_tower(0.0F)).size(), 40'000U);
}

/// Of level ground nothing is hidden, and at its edges neither, wherever steps and lines of sight come to lie there.
TEST_P(StripGround, ReachesTheEdgesOfTheTerrain) {
  const auto terrain = ground_with_tower(0.0F);
  radar::PassingBeam squinted = abeam, backwards = abeam;
  squinted.outwards = {-0.6, 0.8};
  backwards.position = {400.3, 1250.7, 300.0};
  backwards.velocity_mps = {-80.0, -60.0, 0.0};
  backwards.outwards = {0.6, -0.8};
  for (const auto& vantage :
       {radar::Vantage(abeam), radar::Vantage(squinted), radar::Vantage(backwards), radar::Vantage(abeam.position),
        radar::Vantage(backwards.position), radar::Vantage(Vec3d{-300.0, 256.0, 200.0})}) {
    EXPECT_EQ(seen(vantage, whole_area, terrain).size(), 512U * 512U);
  }
}

INSTANTIATE_TEST_SUITE_P(OfFieldAndAtlas, StripGround, ::testing::Bool(),
                         [](const auto& instance) { return instance.param ? "atlas" : "field"; });

/// A hillside that faces a low radar, 60 km away over ground that nobody knows: what the sea hides of it is not there.
TEST(GroundScatterers, BeyondTheHorizonAreOfWhatRisesAboveIt) {
  terrain::HeightField hillside = ground_with_tower(0.0F);
  for (std::size_t row = 0; row < 257; ++row) {
    const auto height_m = std::clamp(0.2F * static_cast<float>(178 - static_cast<int>(row)) * 2.0F, 0.0F, 40.0F);
    for (std::size_t column = 0; column < 257; ++column) hillside.height_m(column, row) = height_m;
  }
  const radar::CurvedEarth earth;
  const Vec3d radar{256.0, -60e3, 100.0};
  const atlas::Atlas atlas = gamma_atlas();
  const radar::ScattererLattice lattice({.seed = 3, .cell_m = 1.0, .levels = 1});
  const auto bright = [](Vec2d, const radar::Aspect&) { return radar::Channels{1.0F, 1.0F, 0.0F, 1.0F}; };
  for (const Reflectivity& sigma0 : {Reflectivity(ReflectivityField(bright)), reflectivity_of(atlas, 10e9, 1.0)}) {
    const auto seen =
        ground_scatterers(hillside, sigma0, lattice,
                          {.vantage = radar::Vantage(radar), .area = {200.0, 100.0, 312.0, 400.0}, .earth = earth});
    ASSERT_FALSE(seen.empty());
    const auto lowest = std::ranges::min_element(seen, {}, [](const auto& one) { return one.position.z; });
    const double distance_m = lowest->position.y - radar.y;
    EXPECT_NEAR(lowest->position.z, earth.drop_m(distance_m - earth.horizon_m(radar.z)), 0.5);
  }
}

TEST(GroundScatterers, SayWhatMakesThemFewer) {
  const terrain::HeightField terrain = ground_with_tower(0.0F);
  const radar::ScattererLattice lattice({.seed = 3, .cell_m = 0.01, .levels = 1});
  const std::string message = message_of_error([&] {
    static_cast<void>(ground_scatterers(terrain, ReflectivityField(of_constant_gamma), lattice,
                                        {.vantage = radar::Vantage(abeam), .area = whole_area}));
  });
  EXPECT_THAT(message, ::testing::HasSubstr("an area of 512 m by 512 m in cells of 0.01 m"));
  EXPECT_THAT(message, ::testing::HasSubstr("pulses over a shorter interval"));
}

}  // namespace
}  // namespace sigmascape::render
