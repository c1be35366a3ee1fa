#include <cmath>
#include <gtest/gtest.h>

#include "live_ground_example.h"
#include "made_obstacles.h"

#include "sigmascape/base/hash.h"
#include "sigmascape/live/horizon_map.h"
#include "sigmascape/live/row_light.h"
#include "sigmascape/terrain/obstacle_sweep.h"

namespace sigmascape::live {
namespace {

radar::Channels black(const radar::Look&) {
  return {};
}

ExampleGround bare_ground(double slope_deg = 0.0) {
  ExampleGround ground;
  ground.sigma0 = black;
  ground.bare_sigma0 = [](const radar::Look& look) { return constant_gamma(example_gamma, look); };
  const double rise = std::tan(radians_from_deg(slope_deg));
  ground.height_m = [rise](Vec2d p) { return rise * p.y; };
  return ground;
}

/// What a plane that rises northward returns to each range of the middle beams: γ sin ψ′ of its true area, ψ′ above the
/// plane, summed over points a quarter of a texel apart.
std::vector<double> rcs_of_slope(const ExampleView& view, const radar::RangeAzimuthGrid& grid, double rise,
                                 std::size_t margin) {
  std::vector<double> rcs(grid.ranges, 0.0);
  const Vec3d radar = view.pose().position;
  const Vec3d normal = normalized(Vec3d{0.0, -rise, 1.0});
  const double first = grid.first_azimuth_rad + static_cast<double>(margin) * grid.azimuth_step_rad;
  const double width = static_cast<double>(grid.azimuths - 2 * margin) * grid.azimuth_step_rad;
  constexpr double spacing_m = 1.0;
  for (double x = -500.0 + spacing_m / 2.0; x < 500.0; x += spacing_m) {
    for (double y = -500.0 + spacing_m / 2.0; y < 500.0; y += spacing_m) {
      const Vec3d point{view.target.x + x, view.target.y + y, rise * y};
      const Vec3d away = radar - point;
      const double azimuth = wrapped_azimuth(std::atan2(-away.x, -away.y) - first + pi) - pi;
      const double range = (length(away) - grid.first_range_m) / grid.range_step_m;
      if (azimuth < 0.0 || azimuth >= width || range < 0.0 || range >= static_cast<double>(grid.ranges)) continue;
      rcs[static_cast<std::size_t>(range)] +=
          example_gamma * dot(normal, away) / length(away) * spacing_m * spacing_m / normal.z;
    }
  }
  return rcs;
}

TEST(LiveGroundApart, BareGroundAnswersWithItsOwnAngleAndAreaAtEveryRange) {
  for (const double slope_deg : {-6.0, 0.0, 10.0}) {
    const ScratchFolder folder;
    ExampleGround example = bare_ground(slope_deg);
    if (slope_deg == 10.0) example.ground_elevations_deg = {0.2, 89.0};  // as bakes keep it of constant γ
    const auto ground = example.over(example.store(folder.path("atlas")));
    for (const double elevation_deg : {8.6, 21.0}) {
      ExampleView view;
      view.azimuth_deg = 180.0;
      view.elevation_deg = elevation_deg;
      LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
      const Frame& frame = settled_frame(renderer, *ground, view.pose());
      ASSERT_EQ(frame.report.dark, 0U);
      ASSERT_EQ(frame.report.coarse, 0U);
      const auto expected = rcs_of_slope(view, frame.grid, std::tan(radians_from_deg(slope_deg)), 2);
      for (std::size_t range = 4; range + 12 <= view.ranges; range += 8) {
        double sum = 0.0, wanted = 0.0;
        for (std::size_t r = range; r < range + 8; ++r) {
          wanted += expected[r];
          for (std::size_t beam = 2; beam + 2 < view.beams; ++beam) {
            sum += static_cast<double>(frame.powers_m2[(beam * view.ranges + r) * 4]);
          }
        }
        EXPECT_NEAR(db_from_linear(sum / wanted), 0.0, 0.05)
            << "slope " << slope_deg << "°, elevation " << elevation_deg << "°, range bin " << range;
      }
    }
  }
}

TEST(LiveGroundApart, WhatLiesBetweenTheTerrainAndBinsFarAwayIsNotWalkedOver) {
  const ScratchFolder folder;
  ExampleGround example = bare_ground();
  example.obstacle = [](Vec2d p) { return p.x > 0.0 ? radar::Obstacle{.solid_top_m = 10.0F} : radar::Obstacle{}; };
  const auto ground = example.over(example.store(folder.path("atlas")));
  LiveRenderer renderer(ground, {.content = FrameContent::Powers,
                                 .beams = 4096,
                                 .ranges = 20,
                                 .beam_step_rad = 1e-3,
                                 .range_step_m = 100.0,
                                 .threads = 1});
  // Steps are as short there as the squares that obstacles stand on: to walk over it takes longer than a test may.
  const Pose pose{.position = {example.middle().x, example.middle().y, 1000.0}, .first_range_m = 9e6};
  EXPECT_EQ(renderer.render(pose).report.lit, 0U);
}

TEST(LiveGroundApart, BinsThatBeginBelowTheRadarShowTheGroundBeyond) {
  const ScratchFolder folder;
  ExampleGround example = bare_ground();
  // A mast straight below.
  example.obstacle = [](Vec2d p) {
    return length(Vec3d{p.x, p.y, 0.0}) < 8.0 ? radar::Obstacle{.solid_top_m = 10.0F} : radar::Obstacle{};
  };
  const atlas::Store store = example.store(folder.path("atlas"));
  atlas::Pyramid(store).make_above(store.units());
  const auto ground = example.over(store);
  LiveSettings settings;
  settings.content = FrameContent::Powers;
  settings.beams = 36;
  settings.ranges = 40;
  settings.beam_step_rad = 2.0 * pi / 36.0;
  settings.range_step_m = 24.0;
  settings.refraction = 1e9;
  Pose pose;
  pose.position = {example.middle().x, example.middle().y, 300.0};
  pose.first_range_m = 0.0;
  LiveRenderer renderer(ground, settings);
  const Frame& frame = settled_frame(renderer, *ground, pose);
  ASSERT_EQ(frame.report.dark, 0U);
  // But for the last, which lack what lies beyond.
  for (std::size_t range = 0; range + 4 < settings.ranges; range += 4) {
    const double near_m = static_cast<double>(range) * settings.range_step_m,
                 far_m = near_m + 4.0 * settings.range_step_m;
    double sum = 0.0;
    for (std::size_t beam = 0; beam < settings.beams; ++beam) {
      for (std::size_t r = range; r < range + 4; ++r)
        sum += static_cast<double>(frame.powers_m2[(beam * settings.ranges + r) * 4]);
    }
    // Up to the ground straight below there is air.
    if (far_m < 300.0 - settings.range_step_m) {
      EXPECT_EQ(sum, 0.0) << "up to " << far_m << " m";
    }
    if (near_m < 400.0) continue;
    // ∫ γ (h/r) 2π r dr
    const double expected = example_gamma * 300.0 * 2.0 * pi * (far_m - near_m);
    EXPECT_NEAR(db_from_linear(sum / expected), 0.0, 0.05) << "from " << near_m << " m";
  }
}

TEST(LiveGroundApart, ACellThatLacksBothGroundAndObjectsCountsOnce) {
  const ScratchFolder folder;
  const ExampleGround example = bare_ground();
  const atlas::Store store = example.store(folder.path("atlas"));
  atlas::Pyramid(store).make_above(store.units());
  const auto ground = example.over(store);
  const ExampleView view;
  LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
  const FrameReport cold = renderer.render(view.pose()).report;
  EXPECT_EQ(cold.dark, 0U);
  EXPECT_EQ(cold.coarse, cold.cells);
}

TEST(LiveGroundApart, AWallThrowsAShadowOfItsLength) {
  const ScratchFolder folder;
  ExampleGround example = bare_ground();
  constexpr double height_m = 20.0, thickness_m = 16.0;
  example.obstacle = [](Vec2d p) {
    return std::abs(p.y) < thickness_m / 2.0 ? radar::Obstacle{.solid_top_m = height_m} : radar::Obstacle{};
  };
  const auto ground = example.over(example.store(folder.path("atlas")));
  for (const double elevation_deg : {8.6, 13.0, 21.0}) {
    ExampleView view;
    view.azimuth_deg = 180.0;
    view.elevation_deg = elevation_deg;
    LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
    const Frame& frame = settled_frame(renderer, *ground, view.pose());
    const auto expected = rcs_of_slope(view, frame.grid, 0.0, 2);
    double missing_m = 0.0;
    for (std::size_t r = 4; r + 4 < view.ranges; ++r) {
      double sum = 0.0;
      for (std::size_t beam = 2; beam + 2 < view.beams; ++beam) {
        sum += static_cast<double>(frame.powers_m2[(beam * view.ranges + r) * 4]);
      }
      missing_m += view.bin_m * (1.0 - sum / expected[r]);
    }
    // The ground under the wall is hidden as well.
    const double shadow_m = thickness_m + height_m / std::tan(radians_from_deg(elevation_deg));
    EXPECT_NEAR(missing_m, shadow_m, view.bin_m / 2.0) << elevation_deg;
  }
}

TEST(LiveGroundApart, ObjectsKeepTheirEcho) {
  const ScratchFolder folder;
  ExampleGround example = bare_ground();
  example.sigma0 = [](const radar::Look& look) { return constant_gamma(3.0 * example_gamma, look); };
  const auto ground = example.over(example.store(folder.path("atlas")));
  ExampleView view;
  view.azimuth_deg = 180.0;
  LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
  const Frame& frame = settled_frame(renderer, *ground, view.pose());
  const auto expected = rcs_of_slope(view, frame.grid, 0.0, 2);
  double sum = 0.0, wanted = 0.0;
  for (std::size_t r = 4; r + 4 < view.ranges; ++r) {
    wanted += 4.0 * expected[r];
    for (std::size_t beam = 2; beam + 2 < view.beams; ++beam) {
      sum += static_cast<double>(frame.powers_m2[(beam * view.ranges + r) * 4]);
    }
  }
  EXPECT_NEAR(db_from_linear(sum / wanted), 0.0, 0.05);
}

// From under the lowest baked look, 5°, and from lower than the hillside itself: that look, less as the slope is.
TEST(LiveGroundApart, ObjectsOnAHillsideAnswerToALowRadar) {
  constexpr double slope_deg = 20.0, lowest_deg = 5.0;
  const ScratchFolder folder;
  ExampleGround example = bare_ground(slope_deg);
  example.bare_sigma0 = black;
  example.sigma0 = [](const radar::Look& look) { return constant_gamma(3.0 * example_gamma, look); };
  const auto ground = example.over(example.store(folder.path("atlas")));
  for (const double elevation_deg : {1.0, -3.0}) {
    ExampleView view;
    view.azimuth_deg = 180.0;
    view.elevation_deg = elevation_deg;
    LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
    const Frame& frame = settled_frame(renderer, *ground, view.pose());
    const auto bare = rcs_of_slope(view, frame.grid, std::tan(radians_from_deg(slope_deg)), 2);
    const double of_bare = 3.0 * std::sin(radians_from_deg(lowest_deg)) * std::cos(radians_from_deg(slope_deg)) /
                           std::sin(radians_from_deg(lowest_deg + slope_deg));
    double sum = 0.0, wanted = 0.0;
    for (std::size_t r = 4; r + 4 < view.ranges; ++r) {
      wanted += of_bare * bare[r];
      sum += vv_of_range(frame, r);
    }
    EXPECT_NEAR(db_from_linear(sum / wanted), 0.0, 0.05) << elevation_deg;
  }
}

TEST(LiveGroundApart, WhatRisesAboveARidgeIsSeen) {
  auto row = std::make_unique<LatticeRow>();
  row->count = 3;
  const std::array<float, 4> terrain{-0.1F, -0.1F, -0.1F, -0.1F}, solid{-1e30F, -1e30F, -1e30F, -1e30F},
      through{1.0F, 1.0F, 1.0F, 1.0F};
  const Horizon horizon{.slopes = terrain.data(),
                        .solid_slopes = solid.data(),
                        .through = through.data(),
                        .azimuths = 2,
                        .distances = 2,
                        .stride = 2,
                        .near_m = 500.0F};
  // 1000 m away and 10 m below the line of sight over the ridge: things 0, 5 and 40 m high.
  for (std::size_t i = 0; i < 3; ++i) {
    row->beam[i] = 0.5F;
    row->ground_m[i] = 1000.0F;
    row->slope[i] = -0.11F;
    row->top_m[i] = std::array{0.0F, 5.0F, 40.0F}[i];
  }
  EXPECT_EQ(light(*row, horizon), 0U);
  light_apart(*row, horizon);
  EXPECT_EQ(row->lit[0], 0.0F);
  EXPECT_EQ(row->lit[1], 0.0F);
  EXPECT_NEAR(row->lit[2], 0.75F, 1e-3F);
  EXPECT_EQ(row->ground_lit[2], 0.0F);
}

/// Trees and houses on hills, 16 m wide.
radar::Obstacle tree_or_house(Vec2d point) {
  if (std::abs(point.x) > 2000.0 || std::abs(point.y) > 2000.0) return {};
  const auto key = hashed(static_cast<std::int64_t>((2000.0 - point.y) / 16.0),
                          static_cast<std::int64_t>((point.x + 2000.0) / 16.0)) %
                   16;
  if (key == 0) return {.solid_top_m = 9.0F};
  if (key <= 10) return {};
  return {.crown_base_m = 3.0F, .crown_top_m = 12.0F + static_cast<float>(key), .crown_extinction_per_m = 0.05F};
}

struct HillsWithHouses {
  terrain::HeightField field{
      .west_m = -2000.0, .north_m = 2000.0, .spacing_m = 20.0, .height_m = Array2D<float>(201, 201)};
  MadeObstacles obstacles{
      {.texel_m = 4.0}, {.level = 0, .west = -2, .north = 1, .across = 4, .down = 4}, tree_or_house};

  HillsWithHouses() {
    for (std::size_t row = 0; row < 201; ++row) {
      for (std::size_t column = 0; column < 201; ++column) {
        field.height_m(column, row) = static_cast<float>(30.0 * std::sin(static_cast<double>(column) * 0.21) *
                                                         std::cos(static_cast<double>(row) * 0.17));
      }
    }
  }
};

TEST(LiveGroundApart, TheHorizonMapSeesWhatAnExactWalkSees) {
  const HillsWithHouses land;
  for (const double radar_height_m : {150.0, 400.0, 1200.0}) {
    const Vec3d radar{0.0, -1900.0, radar_height_m};
    HorizonGrid grid;
    grid.first_azimuth_rad = -0.3;
    grid.azimuth_step_rad = 0.6 / 63.0;
    grid.azimuths = 64;
    grid.near_m = 500.0;
    grid.step_m = 4.0;
    grid.distances = 800;
    const Occluders occluders{terrain::view_of(land.field), &land.obstacles.mosaic(), 27.0F};
    HorizonMap map(grid);
    map.reset(grid, true);
    double error = 0.0, seen = 0.0, exactly_seen = 0.0;
    for (std::size_t azimuth = 0; azimuth < grid.azimuths; ++azimuth) {
      map.sweep(azimuth, radar, occluders);
      const Vec2d direction =
          radar::horizontal_direction(grid.first_azimuth_rad + static_cast<double>(azimuth) * grid.azimuth_step_rad);
      terrain::ObstacleSweep exact(radar.z);
      for (std::size_t k = 0; k < 125; ++k) {
        const double distance = 2.0 + 4.0 * static_cast<double>(k);
        if (distance >= grid.near_m - 1.0) break;
        const Vec2d point = Vec2d{radar.x, radar.y} + direction * distance;
        exact.advance(distance, land.field.height_at(point), land.obstacles.mosaic().at(point).unpacked(), 4.0);
      }
      for (std::size_t k = 0; k < grid.distances; ++k) {
        const double distance = grid.near_m + grid.step_m * static_cast<double>(k);
        const Vec2d point = Vec2d{radar.x, radar.y} + direction * distance;
        const double height = land.field.height_at(point);
        const auto sight = exact.advance(distance, height, land.obstacles.mosaic().at(point).unpacked(), grid.step_m);
        const double slope = (height - radar.z) / distance + 1e-6;
        const bool open = slope >= static_cast<double>(map.slopes(azimuth)[k]) &&
                          slope >= static_cast<double>(map.solid_slopes(azimuth)[k]);
        const double here = open ? static_cast<double>(map.through(azimuth)[k]) : 0.0;
        error += std::abs(here - sight.ground);
        seen += here;
        exactly_seen += sight.ground;
      }
    }
    EXPECT_GT(exactly_seen, 2000.0) << radar_height_m;
    EXPECT_NEAR(seen / exactly_seen, 1.0, 0.01) << radar_height_m;
    EXPECT_LT(error / exactly_seen, 0.03) << radar_height_m;
  }
}

}  // namespace
}  // namespace sigmascape::live
