#include "sigmascape/render/paper_method.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>

#include "sigmascape/base/units.h"
#include "sigmascape/receiver/range_azimuth_receiver.h"

namespace sigmascape::render {
namespace {

constexpr radar::GroundGrid patch{.west_m = 0, .north_m = 512, .cell_m = 2.0, .columns = 256, .rows = 256};
const atlas::AspectGrid paper_grid = atlas::paper_aspect_grid();

using PaperTexel = std::function<double(std::size_t column, std::size_t row, const radar::Aspect& aspect)>;

PaperTextures textures_of(const PaperTexel& texel) {
  std::vector<Array2D<radar::Channels>> looks;
  for (atlas::LookIndex look = 0; look < paper_grid.look_count(); ++look) {
    Array2D<radar::Channels>& texels = looks.emplace_back(patch.columns, patch.rows);
    for (std::size_t row = 0; row < patch.rows; ++row) {
      for (std::size_t column = 0; column < patch.columns; ++column)
        texels(column, row).vv = static_cast<float>(texel(column, row, paper_grid.look(look).aspect));
    }
  }
  return {patch, paper_grid, looks};
}

terrain::HeightField terrain_of(const std::function<double(Vec2d)>& height) {
  terrain::HeightField terrain{0.0, 512.0, 4.0, Array2D<float>(129, 129)};
  for (std::size_t row = 0; row < 129; ++row) {
    for (std::size_t column = 0; column < 129; ++column) {
      terrain.height_m(column, row) =
          static_cast<float>(height({4.0 * static_cast<double>(column), 512.0 - 4.0 * static_cast<double>(row)}));
    }
  }
  return terrain;
}

radar::Radar radar_in_the_south(double elevation_deg) {
  radar::Radar radar;
  radar.position = radar::position_seeing({256, 256, 0}, pi, radians_from_deg(elevation_deg), 20e3);
  radar.range_resolution_m = 4.0;
  radar.beam_width_rad = 4.0 * std::sqrt(2.0) / 20e3;
  return radar;
}

/// Cross-section of all that answers within the area.
double total_m2(const PaperTextures& textures, const terrain::HeightField& terrain, const radar::Radar& radar,
                const radar::Rectangle& area, const PaperLookUp& look_up = {}) {
  const std::vector<Vec3d> corners{{0, 0, -60}, {512, 0, 60}, {0, 512, -60}, {512, 512, 60}};
  const auto image = paper_image(textures, terrain, radar, area, receiver::grid_covering(radar, corners), look_up, 1);
  double sum = 0.0;
  for (const radar::Channels& bin : image.rcs_m2.values()) sum += static_cast<double>(bin.vv);
  return sum;
}

TEST(PaperMethod, RadianceIsTheInverseOfReflectivity) {
  // σ of a small surface: σ0 · A, with the solid angle A (n·l) / r² that it fills.
  const double range_m = 7e3, facing = 0.2, area_m2 = 3.0;
  const double rcs =
      rcs_of_radiance(radiance_of(0.05, range_m, facing), range_m, area_m2 * facing / (range_m * range_m));
  EXPECT_NEAR(rcs, 0.05 * area_m2, 1e-12);
}

TEST(PaperMethod, LevelGroundReturnsItsAreaTimesSigma0) {
  const auto textures = textures_of([](auto, auto, const auto&) { return 0.02; });
  const radar::Rectangle area{100, 100, 400, 400};
  for (const double elevation_deg : {5.0, 8.6, 30.0}) {
    const double total =
        total_m2(textures, terrain_of([](Vec2d) { return 0.0; }), radar_in_the_south(elevation_deg), area);
    EXPECT_NEAR(total, 0.02 * 300.0 * 300.0, 0.02 * 300.0 * 300.0 * 0.02) << elevation_deg;
  }
}

TEST(PaperMethod, SlopesReturnTheirTrueAreaOrTheirMapArea) {
  const auto textures = textures_of([](auto, auto, const auto&) { return 0.02; });
  const radar::Rectangle area{100, 100, 400, 400};
  // Rising northwards, away from the radar, by 10°: it is met more steeply than level ground.
  const double tangent = std::tan(radians_from_deg(10.0));
  const auto slope = terrain_of([&](Vec2d p) { return (p.y - 256.0) * tangent; });
  const double map_m2 = 0.02 * 300.0 * 300.0;
  const radar::Radar radar = radar_in_the_south(13.0);
  EXPECT_NEAR(total_m2(textures, slope, radar, area), map_m2 / std::cos(radians_from_deg(10.0)), map_m2 * 0.01);
  EXPECT_NEAR(total_m2(textures, slope, radar, area, {.by_map_area = true}), map_m2, map_m2 * 0.01);
}

TEST(PaperMethod, GroundBehindARidgeIsHidden) {
  const auto textures = textures_of([](auto, auto, const auto&) { return 0.02; });
  // A wall-like ridge 20 m high at y = 200 throws a shadow of 20 / tan 10° = 113 m: to y = 313.
  const auto ridge = terrain_of([](Vec2d p) { return p.y == 200.0 ? 20.0 : 0.0; });
  const radar::Radar radar = radar_in_the_south(10.0);
  EXPECT_EQ(total_m2(textures, ridge, radar, {100, 210, 400, 290}), 0.0);
  EXPECT_NEAR(total_m2(textures, ridge, radar, {100, 330, 400, 430}), 0.02 * 300 * 100, 0.02 * 300 * 100 * 0.03);
}

TEST(PaperMethod, LooksAreBlendedLinearlyInTheAngles) {
  const auto textures = textures_of([](auto, auto, const radar::Aspect& aspect) { return aspect.elevation_rad; });
  for (const double elevation_deg : {5.0, 7.0, 13.0, 25.5, 37.0}) {
    const auto weights = textures.weights_for({0.1, radians_from_deg(elevation_deg)}, {});
    EXPECT_NEAR(textures.sigma0_at({256, 256}, weights, 0.0).vv, radians_from_deg(elevation_deg), 1e-6);
  }
  // Held beyond the ends.
  EXPECT_NEAR(textures.sigma0_at({256, 256}, textures.weights_for({0.1, radians_from_deg(2.0)}, {}), 0.0).vv,
              radians_from_deg(5.0), 1e-6);
  const auto turning = textures_of([](auto, auto, const radar::Aspect& aspect) { return aspect.azimuth_rad; });
  const auto weights = turning.weights_for({radians_from_deg(337.5), radians_from_deg(13.0)}, {});
  EXPECT_NEAR(turning.sigma0_at({256, 256}, weights, 0.0).vv, radians_from_deg(315.0) / 2.0, 1e-6);
}

TEST(PaperMethod, OtherScalesAreExactForWhatTheyAreLinearIn) {
  const auto shadows =
      textures_of([](auto, auto, const radar::Aspect& aspect) { return 1.0 / std::tan(aspect.elevation_rad); });
  const auto ground =
      textures_of([](auto, auto, const radar::Aspect& aspect) { return std::sin(aspect.elevation_rad); });
  for (const double elevation_deg : {6.0, 8.6, 16.0, 33.0}) {
    const double angle = radians_from_deg(elevation_deg);
    const auto by_cotangent = shadows.weights_for({1.0, angle}, {.by_cotangent = true});
    EXPECT_NEAR(shadows.sigma0_at({256, 256}, by_cotangent, 0.0).vv, 1.0 / std::tan(angle), 1e-5);
    const auto gamma = ground.weights_for({1.0, angle}, {.blends_gamma = true});
    EXPECT_NEAR(ground.sigma0_at({256, 256}, gamma, 0.0).vv, std::sin(angle), 1e-6);
  }
}

TEST(PaperMethod, MipsAreMeansOfWhatTheyCover) {
  const auto textures = textures_of(
      [](std::size_t column, std::size_t row, const auto&) { return (column + row) % 2 == 0 ? 0.04 : 0.0; });
  const auto weights = textures.weights_for({0.0, radians_from_deg(5.0)}, {});
  EXPECT_NEAR(textures.sigma0_at(patch.centre_of(100, 100), weights, 0.0).vv, 0.04, 1e-7);
  EXPECT_NEAR(textures.sigma0_at(patch.centre_of(100, 100), weights, 0.5).vv, 0.03, 1e-7);
  EXPECT_NEAR(textures.sigma0_at(patch.centre_of(100, 100), weights, 1.0).vv, 0.02, 1e-7);
  EXPECT_EQ(textures.texture_bytes(), 40U * 256U * 256U * 16U);
}

}  // namespace
}  // namespace sigmascape::render
