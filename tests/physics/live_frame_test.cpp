#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numbers>
#include <tuple>

#include "keep_worst.h"
#include "level_ground_watts.h"
#include "unit/live/live_ground_example.h"
#include "validation/validation_record.h"

#include "sigmascape/live/frame_image.h"
#include "sigmascape/live/row_looks.h"
#include "sigmascape/live/row_places.h"
#include "sigmascape/receiver/receive_chain.h"

namespace sigmascape::live {
namespace {

constexpr double level_ground_gamma = 0.1;

/// Cross-section of a bin on level ground: σ0 = γ sin ψ times the area between two ranges and two azimuths.
double expected_rcs(const radar::RangeAzimuthGrid& grid, std::size_t range, double height_m) {
  const double near = grid.first_range_m + static_cast<double>(range) * grid.range_step_m;
  const double far = near + grid.range_step_m, middle = near + grid.range_step_m / 2.0;
  return level_ground_gamma * height_m / middle * (far * far - near * near) / 2.0 * grid.azimuth_step_rad;
}

/// The worst of all bands of ranges, away from the ends that have no ground beyond.
double worst_db(const Frame& frame, double height_m) {
  constexpr std::size_t band = 14;
  double worst = 0.0;
  for (std::size_t first = 4; first + band + 4 <= frame.grid.ranges; first += band) {
    double sum = 0.0, expected = 0.0;
    for (std::size_t range = first; range < first + band; ++range) {
      sum += vv_of_range(frame, range);
      expected += expected_rcs(frame.grid, range, height_m) * static_cast<double>(frame.grid.azimuths - 4);
    }
    const double error_db = db_from_linear(sum / expected);
    keep_worst(worst, error_db);
  }
  return worst;
}

ExampleGround level_ground(bool apart) {
  ExampleGround ground;
  ground.patches_a_side = 4;
  ground.azimuths = 2;  // it is the same from everywhere; few looks are soon written
  const auto sigma0 = [](const radar::Look& look) { return constant_gamma(level_ground_gamma, look); };
  ground.sigma0 = apart ? [](const radar::Look&) { return radar::Channels{}; } : decltype(ground.sigma0)(sigma0);
  if (apart) ground.bare_sigma0 = sigma0;
  return ground;
}

/// Bins of a mip at a distance, at most a third of it deep: where ranges are short, in fewer bins.
ExampleView view_at(Vec2d middle, double slant_range_m, double elevation_deg, std::size_t mip) {
  ExampleView view;
  view.target = middle;
  view.elevation_deg = elevation_deg;
  view.slant_range_m = slant_range_m;
  view.bin_m = 12.0 * static_cast<double>(1U << mip);
  if (slant_range_m < 3000.0) {
    view.ranges = 22;
    view.beams = 24;
  }
  return view;
}

void expect_the_radar_equation(bool apart) {
  const ScratchFolder folder;
  const ExampleGround example = level_ground(apart);
  const atlas::Store store = example.store(folder.path("atlas"));
  atlas::Pyramid(store).make_above(store.units());
  const auto ground = example.over(store);
  for (const double slant_range_m : {1000.0, 6000.0, 60e3}) {
    for (const std::size_t mip : {0U, 1U, 2U}) {
      // The textures' highest elevation is 37°, above which σ0 is held; the ground's is 88°.
      for (const double elevation_deg : {3.0, 5.0, 8.6, apart ? 37.0 : 21.0}) {
        const ExampleView view = view_at(example.middle(), slant_range_m, elevation_deg, mip);
        LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
        const Frame& frame = settled_frame(renderer, *ground, view.pose());
        EXPECT_EQ(frame.report.dark + frame.report.coarse, 0U) << slant_range_m << " m, mip " << mip;
        EXPECT_EQ(frame.report.level, mip) << slant_range_m << " m, " << elevation_deg << "°";
        validation::expect_close(
            {.group = "Live frames",
             .name = fmt::format("level ground {}, {} km, mip {}, {}°, worst of the bands of ranges",
                                 apart ? "kept apart" : "in the textures", 1e-3 * slant_range_m, mip, elevation_deg),
             .expected = 0.0,
             .measured = worst_db(frame, view.pose().position.z),
             .tolerance = 0.05,
             .unit = "dB",
             .source = "γ sin ψ times the area of the bin"});
      }
    }
  }
}

TEST(LiveFrame, TexturesOfLevelGroundReturnTheirSigma0AtEveryRangeElevationAndMip) {
  expect_the_radar_equation(false);
}

TEST(LiveFrame, BareGroundReturnsItsSigma0AtEveryRangeElevationAndMip) {
  expect_the_radar_equation(true);
}

/// A radar of 10 kW and 30 dB with a pulse of 1 µs, which resolves two bins of the view each way.
radar::Radar radar_for(const LiveSettings& bins) {
  radar::Radar radar;
  radar.frequency_hz = 10e9;
  radar.range_resolution_m = 2.0 * bins.range_step_m;
  radar.beam_width_rad = 2.0 * std::numbers::sqrt2 * bins.beam_step_rad;
  radar.antenna.gain = 1000.0;
  radar.waveform = {.peak_power_w = 10e3,
                    .pulse_length_s = 1e-6,
                    .pulse_repetition_hz = 1000.0,
                    .window = {.shape = radar::WindowShape::Hamming}};
  radar.receiver.losses = linear_from_db(4.0);
  return radar;
}

TEST(LiveFrame, OfLevelGroundHasTheReceivedPowerOfTheRadarEquation) {
  const ScratchFolder folder;
  const ExampleGround example = level_ground(false);
  const atlas::Store store = example.store(folder.path("atlas"));
  atlas::Pyramid(store).make_above(store.units());
  const auto ground = example.over(store);
  for (const double slant_range_m : {1000.0, 6000.0, 60e3}) {
    const ExampleView view = view_at(example.middle(), slant_range_m, 8.6, 1);
    const LiveSettings bins = view.settings(FrameContent::Powers);
    LiveRenderer renderer(ground, bins);
    const Pose pose = view.pose();
    const Frame& frame = settled_frame(renderer, *ground, pose);
    const radar::Radar radar = radar_for(bins);
    for (const auto& [polarization, name, part] : {std::tuple{radar::Polarization::VV, "VV", 1.0},
                                                   {radar::Polarization::HH, "HH", 0.5},
                                                   {radar::Polarization::HV, "HV", 0.1}}) {
      const auto received = receiver::received_power(radar, image_of(frame), polarization);
      double sum_w = 0.0, wanted_w = 0.0;
      for (std::size_t range = 4; range + 4 < view.ranges; ++range) {
        const double range_m = pose.first_range_m + (static_cast<double>(range) + 0.5) * bins.range_step_m;
        for (std::size_t beam = 2; beam + 2 < view.beams; ++beam) {
          sum_w += static_cast<double>(received.signal_w(beam, range));
          wanted_w += level_ground_w(radar, range_m, part * level_ground_gamma * pose.position.z / range_m);
        }
      }
      const auto bins_of_it = static_cast<double>((view.ranges - 8) * (view.beams - 4));
      validation::expect_close(
          {.group = "Live frames",
           .name = fmt::format("received power of level ground at {} km, {}", 1e-3 * slant_range_m, name),
           .expected = db_from_linear(wanted_w / bins_of_it),
           .measured = db_from_linear(sum_w / bins_of_it),
           .tolerance = 0.05,
           .unit = "dBW",
           .source = "P_t G² λ² σ0 A C / ((4π)³ r⁴ L)"});
    }
  }
}

TEST(LiveFrame, GroundAHundredKilometresAwayLiesBelowTheTangent) {
  auto row = std::make_unique<LatticeRow>();
  row->count = 1;
  row->north_m[0] = 100e3;
  locate(*row, {.radar_height_m = 1000.0,
                .drop_per_square_m = 0.5 * radar::CurvedEarth{}.curvature_per_m(),
                .beams_per_rad = 100.0,
                .ranges_per_m = 1.0});
  validation::expect_close({.group = "Live frames",
                            .name = "drop of sea level at 100 km",
                            .expected = 588.6,
                            .measured = static_cast<double>(row->below_m[0]) - 1000.0,
                            .tolerance = 0.1,
                            .unit = "m",
                            .source = "d²/(2 k R), k = 4/3"});
}

/// Sine of the grazing angle of sea level, from the triangle with the centre of the Earth of 4/3 radius: its sides are
/// the line of sight, k R and k R + h.
double sine_by_triangle(double height_m, double distance_m) {
  constexpr double foot_m = 4.0 / 3.0 * 6'371'008.8;
  const double top_m = foot_m + height_m;
  const double sight_m =
      std::sqrt(top_m * top_m + foot_m * foot_m - 2.0 * top_m * foot_m * std::cos(distance_m / foot_m));
  return (top_m * top_m - foot_m * foot_m - sight_m * sight_m) / (2.0 * foot_m * sight_m);
}

TEST(LiveFrame, GroundFarAwayFacesTheRadarByItsOwnHorizontal) {
  EXPECT_NEAR(sine_by_triangle(1000.0, 100e3), 0.004113, 1e-6);
  for (const double distance_m : {50e3, 100e3}) {
    for (const double slope : {0.0, 0.01}) {
      auto row = std::make_unique<LatticeRow>();
      row->count = 1;
      row->north_m[0] = distance_m;
      row->slope_north[0] = static_cast<float>(slope);
      row->ground_lit[0] = 1.0F;
      const RowGeometry geometry{.radar_height_m = 1000.0,
                                 .drop_per_square_m = 0.5 * radar::CurvedEarth{}.curvature_per_m()};
      locate(*row, geometry);
      (void)face(*row, geometry, 1.0F);
      // Rising away from the radar.
      const double sine = std::sin(std::asin(sine_by_triangle(1000.0, distance_m)) + std::atan(slope));
      const auto expect_sine = [&](const char* what, float measured) {
        validation::expect_close(
            {.group = "Live frames",
             .name = fmt::format("{} {} km away, slope {}, seen from 1 km: sine of its grazing angle", what,
                                 1e-3 * distance_m, slope),
             .expected = sine,
             .measured = static_cast<double>(measured),
             .tolerance = 2e-6,
             .unit = "1",
             .source = "triangle with the centre of the Earth, k = 4/3"});
      };
      expect_sine("bare ground", row->local_sine[0]);
      // What stands there and was looked up at 2°, the lowest elevation, has as much less of the beam as the ground.
      const double lowest = radians_from_deg(2.0);
      const double lowest_sine = std::sin(lowest + std::atan(slope));
      hold_lowest_look(*row, geometry, static_cast<float>(1.0 / std::tan(lowest)),
                       static_cast<float>(std::sin(lowest)));
      expect_sine("what stands on ground", row->sine[0] * static_cast<float>(lowest_sine / std::sin(lowest)));
    }
  }
}

/// Mean sine of the grazing angle of a band of ranges, as the power tells it.
double sine_of_band(const Frame& frame, std::size_t first, std::size_t count) {
  double power = 0.0, area = 0.0;
  for (std::size_t range = first; range < first + count; ++range) {
    const double middle_m = frame.grid.first_range_m + (static_cast<double>(range) + 0.5) * frame.grid.range_step_m;
    power += vv_of_range(frame, range);
    area +=
        middle_m * frame.grid.range_step_m * frame.grid.azimuth_step_rad * static_cast<double>(frame.grid.azimuths - 4);
  }
  return power / (level_ground_gamma * area);
}

constexpr double height_over_sea_m = 1000.0;

/// 205 km of sea, of which a radar near the southern edge looks north.
struct Sea {
  explicit Sea(bool apart) : example(level_ground(apart)) {
    example.texel_m = 400.0;
    example.elevations_deg = {5.0, 37.0};
    example.ground_elevations_deg = {2.0, 45.0};
    example.terrain_spacing_m = 1000.0;
    const atlas::Store store = example.store(folder.path("atlas"));
    atlas::Pyramid(store).make_above(store.units());
    ground = example.over(store);
    settings.content = FrameContent::Powers;
    settings.beams = 44;
    settings.ranges = 100;
    settings.beam_step_rad = 0.01;
    settings.range_step_m = 400.0;
    settings.cells_per_bin = 1.0;
  }

  [[nodiscard]] Pose pose(double first_range_m) const {
    Pose pose;
    pose.position = {example.middle().x, 5e3, height_over_sea_m};
    pose.first_azimuth_rad = -22.0 * settings.beam_step_rad;
    pose.first_range_m = first_range_m;
    return pose;
  }

  ScratchFolder folder;
  ExampleGround example;
  std::shared_ptr<LiveGround> ground;
  LiveSettings settings;
};

void expect_the_sea_to_end(bool apart) {
  Sea sea(apart);
  const Pose pose = sea.pose(110e3);
  LiveRenderer renderer(sea.ground, sea.settings);
  const Frame& frame = settled_frame(renderer, *sea.ground, pose);
  ASSERT_EQ(frame.report.dark, 0U);

  // γ sin ψ falls in a straight line, nearly, and to nothing where the line of sight touches the sea.
  constexpr std::size_t near = 20, far = 36, band = 12;
  const double near_sine = sine_of_band(frame, near, band), far_sine = sine_of_band(frame, far, band);
  const double step_m = sea.settings.range_step_m;
  const double far_middle_m = pose.first_range_m + (static_cast<double>(far) + band / 2.0) * step_m;
  const double end_m = far_middle_m + far_sine * static_cast<double>(far - near) * step_m / (near_sine - far_sine);
  validation::expect_close(
      {.group = "Live frames",
       .name = fmt::format("horizon of the sea{} from 1 km, where its power runs out", apart ? ", kept apart," : ""),
       .expected = 130.3,
       .measured = 1e-3 * end_m,
       .tolerance = 0.5,
       .unit = "km",
       .source = "√(2 k R h), k = 4/3"});
  EXPECT_LT(sine_of_band(frame, 60, band), 1e-2 * near_sine);

  // On the way there.
  for (const double distance_m : {50e3, 100e3}) {
    const double first_range_m = distance_m - 46.0 * step_m;
    const Frame& nearer = settled_frame(renderer, *sea.ground, sea.pose(first_range_m));
    validation::expect_close({.group = "Live frames",
                              .name = fmt::format("sea{} {} km away, power over that of ψ = 90°",
                                                  apart ? ", kept apart," : "", 1e-3 * distance_m),
                              .expected = db_from_linear(sine_by_triangle(height_over_sea_m, distance_m)),
                              .measured = db_from_linear(sine_of_band(nearer, 40, band)),
                              .tolerance = 0.05,
                              .unit = "dB",
                              .source = "γ sin ψ, triangle with the centre of the Earth, k = 4/3"});
  }

  sea.settings.refraction = 1e9;
  LiveRenderer flat(sea.ground, sea.settings);
  EXPECT_GT(sine_of_band(settled_frame(flat, *sea.ground, pose), 60, band), 0.9 * height_over_sea_m / 137e3);
}

TEST(LiveFrame, TheSeaEndsAtTheHorizon) {
  expect_the_sea_to_end(false);
}

TEST(LiveFrame, TheSeaKeptApartEndsAtTheHorizon) {
  expect_the_sea_to_end(true);
}

// Beyond the horizon at 130.3 km the sea hides what is lower than (d − 130.3 km)²/(2 k R): at 150 km 22.7 m.
TEST(LiveFrame, TheSeaHidesTheFeetOfWhatIsBeyondTheHorizon) {
  const Sea sea(false);
  Pose pose = sea.pose(140e3);
  const auto seen = [&](double height_m, double refraction) {
    radar::Target mast;
    mast.track = radar::Track::straight(Vec3d{pose.position.x, pose.position.y + 150e3, height_m});
    mast.rcs_m2 = radar::Channels{1e4F, 1e4F, 0.0F, 0.0F};
    const std::vector<radar::Target> targets{mast};
    LiveSettings settings = sea.settings;
    settings.refraction = refraction;
    LiveRenderer looking(sea.ground, settings);
    pose.targets = targets;
    return settled_frame(looking, *sea.ground, pose).report.targets;
  };
  EXPECT_EQ(seen(20.0, 4.0 / 3.0), 0U);
  EXPECT_EQ(seen(25.5, 4.0 / 3.0), 1U);
  EXPECT_EQ(seen(20.0, 1e9), 1U);
}

}  // namespace
}  // namespace sigmascape::live
