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
constexpr float height_m = 20.0F;
const double elevations_deg[] = {5.0, 13.0, 21.0, 29.0, 37.0};

scatter::Material lambert(std::string name, double albedo) {
  return {.name = std::move(name), .model = scatter::LambertParameters{albedo, {0.0, 1.0}}, .source = {}};
}

/// Mean VV over a strip 8 m wide about x = 0, one number for each metre of y from `south_m` on: what a bake makes of
/// the scene seen from the south.
std::vector<double> baked_profile(const scene::Scene& scene, double elevation_rad, double south_m, std::size_t metres) {
  const radar::Aspect aspect{pi, elevation_rad};
  const double north_m = south_m + static_cast<double>(metres);
  receiver::GroundAccumulator texels({-4.0, north_m, texel_m, 8, metres}, aspect);
  texels.add(traced_echoes(scene, aspect,
                           {.area = {-4.0, south_m, 4.0, north_m}, .samples = 64, .options = {.max_bounces = 1}}));
  const auto sigma0 = texels.sigma0();
  std::vector<double> profile(metres, 0.0);
  for (std::size_t row = 0; row < metres; ++row) {
    for (const radar::Channels& texel : sigma0.row(metres - 1 - row))
      profile[row] += static_cast<double>(texel.vv) / 8.0;
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
    add_wall(scene, lambert("black", 0.0), 60.0F, height_m, pi);
    const double elevation_rad = radians_from_deg(elevation_deg);
    const double expected = height_m / std::tan(elevation_rad);
    const auto profile = baked_profile(scene, elevation_rad, -20.0, static_cast<std::size_t>(expected) + 40);
    expect_metres("shadow of a 20 m wall", elevation_deg, expected, shadow_m(profile, -20.0));
  }
}

TEST(LayoverAndShadow, AWallLiesOverByHeightTimesTangent) {
  for (const double elevation_deg : elevations_deg) {
    scene::Scene scene = level_scene(lambert("black", 0.0));
    add_wall(scene, lambert("wall", 0.5), 60.0F, height_m, pi);
    const double elevation_rad = radians_from_deg(elevation_deg);
    const auto profile = baked_profile(scene, elevation_rad, -30.0, 40);
    const double brightest = *std::ranges::max_element(profile);
    ASSERT_GT(brightest, 0.0);
    // An evenly bright wall fills its layover evenly.
    double lit = 0.0;
    for (const double texel : profile) lit += texel / brightest;
    expect_metres("layover of a 20 m wall", elevation_deg, height_m * std::tan(elevation_rad), lit);
    for (std::size_t y = 31; y < profile.size(); ++y) EXPECT_EQ(profile[y], 0.0) << "echoes behind the wall";
  }
}

// The near side lies over, the roof with it, and the far edge of the roof throws the shadow.
TEST(LayoverAndShadow, ABoxThrowsItsShadowFromTheFarEdge) {
  constexpr float depth_m = 12.0F;
  for (const double elevation_deg : elevations_deg) {
    scene::Scene scene = level_scene(lambert("ground", 0.5), 1024.0);
    scene.prototypes.push_back(
        scene::box_mesh({60.0F, depth_m, height_m}, scene.material_index(lambert("black", 0.0))));
    scene.instances.push_back({.y_m = depth_m / 2.0F});
    const double elevation_rad = radians_from_deg(elevation_deg);
    const double from_near_side = depth_m + height_m / std::tan(elevation_rad);
    const auto profile = baked_profile(scene, elevation_rad, -20.0, static_cast<std::size_t>(from_near_side) + 40);
    expect_metres("ground hidden by a 20 m box 12 m deep", elevation_deg, from_near_side, shadow_m(profile, -20.0));
  }
}

TEST(LayoverAndShadow, ABoxIsBrightFromItsFacingDirections) {
  scene::Scene scene = level_scene(rough_conductor("ground", 0.3));
  scene.prototypes.push_back(
      scene::box_mesh({12.0F, 12.0F, 10.0F}, scene.material_index(rough_conductor("wall", 0.05))));
  scene.instances.push_back({.yaw_rad = static_cast<float>(radians_from_deg(20.0))});
  const auto double_bounce = [&](double azimuth_deg) {
    const auto echoes =
        traced_echoes(scene, {radians_from_deg(azimuth_deg), radians_from_deg(30.0)}, {.area = {-30, -30, 30, 30}});
    return bounce_sums(echoes)[2][0];
  };
  double weakest_face = 1e30, brightest_edge = 0.0;
  for (int side = 0; side < 4; ++side) {
    weakest_face = std::min(weakest_face, double_bounce(20.0 + 90.0 * side));
    brightest_edge = std::max(brightest_edge, double_bounce(65.0 + 90.0 * side));
  }
  EXPECT_GT(db_from_linear(weakest_face / brightest_edge), 15.0);
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
      const double expected = height_m / tangents;

      scene::Scene scene = level_scene(lambert("ground", 0.5), 800.0);
      scene.terrain = slope(slope_deg, 400.0);
      add_wall(scene, lambert("black", 0.0), 60.0F, height_m, pi);
      const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
      radar::Radar radar;
      radar.position = radar::position_seeing({}, pi, elevation_rad, 200e3);
      radar.range_resolution_m = 0.5;
      radar.beam_width_rad = 4.0 / 200e3;
      const radar::Rectangle area{-8.0, -30.0, 8.0, std::ceil(expected) + 30.0};
      trace::TraceCounts counts;
      const auto image = simulate::traced_image(scene, geometry, radar, area,
                                                {.cell_m = 1.0, .samples_per_cell = 16, .max_bounces = 1}, counts);
      const auto map = product::ground_map(image, scene.terrain,
                                           {-2.0, area.north_m, texel_m, 4, static_cast<std::size_t>(area.height_m())});
      std::vector<double> profile;
      for (std::size_t row = map.grid.rows; row-- > 0;) {
        double mean = 0.0;
        for (const radar::Channels& cell : map.sigma0.row(row)) mean += static_cast<double>(cell.vv) / 4.0;
        profile.push_back(mean);
      }
      // At the ends of the area the pulse takes in ground that was not traced.
      expect_metres(fmt::format("shadow of a 20 m wall on ground rising by {:+.0f}°", slope_deg).c_str(), elevation_deg,
                    expected, shadow_m({profile.begin() + 5, profile.end() - 5}, -25.0));
    }
  }
}

}  // namespace
}  // namespace sigmascape::physics_test
