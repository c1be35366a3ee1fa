#include "sigmascape/trace/path_tracer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <mutex>

#include "from_south.h"
#include "plain_scene.h"

#include "sigmascape/base/error.h"
#include "sigmascape/radar/radar.h"

namespace sigmascape::trace {
namespace {

constexpr radar::Rectangle area{-30, -30, 30, 30};

/// Two boxes close together on bright ground, black beyond 25 m: paths of many bounces, with both ends within what is
/// launched.
scene::Scene street_scene(double albedo = 0.8) {
  scene::Scene scene = plain_scene(albedo);
  add_box(scene, {8, 20, 10}, {-9, 0}, albedo);
  add_box(scene, {8, 20, 10}, {9, 0}, albedo);
  scene.ground = {{-75, 75, 50, 3, 3},
                  Array2D<scene::MaterialIndex>(3, 3, scene.material_index(lambert("black", 0.0)))};
  scene.ground.material(1, 1) = scene.material_index(lambert("ground", albedo));
  return scene;
}

struct Tracing {
  PathOptions options = {};
  std::uint64_t seed = 1;
  SampleRange samples{0, 16, 16};
  unsigned threads = 2;
  Viewpoint viewpoint = from_south;
  Footing footing = Footing::LevelPlane;
};

std::vector<radar::Echo> echoes_of(const scene::Scene& scene, const Tracing& how, TraceCounts* counts = nullptr) {
  const SceneGeometry geometry(scene, how.footing);
  const PathTracer tracer(geometry, surface_models(scene, 10e9), how.viewpoint, how.options, how.seed);
  const LaunchArea launch = launch_area(how.viewpoint, area, 2.0, 0.0, geometry.highest_m() + 1.0, {10.0, 10.0});
  std::vector<radar::Echo> echoes;
  std::mutex guard;
  const TraceCounts total =
      tracer.trace(launch, how.samples, how.threads, [&](std::span<const radar::Echo> some, unsigned) {
        const std::lock_guard lock(guard);
        echoes.insert(echoes.end(), some.begin(), some.end());
      });
  if (counts != nullptr) *counts = total;
  return echoes;
}

/// A key that orders echoes whatever thread found them.
auto as_tuple(const radar::Echo& e) {
  return std::tuple(e.range_m, e.cross, e.bounces, e.rcs_m2.vv, e.rcs_m2.hh, e.rcs_m2.hv, e.rcs_m2.re_vvhh);
}

std::vector<radar::Echo> sorted(std::vector<radar::Echo> echoes) {
  std::ranges::sort(echoes, [](const auto& a, const auto& b) { return as_tuple(a) < as_tuple(b); });
  return echoes;
}

bool same_echoes(const std::vector<radar::Echo>& a, const std::vector<radar::Echo>& b) {
  return std::ranges::equal(sorted(a), sorted(b),
                            [](const auto& x, const auto& y) { return as_tuple(x) == as_tuple(y); });
}

double power_of(const std::vector<radar::Echo>& echoes, int from_bounces = 1) {
  double sum = 0.0;
  for (const radar::Echo& echo : echoes)
    sum += echo.bounces >= from_bounces ? echo.rcs_m2.power(radar::Polarization::Sum) : 0.0;
  return sum;
}

TEST(PathTracer, ThreadsDoNotMatter) {
  const scene::Scene scene = street_scene();
  const auto one = echoes_of(scene, {.threads = 1});
  ASSERT_GT(power_of(one, 3), 0.0);
  EXPECT_TRUE(same_echoes(one, echoes_of(scene, {.threads = 2})));
  EXPECT_TRUE(same_echoes(one, echoes_of(scene, {.threads = 5})));
}

TEST(PathTracer, PartsOfTheSamplesMakeTheWhole) {
  const scene::Scene scene = street_scene();
  const auto whole = echoes_of(scene, {});
  auto parts = echoes_of(scene, {.samples = {0, 5, 16}});
  const auto rest = echoes_of(scene, {.samples = {5, 11, 16}});
  EXPECT_FALSE(same_echoes(whole, parts));
  parts.insert(parts.end(), rest.begin(), rest.end());
  EXPECT_TRUE(same_echoes(whole, parts));
}

TEST(PathTracer, SeedsDifferButAgreeInTheMean) {
  const scene::Scene scene = street_scene();
  const auto a = echoes_of(scene, {.seed = 1, .samples = {0, 64, 64}}),
             b = echoes_of(scene, {.seed = 2, .samples = {0, 64, 64}});
  EXPECT_FALSE(same_echoes(a, b));
  EXPECT_NEAR(power_of(a) / power_of(b), 1.0, 0.02);
}

TEST(PathTracer, RouletteKeepsTheMean) {
  const scene::Scene scene = street_scene(0.5);
  const Tracing with{.options = {.max_bounces = 6}, .samples = {0, 256, 256}};
  Tracing without = with;
  without.options.roulette = false;
  TraceCounts with_counts, without_counts;
  const auto a = echoes_of(scene, with, &with_counts), b = echoes_of(scene, without, &without_counts);
  for (const int from : {2, 3})
    EXPECT_NEAR(power_of(a, from) / power_of(b, from), 1.0, 0.04) << from << " bounces and more";
  EXPECT_LT(with_counts.rays, without_counts.rays);
}

TEST(PathTracer, EstimatorsAgreeInTheMean) {
  const scene::Scene scene = street_scene();
  const auto reciprocal = echoes_of(scene, {.samples = {0, 256, 256}});
  const auto one_way = echoes_of(scene, {.options = {.estimator = Estimator::OneWay}, .samples = {0, 256, 256}});
  EXPECT_NEAR(power_of(reciprocal, 2) / power_of(one_way, 2), 1.0, 0.03);
}

TEST(PathTracer, EmptyMaterialReturnsNoEcho) {
  TraceCounts counts;
  EXPECT_TRUE(echoes_of(street_scene(0.0), {}, &counts).empty());
  EXPECT_EQ(counts.echoes, 0U);
  EXPECT_GT(counts.paths, 0U);
}

TEST(PathTracer, CountsWhatItDoes) {
  TraceCounts counts;
  const auto echoes = echoes_of(plain_scene(), {.options = {.max_bounces = 3}}, &counts);
  EXPECT_EQ(counts.echoes, echoes.size());
  // Level ground never meets itself again: one ray to it, one away. The outermost rays miss what is asked for.
  EXPECT_LE(counts.echoes, counts.paths);
  EXPECT_GT(static_cast<double>(counts.echoes), 0.95 * static_cast<double>(counts.paths));
  EXPECT_EQ(counts.paths % 16, 0U);
  EXPECT_LE(counts.rays, 2 * counts.paths);
}

TEST(PathTracer, MaximumOfBouncesIsKept) {
  for (const int most : {1, 2, 4}) {
    int highest = 0;
    for (const radar::Echo& echo : echoes_of(street_scene(), {.options = {.max_bounces = most}}))
      highest = std::max(highest, int{echo.bounces});
    EXPECT_EQ(highest, most);
  }
}

TEST(PathTracer, LevelGroundReturnsItsReflectivity) {
  // σ0 = 4 ρ sin²ψ over both co- and cross-polarization together, per polarization sent.
  double power = 0.0;
  for (const radar::Echo& echo : echoes_of(plain_scene(0.4), {})) {
    const Vec2d point{-echo.cross,
                      echo.range_m / std::cos(radians_from_deg(30.0))};  // seen from the south, right is east
    if (std::abs(point.x) < 20.0 && std::abs(point.y) < 20.0) power += echo.rcs_m2.vv + echo.rcs_m2.hv;
  }
  EXPECT_NEAR(power / (40.0 * 40.0) / (4.0 * 0.4 * 0.25), 1.0, 0.01);
}

TEST(PathTracer, LocatedRadarFarAwayEqualsTheDistantOne) {
  const scene::Scene scene = street_scene();
  const double range_m = 1e6;
  const Tracing far{.samples = {0, 64, 64},
                    .viewpoint = Viewpoint::located(radar::position_seeing({}, pi, radians_from_deg(30.0), range_m))};
  const auto distant_echoes = echoes_of(scene, {.samples = {0, 64, 64}}), far_echoes = echoes_of(scene, far);
  EXPECT_NEAR(power_of(far_echoes) / power_of(distant_echoes), 1.0, 0.01);
  EXPECT_NEAR(power_of(far_echoes, 2) / power_of(distant_echoes, 2), 1.0, 0.02);
  const auto mean_range = [](const auto& echoes, double origin_m) {
    double sum = 0.0;
    for (const radar::Echo& echo : echoes)
      sum += (echo.range_m - origin_m) * echo.rcs_m2.power(radar::Polarization::Sum);
    return sum / power_of(echoes);
  };
  EXPECT_NEAR(mean_range(far_echoes, range_m), mean_range(distant_echoes, 0.0), 0.2);
}

// The mean of two azimuths on either side of south is south, not north.
TEST(PathTracer, EchoesOfARadarInTheNorthStayInTheSouth) {
  const Tracing from_north{.viewpoint =
                               Viewpoint::located(radar::position_seeing({}, 0.0, radians_from_deg(30.0), 5000.0))};
  std::size_t several = 0;
  for (const radar::Echo& echo : echoes_of(street_scene(), from_north)) {
    ASSERT_LT(std::abs(std::remainder(echo.cross - pi, 2.0 * pi)), 0.02) << int{echo.bounces} << " bounces";
    several += echo.bounces > 1 ? 1U : 0U;
  }
  EXPECT_GT(several, 100U);
}

// Two walls like an open book on black ground. Where only one of them is aimed at, each of its paths answers for its
// reversal too.
TEST(PathTracer, PathsCountTwiceWhereTheirReversalsAreNotLaunched) {
  scene::Scene scene = plain_scene(0.0);
  scene.prototypes.push_back(scene::wall_mesh(10, 10, scene.material_index(lambert("wall", 0.8))));
  for (const float side : {-1.0F, 1.0F}) {
    scene.instances.push_back({.x_m = 4.0F * side, .yaw_rad = side * static_cast<float>(radians_from_deg(45.0))});
  }
  const SceneGeometry geometry(scene, Footing::LevelPlane);
  const auto double_bounce = [&](const radar::Rectangle& target) {
    const PathTracer tracer(geometry, surface_models(scene, 10e9), from_south, {.max_bounces = 2}, 1);
    const LaunchArea launch = launch_area(from_south, target, 0.5, 0.0, geometry.highest_m() + 1.0, {});
    double sum = 0.0;
    tracer.trace(launch, {0, 32, 32}, 1, [&](std::span<const radar::Echo> echoes, unsigned) {
      for (const radar::Echo& echo : echoes) sum += echo.bounces == 2 ? static_cast<double>(echo.rcs_m2.vv) : 0.0;
    });
    return sum;
  };
  const double both = double_bounce({-20, -20, 20, 20});
  ASSERT_GT(both, 0.0);
  EXPECT_NEAR(double_bounce({0, -20, 20, 20}) / both, 1.0, 0.02);
}

// Of 256 cells with 200 samples each no list is made as a whole; of a quarter of the samples it is.
TEST(PathTracer, ManySamplesOfATileComeInPartsAndAreTheSame) {
  const scene::Scene scene = plain_scene(0.4);
  const SceneGeometry geometry(scene, Footing::LevelPlane);
  const PathTracer tracer(geometry, surface_models(scene, 10e9), from_south, {}, 1);
  const LaunchArea launch = launch_area(from_south, {-16, -16, 16, 16}, 2.0, 0.0, 1.0, {});
  std::size_t parts = 0, ends = 0;
  const auto echoes_of_samples = [&](SampleRange samples) {
    std::vector<radar::Echo> echoes;
    tracer.trace(launch, samples, 1, [&](const TileEchoes& tile) {
      ++parts;
      ends += tile.completes_tile ? 1U : 0U;
      echoes.insert(echoes.end(), tile.echoes.begin(), tile.echoes.end());
    });
    return echoes;
  };
  const auto all = sorted(echoes_of_samples({0, 200, 200}));
  EXPECT_EQ(ends, launch.tiles());
  EXPECT_GT(parts, launch.tiles());
  std::vector<radar::Echo> quarters;
  for (const std::uint32_t first : {0U, 50U, 100U, 150U}) {
    const auto some = echoes_of_samples({first, 50, 200});
    quarters.insert(quarters.end(), some.begin(), some.end());
  }
  quarters = sorted(std::move(quarters));
  ASSERT_EQ(all.size(), quarters.size());
  for (std::size_t i = 0; i < all.size(); ++i) ASSERT_EQ(as_tuple(all[i]), as_tuple(quarters[i])) << i;
}

TEST(PathTracer, TerrainLiftedByAnyHeightScattersAlike) {
  scene::Scene low = plain_scene(0.4), high = plain_scene(0.4, 12.0F);
  const auto shifted_area = [](const scene::Scene& scene) { return echoes_of(scene, {.footing = Footing::Terrain}); };
  const auto a = shifted_area(low), b = shifted_area(high);
  ASSERT_FALSE(a.empty());
  ASSERT_FALSE(b.empty());
  // The higher one is met from farther out on the launch plane, so that there are more of these.
  EXPECT_GE(b.size(), a.size());
  for (const radar::Echo& echo : b) ASSERT_NEAR(a.front().rcs_m2.vv / echo.rcs_m2.vv, 1.0, 1e-4);
}

TEST(PathTracer, GoesNoFartherThanEchoesCount) {
  const scene::Scene scene = plain_scene();
  const SceneGeometry geometry(scene, Footing::LevelPlane);
  const auto made = [&](int max_bounces) {
    return PathTracer(geometry, surface_models(scene, 10e9), Viewpoint::distant({0.0, 0.5}),
                      {.max_bounces = max_bounces}, 1);
  };
  for (const int bounces : {1, 255}) EXPECT_NO_THROW(made(bounces)) << bounces;
  for (const int bounces : {-1, 0, 256}) EXPECT_THROW(made(bounces), Error) << bounces;
}

}  // namespace
}  // namespace sigmascape::trace
