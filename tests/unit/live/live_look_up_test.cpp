#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "live_ground_example.h"

#include "sigmascape/atlas/atlas.h"

namespace sigmascape::live {
namespace {

constexpr double period_m = 256.0;
constexpr float modulation = 0.5F;

/// From one half to three halves, along one of the axes.
float waves(double along_m) {
  return 1.0F + modulation * static_cast<float>(std::sin(2.0 * pi * along_m / period_m));
}

ExampleGround wavy_ground() {
  ExampleGround ground = even_example();
  ground.pattern = [](const radar::Look&, Vec2d from_middle) { return waves(from_middle.x); };
  return ground;
}

/// VV of all bins, [beam][range]: what the offline look-up says of the ground, added up point by point and shared
/// between the centres of the bins, which lie at halves.
std::vector<double> added_up(const atlas::Atlas& atlas, const ExampleView& view, double frequency_hz, double level) {
  const LiveSettings bins = view.settings(FrameContent::Powers);
  const Pose pose = view.pose();
  std::vector<double> powers(view.beams * view.ranges);
  const auto add = [&](double beam, double range, double power) {
    if (beam < 0.0 || range < 0.0 || beam >= static_cast<double>(view.beams) ||
        range >= static_cast<double>(view.ranges))
      return;
    powers[static_cast<std::size_t>(beam) * view.ranges + static_cast<std::size_t>(range)] += power;
  };
  const double step_m = 1.5,
               reach_m = 0.5 * view.bin_m *
                         std::hypot(static_cast<double>(view.beams + 2), static_cast<double>(view.ranges + 2));
  for (double y = -reach_m; y < reach_m; y += step_m) {
    for (double x = -reach_m; x < reach_m; x += step_m) {
      const Vec2d point = view.target + Vec2d{x, y};
      const double east_m = point.x - pose.position.x, north_m = point.y - pose.position.y;
      const double ground_m = std::hypot(east_m, north_m), azimuth_rad = std::atan2(east_m, north_m);
      const radar::Aspect aspect{wrapped_azimuth(azimuth_rad + pi), std::atan2(pose.position.z, ground_m)};
      const radar::Channels sigma0 = atlas.sigma0_at(point, aspect, frequency_hz, level);
      const double power = static_cast<double>(sigma0.vv) * step_m * step_m;
      const double off_rad = wrapped_azimuth(azimuth_rad - pose.first_azimuth_rad + pi) - pi;
      const double beam = off_rad / bins.beam_step_rad - 0.5;
      const double range = (std::hypot(ground_m, pose.position.z) - pose.first_range_m) / bins.range_step_m - 0.5;
      const double first_beam = std::floor(beam), first_range = std::floor(range);
      const double next_beam = beam - first_beam, next_range = range - first_range;
      add(first_beam, first_range, power * (1.0 - next_beam) * (1.0 - next_range));
      add(first_beam, first_range + 1.0, power * (1.0 - next_beam) * next_range);
      add(first_beam + 1.0, first_range, power * next_beam * (1.0 - next_range));
      add(first_beam + 1.0, first_range + 1.0, power * next_beam * next_range);
    }
  }
  return powers;
}

constexpr std::size_t block = 8;

/// Sums over squares of 8 × 8 bins, away from the edges of the frame.
std::vector<double> blocks_of(const std::vector<double>& powers, const ExampleView& view) {
  std::vector<double> sums;
  for (std::size_t beam = block / 2; beam + block + block / 2 <= view.beams; beam += block) {
    for (std::size_t range = block / 2; range + block + block / 2 <= view.ranges; range += block) {
      double sum = 0.0;
      for (std::size_t i = 0; i < block * block; ++i)
        sum += powers[(beam + i / block) * view.ranges + range + i % block];
      sums.push_back(sum);
    }
  }
  return sums;
}

double mean_of(const std::vector<double>& numbers) {
  double sum = 0.0;
  for (const double number : numbers) sum += number;
  return sum / static_cast<double>(numbers.size());
}

/// How far a frame may be from the offline look-up in a block of bins, over the mean of all blocks.
///
/// A scatterer is dealt out evenly over its cell of side t, so that only where a block's weight rises, over the width b
/// of a bin along its edges of length S, does its place count: of each cell there by a variance of (t/b)²/12. That are
/// 4 S b/t² cells of the S²/t² of the block. Five times its root, of the brightest ground, is more than any of some
/// hundred blocks shows. Then a texel is even where the offline look-up goes linearly to the next, which takes
/// 1 − sinc(t/L) more from waves of period L.
double tolerance(double texel_m, double bin_m) {
  const double side_m = static_cast<double>(block) * bin_m, brightest = 1.0 + static_cast<double>(modulation);
  const double places = std::sqrt(side_m / (3.0 * bin_m)) * texel_m * texel_m / (side_m * side_m);
  const double evenness = std::pow(pi * texel_m / period_m, 2.0) / 6.0;
  return 5.0 * brightest * places + static_cast<double>(modulation) * evenness;
}

void expect_the_offline_look_up(const ExampleGround& example, const atlas::Store& store, double frequency_hz,
                                double azimuth_deg = 30.0) {
  const auto ground = example.over(store, frequency_hz);
  const atlas::Atlas atlas = atlas::load_atlas(store);
  for (const std::size_t level : {0U, 1U}) {
    const double times = static_cast<double>(1U << level);
    const ExampleView view{.target = example.middle(), .azimuth_deg = azimuth_deg, .bin_m = 12.0 * times};
    LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
    const Frame& frame = settled_frame(renderer, *ground, view.pose());
    ASSERT_EQ(frame.report.level, level);
    ASSERT_EQ(frame.report.coarse + frame.report.dark, 0U);
    std::vector<double> shown;
    for (std::size_t i = 0; i < frame.powers_m2.size(); i += 4) {
      shown.push_back(static_cast<double>(frame.powers_m2[i]));
    }
    const auto live = blocks_of(shown, view);
    const auto offline = blocks_of(added_up(atlas, view, frequency_hz, static_cast<double>(level)), view);
    const double mean = mean_of(offline), allowed = tolerance(example.texel_m * times, view.bin_m);
    ASSERT_LT(allowed, 0.025);
    EXPECT_NEAR(mean_of(live) / mean, 1.0, allowed / 5.0);
    for (std::size_t i = 0; i < live.size(); ++i) {
      EXPECT_NEAR(live[i] / mean, offline[i] / mean, allowed) << azimuth_deg << "°, level " << level << ", block " << i;
    }
  }
}

TEST(LiveLookUp, HasThePowerOfTheOfflineOneAtTwoLevels) {
  const ScratchFolder folder;
  const ExampleGround example = wavy_ground();
  const atlas::Store store = example.store(folder.path("atlas"));
  atlas::Pyramid(store).make_above(store.units());
  expect_the_offline_look_up(example, store, 10e9);
}

TEST(LiveLookUp, BlendsAzimuthsAsTheOfflineOneDoesAllRound) {
  const ScratchFolder folder;
  ExampleGround example = wavy_ground();
  // Baked from north, east, south and west, each unlike its neighbours.
  example.pattern = [](const radar::Look& look, Vec2d) {
    constexpr std::array<float, 4> brightness{1.0F, 6.0F, 2.0F, 16.0F};
    return brightness.at(static_cast<std::size_t>(std::lround(look.aspect.azimuth_rad / (pi / 2.0))));
  };
  const atlas::Store store = example.store(folder.path("atlas"));
  atlas::Pyramid(store).make_above(store.units());
  // Between the last azimuth and north; with north, or another baked azimuth, in the middle of the beams; where two
  // are blended; elsewhere.
  for (const double azimuth_deg : {350.0, 312.0, 319.0, 285.0, 358.0, 0.0, 1.5, 46.0, 60.0, 90.0, 133.0, 137.0, 268.0})
    expect_the_offline_look_up(example, store, 10e9, azimuth_deg);
}

// Beneath the radar texels of one row, each answering from a place of its own within it, lie to and fro across the
// azimuth at which the baked looks change.
TEST(LiveLookUp, OfATexelDoesNotDependOnItsRow) {
  const ScratchFolder folder;
  ExampleGround example = wavy_ground();
  example.azimuths = 8;
  example.pattern = [](const radar::Look& look, Vec2d) {
    return std::lround(look.aspect.azimuth_rad / (pi / 4.0)) % 2 == 0 ? 1.0F : 16.0F;
  };
  const atlas::Store store = example.store(folder.path("atlas"));
  atlas::Pyramid(store).make_above(store.units());
  const auto ground = example.over(store);
  constexpr std::size_t beams = 90;
  constexpr double height_m = 60.0;
  LiveSettings settings;
  settings.content = FrameContent::Powers;
  settings.beams = beams;
  settings.beam_step_rad = 2.0 * pi / static_cast<double>(beams);
  settings.ranges = 64;
  settings.range_step_m = 1.0;
  settings.refraction = 1e9;
  std::vector<float> whole;
  for (const std::size_t a_step : {beams, 11UL, 3UL}) {
    LiveRenderer renderer(ground, settings);
    std::vector<float> powers;
    for (double aside = 0.0; aside < 8.0; aside += 0.7) {
      const Pose pose{.position = {example.middle().x + aside, example.middle().y + 0.3 * aside, height_m},
                      .first_range_m = height_m - 2.0};
      settled_frame(renderer, *ground, pose);
      const Frame* frame = nullptr;
      for (std::size_t beam = 0; beam < beams; beam += a_step) frame = &renderer.scan(pose, beam, a_step);
      powers.insert(powers.end(), frame->powers_m2.begin(), frame->powers_m2.end());
    }
    if (whole.empty()) whole = powers;
    EXPECT_TRUE(powers == whole) << a_step;
  }
}

TEST(LiveLookUp, BlendsTwoBakedFrequenciesByTheLogarithm) {
  const ScratchFolder folder;
  ExampleGround example = wavy_ground();
  constexpr double low_hz = 4e9, high_hz = 16e9, between_hz = 7e9;
  example.frequencies_hz = {low_hz, high_hz};
  // Unlike each other: waves in one direction, and four times the power with waves in the other.
  example.pattern = [](const radar::Look& look, Vec2d from_middle) {
    return look.frequency_hz < 10e9 ? waves(from_middle.x) : 4.0F * waves(from_middle.y);
  };
  const atlas::Store store = example.store(folder.path("atlas"));
  atlas::Pyramid(store).make_above(store.units());
  expect_the_offline_look_up(example, store, between_hz);

  // The offline one against paper: the middle of a texel, at a baked aspect.
  const Vec2d from_middle{2.0 + 4.0 * 11.0, 2.0 + 4.0 * 29.0};
  const double high_part = std::log(between_hz / low_hz) / std::log(high_hz / low_hz);
  const radar::Aspect aspect{radians_from_deg(90.0), radians_from_deg(13.0)};
  const double expected = example_gamma * std::sin(aspect.elevation_rad) *
                          ((1.0 - high_part) * static_cast<double>(waves(from_middle.x)) +
                           high_part * 4.0 * static_cast<double>(waves(from_middle.y)));
  const radar::Channels sigma0 =
      atlas::load_atlas(store).sigma0_at(example.middle() + from_middle, aspect, between_hz, 0.0);
  EXPECT_NEAR(static_cast<double>(sigma0.vv), expected, 1e-3 * expected);
}

}  // namespace
}  // namespace sigmascape::live
