#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <tuple>
#include <vector>

#include "plain_scene.h"

#include "sigmascape/base/hash.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/trace/coarse_heights.h"
#include "sigmascape/trace/launch.h"
#include "sigmascape/trace/path_tracer.h"
#include "sigmascape/trace/rings_in_sight.h"

namespace sigmascape::trace {
namespace {

/// Hills with boxes on them, and one mast that is far higher than all else.
scene::Scene hilly_scene(Vec2d mast) {
  scene::Scene scene = plain_scene();
  for (std::size_t row = 0; row < 21; ++row) {
    for (std::size_t column = 0; column < 21; ++column) {
      const double x = -100.0 + 10.0 * static_cast<double>(column), y = 100.0 - 10.0 * static_cast<double>(row);
      scene.terrain.height_m(column, row) = static_cast<float>(8.0 * std::sin(0.05 * x) * std::cos(0.04 * y));
    }
  }
  add_box(scene, {5.0F, 7.0F, 6.0F}, {0.0F, 0.0F}, 0.8);
  scene.instances.clear();
  for (std::uint64_t i = 0; i < 60; ++i) {
    scene.instances.push_back({.prototype = 0,
                               .x_m = -95.0F + 190.0F * unit_float(hashed(i, 1)),
                               .y_m = -95.0F + 190.0F * unit_float(hashed(i, 2)),
                               .yaw_rad = 6.0F * unit_float(hashed(i, 3)),
                               .scale = {1.0F, 1.0F, 0.3F + unit_float(hashed(i, 4))}});
  }
  scene.buildings.mesh = scene::box_mesh({3.0F, 3.0F, 45.0F}, 1);
  for (Vec3f& v : scene.buildings.mesh.vertices) v = v + Vec3d{mast.x, mast.y, 0.0}.to<float>();
  scene.buildings.items = {{.first_vertex = 0,
                            .vertex_count = static_cast<std::uint32_t>(scene.buildings.mesh.vertices.size()),
                            .footing_m = static_cast<float>(scene.terrain.height_at(mast)) - 1.0F}};
  return scene;
}

using Record = std::tuple<double, double, float, float>;

std::vector<Record> echoes_from(const PathTracer& tracer, const LaunchArea& area) {
  std::vector<Record> records;
  const auto counts = tracer.trace(area, {0, 4, 4}, 1, [&](std::span<const radar::Echo> echoes, unsigned) {
    for (const radar::Echo& echo : echoes)
      records.emplace_back(echo.range_m, echo.cross, echo.rcs_m2.vv, echo.rcs_m2.hv);
  });
  EXPECT_EQ(counts.echoes, records.size());
  std::ranges::sort(records);
  return records;
}

// A single path more or fewer would change the list.
TEST(IdleCells, NothingComesFromThem) {
  constexpr radar::Rectangle target{-40.0, -25.0, 35.0, 30.0};
  // In the target, behind it and before it, as seen from north-east.
  for (const Vec2d mast : {Vec2d{10.0, 5.0}, {-70.0, -60.0}, {70.0, 65.0}}) {
    const scene::Scene scene = hilly_scene(mast);
    for (const Footing footing : {Footing::Terrain, Footing::LevelPlane}) {
      const SceneGeometry geometry(scene, footing);
      for (const double elevation_deg : {6.0, 40.0}) {
        const radar::Aspect aspect{radians_from_deg(45.0), radians_from_deg(elevation_deg)};
        const Vec3d place = radar::position_seeing({}, aspect.azimuth_rad, aspect.elevation_rad, 900.0);
        for (const bool is_distant : {true, false}) {
          const auto viewpoint = is_distant ? Viewpoint::distant(aspect) : Viewpoint::located(place);
          for (const int grain : {1, tile_side_cells}) {
            const LaunchArea all = launch_area(viewpoint, target, 1.5, geometry.lowest_m(), geometry.highest_m() + 1.0,
                                               {10.0, 10.0}, grain);
            LaunchArea useful = all;
            spare_rays(useful, scene, footing);
            // Of whole tiles this place has few.
            if (elevation_deg < 10.0 && grain == 1) {
              EXPECT_LT(useful.cells.size(), all.cells.size());
            }
            const PathTracer tracer(geometry, surface_models(scene, 10e9), viewpoint, {.max_bounces = 3}, 7);
            const auto expected = echoes_from(tracer, all);
            EXPECT_GT(expected.size(), 1000U);
            EXPECT_TRUE(echoes_from(tracer, useful) == expected)
                << "mast at " << mast.x << ", elevation " << elevation_deg << (is_distant ? " distant" : " located")
                << ", grain " << grain;
          }
        }
      }
    }
  }
}

/// The hills about the middle of level ground that is larger, with one in its south-west that is far higher.
scene::Scene scene_before_a_hill() {
  scene::Scene scene = hilly_scene({10.0, 5.0});
  const terrain::HeightField near = scene.terrain;
  scene.extent = {-1000.0, -1000.0, 1000.0, 1000.0};
  scene.terrain = {scene.extent.west_m, scene.extent.north_m, 10.0, Array2D<float>(201, 201)};
  for (std::size_t row = 0; row < 201; ++row) {
    for (std::size_t column = 0; column < 201; ++column) {
      const Vec2d place{-1000.0 + 10.0 * static_cast<double>(column), 1000.0 - 10.0 * static_cast<double>(row)};
      const double from_top_m = length(place - Vec2d{-700.0, -700.0});
      const bool is_near = std::max(std::abs(place.x), std::abs(place.y)) <= 100.0;
      scene.terrain.height_m(column, row) =
          is_near ? static_cast<float>(near.height_at(place)) : static_cast<float>(std::max(0.0, 300.0 - from_top_m));
    }
  }
  return scene;
}

// As to the list, a hill of 300 m behind the target might as well stand before it.
TEST(IdleCells, NothingIsListedForAHillElsewhere) {
  constexpr radar::Rectangle target{-40.0, -25.0, 35.0, 30.0};
  const scene::Scene scene = scene_before_a_hill();
  const SceneGeometry geometry(scene, Footing::Terrain);
  for (const double elevation_deg : {6.0, 40.0}) {
    const radar::Aspect aspect{radians_from_deg(45.0), radians_from_deg(elevation_deg)};
    const Vec3d place = radar::position_seeing({}, aspect.azimuth_rad, aspect.elevation_rad, 6000.0);
    for (const auto& viewpoint : {Viewpoint::distant(aspect), Viewpoint::located(place)}) {
      for (const int grain : {1, tile_side_cells}) {
        LaunchArea low = launch_outline(viewpoint, target, 1.5, geometry.lowest_m(), geometry.highest_m() + 1.0,
                                        {10.0, 10.0}, grain);
        LaunchArea all = low;
        const RingsInSight sight(low, scene, Footing::Terrain);
        low.highest_m = sight.highest_m();
        EXPECT_LT(low.highest_m, 60.0);
        list_cells(low);
        list_cells(all);
        if (elevation_deg < 10.0) {
          EXPECT_LT(low.cells.size(), all.cells.size() / 2);
          EXPECT_LT(aimed_area_m2(low), aimed_area_m2(all) / 3.0);
        }
        spare_rays(low, sight);
        const PathTracer tracer(geometry, surface_models(scene, 10e9), viewpoint, {.max_bounces = 3}, 7);
        const auto expected = echoes_from(tracer, all);
        EXPECT_GT(expected.size(), 1000U);
        EXPECT_TRUE(echoes_from(tracer, low) == expected)
            << "elevation " << elevation_deg << ", at " << viewpoint.range_of({}) << " m, grain " << grain;
      }
    }
  }
}

// From nearly straight above level ground is met where it was aimed at: its rings are the target's. Walls land far
// before themselves, with the ring of what they land in.
TEST(IdleCells, SteepRaysGetTheShareOfTheRingTheyMeet) {
  constexpr radar::Rectangle target{-20.0, -20.0, 20.0, 20.0};
  scene::Scene scene = plain_scene();
  scene.extent = {-2000.0, -2000.0, 2000.0, 2000.0};
  add_box(scene, {6.0F, 6.0F, 10.0F}, {1900.0F, 1900.0F});
  const SceneGeometry geometry(scene, Footing::LevelPlane);
  const double top_m = geometry.highest_m() + 1.0;
  for (const double elevation_deg : {88.0, 89.0}) {
    const auto viewpoint = Viewpoint::distant({radians_from_deg(180.0), radians_from_deg(elevation_deg)});
    LaunchArea area = launch_area(viewpoint, target, 1.0, 0.0, top_m, {256.0, 128.0});
    const double before = area.whole_cells();
    spare_rays(area, scene, Footing::LevelPlane);
    EXPECT_LT(area.whole_cells(), before);
    const auto share_before = [&](double metres) { return area.share_at({0.0, target.south_m - metres}); };
    EXPECT_EQ(share_before(16.0), 1.0F) << elevation_deg;
    EXPECT_EQ(share_before(48.0), 0.5F) << elevation_deg;
    EXPECT_EQ(share_before(96.0), 0.25F) << elevation_deg;
    EXPECT_EQ(share_before(192.0), 0.125F) << elevation_deg;
  }
}

TEST(CoarseHeights, HoldGroundAndWhatStandsOnIt) {
  const scene::Scene scene = hilly_scene({20.0, 20.0});
  const CoarseHeights bounds(scene, Footing::Terrain, {-60.0, -60.0, 60.0, 60.0}, 16.0);
  const SceneGeometry geometry(scene, Footing::Terrain);
  for (double x = -59.0; x < 60.0; x += 2.3) {
    for (double y = -59.0; y < 60.0; y += 2.3) {
      const CoarseHeights::Interval* here = bounds.around({x, y});
      ASSERT_NE(here, nullptr);
      SurfaceHit hit;
      ASSERT_TRUE(geometry.intersect(Vec3d{x, y, 200.0}.to<float>(), {0, 0, -1}, hit));
      EXPECT_GE(hit.position.z, here->lowest_m);
      EXPECT_LE(hit.position.z, here->highest_m + 1e-3F);
    }
  }
  EXPECT_EQ(bounds.around({-80.0, 0.0}), nullptr);
  EXPECT_NEAR(bounds.highest_m(), scene.terrain.height_at({20.0, 20.0}) + 44.0, 1e-3);
  EXPECT_NEAR(CoarseHeights(scene, Footing::LevelPlane, {-60, -60, 60, 60}, 16.0).highest_m(), 45.0F, 1e-4F);
}

}  // namespace
}  // namespace sigmascape::trace
