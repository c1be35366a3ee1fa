#include "sigmascape/trace/scene_geometry.h"

#include <gtest/gtest.h>

#include "plain_scene.h"

#include "sigmascape/base/hash.h"
#include "sigmascape/base/interruption.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/scene/paper_scene.h"
#include "sigmascape/scene/solid_mesh.h"

namespace sigmascape::trace {
namespace {

Vec3f towards(Vec3f from, Vec3f to) {
  return normalized(to - from);
}

/// First surface on the way, both points in the world; no hit fails the test.
SurfaceHit hit_between(const SceneGeometry& geometry, Vec3d from, Vec3d to) {
  SurfaceHit hit;
  const Vec3f start = (from - geometry.origin()).to<float>(), end = (to - geometry.origin()).to<float>();
  EXPECT_TRUE(geometry.intersect(start, towards(start, end), hit));
  hit.position = hit.position + geometry.origin().to<float>();
  return hit;
}

TEST(SceneGeometry, LevelPlaneLiesAtZeroWhateverTheTerrain) {
  const SceneGeometry geometry(plain_scene(0.5, 70.0F, {1000.0, 2000.0}), Footing::LevelPlane);
  const SurfaceHit hit = hit_between(geometry, {1010, 2010, 50}, {1040, 2000, 0});
  EXPECT_NEAR(length(hit.position - Vec3f{1040, 2000, 0}), 0.0F, 1e-3F);
  EXPECT_EQ(hit.normal, (Vec3f{0, 0, 1}));
  EXPECT_EQ(geometry.lowest_m(), 0.0);
  EXPECT_EQ(geometry.highest_m(), 0.0);
}

TEST(SceneGeometry, IsNotBuiltToItsEndWhenToldToStop) {
  const scene::Scene scene = scene::paper_scene({.scale = 0.1});
  {
    const Interruption goes_on([] { return false; });
    EXPECT_NO_THROW(SceneGeometry(scene, Footing::Terrain));
  }
  const Interruption stops([] { return true; });
  EXPECT_THROW(SceneGeometry(scene, Footing::Terrain), Interrupted);
}

// What is baked on the plane meets the ground that is traced, and no more.
TEST(SceneGeometry, LevelPlaneEndsWhereLevelTerrainDoes) {
  const scene::Scene scene = plain_scene(0.5, 0.0F, {1000.0, 2000.0});
  const SceneGeometry plane(scene, Footing::LevelPlane), terrain(scene, Footing::Terrain);
  std::vector<Ray> rays;
  for (const double beyond_m : {-1.0, 299.0, 301.0, 5000.0}) {
    for (const Vec2d side : {Vec2d{1.0, 0.3}, {-1.0, -0.8}, {0.1, 1.0}, {-0.5, -1.0}}) {
      const Vec3d foot{side.x * (100.0 + beyond_m), side.y * (100.0 + beyond_m), 0.0};
      const Vec3f start{3.0F, -7.0F, 40.0F};
      rays.push_back({start, towards(start, foot.to<float>())});
      for (const auto* geometry : {&plane, &terrain}) {
        SurfaceHit hit;
        EXPECT_EQ(geometry->intersect(rays.back().origin, rays.back().direction, hit), beyond_m < 300.0)
            << foot.x << ", " << foot.y;
      }
    }
  }
  std::vector<SurfaceHit> hits(rays.size());
  std::vector<std::uint8_t> meets(rays.size());
  plane.intersect(rays, hits, meets);
  for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_EQ(meets[i] == 1, i < rays.size() / 2) << i;
}

TEST(SceneGeometry, LevelPlaneIsMissedFromBelowAndUpwards) {
  const SceneGeometry geometry(plain_scene(), Footing::LevelPlane);
  SurfaceHit hit;
  EXPECT_FALSE(geometry.intersect({0, 0, 5}, {0, 0, 1}, hit));
  EXPECT_FALSE(geometry.intersect({0, 0, -5}, {0, 0, 1}, hit));
  EXPECT_FALSE(geometry.intersect({0, 0, -5}, {0, 0, -1}, hit));
}

TEST(SceneGeometry, TerrainIsHitFromAboveOnly) {
  scene::Scene scene = plain_scene();
  for (std::size_t row = 0; row < 21; ++row) {
    for (std::size_t column = 0; column < 21; ++column)
      scene.terrain.height_m(column, row) = 30.0F + 2.0F * static_cast<float>(column);
  }
  const SceneGeometry geometry(scene, Footing::Terrain);
  const Vec3f uphill = normalized(Vec3f{-0.2F, 0.0F, 1.0F});
  for (const Vec2d p : {Vec2d{3, 7}, {-99, 99}, {55.5, -62}}) {
    const double ground = scene.terrain.height_at(p);
    const SurfaceHit hit = hit_between(geometry, {p.x + 5, p.y - 8, 200}, {p.x, p.y, ground});
    EXPECT_NEAR(hit.position.z, ground, 1e-3);
    EXPECT_NEAR(length(hit.normal - uphill), 0.0F, 1e-5F);
    SurfaceHit none;
    EXPECT_FALSE(geometry.intersect({static_cast<float>(p.x), static_cast<float>(p.y), 10.0F}, {0, 0, 1}, none));
  }
  EXPECT_EQ(geometry.lowest_m(), 30.0);
  EXPECT_EQ(geometry.highest_m(), 70.0);
}

TEST(SceneGeometry, PlusYPointsWhereYawTurnsClockwise) {
  for (const double yaw_deg : {0.0, 90.0, 200.0}) {
    scene::Scene scene = plain_scene();
    // Long along +y from the origin of the prototype, so that front and back differ.
    scene.prototypes.push_back(scene::box_mesh({2, 10, 4}, 0));
    for (Vec3f& vertex : scene.prototypes[0].vertices) vertex.y += 5.0F;
    scene.instances.push_back({.x_m = 30.0F, .y_m = -20.0F, .yaw_rad = static_cast<float>(radians_from_deg(yaw_deg))});
    const SceneGeometry geometry(scene, Footing::LevelPlane);
    const Vec2d front = radar::horizontal_direction(radians_from_deg(yaw_deg));
    for (const double along : {1.0, 9.0}) {
      const Vec2d p = Vec2d{30, -20} + front * along;
      EXPECT_NEAR(hit_between(geometry, {p.x, p.y, 50}, {p.x, p.y, 0}).position.z, 4.0F, 1e-4F) << yaw_deg;
    }
    const Vec2d behind = Vec2d{30, -20} - front * 1.0;
    EXPECT_NEAR(hit_between(geometry, {behind.x, behind.y, 50}, {behind.x, behind.y, 0}).position.z, 0.0F, 1e-4F)
        << yaw_deg;
  }
}

/// A tetrahedron without any symmetry, each face of a material of its own.
scene::Mesh crooked_mesh() {
  return {.name = "crooked",
          .vertices = {{-3, -2, 0.5F}, {4, -1, 1}, {1, 5, 0}, {0.5F, 0.3F, 6}},
          .triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}},
          .materials = {1, 2, 3, 4}};
}

// The same shape, once as an instance and once with its vertices moved by hand.
TEST(SceneGeometry, InstancesAreTransformedMeshes) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const auto draw = [seed](int k) { return unit_float(hashed(seed, k)); };
    const Vec3f scale{0.3F + 2.0F * draw(0), 0.3F + 2.0F * draw(1), 0.3F + 2.0F * draw(2)};
    const float yaw = 6.28F * draw(3), x = -50.0F + 100.0F * draw(4), y = -50.0F + 100.0F * draw(5),
                lift = 10.0F * draw(6);

    scene::Scene as_instance = plain_scene(), as_building = plain_scene();
    as_instance.prototypes.push_back(crooked_mesh());
    as_instance.instances.push_back({.x_m = x, .y_m = y, .lift_m = lift, .yaw_rad = yaw, .scale = scale});
    as_building.buildings.mesh = crooked_mesh();
    const Vec2f front{std::sin(yaw), std::cos(yaw)}, right{std::cos(yaw), -std::sin(yaw)};
    for (Vec3f& v : as_building.buildings.mesh.vertices) {
      const Vec2f p = right * (v.x * scale.x) + front * (v.y * scale.y);
      v = {p.x + x, p.y + y, v.z * scale.z + lift};
    }
    as_building.buildings.items = {{.first_vertex = 0, .vertex_count = 4}};

    const SceneGeometry instance(as_instance, Footing::LevelPlane), building(as_building, Footing::LevelPlane);
    EXPECT_NEAR(instance.highest_m(), building.highest_m(), 1e-4);
    int object_hits = 0;
    for (int k = 0; k < 400; ++k) {
      const auto spread = [&](int dimension) { return unit_float(hashed(seed, k, dimension)) - 0.5F; };
      const Vec3f from{x + 60.0F * spread(0), y + 60.0F * spread(1), 40.0F};
      const Vec3f to{x + 6.0F * spread(2), y + 6.0F * spread(3), lift + 4.0F * scale.z * (spread(4) + 0.5F)};
      const SurfaceHit a = hit_between(instance, from.to<double>(), to.to<double>());
      const SurfaceHit b = hit_between(building, from.to<double>(), to.to<double>());
      EXPECT_NEAR(length(a.position - b.position), 0.0F, 2e-3F);
      EXPECT_NEAR(length(a.normal - b.normal), 0.0F, 1e-3F) << "material " << int{b.material};
      EXPECT_EQ(a.material, b.material);
      EXPECT_LT(dot(a.normal, towards(from, to)), 0.0F);
      object_hits += a.material > 0 ? 1 : 0;
    }
    EXPECT_GT(object_hits, 50);
  }
}

TEST(SceneGeometry, BothSidesOfAMeshFaceTheRay) {
  scene::Scene scene = plain_scene();
  scene.prototypes.push_back(scene::wall_mesh(10, 10, 0));
  scene.instances.push_back({});
  const SceneGeometry geometry(scene, Footing::LevelPlane);
  EXPECT_NEAR(hit_between(geometry, {1, -20, 5}, {1, 0, 5}).normal.y, -1.0F, 1e-6F);
  EXPECT_NEAR(hit_between(geometry, {1, 20, 5}, {1, 0, 5}).normal.y, 1.0F, 1e-6F);
}

TEST(SceneGeometry, ObjectsStandOnTerrainOrOnTheLevelPlane) {
  scene::Scene scene = plain_scene(0.5, 40.0F, {500.0, 500.0});
  add_box(scene, {10, 10, 6}, {500, 500});
  scene.instances.back().lift_m = 1.0F;
  scene.buildings.mesh = scene::box_mesh({10, 10, 8}, 0);
  for (Vec3f& v : scene.buildings.mesh.vertices) v = v + Vec3f{550, 500, 0};
  scene.buildings.items = {{.first_vertex = 0,
                            .vertex_count = static_cast<std::uint32_t>(scene.buildings.mesh.vertices.size()),
                            .footing_m = 37.0F}};
  const auto top_at = [&](const SceneGeometry& geometry, double x) {
    return hit_between(geometry, {x, 501, 200}, {x, 501, 0}).position.z;
  };

  const SceneGeometry on_terrain(scene, Footing::Terrain);
  EXPECT_NEAR(top_at(on_terrain, 501), 47.0F, 1e-3F);
  EXPECT_NEAR(top_at(on_terrain, 551), 45.0F, 1e-3F);
  EXPECT_NEAR(on_terrain.highest_m(), 47.0, 1e-3);
  const SceneGeometry on_plane(scene, Footing::LevelPlane);
  EXPECT_NEAR(top_at(on_plane, 501), 7.0F, 1e-3F);
  EXPECT_NEAR(top_at(on_plane, 551), 8.0F, 1e-3F);
  EXPECT_NEAR(on_plane.highest_m(), 8.0, 1e-3);
}

// Walls at the edge of the terrain have ground before them.
TEST(SceneGeometry, GroundGoesOnBeyondTheEdge) {
  const SceneGeometry geometry(plain_scene(0.5, 12.0F), Footing::Terrain);
  EXPECT_NEAR(hit_between(geometry, {250, 0, 50}, {250, 0, 0}).position.z, 12.0F, 1e-4F);
  EXPECT_NEAR(hit_between(geometry, {-180, -300, 50}, {-180, -300, 0}).position.z, 12.0F, 1e-4F);
}

// Instances are put into an order of their own; each has to keep its place, its form and its material.
TEST(SceneGeometry, InstancesMayBeListedInAnyOrder) {
  scene::Scene scene = plain_scene();
  for (scene::MaterialIndex kind = 0; kind < 4; ++kind)
    scene.prototypes.push_back(scene::box_mesh({2, 2, 1.0F + kind}, kind));
  const auto prototype_at = [](int i, int j) { return hashed(3, i, j) % 4; };
  for (int i = -9; i < 9; ++i) {
    for (int j = -9; j < 9; ++j) {
      scene.instances.push_back({.prototype = static_cast<std::uint32_t>(prototype_at(i, j)),
                                 .x_m = 10.0F * static_cast<float>(i) + 5.0F,
                                 .y_m = 10.0F * static_cast<float>(j) + 5.0F});
    }
  }
  const SceneGeometry geometry(scene, Footing::LevelPlane);
  for (int i = -9; i < 9; ++i) {
    for (int j = -9; j < 9; ++j) {
      const SurfaceHit hit = hit_between(geometry, {10.0 * i + 5, 10.0 * j + 5, 50}, {10.0 * i + 5, 10.0 * j + 5, 0});
      EXPECT_EQ(hit.material, prototype_at(i, j)) << i << ", " << j;
      EXPECT_NEAR(hit.position.z, 1.0F + static_cast<float>(prototype_at(i, j)), 1e-4F) << i << ", " << j;
    }
  }
}

TEST(SceneGeometry, GroundMaterialsFollowTheMap) {
  scene::Scene scene = plain_scene();
  scene.ground = {{-100, 100, 100, 2, 2}, Array2D<scene::MaterialIndex>(2, 2)};
  scene.ground.material(0, 0) = 1;  // north-west
  scene.ground.material(1, 0) = 2;
  scene.ground.material(0, 1) = 3;
  for (const Footing footing : {Footing::Terrain, Footing::LevelPlane}) {
    const SceneGeometry geometry(scene, footing);
    const auto at = [&](double x, double y) { return hit_between(geometry, {x, y, 50}, {x, y, 0}).material; };
    EXPECT_EQ(at(-50, 50), 1);
    EXPECT_EQ(at(50, 50), 2);
    EXPECT_EQ(at(-50, -50), 3);
    EXPECT_EQ(at(50, -50), 0);
  }
}

TEST(SceneGeometry, OcclusionAgreesWithIntersection) {
  scene::Scene scene = plain_scene();
  add_box(scene, {10, 10, 10}, {0, 0});
  const SceneGeometry geometry(scene, Footing::LevelPlane);
  const Vec3f to_radar = normalized(Vec3f{0, -1, 1});
  EXPECT_TRUE(geometry.occluded({0, 10, 0.01F}, to_radar));
  EXPECT_FALSE(geometry.occluded({0, 15.2F, 0.01F}, to_radar));
  EXPECT_TRUE(geometry.occluded({0, 14.8F, 0.01F}, to_radar));
  EXPECT_FALSE(geometry.occluded({0, -10, 0.01F}, to_radar));
}

TEST(SceneGeometry, OutlivesTheSceneItCameFrom) {
  auto scene = std::make_unique<scene::Scene>(plain_scene());
  add_box(*scene, {10, 10, 10}, {0, 0});
  SceneGeometry geometry(*scene, Footing::LevelPlane);
  scene.reset();
  const SceneGeometry moved = std::move(geometry);
  const SurfaceHit hit = hit_between(moved, {0, 0, 50}, {0, 0, 0});
  EXPECT_NEAR(hit.position.z, 10.0F, 1e-4F);
  EXPECT_EQ(hit.material, 1);
  EXPECT_GT(moved.memory_bytes(), 100U);
}

// A box of 8 m, so that some rays meet it and others the plane, which no structure knows of.
TEST(SceneGeometry, ReplaysTheRaysThatItWasAsked) {
  scene::Scene scene = plain_scene();
  scene.prototypes.push_back(scene::box_mesh({8, 8, 8}, 0));
  scene.instances.push_back({.prototype = static_cast<std::uint32_t>(scene.prototypes.size() - 1)});
  SceneGeometry geometry(scene, Footing::LevelPlane);
  RayLog log;
  geometry.log_to(&log);
  std::size_t meet_box = 0;
  for (int i = 0; i < 20; ++i) {
    const Vec3f from{static_cast<float>(i) - 10.0F, 0.0F, 40.0F};
    SurfaceHit hit;
    EXPECT_TRUE(geometry.intersect(from, {0, 0, -1}, hit));
    meet_box += hit.is_ground ? 0U : 1U;
    meet_box += geometry.occluded({from.x, 0.0F, 20.0F}, {0, 0, -1}) ? 1U : 0U;
  }
  geometry.log_to(nullptr);
  EXPECT_FALSE(geometry.occluded({0, 0, 20}, {0, 0, 1}));
  EXPECT_EQ(log.size(), 40U);
  EXPECT_GT(meet_box, 0U);
  EXPECT_LT(meet_box, 40U);
  EXPECT_EQ(geometry.replay(log), meet_box);
}

// Packets of sixteen: of far rays the second questions go together as well, sixteen and then four.
TEST(SceneGeometry, ReplaysFarRaysInTheirPackets) {
  scene::Scene scene = plain_scene();
  scene.prototypes.push_back(scene::box_mesh({30, 8, 8}, 0));
  scene.instances.push_back({.prototype = static_cast<std::uint32_t>(scene.prototypes.size() - 1)});
  SceneGeometry geometry(scene, Footing::LevelPlane);
  std::vector<Ray> rays;
  for (int i = 0; i < 20; ++i) rays.push_back({{static_cast<float>(i) - 10.0F, 0.0F, 3000.0F}, {0, 0, -1}});
  std::vector<SurfaceHit> hits(rays.size());
  std::vector<std::uint8_t> meets(rays.size());
  RayLog log;
  geometry.log_to(&log);
  geometry.intersect(rays, hits, meets, RayOrder::AsGiven);
  SurfaceHit hit;
  EXPECT_TRUE(geometry.intersect({0, 0, 3000}, {0, 0, -1}, hit));
  geometry.log_to(nullptr);
  EXPECT_EQ(log.size(), 42U);
  EXPECT_EQ(std::ranges::count_if(log, &LoggedRay::asks_again), 21);
  EXPECT_EQ(std::ranges::count_if(log, &LoggedRay::begins), 1 + 2);
  EXPECT_EQ(geometry.replay(log), 42U);
}

/// Rays that start within the scene and fly every way.
std::vector<Ray> rays_through_a_town(std::size_t count) {
  std::vector<Ray> rays;
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto drawn = [i](int n, float low, float high) { return low + (high - low) * unit_float(hashed(i, n)); };
    rays.push_back({{drawn(1, -90.0F, 90.0F), drawn(2, -90.0F, 90.0F), drawn(3, 0.1F, 30.0F)},
                    normalized(Vec3f{drawn(4, -1.0F, 1.0F), drawn(5, -1.0F, 1.0F), drawn(6, -1.0F, 0.3F)})});
  }
  return rays;
}

// What a path brings back must not depend on which others share its packets. No two boxes are equally high, for where
// faces coincide either may be met.
TEST(SceneGeometry, ManyRaysAtOnceHaveTheAnswersOfSingleOnes) {
  scene::Scene scene = plain_scene();
  scene.prototypes.push_back(scene::box_mesh({7, 9, 12}, 0));
  for (std::uint64_t i = 0; i < 60; ++i) {
    scene.instances.push_back({.prototype = 0,
                               .x_m = -80.0F + 160.0F * unit_float(hashed(i, 1)),
                               .y_m = -80.0F + 160.0F * unit_float(hashed(i, 2)),
                               .lift_m = 0.02F * static_cast<float>(i),
                               .yaw_rad = 6.0F * unit_float(hashed(i, 3)),
                               .scale = {0.5F + unit_float(hashed(i, 4)), 1.0F, 0.8F}});
  }
  for (const Footing footing : {Footing::LevelPlane, Footing::Terrain}) {
    const SceneGeometry geometry(scene, footing);
    const FlushDenormals flush;
    // No multiple of a packet.
    const std::vector<Ray> rays = rays_through_a_town(20'011);
    std::vector<SurfaceHit> hits(rays.size());
    std::vector<std::uint8_t> meets(rays.size()), is_occluded(rays.size());
    geometry.intersect(rays, hits, meets);
    geometry.occluded(rays, is_occluded);
    std::size_t on_boxes = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      SurfaceHit hit;
      ASSERT_EQ(geometry.intersect(rays[i].origin, rays[i].direction, hit), meets[i] != 0);
      ASSERT_EQ(geometry.occluded(rays[i].origin, rays[i].direction), is_occluded[i] != 0);
      if (meets[i] == 0) continue;
      ASSERT_EQ(hit.position, hits[i].position);
      ASSERT_EQ(hit.normal, hits[i].normal);
      ASSERT_EQ(hit.inverse_facet_area_per_m2, hits[i].inverse_facet_area_per_m2);
      ASSERT_EQ(hit.material, hits[i].material);
      ASSERT_EQ(hit.is_ground, hits[i].is_ground);
      on_boxes += hit.is_ground ? 0U : 1U;
    }
    EXPECT_GT(on_boxes, 2000U);
  }
}

}  // namespace
}  // namespace sigmascape::trace
