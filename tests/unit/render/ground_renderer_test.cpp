#include "sigmascape/render/ground_renderer.h"

#include <cmath>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <utility>

#include "keep_worst.h"
#include "scratch_folder.h"

#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"
#include "sigmascape/receiver/range_azimuth_receiver.h"
#include "sigmascape/render/reflecting_ground.h"

namespace sigmascape::render {
namespace {

/// One patch of 2 m texels.
constexpr radar::Rectangle patch_extent{0, 0, 512, 512};
constexpr double baked_gamma = 0.03;
constexpr double hh_over_vv = 0.5, hv_over_vv = 0.1, re_over_vv = 0.2;

using Texel = std::function<double(Vec2d point, const radar::Aspect& aspect)>;

double gamma_times_sine(Vec2d, const radar::Aspect& aspect) {
  return baked_gamma * std::sin(aspect.elevation_rad);
}

/// An atlas of that patch, without anything baked.
atlas::Atlas atlas_of(const ScratchFolder& folder, const std::vector<double>& elevations_deg, const Texel& texel) {
  atlas::AtlasDescription description;
  description.name = "made up";
  description.extent = patch_extent;
  description.patches = {2.0, 256};
  description.aspects.azimuths_rad = {0.0, pi / 2.0, pi, 1.5 * pi};
  for (const double degrees : elevations_deg) description.aspects.elevations_rad.push_back(radians_from_deg(degrees));
  description.aspects.frequencies_hz = {10e9};
  description.scene_hash = "none";
  const auto store = atlas::Store::create(folder.path("atlas"), description);
  for (const atlas::Unit& unit : store.units()) {
    const radar::GroundGrid grid = description.patches.texels_of(unit.patch);
    const radar::Look look = description.aspects.look(unit.look);
    Array2D<radar::Channels> texels(grid.columns, grid.rows);
    for (std::size_t row = 0; row < grid.rows; ++row) {
      for (std::size_t column = 0; column < grid.columns; ++column) {
        const auto sigma0 = static_cast<float>(texel(grid.centre_of(column, row), look.aspect));
        texels(column, row) = {sigma0, static_cast<float>(hh_over_vv) * sigma0, static_cast<float>(hv_over_vv) * sigma0,
                               static_cast<float>(re_over_vv) * sigma0};
      }
    }
    store.write(unit.patch, unit.look, texels, {});
  }
  return atlas::load_atlas(store);
}

terrain::HeightField level_terrain(std::size_t nodes = 2) {
  return {patch_extent.west_m, patch_extent.north_m, 512.0 / static_cast<double>(nodes - 1),
          Array2D<float>(nodes, nodes, 0.0F)};
}

radar::Radar radar_seeing(double azimuth_deg, double elevation_deg, double range_m = 20e3) {
  radar::Radar radar;
  radar.position =
      radar::position_seeing({256, 256, 0}, radians_from_deg(azimuth_deg), radians_from_deg(elevation_deg), range_m);
  radar.range_resolution_m = 4.0;
  radar.beam_width_rad = 4.0 * std::sqrt(2.0) / range_m;
  return radar;
}

struct Rendered {
  radar::RangeAzimuthImage image;
  RenderCounts counts;

  /// σ0 of a bin over level ground.
  [[nodiscard]] double sigma0(std::size_t azimuth, std::size_t range,
                              float radar::Channels::*channel = &radar::Channels::vv) const {
    const auto& grid = image.grid;
    const double range_m = grid.first_range_m + (static_cast<double>(range) + 0.5) * grid.range_step_m;
    return static_cast<double>(image.rcs_m2(azimuth, range).*channel) /
           (range_m * grid.range_step_m * grid.azimuth_step_rad);
  }
  [[nodiscard]] double total() const {
    double sum = 0.0;
    for (const auto& bin : image.rcs_m2.values()) sum += static_cast<double>(bin.vv);
    return sum;
  }
};

Rendered rendered(const atlas::Atlas& atlas, const terrain::HeightField& terrain, const radar::Radar& radar,
                  const RenderSettings& settings = {}, const radar::Rectangle& area = {106, 106, 406, 406}) {
  Rendered result;
  const std::vector<Vec3d> corners{{area.west_m, area.south_m, 0},
                                   {area.east_m, area.south_m, 0},
                                   {area.west_m, area.north_m, 0},
                                   {area.east_m, area.north_m, 0}};
  result.image = GroundRenderer(atlas, terrain)
                     .render(radar, area, receiver::grid_covering(radar, corners), settings, result.counts);
  return result;
}

/// Largest deviation in decibels over the middle of the image, of all channels.
double worst_error_db(const Rendered& map, double expected) {
  double worst = 0.0;
  const std::size_t azimuths = map.image.grid.azimuths, ranges = map.image.grid.ranges;
  for (std::size_t r = ranges * 2 / 5; r < ranges * 3 / 5; ++r) {
    for (std::size_t a = azimuths * 2 / 5; a < azimuths * 3 / 5; ++a) {
      for (const auto& [channel, over_vv] :
           {std::pair(&radar::Channels::vv, 1.0), std::pair(&radar::Channels::hh, hh_over_vv),
            std::pair(&radar::Channels::hv, hv_over_vv), std::pair(&radar::Channels::re_vvhh, re_over_vv)})
        keep_worst(worst, db_from_linear(map.sigma0(a, r, channel) / (over_vv * expected)));
    }
  }
  return std::abs(worst);
}

TEST(GroundRenderer, ConstantGammaIsGammaTimesSine) {
  const ScratchFolder folder;
  const atlas::Atlas atlas = atlas_of(folder, {10.0, 11.0, 20.0, 22.0, 40.0, 43.0}, gamma_times_sine);
  for (const double elevation_deg : {6.0, 10.0, 10.5, 20.0, 21.0, 22.0, 41.5}) {
    for (const double azimuth_deg : {0.0, 37.0, 180.0, 300.0}) {
      for (const int level : {1, 2, 4}) {
        const Rendered map =
            rendered(atlas, level_terrain(), radar_seeing(azimuth_deg, elevation_deg), {.level_of_detail = level});
        // 60 m nearer or farther than 20 km the sine of the grazing angle is 0.3 % larger or smaller.
        const double spread_db = db_from_linear(1.003);
        EXPECT_LT(worst_error_db(map, baked_gamma * std::sin(radians_from_deg(elevation_deg))), 0.05 + spread_db)
            << azimuth_deg << "°, " << elevation_deg << "°, level " << level;
      }
    }
  }
}

TEST(GroundRenderer, LooksUpTheAspectFromGroundToRadar) {
  const ScratchFolder folder;
  const atlas::Atlas atlas =
      atlas_of(folder, {20.0}, [](Vec2d, const radar::Aspect& aspect) { return 0.1 + 0.1 * aspect.azimuth_rad; });
  for (const double azimuth_deg : {90.0, 135.0, 270.0}) {
    const Rendered map = rendered(atlas, level_terrain(), radar_seeing(azimuth_deg, 20.0));
    EXPECT_NEAR(map.total() / 300.0 / 300.0, 0.1 + 0.1 * radians_from_deg(azimuth_deg), 0.01) << azimuth_deg << "°";
  }
}

TEST(GroundRenderer, EveryLevelKeepsThePower) {
  const ScratchFolder folder;
  const atlas::Atlas atlas = atlas_of(folder, {20.0}, [](Vec2d p, const radar::Aspect&) {
    const auto key =
        hashed(static_cast<std::int64_t>(std::floor(p.x / 2.0)), static_cast<std::int64_t>(std::floor(p.y / 2.0)));
    return key % 7 == 0 ? 1.0 : 0.01;
  });
  const double finest = rendered(atlas, level_terrain(), radar_seeing(130.0, 20.0)).total();
  for (const int level : {2, 3, 4}) {
    EXPECT_NEAR(
        rendered(atlas, level_terrain(), radar_seeing(130.0, 20.0), {.level_of_detail = level}).total() / finest, 1.0,
        0.02)
        << level;
  }
}

// Wherever the bins begin, which follow the edges of the area, and however the map lies over the texture.
TEST(GroundRenderer, ALoneBrightTexelKeepsItsPower) {
  const ScratchFolder folder;
  const atlas::Atlas atlas = atlas_of(folder, {20.0}, [](Vec2d p, const radar::Aspect&) {
    return std::abs(p.x - 257.0) < 1.0 && std::abs(p.y - 255.0) < 1.0 ? 100.0 : 0.0;
  });
  for (const double resolution_m : {4.0, 6.0, 9.0, 24.0}) {
    for (const double beam_m : {resolution_m, 150.0}) {
      for (const double azimuth_deg : {0.0, 12.0, 45.0}) {
        radar::Radar radar = radar_seeing(azimuth_deg, 20.0);
        radar.range_resolution_m = resolution_m;
        radar.beam_width_rad = beam_m / 20e3;
        for (double shift_m = 0.0; shift_m < 8.0; shift_m += 1.1) {
          const Rendered map =
              rendered(atlas, level_terrain(), radar, {}, {206.0 + shift_m, 206.0 - 0.3 * shift_m, 306, 306});
          EXPECT_NEAR(db_from_linear(map.total() / 400.0), 0.0, 0.16)
              << resolution_m << " m by " << beam_m << " m from " << azimuth_deg << "°, moved by " << shift_m << " m";
        }
      }
    }
  }
}

// However few bins hold it, and whether or not the middle of one falls on it.
TEST(GroundRenderer, AnAreaNarrowerThanABinKeepsItsPower) {
  const ScratchFolder folder;
  const atlas::Atlas atlas = atlas_of(folder, {20.0}, [](Vec2d, const radar::Aspect&) { return 0.1; });
  for (const double beam_deg : {0.3, 1.0, 4.0, 12.0}) {
    for (const double azimuth_deg : {0.0, 37.0, 359.0}) {
      radar::Radar radar = radar_seeing(azimuth_deg, 20.0);
      radar.beam_width_rad = radians_from_deg(beam_deg);
      EXPECT_NEAR(rendered(atlas, level_terrain(), radar).total() / (0.1 * 300.0 * 300.0), 1.0, 0.01)
          << beam_deg << "°, " << azimuth_deg << "°";
    }
  }
}

// Close beside the ground, a beam aimed beside it takes in a whole turn: no azimuth has two bins.
TEST(GroundRenderer, VeryWideBeamsCountGroundOnce) {
  const ScratchFolder folder;
  const atlas::Atlas atlas = atlas_of(folder, {20.0}, [](Vec2d, const radar::Aspect&) { return 0.1; });
  for (const double beam_deg : {30.0, 60.0, 120.0}) {
    radar::Radar radar = radar_seeing(0.0, 20.0);
    radar.position = {105.0, 105.0, 150.0};
    radar.beam_width_rad = radians_from_deg(beam_deg);
    EXPECT_NEAR(rendered(atlas, level_terrain(), radar).total() / (0.1 * 300.0 * 300.0), 1.0, 0.02) << beam_deg << "°";
  }
}

// Strips of bright texels run outwards, many to a bin.
TEST(GroundRenderer, ABinWiderThanItIsLongIsTheMeanOfItsWidth) {
  const ScratchFolder folder;
  const atlas::Atlas atlas = atlas_of(folder, {20.0}, [](Vec2d p, const radar::Aspect&) {
    return static_cast<int>(std::floor(p.x / 2.0)) % 5 == 0 ? 0.5 : 0.0;
  });
  radar::Radar radar = radar_seeing(180.0, 20.0);
  radar.beam_width_rad = 100.0 / 20e3;
  const Rendered map = rendered(atlas, level_terrain(), radar);
  const std::size_t azimuths = map.image.grid.azimuths, ranges = map.image.grid.ranges;
  for (std::size_t azimuth = azimuths / 2 - 1; azimuth <= azimuths / 2 + 1; ++azimuth)
    EXPECT_NEAR(map.sigma0(azimuth, ranges / 2) / 0.1, 1.0, 0.1) << azimuth;
}

TEST(GroundRenderer, ABinLongerThanItIsWideIsTheMeanOfItsLength) {
  const ScratchFolder folder;
  const atlas::Atlas atlas = atlas_of(folder, {20.0}, [](Vec2d p, const radar::Aspect&) {
    return static_cast<int>(std::floor(p.y / 2.0)) % 5 == 0 ? 0.5 : 0.0;
  });
  radar::Radar radar = radar_seeing(180.0, 20.0);
  radar.range_resolution_m = 80.0;
  const Rendered map = rendered(atlas, level_terrain(), radar);
  const std::size_t azimuths = map.image.grid.azimuths, ranges = map.image.grid.ranges;
  for (std::size_t range = ranges / 2 - 1; range <= ranges / 2 + 1; ++range)
    EXPECT_NEAR(map.sigma0(azimuths / 2, range) / 0.1, 1.0, 0.1) << range;
}

// Wherever the bins begin, which follow the edges of the area.
TEST(GroundRenderer, WideBinsKeepThePlaceOfWhatTheyHold) {
  const ScratchFolder folder;
  const atlas::Atlas atlas =
      atlas_of(folder, {20.0}, [](Vec2d p, const radar::Aspect&) { return p.x >= 230.0 && p.x < 238.0 ? 1.0 : 0.0; });
  radar::Radar radar = radar_seeing(180.0, 20.0);
  radar.beam_width_rad = 100.0 / 20e3;
  for (const double east_m : {380.0, 388.0, 396.0, 404.0}) {
    const Rendered map = rendered(atlas, level_terrain(), radar, {}, {106, 196, east_m, 316});
    double power = 0.0, moment = 0.0;
    for (std::size_t range = 0; range < map.image.grid.ranges; ++range) {
      for (std::size_t azimuth = 0; azimuth < map.image.grid.azimuths; ++azimuth) {
        const double azimuth_rad =
            map.image.grid.first_azimuth_rad + (static_cast<double>(azimuth) + 0.5) * map.image.grid.azimuth_step_rad;
        const auto here = static_cast<double>(map.image.rcs_m2(azimuth, range).vv);
        power += here;
        moment += here * azimuth_rad;
      }
    }
    const double ground_m = 256.0 - radar.position.y;
    EXPECT_NEAR(radar.position.x + ground_m * std::tan(moment / power), 234.0, 0.3) << "area to " << east_m << " m";
  }
}

TEST(GroundRenderer, ThreadsDoNotMatter) {
  const ScratchFolder folder;
  const atlas::Atlas atlas = atlas_of(folder, {20.0}, gamma_times_sine);
  const Rendered one = rendered(atlas, level_terrain(), radar_seeing(50.0, 20.0), {.threads = 1});
  const Rendered three = rendered(atlas, level_terrain(), radar_seeing(50.0, 20.0), {.threads = 3});
  EXPECT_TRUE(std::ranges::equal(one.image.rcs_m2.values(), three.image.rcs_m2.values()));
  EXPECT_EQ(one.counts.visible, three.counts.visible);
}

/// Ground at `height_m` from y = 256 m to 260 m, level elsewhere: a dam, steep on both sides.
terrain::HeightField dam(float height_m) {
  terrain::HeightField terrain = level_terrain(513);  // nodes 1 m apart, row 0 at y = 512
  for (std::size_t row = 252; row <= 256; ++row) {
    for (std::size_t column = 0; column < 513; ++column) terrain.height_m(column, row) = height_m;
  }
  return terrain;
}

TEST(GroundRenderer, AHillHidesGroundBehindItAtTheRightLength) {
  const ScratchFolder folder;
  const atlas::Atlas atlas =
      atlas_of(folder, {5.0, 13.0, 21.0, 29.0, 37.0}, [](Vec2d, const radar::Aspect&) { return 0.1; });
  constexpr double height_m = 8.0;
  for (const double elevation_deg : {5.0, 13.0, 29.0}) {
    radar::Radar radar = radar_seeing(180.0, elevation_deg);
    radar.range_resolution_m = 1.0;
    const Rendered map = rendered(atlas, dam(height_m), radar);
    const auto& grid = map.image.grid;
    // The crest's northern edge throws the shadow.
    const double crest_m = 260.0 - radar.position.y;
    const double end_m = crest_m * radar.position.z / (radar.position.z - height_m);
    EXPECT_NEAR((end_m - crest_m) * std::tan(radians_from_deg(elevation_deg)) / height_m, 1.0, 0.01);
    const double first_dark_m = std::hypot(crest_m, radar.position.z - height_m),
                 last_dark_m = std::hypot(end_m, radar.position.z);
    std::size_t dark = 0;
    double darkest = 1.0;
    for (std::size_t r = 0; r < grid.ranges; ++r) {
      const double range_m = grid.first_range_m + (static_cast<double>(r) + 0.5) * grid.range_step_m;
      if (range_m < first_dark_m - 1.0 || range_m > last_dark_m + 10.0) continue;
      const double sigma0 = map.sigma0(grid.azimuths / 2, r);
      if (sigma0 < 0.05) ++dark;
      darkest = std::min(darkest, sigma0);
    }
    EXPECT_NEAR(static_cast<double>(dark) * grid.range_step_m, last_dark_m - first_dark_m, 1.0) << elevation_deg << "°";
    EXPECT_LT(darkest, 1e-4) << elevation_deg << "°";
    EXPECT_LT(map.counts.visible, map.counts.ground_samples);
  }
}

TEST(GroundRenderer, LevelGroundIsAllVisibleAndCountedOnce) {
  const ScratchFolder folder;
  const atlas::Atlas atlas = atlas_of(folder, {20.0}, [](Vec2d, const radar::Aspect&) { return 0.1; });
  const Rendered map = rendered(atlas, level_terrain(), radar_seeing(130.0, 20.0));
  EXPECT_EQ(map.counts.visible, map.counts.ground_samples);
  // All of the area's cross-section arrives.
  EXPECT_NEAR(map.total() / (0.1 * 300.0 * 300.0), 1.0, 0.005);
}

TEST(GroundRenderer, TiltedModelFollowsTheLocalSlope) {
  const ScratchFolder folder;
  const atlas::Atlas atlas = atlas_of(folder, {18.0, 20.0, 22.0, 28.0, 30.0, 32.0}, gamma_times_sine);
  terrain::HeightField slope = level_terrain();  // rises northward by 10°, towards a radar in the south it tilts up
  const auto rise = static_cast<float>(256.0 * std::tan(radians_from_deg(10.0)));
  for (const std::size_t column : {0U, 1U}) {
    slope.height_m(column, 0) = rise;
    slope.height_m(column, 1) = -rise;
  }
  const auto total = [&](SlopeModel model) {
    return rendered(atlas, slope, radar_seeing(180.0, 20.0), {.slope = model}).total();
  };
  // γ sin(ψ + α) over true area against γ sin ψ over map area.
  const double expected =
      std::sin(radians_from_deg(30.0)) / std::cos(radians_from_deg(10.0)) / std::sin(radians_from_deg(20.0));
  EXPECT_NEAR(db_from_linear(total(SlopeModel::Tilted) / total(SlopeModel::Upright) / expected), 0.0, 0.1);
}

// Below it γ is held over the slope as it is over level ground.
TEST(ReflectingGround, AHillsideGoesOnToAnswerBelowTheLowestLook) {
  const ScratchFolder folder;
  constexpr double lowest_deg = 5.0;
  const atlas::Atlas atlas = atlas_of(folder, {lowest_deg, 20.0}, gamma_times_sine);
  const auto sine = [](double degrees) { return std::sin(radians_from_deg(degrees)); };
  const Vec3d point{256.0, 256.0, 0.0};
  for (const double slope_deg : {-10.0, 0.0, 20.0}) {  // rising northward
    terrain::HeightField plane = level_terrain();
    const auto rise = static_cast<float>(256.0 * std::tan(radians_from_deg(slope_deg)));
    for (const std::size_t column : {0U, 1U}) {
      plane.height_m(column, 0) = rise;
      plane.height_m(column, 1) = -rise;
    }
    for (const double elevation_deg : {-8.0, 1.0, 4.9, 5.0, 7.0}) {
      const Vec3d to_south = radar::direction_to_radar({pi, radians_from_deg(elevation_deg)});
      const ReflectingGround ground(atlas, plane, point + to_south * 5000.0, 10e9, 0.0);
      ReflectingGround::Looks looks;
      const double found = static_cast<double>(ground.sigma0(point, pi, {.ground = 1.0, .hidden_m = 0.0}, looks).vv);
      const double level = baked_gamma * std::max(0.0, sine(elevation_deg));
      const double of_slope =
          baked_gamma * sine(lowest_deg) * sine(elevation_deg + slope_deg) / sine(lowest_deg + slope_deg);
      const double expected = slope_deg > 0.0 && elevation_deg < lowest_deg ? of_slope : level;
      EXPECT_NEAR(found, expected, 2e-3 * expected) << slope_deg << "° seen from " << elevation_deg << "°";
    }
  }
}

TEST(GroundRenderer, OtherFrequenciesAreRefused) {
  const ScratchFolder folder;
  const atlas::Atlas atlas = atlas_of(folder, {20.0}, gamma_times_sine);
  radar::Radar radar = radar_seeing(0.0, 20.0);
  radar.frequency_hz = 35e9;
  EXPECT_THAT(message_of_error([&] { static_cast<void>(rendered(atlas, level_terrain(), radar)); }),
              ::testing::HasSubstr("35 GHz is not in this atlas; it was baked at 10 GHz"));
}

}  // namespace
}  // namespace sigmascape::render
