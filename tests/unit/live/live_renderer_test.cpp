#include "sigmascape/live/live_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "frame_numbers.h"
#include "live_ground_example.h"

#include "sigmascape/atlas/pyramid.h"
#include "sigmascape/base/error.h"

namespace sigmascape::live {
namespace {

/// Cross-section of a bin on level ground: σ0 times the area between two ranges and two azimuths.
double rcs_of_bin(const radar::RangeAzimuthGrid& grid, std::size_t range, double height_m, double gamma_vv) {
  const double near = grid.first_range_m + static_cast<double>(range) * grid.range_step_m;
  const double far = near + grid.range_step_m, middle = near + grid.range_step_m / 2.0;
  const double area = (far * far - near * near) / 2.0 * grid.azimuth_step_rad;
  return gamma_vv * height_m / middle * area;
}

/// All tests look at one atlas, of level ground.
class LiveRendererTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<ScratchFolder>();
    store_ = std::make_unique<atlas::Store>(even_example().store(folder_->path("atlas")));
    atlas::Pyramid(*store_).make_above(store_->units());
  }
  static void TearDownTestSuite() {
    store_.reset();
    folder_.reset();
  }
  static inline std::unique_ptr<ScratchFolder> folder_;
  static inline std::unique_ptr<atlas::Store> store_;
};

TEST_F(LiveRendererTest, PowerIsThatOfTheRadarEquationAtEveryRange) {
  const auto ground = even_example().over(*store_);
  for (const double elevation_deg : {5.0, 8.6, 13.0, 21.0, 30.0}) {
    ExampleView view;
    view.elevation_deg = elevation_deg;
    LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
    const Frame& frame = settled_frame(renderer, *ground, view.pose());
    ASSERT_EQ(frame.report.dark, 0U);
    // Rows of bins, away from the ends that have no ground beyond.
    for (std::size_t range = 4; range + 12 <= view.ranges; range += 8) {
      double sum = 0.0, expected = 0.0;
      for (std::size_t r = range; r < range + 8; ++r) {
        for (std::size_t beam = 2; beam + 2 < view.beams; ++beam) {
          sum += frame.powers_m2[(beam * view.ranges + r) * 4];
          expected += rcs_of_bin(frame.grid, r, view.pose().position.z, example_gamma);
        }
      }
      EXPECT_NEAR(10.0 * std::log10(sum / expected), 0.0, 0.05) << elevation_deg << "°, range bin " << range;
    }
  }
}

TEST_F(LiveRendererTest, ChannelsComeBackInTheirOwnParts) {
  const auto ground = even_example().over(*store_);
  const ExampleView view;
  LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
  const Frame& frame = settled_frame(renderer, *ground, view.pose());
  const std::size_t middle = ((view.beams / 2) * view.ranges + view.ranges / 2) * 4;
  EXPECT_NEAR(frame.powers_m2[middle + 1] / frame.powers_m2[middle], 0.5, 1e-3);
  EXPECT_NEAR(frame.powers_m2[middle + 2] / frame.powers_m2[middle], 0.1, 1e-3);
  EXPECT_NEAR(frame.powers_m2[middle + 3] / frame.powers_m2[middle], 0.6 * std::sqrt(0.5), 1e-3);
}

TEST_F(LiveRendererTest, AmplitudesAreSpeckleOfThatPower) {
  const auto ground = even_example().over(*store_);
  const ExampleView view;
  LiveRenderer powers(ground, view.settings(FrameContent::Powers));
  const Frame& mean = settled_frame(powers, *ground, view.pose());
  std::array<double, 3> sums{};  // VV, HH, HV
  double squares = 0.0, cross = 0.0;
  std::size_t count = 0;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    LiveSettings settings = view.settings(FrameContent::Amplitudes);
    settings.seed = seed;
    LiveRenderer amplitudes(ground, settings);
    const Frame& drawn = amplitudes.render(view.pose());
    for (std::size_t beam = 2; beam + 2 < view.beams; ++beam) {
      for (std::size_t range = 4; range + 4 < view.ranges; ++range) {
        const std::size_t bin = (beam * view.ranges + range) * 4;
        for (std::size_t channel = 0; channel < 3; ++channel)
          sums[channel] += std::norm(drawn.amplitudes_m[bin + channel]) / mean.powers_m2[bin + channel];
        const double intensity = std::norm(drawn.amplitudes_m[bin]) / mean.powers_m2[bin];
        squares += intensity * intensity;
        cross += (drawn.amplitudes_m[bin] * std::conj(drawn.amplitudes_m[bin + 1])).real() / mean.powers_m2[bin];
        EXPECT_EQ(drawn.amplitudes_m[bin + 2], drawn.amplitudes_m[bin + 3]);
        ++count;
      }
    }
  }
  const auto n = static_cast<double>(count);
  // Neighbouring bins share scatterers, so that fewer than all of them are independent: four standard errors of a
  // quarter of them, whose intensity deviates by 1, its square by √20.
  const double of_a_mean = 4.0 / std::sqrt(n / 4.0);
  for (const double sum : sums) EXPECT_NEAR(sum / n, 1.0, of_a_mean);
  EXPECT_NEAR(squares / n / (sums[0] * sums[0] / n / n), 2.0, std::sqrt(20.0) * of_a_mean);
  EXPECT_NEAR(cross / n, 0.6 * std::sqrt(0.5), of_a_mean);
}

TEST_F(LiveRendererTest, GivesTheSameBytesForAnyNumberOfThreads) {
  const auto ground = even_example().over(*store_);
  const ExampleView view;
  LiveRenderer one(ground, view.settings(FrameContent::Amplitudes, 1));
  LiveRenderer three(ground, view.settings(FrameContent::Amplitudes, 3));
  const Frame& first = settled_frame(one, *ground, view.pose());
  const Frame& second = settled_frame(three, *ground, view.pose());
  EXPECT_TRUE(std::ranges::equal(first.amplitudes_m, second.amplitudes_m));
}

/// Hills with a pattern on them, houses and crowns in rows, and ground of its own.
ExampleGround town_on_hills() {
  ExampleGround ground = even_example();
  ground.height_m = [](Vec2d p) { return 25.0 * std::sin(0.021 * p.x + 0.006 * p.y) * std::cos(0.017 * p.y); };
  ground.pattern = [](const radar::Look& look, Vec2d p) {
    return 1.0F + 0.5F * static_cast<float>(std::sin(0.05 * p.x + look.aspect.azimuth_rad));
  };
  ground.bare_sigma0 = [](const radar::Look& look) { return constant_gamma(0.03, look); };
  ground.obstacle = [](Vec2d p) -> radar::Obstacle {
    const double column = std::fmod(std::abs(p.x), 90.0), row = std::fmod(std::abs(p.y), 70.0);
    if (column < 12.0 && row < 12.0) return {.solid_top_m = 14.0F};
    if (column > 40.0 && column < 60.0 && row < 30.0)
      return {.crown_base_m = 4.0F, .crown_top_m = 12.0F, .crown_extinction_per_m = 0.1F};
    return {};
  };
  return ground;
}

/// Points, boxes that throw shadows over one another's beams, and a mover that fluctuates.
std::vector<radar::Target> many_targets(Vec2d middle) {
  std::vector<radar::Target> targets;
  for (int i = 0; i < 600; ++i) {
    radar::Target target;
    const Vec3d place{middle.x - 450.0 + 1.5 * i, middle.y - 300.0 + static_cast<double>(i * 37 % 600), 30.0};
    target.track = radar::Track::straight(place, {3.0, -2.0, 0.0});
    target.rcs_m2 = radar::Channels{20.0F, 10.0F, 1.0F, 5.0F};
    if (i % 6 == 0) target.size_m = {20.0, 10.0, 24.0};
    if (i % 10 == 0) target.fluctuation = radar::Swerling::Case1;
    target.seed = static_cast<std::uint64_t>(i);
    targets.push_back(target);
  }
  return targets;
}

TEST_F(LiveRendererTest, GivesTheSameBytesOfHillsObstaclesAndTargetsForAnyNumberOfThreads) {
  const ScratchFolder folder;
  const ExampleGround example = town_on_hills();
  const atlas::Store store = example.store(folder.path("atlas"));
  atlas::Pyramid(store).make_above(store.units());
  const auto ground = example.over(store);
  ExampleView view;
  // Groups of 64 beams, so that there is something to share out.
  view.beams = 200;
  view.ranges = 96;
  view.bin_m = 6.0;
  const std::vector<radar::Target> targets = many_targets(view.target);
  Pose pose = view.pose();
  pose.targets = targets;
  pose.moment.time_s = 2.0;
  for (const FrameContent content : {FrameContent::Powers, FrameContent::Amplitudes}) {
    std::vector<float> powers;
    std::vector<std::complex<float>> amplitudes;
    for (const unsigned threads : {1U, 2U, 3U}) {
      LiveRenderer renderer(ground, view.settings(content, threads));
      const Frame& frame = settled_frame(renderer, *ground, pose);
      ASSERT_EQ(frame.report.coarse + frame.report.dark + frame.report.coarse_obstacles, 0U);
      ASSERT_LT(frame.report.lit, frame.report.cells) << "something is hidden";
      ASSERT_GT(frame.report.targets, 300U);
      if (threads == 1) {
        powers.assign(frame.powers_m2.begin(), frame.powers_m2.end());
        amplitudes.assign(frame.amplitudes_m.begin(), frame.amplitudes_m.end());
      }
      EXPECT_TRUE(std::ranges::equal(frame.powers_m2, powers)) << threads << " threads";
      EXPECT_TRUE(std::ranges::equal(frame.amplitudes_m, amplitudes)) << threads << " threads";
    }
  }
}

TEST_F(LiveRendererTest, AScanFillsTheFrameBeamByBeam) {
  const auto ground = even_example().over(*store_);
  const ExampleView view;
  LiveRenderer at_once(ground, view.settings(FrameContent::Amplitudes));
  LiveRenderer scanning(ground, view.settings(FrameContent::Amplitudes));
  const Frame& whole = settled_frame(at_once, *ground, view.pose());
  for (std::size_t beam = 0; beam < view.beams; beam += 16) scanning.scan(view.pose(), beam, 16);
  const Frame& swept = scanning.scan(view.pose(), 0, 16);
  EXPECT_TRUE(std::ranges::equal(whole.amplitudes_m, swept.amplitudes_m));
}

TEST_F(LiveRendererTest, AStepWithoutABeamIsRefused) {
  const auto ground = even_example().over(*store_);
  const ExampleView view;
  LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
  const std::vector<float> before = numbers_of(settled_frame(renderer, *ground, view.pose()));
  EXPECT_THROW(renderer.scan(view.pose(), view.beams, 4), Error);
  EXPECT_THROW(renderer.scan(view.pose(), 0, 0), Error);
  EXPECT_TRUE(numbers_of(renderer.scan(view.pose(), view.beams - 1, 4)) == before) << "the last beam alone";
}

TEST_F(LiveRendererTest, AFrameSaysOfWhichFrequencyAndEarthItIs) {
  const auto ground = even_example().over(*store_);
  const ExampleView view;
  LiveSettings settings = view.settings(FrameContent::Powers);
  settings.refraction = 1.5;
  LiveRenderer renderer(ground, settings);
  const Frame& frame = renderer.render(view.pose());
  EXPECT_EQ(frame.frequency_hz, ground->frequency_hz());
  EXPECT_EQ(frame.earth.refraction, 1.5);
}

TEST_F(LiveRendererTest, TheSameGroundAnswersWithTheSamePhase) {
  const auto ground = even_example().over(*store_);
  const ExampleView view;
  LiveRenderer renderer(ground, view.settings(FrameContent::Amplitudes));
  const Frame& frame = settled_frame(renderer, *ground, view.pose());
  const std::vector<std::complex<float>> before(frame.amplitudes_m.begin(), frame.amplitudes_m.end());
  // The radar comes nearer by an eighth of a wavelength along its line of sight, bins with it: exp(−4πi r/λ) of ground
  // straight ahead goes on by a quarter of a turn.
  Pose moved = view.pose();
  const double nearer_m = wavelength_m(10e9) / 8.0;
  const Vec3d target{view.target.x, view.target.y, 0.0};
  moved.position = target + (moved.position - target) * (1.0 - nearer_m / view.slant_range_m);
  moved.first_range_m -= nearer_m;
  const Frame& after = renderer.render(moved);
  std::complex<double> cross;
  double power = 0.0;
  const std::size_t beam = view.beams / 2;
  for (std::size_t range = view.ranges / 2 - 4; range < view.ranges / 2 + 4; ++range) {
    const std::size_t bin = (beam * view.ranges + range) * 4;
    cross += std::complex<double>(before[bin]) * std::conj(std::complex<double>(after.amplitudes_m[bin]));
    power += std::norm(before[bin]);
  }
  EXPECT_GT(std::abs(cross) / power, 0.95);
  EXPECT_NEAR(std::arg(cross), -0.5 * pi, 0.3);
}

TEST_F(LiveRendererTest, AHillHidesWhatLiesBehindIt) {
  ExampleGround ridge = even_example();
  ridge.height_m = [](Vec2d p) { return std::abs(p.y) < 8.0 ? 30.0 : 0.0; };
  const auto ground = ridge.over(*store_);
  ExampleView view;
  view.azimuth_deg = 0.0;
  LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
  const Frame& frame = settled_frame(renderer, *ground, view.pose());
  // Seen from the north under 13°, a ridge of 30 m through the origin throws a shadow of 30 / tan 13° = 130 m
  // southwards.
  const auto power_at = [&](double south_m) {
    const double range = length(Vec3d{view.target.x, view.target.y - south_m, 0.0} - view.pose().position);
    const auto r = static_cast<std::size_t>((range - frame.grid.first_range_m) / frame.grid.range_step_m);
    double sum = 0.0;
    for (std::size_t beam = 8; beam + 8 < view.beams; ++beam) sum += frame.powers_m2[(beam * view.ranges + r) * 4];
    return sum;
  };
  const double open = power_at(-200.0);
  EXPECT_LT(power_at(30.0), 1e-3 * open);
  EXPECT_LT(power_at(100.0), 1e-3 * open);
  EXPECT_GT(power_at(180.0), 0.8 * open);
}

TEST_F(LiveRendererTest, ShowsCoarserGroundUntilTheFinerIsThere) {
  const auto ground = even_example().over(*store_);
  const ExampleView view;
  LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
  const Frame& frame = renderer.render(view.pose());
  ASSERT_EQ(frame.report.dark, 0U);
  ASSERT_GT(frame.report.coarse, 0U);
  const auto total = [](const Frame& f) {
    double sum = 0.0;
    for (std::size_t i = 0; i < f.powers_m2.size(); i += 4) sum += f.powers_m2[i];
    return sum;
  };
  const double coarse = total(frame);
  ground->wait_until_loaded();
  const Frame& fine = renderer.render(view.pose());
  EXPECT_EQ(fine.report.coarse, 0U);
  EXPECT_NEAR(10.0 * std::log10(coarse / total(fine)), 0.0, 0.01);
}

TEST_F(LiveRendererTest, MemoryStaysWithinTheBudget) {
  ExampleGround small = even_example();
  small.cache.budget_bytes = std::size_t{16} << 20U;
  const auto ground = small.over(*store_);
  ExampleView view;
  LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
  for (double azimuth = 0.0; azimuth < 360.0; azimuth += 20.0) {
    view.azimuth_deg = azimuth;
    settled_frame(renderer, *ground, view.pose());
    EXPECT_LE(ground->pages().report().bytes, small.cache.budget_bytes);
  }
  EXPECT_GT(ground->pages().report().evicted, 0U);
}

/// Of all numbers in a frame.
double largest(const Frame& frame) {
  double most = 0.0;
  for (const float power : frame.powers_m2) most = std::max(most, std::abs(static_cast<double>(power)));
  for (const std::complex<float>& amplitude : frame.amplitudes_m)
    most = std::max(most, static_cast<double>(std::abs(amplitude)));
  return most;
}

TEST_F(LiveRendererTest, BinsNearerThanAllGroundHoldTargetsAndNothingElse) {
  const auto ground = even_example().over(*store_);
  const Vec2d middle = ExampleGround{}.middle();
  LiveSettings settings;
  settings.beams = settings.ranges = 32;
  settings.beam_step_rad = 0.01;
  settings.range_step_m = 15.0;
  for (const FrameContent content : {FrameContent::Powers, FrameContent::Amplitudes}) {
    settings.content = content;
    for (const double refraction : {4.0 / 3.0, 1e9}) {
      settings.refraction = refraction;
      for (const Vec3d position :
           {Vec3d{middle.x, middle.y, 12e3}, {1e7, 1e7, 1e4}, {0.0, 0.0, 1e6}, {0.0, 0.0, 1e7}}) {
        LiveRenderer renderer(ground, settings);
        Pose pose{.position = position, .first_range_m = 1000.0};
        const Frame& empty = settled_frame(renderer, *ground, pose);
        EXPECT_EQ(largest(empty), 0.0) << position.z;
        // Three beams from the left, in the middle of a bin.
        const double azimuth_rad = 3.5 * settings.beam_step_rad, distance_m = 300.0;
        radar::Target target;
        target.track = radar::Track::straight(
            position + Vec3d{std::sin(azimuth_rad) * distance_m, std::cos(azimuth_rad) * distance_m, -1000.0});
        target.rcs_m2 = radar::Channels{10.0F, 10.0F, 0.0F, 10.0F};
        pose.targets = {&target, 1};
        const Frame& frame = renderer.render(pose);
        EXPECT_EQ(frame.report.targets, 1U) << position.z;
        EXPECT_GT(largest(frame), 1.0) << position.z;
      }
    }
  }
}

TEST(LiveSettingsCheck, RefractionMayNotBendBeamsAllTheWayAwayFromTheGround) {
  LiveSettings settings;
  for (const double refraction : {0.1, 1.0, 4.0 / 3.0, 1e9}) {
    settings.refraction = refraction;
    EXPECT_NO_THROW(check(settings, "here")) << refraction;
  }
  for (const double refraction : {0.0, 0.05, -1.0, std::nan("")}) {
    settings.refraction = refraction;
    EXPECT_THROW(check(settings, "here"), Error) << refraction;
  }
}

TEST_F(LiveRendererTest, GroundBeyondTheAtlasIsCountedButNotGoneOver) {
  const auto ground = even_example().over(*store_);
  LiveSettings settings;
  settings.content = FrameContent::Powers;
  settings.beams = 200;
  settings.beam_step_rad = 2.0 * pi / 200.0;
  // Two thousand kilometres in the finest texels, which to go over takes far longer than a test may.
  settings.ranges = 5000;
  settings.range_step_m = 400.0;
  settings.cells_per_bin = 64.0;
  settings.refraction = 1e9;
  const Vec2d middle = ExampleGround{}.middle();
  const Pose pose{.position = {middle.x, middle.y, 1000.0}, .first_range_m = 1000.0};
  LiveRenderer renderer(ground, settings);
  const Frame& frame = settled_frame(renderer, *ground, pose);
  const double cell_m = ExampleGround{}.texel_m * static_cast<double>(1U << frame.report.level);
  const double far_m = 1000.0 + 5000.5 * 400.0;
  const double all = pi * far_m * far_m / (cell_m * cell_m);
  const double inside = std::pow(ExampleGround{}.side_m() / cell_m, 2.0);
  // Those at the edges of beams that are filled apart, half a beam wide, are looked at from both sides.
  const double twice = std::ceil(200.0 / std::floor(0.75 / settings.beam_step_rad)) / 200.0;
  EXPECT_NEAR(static_cast<double>(frame.report.cells) / all, 1.0 + twice, 0.005);
  EXPECT_NEAR(static_cast<double>(frame.report.cells - frame.report.dark) / inside, 1.0 + twice, 0.02);
  EXPECT_EQ(frame.report.lit, frame.report.cells - frame.report.dark);
}

TEST_F(LiveRendererTest, TheAltitudeReturnIsThatOfAFrameHoweverAScanIsCut) {
  const auto ground = even_example().over(*store_);
  const Vec2d middle = ExampleGround{}.middle();
  constexpr double height_m = 300.0;
  LiveSettings settings;
  settings.beams = 128;
  settings.ranges = 32;
  settings.beam_step_rad = 2.0 * pi / 128.0;
  settings.range_step_m = 1.0;
  settings.refraction = 1e9;
  const Pose pose{.position = {middle.x + 3.0, middle.y + 5.0, height_m}, .first_range_m = height_m - 4.0};
  for (const FrameContent content : {FrameContent::Powers, FrameContent::Amplitudes}) {
    settings.content = content;
    LiveRenderer at_once(ground, settings);
    const Frame& frame = settled_frame(at_once, *ground, pose);
    const std::vector<float> whole = numbers_of(frame);
    if (content == FrameContent::Powers) {
      double sum = 0.0;
      for (std::size_t beam = 0; beam < settings.beams; ++beam) {
        for (std::size_t range = 0; range < 20; ++range) sum += frame.powers_m2[(beam * settings.ranges + range) * 4];
      }
      // The disc that the first bins reach over, with the σ0 of the steepest elevation baked.
      const double disc_m2 = pi * ((height_m + 16.0) * (height_m + 16.0) - height_m * height_m);
      EXPECT_NEAR(db_from_linear(sum / (example_gamma * std::sin(radians_from_deg(37.0)) * disc_m2)), 0.0, 0.1);
    }
    for (const std::size_t a_step : {64UL, 7UL, 1UL}) {
      LiveRenderer scanning(ground, settings);
      const Frame* swept = nullptr;
      for (std::size_t beam = 0; beam < settings.beams; beam += a_step) swept = &scanning.scan(pose, beam, a_step);
      EXPECT_TRUE(numbers_of(*swept) == whole) << a_step;
    }
  }
}

TEST_F(LiveRendererTest, ATurnOfAnyNumberOfBeamsHasThePowerOfTheGround) {
  const auto ground = even_example().over(*store_);
  const Vec2d middle = ExampleGround{}.middle();
  constexpr double height_m = 400.0;
  for (const std::size_t beams : {8UL, 9UL, 13UL, 100UL, 200UL}) {
    LiveSettings settings;
    settings.content = FrameContent::Powers;
    settings.beams = beams;
    settings.ranges = 20;
    settings.beam_step_rad = 2.0 * pi / static_cast<double>(beams);
    settings.range_step_m = 10.0;
    settings.refraction = 1e9;
    const Pose pose{.position = {middle.x, middle.y, height_m}, .first_azimuth_rad = 0.3, .first_range_m = 820.0};
    LiveRenderer renderer(ground, settings);
    const Frame& frame = settled_frame(renderer, *ground, pose);
    for (std::size_t beam = 0; beam < beams; ++beam) {
      double sum = 0.0, expected = 0.0;
      for (std::size_t range = 0; range < settings.ranges; ++range) {
        sum += frame.powers_m2[(beam * settings.ranges + range) * 4];
        expected += rcs_of_bin(frame.grid, range, height_m, example_gamma);
      }
      EXPECT_NEAR(db_from_linear(sum / expected), 0.0, 0.3) << beam << " of " << beams;
    }
  }
}

TEST(LiveSettings, WhatNoFrameCanComeFromIsRefused) {
  const auto error_of = [](const LiveSettings& settings) -> std::string {
    try {
      check(settings, "these");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  // Whole turns, as they come back from a division, and no more.
  for (std::size_t beams = 8; beams <= 4096; ++beams) {
    const double step_rad = 2.0 * pi / static_cast<double>(beams);
    ASSERT_EQ(error_of({.beams = beams, .beam_step_rad = step_rad}), "") << beams;
    ASSERT_NE(error_of({.beams = beams, .beam_step_rad = step_rad * (1.0 + 1e-5)}), "") << beams;
  }
  EXPECT_NE(error_of({.beams = 1, .beam_step_rad = 0.8}).find("an eighth of a turn"), std::string::npos);
  EXPECT_EQ(error_of({.beams = 1, .beam_step_rad = pi / 4.0}), "");
  EXPECT_NE(error_of({.ranges = 100'000, .range_step_m = 101.0}).find("1e+07 m"), std::string::npos);
  EXPECT_EQ(error_of({.ranges = 100'000, .range_step_m = 99.0}), "");
}

// Of two looks one shines and the other is dark: a place takes of each by how far round it is, be it half a turn.
TEST(LiveRenderer, BlendsLooksThatAreHalfATurnApart) {
  ExampleGround example = even_example();
  example.azimuths = 2;
  example.pattern = [](const radar::Look& look, Vec2d) {
    return std::abs(look.aspect.azimuth_rad) < 1.0 ? 1.0F : 0.0F;
  };
  const ScratchFolder folder;
  const atlas::Store store = example.store(folder.path("atlas"));
  atlas::Pyramid(store).make_above(store.units());
  const auto ground = example.over(store);
  for (const double azimuth_deg : {0.0, 84.0, 90.0, 179.0, 270.0}) {
    ExampleView view;
    view.azimuth_deg = azimuth_deg;
    LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
    Pose pose = view.pose();
    // The left edge of beam 0 exactly where the radar is seen under that azimuth.
    pose.first_azimuth_rad = radians_from_deg(azimuth_deg) + pi;
    const Frame& frame = settled_frame(renderer, *ground, pose);
    for (const std::size_t beam : {0U, 1U, 9U}) {
      double sum = 0.0, expected = 0.0;
      for (std::size_t range = 8; range + 8 < view.ranges; ++range) {
        sum += static_cast<double>(frame.powers_m2[(beam * view.ranges + range) * 4]);
        expected += rcs_of_bin(frame.grid, range, pose.position.z, example_gamma);
      }
      const double seen_from_deg = azimuth_deg + deg_from_radians((static_cast<double>(beam) + 0.5) *
                                                                  view.settings(FrameContent::Powers).beam_step_rad);
      // Over 12° about east and west one look passes into the other.
      const double past_the_middle_deg = std::abs(std::fmod(seen_from_deg, 360.0) - 180.0) - 90.0;
      const double share = std::clamp(0.5 + past_the_middle_deg / 12.0, 0.0, 1.0);
      EXPECT_NEAR(sum / expected, share, 0.02) << azimuth_deg << "°, beam " << beam;
    }
  }
}

}  // namespace
}  // namespace sigmascape::live
