#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <vector>

#include "physics/level_scene.h"
#include "validation/validation_record.h"

#include "sigmascape/product/ground_projection.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::physics_test {
namespace {

constexpr double texel_m = 1.0;
constexpr float object_height_m = 20.0F;
const double elevations_deg[] = {5.0, 13.0, 21.0, 29.0, 37.0};

/// Mean VV over a strip 8 m wide about x = 0, one number for each metre of y from `south_m` on: what a bake makes of
/// the scene seen from the south.
std::vector<double> baked_profile(const scene::Scene& scene, double elevation_rad, double south_m, std::size_t metres) {
  const radar::Aspect aspect{pi, elevation_rad};
  const double north_m = south_m + static_cast<double>(metres);
  const auto echoes = traced_echoes(
      scene, aspect, {.area = {-4.0, south_m, 4.0, north_m}, .samples = 64, .options = {.max_bounces = 1}});
  const auto sigma0 = landed(echoes, aspect, {-4.0, north_m, texel_m, 8, metres}).sigma0();
  std::vector<double> profile(metres, 0.0);
  for (std::size_t row = 0; row < metres; ++row) {
    for (const radar::Channels& texel : sigma0.row(metres - 1 - row))
      profile[row] += static_cast<double>(texel.vv) / 8.0;
  }
  return profile;
}

/// The same for a radar at a place, over the scene's terrain, between two values of y.
std::vector<double> traced_profile(const scene::Scene& scene, double elevation_rad, double south_m, double north_m) {
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  radar::Radar radar;
  radar.position = radar::position_seeing({}, pi, elevation_rad, 200e3);
  radar.range_resolution_m = 0.5;
  radar.beam_width_rad = 4.0 / 200e3;
  trace::TraceCounts counts;
  const auto image = simulate::traced_image(scene, geometry, radar, {-8.0, south_m, 8.0, north_m},
                                            {.cell_m = 1.0, .samples_per_cell = 16, .max_bounces = 1}, counts);
  const auto map = product::ground_map(image, scene.terrain,
                                       {-2.0, north_m, texel_m, 4, static_cast<std::size_t>(north_m - south_m)});
  std::vector<double> profile;
  for (std::size_t row = map.grid.rows; row-- > 0;) {
    double mean = 0.0;
    for (const radar::Channels& cell : map.sigma0.row(row)) mean += static_cast<double>(cell.vv) / 4.0;
    profile.push_back(mean);
  }
  return profile;
}

/// Metres of the profile behind the origin, `south_m` before it, that lie in shadow; parts of a metre count as parts.
double shadow_m(const std::vector<double>& profile, double south_m) {
  const auto origin = static_cast<std::size_t>(-south_m);
  double open = 0.0;
  for (std::size_t y = 0; y + 3 < origin; ++y) open += profile[y] / static_cast<double>(origin - 3);
  double dark = 0.0;
  for (std::size_t y = origin; y < profile.size(); ++y) dark += 1.0 - profile[y] / open;
  return dark;
}

void expect_metres(const char* name, double elevation_deg, double expected, double measured) {
  const std::string full_name = fmt::format("{}, elevation {:.0f}°", name, elevation_deg);
  validation::expect_close({.group = "Layover and shadow",
                            .name = full_name,
                            .expected = expected,
                            .measured = measured,
                            .tolerance = texel_m,
                            .unit = "m",
                            .source = "geometry"});
}

TEST(LayoverAndShadow, AWallThrowsAShadowOfHeightOverTangent) {
  for (const double elevation_deg : elevations_deg) {
    scene::Scene scene = level_scene(lambert("ground", 0.5), 1024.0);
    add_wall(scene, lambert("black", 0.0), 60.0F, object_height_m, pi);
    const double elevation_rad = radians_from_deg(elevation_deg);
    const double expected = object_height_m / std::tan(elevation_rad);
    const auto profile = baked_profile(scene, elevation_rad, -20.0, static_cast<std::size_t>(expected) + 40);
    expect_metres("shadow of a 20 m wall", elevation_deg, expected, shadow_m(profile, -20.0));
  }
}

TEST(LayoverAndShadow, AWallLiesOverByHeightTimesTangent) {
  for (const double elevation_deg : elevations_deg) {
    scene::Scene scene = level_scene(lambert("black", 0.0));
    add_wall(scene, lambert("wall", 0.5), 60.0F, object_height_m, pi);
    const double elevation_rad = radians_from_deg(elevation_deg);
    const auto profile = baked_profile(scene, elevation_rad, -30.0, 40);
    const double brightest = *std::ranges::max_element(profile);
    ASSERT_GT(brightest, 0.0);
    // An evenly bright wall fills its layover evenly.
    double lit = 0.0;
    for (const double texel : profile) lit += texel / brightest;
    expect_metres("layover of a 20 m wall", elevation_deg, object_height_m * std::tan(elevation_rad), lit);
    for (std::size_t y = 31; y < profile.size(); ++y) EXPECT_EQ(profile[y], 0.0) << "echoes behind the wall";
  }
}

// The near side lies over, the roof with it, and the far edge of the roof throws the shadow.
TEST(LayoverAndShadow, ABoxThrowsItsShadowFromTheFarEdge) {
  constexpr float depth_m = 12.0F;
  for (const double elevation_deg : elevations_deg) {
    scene::Scene scene = level_scene(lambert("ground", 0.5), 1024.0);
    scene.prototypes.push_back(
        scene::box_mesh({60.0F, depth_m, object_height_m}, scene.material_index(lambert("black", 0.0))));
    scene.instances.push_back({.y_m = depth_m / 2.0F});
    const double elevation_rad = radians_from_deg(elevation_deg);
    const double from_near_side = depth_m + object_height_m / std::tan(elevation_rad);
    const auto profile = baked_profile(scene, elevation_rad, -20.0, static_cast<std::size_t>(from_near_side) + 40);
    expect_metres("ground hidden by a 20 m box 12 m deep", elevation_deg, from_near_side, shadow_m(profile, -20.0));
  }
}

/// A box of nearly smooth conductor, turned by 20°.
scene::Scene box_scene(const scatter::Material& ground, double alpha) {
  scene::Scene scene = level_scene(ground);
  scene.prototypes.push_back(
      scene::box_mesh({12.0F, 10.0F, 8.0F}, scene.material_index(rough_conductor("face", alpha))));
  scene.instances.push_back({.yaw_rad = static_cast<float>(radians_from_deg(20.0))});
  return scene;
}

void expect_contrast(const char* name, double bright, double dark, double least_db) {
  validation::expect_at_least({.group = "Layover and shadow",
                               .name = name,
                               .limit = least_db,
                               .measured = db_from_linear(bright / dark),
                               .unit = "dB",
                               .source = "a corner of two faces needs the radar across one of them"});
}

// By its double bounces with the ground a box is seen from the four directions its sides face.
TEST(LayoverAndShadow, ABoxOnTheGroundIsBrightFromFourSides) {
  const scene::Scene scene = box_scene(rough_conductor("ground", 0.3), 0.05);
  const auto double_bounce = [&](double azimuth_deg) {
    const auto echoes =
        traced_echoes(scene, {radians_from_deg(azimuth_deg), radians_from_deg(30.0)}, {.area = {-30, -30, 30, 30}});
    return bounce_sums(echoes)[2][0];
  };
  double weakest_side = 1e30, brightest_edge = 0.0;
  for (int side = 0; side < 4; ++side) {
    weakest_side = std::min(weakest_side, double_bounce(20.0 + 90.0 * side));
    brightest_edge = std::max(brightest_edge, double_bounce(65.0 + 90.0 * side));
  }
  expect_contrast("box on the ground, weakest side over brightest edge, two bounces", weakest_side, brightest_edge,
                  15.0);
}

// Alone, each of its five faces is a lobe about its normal: σ = A σ0(θ), seen 2° off.
TEST(LayoverAndShadow, ABoxAloneIsBrightFromFiveDirections) {
  constexpr double alpha = 0.05;
  const scene::Scene scene = box_scene(lambert("black", 0.0), alpha);
  const auto seen = [&](double azimuth_deg, double elevation_deg) {
    const auto echoes = traced_echoes(scene, {radians_from_deg(azimuth_deg), radians_from_deg(elevation_deg)},
                                      {.area = {-14, -14, 14, 14}, .cell_m = 0.5, .samples = 4});
    return bounce_sums(echoes)[1][0];
  };
  const double two = radians_from_deg(2.0);
  const double per_area = std::exp(-std::pow(std::tan(two) / alpha, 2)) / (alpha * alpha * std::pow(std::cos(two), 4));
  double weakest = 1e30;
  const auto expect_face = [&](const std::string& name, double azimuth_deg, double elevation_deg, double area_m2) {
    const double sigma = seen(azimuth_deg, elevation_deg);
    weakest = std::min(weakest, sigma);
    validation::expect_close({.group = "Layover and shadow",
                              .name = "box alone, 2° off the normal of its " + name,
                              .expected = db_from_linear(area_m2 * per_area),
                              .measured = db_from_linear(sigma),
                              .tolerance = 0.1,
                              .unit = "dBsm",
                              .source = "geometric optics, A exp(−tan²θ/α²) / (α² cos⁴θ)"});
  };
  for (int side = 0; side < 4; ++side) {
    expect_face(fmt::format("side towards {}°", 20 + 90 * side), 20.0 + 90.0 * side, 2.0, side % 2 == 0 ? 96.0 : 80.0);
  }
  expect_face("roof", 137.0, 88.0, 120.0);
  double brightest_between = 1e-12;
  for (int edge = 0; edge < 4; ++edge) {
    brightest_between = std::max({brightest_between, seen(65.0 + 90.0 * edge, 2.0), seen(65.0 + 90.0 * edge, 45.0),
                                  seen(20.0 + 90.0 * edge, 45.0)});
  }
  expect_contrast("box alone, weakest face over the brightest of twelve directions between", weakest, brightest_between,
                  60.0);
}

/// Ground that rises northward by `slope_deg`, at height 0 along y = 0.
terrain::HeightField slope(double slope_deg, double half_side_m) {
  const auto rise = static_cast<float>(half_side_m * std::tan(radians_from_deg(slope_deg)));
  terrain::HeightField terrain{-half_side_m, half_side_m, 2.0 * half_side_m, Array2D<float>(2, 2)};
  for (const std::size_t column : {0U, 1U}) {
    terrain.height_m(column, 0) = rise;
    terrain.height_m(column, 1) = -rise;
  }
  return terrain;
}

// LOD 0: the wall stands on its hillside, traced by a radar at a place and laid back onto the terrain.
TEST(LayoverAndShadow, OnAHillsideTheShadowIsHeightOverSumOfTangents) {
  for (const double slope_deg : {-10.0, -5.0, 0.0, 5.0, 10.0}) {
    for (const double elevation_deg : elevations_deg) {
      const double elevation_rad = radians_from_deg(elevation_deg);
      const double tangents = std::tan(elevation_rad) + std::tan(radians_from_deg(slope_deg));
      if (tangents < 0.1) continue;  // the hillside itself is all but unlit
      const double expected = object_height_m / tangents;

      scene::Scene scene = level_scene(lambert("ground", 0.5), 800.0);
      scene.terrain = slope(slope_deg, 400.0);
      add_wall(scene, lambert("black", 0.0), 60.0F, object_height_m, pi);
      const auto profile = traced_profile(scene, elevation_rad, -30.0, std::ceil(expected) + 30.0);
      // At the ends of the area the pulse takes in ground that was not traced.
      expect_metres(fmt::format("shadow of a 20 m wall on ground rising by {:+.0f}°", slope_deg).c_str(), elevation_deg,
                    expected, shadow_m({profile.begin() + 5, profile.end() - 5}, -25.0));
    }
  }
}

// LOD 0: the top of a wall lies as far before its foot as the plane of equal range through it meets the hillside.
TEST(LayoverAndShadow, OnAHillsideTheLayoverFollowsTheSlope) {
  for (const double slope_deg : {-10.0, -5.0, 0.0, 5.0, 10.0}) {
    for (const double elevation_deg : {13.0, 21.0, 29.0, 37.0, 50.0}) {
      const double elevation_rad = radians_from_deg(elevation_deg);
      const double slope_rad = radians_from_deg(slope_deg);
      const double expected =
          object_height_m * std::tan(elevation_rad) / (1.0 - std::tan(elevation_rad) * std::tan(slope_rad));

      scene::Scene scene = level_scene(lambert("black", 0.0), 800.0);
      scene.terrain = slope(slope_deg, 400.0);
      add_wall(scene, lambert("white", 0.5), 60.0F, object_height_m, pi);
      const auto profile = traced_profile(scene, elevation_rad, -std::ceil(expected) - 10.0, 10.0);
      const double brightest = *std::ranges::max_element(profile);
      // Evenly bright from the foot to the top: the sum over the brightness is the length. The pulse rounds both ends
      // alike.
      double power = 0.0, middle = 0.0;
      std::vector<double> lit;
      for (std::size_t i = 0; i < profile.size(); ++i) {
        power += profile[i];
        middle += profile[i] * (static_cast<double>(i) + 0.5 - std::ceil(expected) - 10.0);
        if (profile[i] > 0.5 * brightest) lit.push_back(profile[i]);
      }
      std::ranges::nth_element(lit, lit.begin() + static_cast<std::ptrdiff_t>(lit.size() / 2));
      const double level = lit[lit.size() / 2];
      expect_metres(fmt::format("layover of a 20 m wall on ground rising by {:+.0f}°", slope_deg).c_str(),
                    elevation_deg, expected, power / level);
      expect_metres(fmt::format("middle of the layover on ground rising by {:+.0f}°", slope_deg).c_str(), elevation_deg,
                    -expected / 2.0, middle / power);
    }
  }
}

}  // namespace
}  // namespace sigmascape::physics_test
