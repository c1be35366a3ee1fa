#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

#include "physics/level_scene.h"
#include "unit/live/live_ground_example.h"
#include "validation/validation_record.h"

#include "sigmascape/bake/bake.h"
#include "sigmascape/render/ground_renderer.h"
#include "sigmascape/scene/paper_scene.h"

namespace sigmascape::physics_test {
namespace {

constexpr double slant_range_m = 20e3;

/// Bins about a place, seen from an azimuth and elevation.
struct Bins {
  Vec3d target;
  double azimuth_rad = 0.0, elevation_rad = 0.0;
  double bin_m = 4.0;  ///< on the ground
  std::size_t count = 24;

  [[nodiscard]] live::LiveSettings settings() const {
    live::LiveSettings settings;
    settings.content = live::FrameContent::Powers;
    settings.beams = settings.ranges = count;
    settings.range_step_m = bin_m * std::cos(elevation_rad);
    settings.beam_step_rad = bin_m / (slant_range_m * std::cos(elevation_rad));
    settings.cells_per_bin = 1.8;
    settings.refraction = 1e9;
    return settings;
  }
  [[nodiscard]] live::Pose pose() const {
    const double half = static_cast<double>(count) / 2.0;
    live::Pose pose;
    pose.position = radar::position_seeing(target, azimuth_rad, elevation_rad, slant_range_m);
    pose.first_azimuth_rad = azimuth_rad + pi - half * settings().beam_step_rad;
    pose.first_range_m = slant_range_m - half * settings().range_step_m;
    return pose;
  }
  [[nodiscard]] radar::RangeAzimuthGrid grid() const {
    return {pose().first_range_m,     settings().range_step_m,  count,
            pose().first_azimuth_rad, settings().beam_step_rad, count};
  }
  /// Of the map, whose pulse and beam are narrow enough to leave the bins as they are.
  [[nodiscard]] radar::Radar radar() const {
    radar::Radar radar;
    radar.position = pose().position;
    radar.range_resolution_m = 0.25 * settings().range_step_m;
    radar.beam_width_rad = 0.25 * std::numbers::sqrt2 * settings().beam_step_rad;
    return radar;
  }
};

/// VV of a live frame and of the map of the same atlas, [beam][range].
struct TwoWays {
  std::vector<double> frame, map;
};

TwoWays shown(const std::filesystem::path& atlas_folder, const terrain::HeightField& terrain,
              const radar::Rectangle& area, const Bins& bins) {
  TwoWays two;
  const auto ground = live::LiveGround::open(atlas_folder, frequency_hz);
  live::LiveRenderer renderer(ground, bins.settings());
  const live::Frame& frame = live::settled_frame(renderer, *ground, bins.pose());
  EXPECT_EQ(frame.report.coarse, 0U);
  const atlas::Atlas atlas = atlas::load_atlas(atlas::Store::open(atlas_folder));
  render::RenderCounts counts;
  const auto map = render::GroundRenderer(atlas, terrain).render(bins.radar(), area, bins.grid(), {}, counts);
  for (std::size_t beam = 0; beam < bins.count; ++beam) {
    for (std::size_t range = 0; range < bins.count; ++range) {
      two.frame.push_back(static_cast<double>(frame.powers_m2[(beam * bins.count + range) * 4]));
      two.map.push_back(static_cast<double>(map.rcs_m2(beam, range).vv));
    }
  }
  return two;
}

double total_of(const std::vector<double>& power) {
  double sum = 0.0;
  for (const double of_bin : power) sum += of_bin;
  return sum;
}

/// Houses and a wall about the origin, turned clockwise all together.
scene::Scene turned_scene(double by_rad) {
  scene::Scene scene =
      level_scene({.name = "gamma", .model = scatter::ConstantGammaParameters{0.03, {0.1, 0.5}}, .source = {}}, 256.0);
  const scatter::Material plaster{
      .name = "plaster", .model = scatter::LambertParameters{0.3, {0.1, 0.5}}, .source = {}};
  scene.prototypes.push_back(scene::box_mesh({12.0F, 8.0F, 7.0F}, scene.material_index(plaster)));
  scene.prototypes.push_back(scene::wall_mesh(30.0F, 5.0F, scene.material_index(rough_conductor("metal", 0.4))));
  struct Thing {
    std::uint32_t prototype;
    double east_m, north_m, yaw_rad;
  };
  for (const Thing& thing :
       {Thing{0, -14.0, 6.0, 0.2}, {0, 10.0, 12.0, 1.1}, {0, 3.0, -16.0, 0.0}, {1, 0.0, 0.0, 0.5}}) {
    const double sine = std::sin(by_rad), cosine = std::cos(by_rad);
    scene.instances.push_back({.prototype = thing.prototype,
                               .x_m = static_cast<float>(thing.east_m * cosine + thing.north_m * sine),
                               .y_m = static_cast<float>(thing.north_m * cosine - thing.east_m * sine),
                               .yaw_rad = static_cast<float>(thing.yaw_rad + by_rad)});
  }
  return scene;
}

TEST(Turned, SceneAndRadarTogetherShowTheSame) {
  const auto shown_from = [](double azimuth_rad) {
    const scene::Scene scene = turned_scene(azimuth_rad);
    bake::BakeSettings settings;
    settings.aspects = {{azimuth_rad}, {radians_from_deg(13.0)}, {frequency_hz}};
    settings.patches = {2.0, 256};
    settings.sampling.samples_per_texel = 64;
    const ScratchFolder folder;
    SilentProgress silent;
    bake::bake(scene, settings, folder.path("atlas"), silent);
    const Bins bins{.target = {}, .azimuth_rad = azimuth_rad, .elevation_rad = radians_from_deg(13.0)};
    return shown(folder.path("atlas"), scene.terrain, scene.extent, bins);
  };
  const TwoWays before = shown_from(0.0), after = shown_from(radians_from_deg(37.0));
  const auto expect = [](const char* what, double measured_db) {
    validation::expect_close({.group = "Live frames",
                              .name = what,
                              .expected = 0.0,
                              .measured = measured_db,
                              .tolerance = 0.1,
                              .unit = "dB",
                              .source = "the scene turned by 37°, baked anew, with the radar"});
  };
  expect("scene and radar turned together, live frame", db_from_linear(total_of(after.frame) / total_of(before.frame)));
  expect("scene and radar turned together, map", db_from_linear(total_of(after.map) / total_of(before.map)));
}

/// Correlation of the levels, in decibels, of squares of so many bins. Where the scene has ended the map still shows
/// the flanks of its responses: what is fainter than a ten-thousandth of the mean is left out.
double correlation_of_squares(const TwoWays& two, std::size_t bins, std::size_t side) {
  const double least = 1e-4 * static_cast<double>(side * side) * total_of(two.map) / static_cast<double>(bins * bins);
  std::vector<double> a, b;
  for (std::size_t beam = 0; beam + side <= bins; beam += side) {
    for (std::size_t range = 0; range + side <= bins; range += side) {
      double frame = 0.0, map = 0.0;
      for (std::size_t i = 0; i < side * side; ++i) {
        const std::size_t bin = (beam + i / side) * bins + range + i % side;
        frame += two.frame[bin];
        map += two.map[bin];
      }
      if (!(frame > least && map > least)) continue;
      a.push_back(db_from_linear(frame));
      b.push_back(db_from_linear(map));
    }
  }
  const auto n = static_cast<double>(a.size());
  const double mean_a = total_of(a) / n, mean_b = total_of(b) / n;
  double aa = 0.0, bb = 0.0, ab = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
    ab += (a[i] - mean_a) * (b[i] - mean_b);
  }
  return ab / std::sqrt(aa * bb);
}

TEST(LiveFrame, OfThePapersSceneIsTheMapOfTheSameAtlas) {
  const scene::Scene scene = scene::paper_scene({.scale = 0.15});
  bake::BakeSettings settings;
  settings.aspects.azimuths_rad = {radians_from_deg(90.0), radians_from_deg(135.0)};
  settings.aspects.elevations_rad = {radians_from_deg(5.0), radians_from_deg(13.0)};
  settings.patches.texels_per_side = 256;
  settings.sampling.samples_per_texel = 8;
  const Vec2d centre = scene.extent.centre();
  for (const bake::Shadows shadows : {bake::Shadows::RunTime, bake::Shadows::Baked}) {
    settings.shadows = shadows;
    const ScratchFolder folder;
    SilentProgress silent;
    bake::bake(scene, settings, folder.path("atlas"), silent);
    // A frame meets single bright texels at one or two places each, and holds more of them or less by where these lie.
    constexpr int places = 4;
    double frames = 0.0, maps = 0.0, correlation = 0.0;
    for (int place = 0; place < places; ++place) {
      const double bin_m = 2.0 * settings.patches.texel_m, moved_m = place * bin_m / places;
      const Bins bins{.target = {centre.x + moved_m, centre.y + moved_m, scene.terrain.height_at(centre)},
                      .azimuth_rad = radians_from_deg(130.0),
                      .elevation_rad = radians_from_deg(8.6),
                      .bin_m = bin_m,
                      .count = 128};
      const TwoWays two = shown(folder.path("atlas"), scene.terrain, scene.extent, bins);
      frames += total_of(two.frame);
      maps += total_of(two.map);
      correlation += correlation_of_squares(two, bins.count, 8) / places;
    }
    const std::string way = shadows == bake::Shadows::RunTime ? "ground apart" : "shadows in the textures";
    validation::expect_close({.group = "Live frames",
                              .name = "paper's scene, " + way + ", whole power against the map",
                              .expected = 0.0,
                              .measured = db_from_linear(frames / maps),
                              .tolerance = 0.1,
                              .unit = "dB",
                              .source = "GroundRenderer's map of the same atlas"});
    validation::expect_at_least({.group = "Live frames",
                                 .name = "paper's scene, " + way + ", correlation of levels over 31 m",
                                 .limit = 0.97,
                                 .measured = correlation,
                                 .unit = "1",
                                 .source = "GroundRenderer's map of the same atlas"});
  }
}

}  // namespace
}  // namespace sigmascape::physics_test
