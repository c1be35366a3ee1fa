#include "sigmascape/simulate/live_tracer.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numeric>
#include <vector>

#include "peak_memory.h"
#include "physics/level_scene.h"
#include "unit/live/frame_numbers.h"
#include "unit/simulate/street_scene.h"

#include "sigmascape/base/error.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::simulate {
namespace {

using live::FrameContent;
using physics_test::lambert;

constexpr double slant_range_m = 20e3;
const double elevation_rad = radians_from_deg(30.0);

/// Bins of so many metres of ground about the origin, seen from the south.
struct Bins {
  std::size_t count = 24;
  double bin_m = 2.0;

  [[nodiscard]] live::LiveSettings settings(FrameContent content) const {
    live::LiveSettings settings;
    settings.content = content;
    settings.beams = settings.ranges = count;
    settings.range_step_m = bin_m * std::cos(elevation_rad);
    settings.beam_step_rad = bin_m / (slant_range_m * std::cos(elevation_rad));
    settings.refraction = 1e9;
    settings.threads = 2;
    return settings;
  }
  [[nodiscard]] live::Pose pose() const {
    const auto bins = settings(FrameContent::Powers);
    const double half = 0.5 * static_cast<double>(count);
    live::Pose pose;
    pose.position = radar::position_seeing({}, pi, elevation_rad, slant_range_m);
    pose.first_azimuth_rad = -half * bins.beam_step_rad;
    pose.first_range_m = slant_range_m - half * bins.range_step_m;
    return pose;
  }
};

class LiveTracerTest : public testing::Test {
 protected:
  [[nodiscard]] LiveTracer tracer(const live::LiveSettings& settings, std::uint32_t rays = 8) const {
    return {scene_, geometry_, settings, {.rays_per_cell = rays, .lattice_m = 1.0}};
  }
  [[nodiscard]] LiveTracer tracer(FrameContent content, std::uint32_t rays = 8) const {
    return tracer(bins_.settings(content), rays);
  }

  scene::Scene scene_ = street_scene();
  trace::SceneGeometry geometry_{scene_, trace::Footing::Terrain};
  Bins bins_;
};

double copolar_total(std::span<const float> powers_m2) {
  double sum = 0.0;
  for (std::size_t i = 0; i < powers_m2.size(); i += 4) sum += static_cast<double>(powers_m2[i] + powers_m2[i + 1]);
  return sum;
}

double sum_of_bin(std::span<const float> powers_m2, std::size_t bin) {
  return static_cast<double>(powers_m2[4 * bin] + powers_m2[4 * bin + 1] + 2.0F * powers_m2[4 * bin + 2]);
}

TEST_F(LiveTracerTest, HoldsThePowerOfTheMapInTheSameBins) {
  radar::Radar radar;
  radar.frequency_hz = 10e9;
  radar.position = bins_.pose().position;
  radar.range_resolution_m = 2.0;
  radar.beam_width_rad = std::sqrt(2.0) * 2.0 / slant_range_m;
  trace::TraceCounts counts;
  const auto map = traced_image(scene_, geometry_, radar, {-60.0, -60.0, 60.0, 60.0},
                                {.cell_m = 2.0, .samples_per_cell = 128, .threads = 2}, counts);
  // Bins of the map about its middle, three by three blocks of them.
  constexpr std::size_t block = 16, count = 3 * block;
  const std::size_t first_beam = (map.grid.azimuths - count) / 2, first_range = (map.grid.ranges - count) / 2;
  live::LiveSettings settings = bins_.settings(FrameContent::Powers);
  settings.beams = settings.ranges = count;
  settings.beam_step_rad = map.grid.azimuth_step_rad;
  settings.range_step_m = map.grid.range_step_m;
  live::Pose pose = bins_.pose();
  pose.first_azimuth_rad = map.grid.first_azimuth_rad + static_cast<double>(first_beam) * settings.beam_step_rad;
  pose.first_range_m = map.grid.first_range_m + static_cast<double>(first_range) * settings.range_step_m;
  LiveTracer live = tracer(settings, 32);
  const live::Frame& frame = live.render(pose);

  double of_map = 0.0, of_frame = 0.0;
  for (std::size_t b = 0; b < 9; ++b) {
    double map_block = 0.0, frame_block = 0.0;
    for (std::size_t i = 0; i < block * block; ++i) {
      const std::size_t beam = b / 3 * block + i / block, range = b % 3 * block + i % block;
      map_block +=
          static_cast<double>(map.rcs_m2(first_beam + beam, first_range + range).power(radar::Polarization::Sum));
      frame_block += sum_of_bin(frame.powers_m2, beam * count + range);
    }
    // Pulse and beam carry some of the houses at its edges from block to block.
    EXPECT_NEAR(10.0 * std::log10(frame_block / map_block), 0.0, 0.4) << "block " << b;
    of_map += map_block;
    of_frame += frame_block;
  }
  EXPECT_NEAR(10.0 * std::log10(of_frame / of_map), 0.0, 0.05);
}

TEST_F(LiveTracerTest, AmplitudesHaveThePowersForTheirMean) {
  constexpr std::uint64_t frames = 100;
  live::LiveSettings settings = bins_.settings(FrameContent::Powers);
  LiveTracer powers = tracer(settings, 256);
  const live::Frame& expected = powers.render(bins_.pose());
  settings.content = FrameContent::Amplitudes;
  std::vector<double> mean(settings.beams * settings.ranges);
  for (std::uint64_t seed = 1; seed <= frames; ++seed) {
    settings.seed = seed;
    LiveTracer live = tracer(settings, 4);
    const auto amplitudes = live.render(bins_.pose()).amplitudes_m;
    for (std::size_t bin = 0; bin < mean.size(); ++bin) {
      for (std::size_t p = 0; p < 4; ++p)
        mean[bin] += static_cast<double>(std::norm(amplitudes[4 * bin + p])) / static_cast<double>(frames);
    }
  }
  double ratios = 0.0, squares = 0.0, of_mean = 0.0, of_expected = 0.0;
  std::size_t bins = 0;
  for (std::size_t bin = 0; bin < mean.size(); ++bin) {
    const double power = sum_of_bin(expected.powers_m2, bin);
    of_mean += mean[bin];
    of_expected += power;
    // Of bins nearly all in shadow little is left but what their neighbours share with them.
    if (power < 0.05 * copolar_total(expected.powers_m2) / static_cast<double>(mean.size())) continue;
    const double ratio = mean[bin] / power;
    ratios += ratio - 1.0;
    squares += (ratio - 1.0) * (ratio - 1.0);
    ++bins;
  }
  ASSERT_GT(bins, 400U);
  EXPECT_NEAR(of_mean / of_expected, 1.0, 0.02);
  EXPECT_NEAR(ratios / static_cast<double>(bins), 0.0, 0.03);
  // Of the mean of so many exponentials the deviation is their root's part; noise of the rays adds a little.
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(bins)) * std::sqrt(static_cast<double>(frames)), 1.0, 0.25);
}

TEST_F(LiveTracerTest, AmplitudesOfWhatLaysOverTheEdgeOfTheSceneStandAtItsRange) {
  scene::Scene scene = physics_test::level_scene(lambert("ground", 0.5), 64.0);
  physics_test::add_wall(scene, lambert("wall", 0.5), 60.0F, 15.0F, pi);
  scene.instances[0].y_m = -31.0F;
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  const Bins bins{.count = 48, .bin_m = 2.0};
  const LiveTraceSettings tracing{.rays_per_cell = 16, .lattice_m = 1.0};
  std::vector<double> powers(bins.count), amplitudes(bins.count);
  live::LiveSettings settings = bins.settings(FrameContent::Powers);
  LiveTracer live(scene, geometry, settings, tracing);
  const live::Frame& frame = live.render(bins.pose());
  for (std::size_t bin = 0; bin < bins.count * bins.count; ++bin)
    powers[bin % bins.count] += static_cast<double>(frame.powers_m2[4 * bin]);
  constexpr std::uint64_t frames = 10;
  settings.content = FrameContent::Amplitudes;
  for (settings.seed = 1; settings.seed <= frames; ++settings.seed) {
    LiveTracer other(scene, geometry, settings, tracing);
    const auto iq = other.render(bins.pose()).amplitudes_m;
    for (std::size_t bin = 0; bin < bins.count * bins.count; ++bin)
      amplitudes[bin % bins.count] += static_cast<double>(std::norm(iq[4 * bin])) / static_cast<double>(frames);
  }
  const double brightest = *std::ranges::max_element(powers);
  for (std::size_t range = 0; range < bins.count; ++range) {
    // The mean of ten times some thirty exponentials is good to 6 %; where power begins or ends, cells blur.
    EXPECT_NEAR(amplitudes[range], powers[range], 0.25 * powers[range] + 0.03 * brightest) << "range " << range;
  }
}

TEST_F(LiveTracerTest, ThreadsAndCallsDoNotMatter) {
  for (const FrameContent content : {FrameContent::Powers, FrameContent::Amplitudes}) {
    live::LiveSettings settings = bins_.settings(content);
    settings.threads = 1;
    LiveTracer at_once = tracer(settings, 12);
    const live::Frame& whole = at_once.render(bins_.pose());
    settings.threads = 2;
    LiveTracer in_three = tracer(settings, 4);
    for (int call = 0; call < 2; ++call) in_three.render(bins_.pose());
    const live::Frame& pieces = in_three.render(bins_.pose());
    EXPECT_TRUE(std::ranges::equal(whole.powers_m2, pieces.powers_m2));
    EXPECT_TRUE(std::ranges::equal(whole.amplitudes_m, pieces.amplitudes_m));
    EXPECT_EQ(pieces.report.rays_per_cell, 12U);
    EXPECT_EQ(whole.report.median_error_db, pieces.report.median_error_db);
    EXPECT_EQ(whole.report.lit, pieces.report.lit);
  }
}

radar::Target target_at(Vec3d position, float rcs_m2, Vec3d size_m = {}) {
  radar::Target target;
  target.track = radar::Track::straight(position);
  target.rcs_m2 = radar::Channels{rcs_m2, rcs_m2, 0.0F, rcs_m2};
  target.size_m = size_m;
  return target;
}

/// A turn of the antenna by so many beams a step.
std::vector<float> swept(LiveTracer& tracer, const live::Pose& pose, std::size_t beams, std::size_t a_step) {
  const live::Frame* frame = nullptr;
  for (std::size_t beam = 0; beam < beams; beam += a_step) frame = &tracer.scan(pose, beam, a_step);
  return numbers_of(*frame);
}

TEST_F(LiveTracerTest, AScanFillsTheFrameBeamByBeam) {
  const std::vector<radar::Target> targets{target_at({0.0, -16.0, 9.0}, 100.0F),
                                           target_at({9.0, 5.0, 12.0}, 1.0F, {9, 9, 9})};
  live::Pose pose = bins_.pose();
  pose.targets = targets;
  for (const FrameContent content : {FrameContent::Powers, FrameContent::Amplitudes}) {
    for (const std::size_t a_step : {std::size_t{5}, std::size_t{8}, bins_.count}) {
      live::LiveSettings settings = bins_.settings(content);
      // What comes straight back: houses with their layover and shadows.
      const LiveTraceSettings straight{.rays_per_cell = 4, .max_bounces = 1, .lattice_m = 1.0};
      LiveTracer at_once(scene_, geometry_, settings, straight);
      settings.threads = a_step == 5 ? 1 : 3;
      LiveTracer scanning(scene_, geometry_, settings, straight);
      for (int turn = 0; turn < 2; ++turn) {
        const std::vector<float> whole = numbers_of(at_once.render(pose));
        EXPECT_TRUE(swept(scanning, pose, bins_.count, a_step) == whole) << a_step << " a step, turn " << turn;
      }
    }
  }
}

TEST_F(LiveTracerTest, AScanAllRoundHasNoSeamEither) {
  live::LiveSettings settings = bins_.settings(FrameContent::Amplitudes);
  settings.beams = 30;
  settings.ranges = 10;
  settings.beam_step_rad = 2.0 * pi / 30.0;
  settings.range_step_m = 2.0;
  live::Pose pose;
  pose.position = {0.0, 0.0, 60.0};
  pose.first_azimuth_rad = 0.3;
  // From the roofs below the radar on, where a cell reaches over several beams.
  pose.first_range_m = 53.0;
  for (const FrameContent content : {FrameContent::Powers, FrameContent::Amplitudes}) {
    settings.content = content;
    const LiveTraceSettings straight{.rays_per_cell = 4, .max_bounces = 1, .lattice_m = 1.0};
    LiveTracer at_once(scene_, geometry_, settings, straight), scanning(scene_, geometry_, settings, straight);
    const std::vector<float> whole = numbers_of(at_once.render(pose));
    EXPECT_TRUE(swept(scanning, pose, settings.beams, 7) == whole);
  }
}

TEST_F(LiveTracerTest, AScanHasThePowerOfTheFrameWhateverTheBounces) {
  LiveTracer at_once = tracer(FrameContent::Powers, 256), scanning = tracer(FrameContent::Powers, 256);
  const live::Frame& frame = at_once.render(bins_.pose());
  const std::vector<float> steps = swept(scanning, bins_.pose(), bins_.count, 4);
  // Steps of 8 m lack what begins more than 16 m beside them.
  EXPECT_NEAR(10.0 * std::log10(copolar_total(steps) / copolar_total(frame.powers_m2)), 0.0, 0.02);
  std::vector<double> differences;
  for (std::size_t bin = 0; bin < bins_.count * bins_.count; ++bin) {
    const double whole = sum_of_bin(frame.powers_m2, bin);
    if (whole > 0.0) differences.push_back(std::abs(sum_of_bin(steps, bin) / whole - 1.0));
  }
  std::ranges::sort(differences);
  // What the rays leave open in each of the two.
  const double error = std::pow(10.0, 0.1 * frame.report.median_error_db) - 1.0;
  EXPECT_LT(differences[differences.size() / 2], error);
}

TEST_F(LiveTracerTest, AStepOfAScanLeavesTheOtherBeams) {
  LiveTracer live = tracer(FrameContent::Powers, 2);
  const std::vector<float> before = numbers_of(live.render(bins_.pose()));
  const std::size_t a_beam = 4 * bins_.count;
  live::Pose moved = bins_.pose();
  moved.position.x += 3.0;
  const live::Frame& frame = live.scan(moved, 6, 5);
  const std::vector<float> after = numbers_of(frame);
  for (std::size_t beam = 0; beam < bins_.count; ++beam) {
    const auto first = static_cast<std::ptrdiff_t>(beam * a_beam), end = first + static_cast<std::ptrdiff_t>(a_beam);
    const bool alike = std::equal(before.begin() + first, before.begin() + end, after.begin() + first);
    EXPECT_EQ(alike, beam < 6 || beam >= 11) << beam;
  }
  LiveTracer whole = tracer(FrameContent::Powers, 2);
  EXPECT_LT(frame.report.cells, whole.render(moved).report.cells) << "only ground under and beside the beams";
  EXPECT_THROW(live.scan(moved, bins_.count + 3, 4), Error) << "no beam";
  EXPECT_THROW(live.scan(moved, 0, 0), Error);
}

TEST_F(LiveTracerTest, StepsThatComeAgainAddRays) {
  LiveTracer live = tracer(FrameContent::Powers, 4);
  const live::Pose pose = bins_.pose();
  EXPECT_EQ(live.scan(pose, 0, 8).report.rays_per_cell, 4U);
  EXPECT_EQ(live.scan(pose, 8, 8).report.rays_per_cell, 4U);
  EXPECT_EQ(live.scan(pose, 0, 8).report.rays_per_cell, 8U) << "another step in between";
  EXPECT_EQ(live.scan(pose, 4, 8).report.rays_per_cell, 4U) << "it overlaps with both";
  EXPECT_EQ(live.scan(pose, 0, 8).report.rays_per_cell, 4U);
}

// Ground of all beams together is one area; of beams each by itself it overlaps, and takes several times as much.
TEST_F(LiveTracerTest, OfManyStepsTheOldestAreForgotten) {
  const auto rays_of_second_turn = [&](double most_cells) {
    LiveTracer live(scene_, geometry_, bins_.settings(FrameContent::Powers),
                    {.rays_per_cell = 2, .lattice_m = 1.0, .most_cells = most_cells});
    std::vector<std::uint64_t> rays;
    for (int turn = 0; turn < 2; ++turn) {
      rays.clear();
      for (std::size_t beam = 0; beam < bins_.count; ++beam)
        rays.push_back(live.scan(bins_.pose(), beam, 1).report.rays_per_cell);
    }
    return rays;
  };
  EXPECT_THAT(rays_of_second_turn(1e9), testing::Each(4U));
  double fewest = 1.0;
  for (bool is_refused = true; is_refused; fewest *= 2.0) {
    LiveTracer live(scene_, geometry_, bins_.settings(FrameContent::Powers), {.lattice_m = 1.0, .most_cells = fewest});
    try {
      live.render(bins_.pose());
      is_refused = false;
    } catch (const Error&) {
    }
  }
  EXPECT_THAT(rays_of_second_turn(fewest / 2.0), testing::Each(2U));
}

TEST_F(LiveTracerTest, ScatterersStayWhileRaysAreAdded) {
  LiveTracer live = tracer(FrameContent::Amplitudes, 8);
  const auto first = live.render(bins_.pose()).amplitudes_m;
  const std::vector<std::complex<float>> before(first.begin(), first.end());
  for (int call = 0; call < 8; ++call) live.render(bins_.pose());
  const auto after = live.render(bins_.pose()).amplitudes_m;
  std::complex<double> cross;
  double aa = 0.0, bb = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const std::complex<double> a(before[i]), b(after[i]);
    cross += a * std::conj(b);
    aa += std::norm(a);
    bb += std::norm(b);
  }
  EXPECT_GT(cross.real() / std::sqrt(aa * bb), 0.9);
}

// All scatterers change with the level of the lattice, which the width of the beams asks for.
TEST_F(LiveTracerTest, APoseToAndFroKeepsItsScatterers) {
  const auto pose_at = [&](double times) {
    const auto bins = bins_.settings(FrameContent::Powers);
    live::Pose pose = bins_.pose();
    pose.position = radar::position_seeing({}, pi, elevation_rad, times * slant_range_m);
    pose.first_range_m = times * slant_range_m - 0.5 * static_cast<double>(bins_.count) * bins.range_step_m;
    return pose;
  };
  live::LiveSettings settings = bins_.settings(FrameContent::Powers);
  settings.range_step_m *= 3.0;
  settings.beam_step_rad *= 2.0;
  const auto cells_at = [&](LiveTracer& live, double times) {
    return static_cast<double>(live.render(pose_at(times)).report.cells);
  };
  const auto cells_alone = [&](double times) {
    LiveTracer fresh = tracer(settings);
    return cells_at(fresh, times);
  };
  double times = 0.9;
  while (times < 1.2 && cells_alone(times + 0.02) > 0.5 * cells_alone(times)) times += 0.02;
  ASSERT_LT(times, 1.2) << "no level changes on the way";
  LiveTracer live = tracer(settings);
  const double coarse = cells_at(live, times + 0.02), fine = cells_alone(times);
  EXPECT_LT(coarse, 0.6 * fine);
  EXPECT_LT(cells_at(live, times), 0.6 * fine) << "a little to";
  EXPECT_LT(cells_at(live, times + 0.02), 0.6 * fine) << "and fro";
  EXPECT_GT(cells_at(live, 0.75 * times), 0.9 * cells_alone(0.75 * times)) << "but not for ever";
}

TEST_F(LiveTracerTest, TheErrorIsWhatTwoFramesDifferByAndFallsAsRaysAreAdded) {
  live::LiveSettings settings = bins_.settings(FrameContent::Powers);
  LiveTracer one = tracer(settings, 16);
  const double early_db = one.render(bins_.pose()).report.median_error_db;
  for (int call = 0; call < 14; ++call) one.render(bins_.pose());
  const live::Frame& a = one.render(bins_.pose());
  const auto relative = [](double db) { return std::pow(10.0, db / 10.0) - 1.0; };
  const double error = relative(a.report.median_error_db);
  EXPECT_NEAR(relative(early_db) / error, 4.0, 1.0);

  settings.seed = 2;
  LiveTracer other = tracer(settings, 256);
  const live::Frame& b = other.render(bins_.pose());
  std::vector<double> differences;
  for (std::size_t bin = 0; bin < settings.beams * settings.ranges; ++bin) {
    const double p = sum_of_bin(a.powers_m2, bin), q = sum_of_bin(b.powers_m2, bin);
    if (p > 0.0 && q > 0.0) differences.push_back(std::abs(p - q) / (0.5 * (p + q)));
  }
  std::ranges::sort(differences);
  // Half of normal deviations are below 0.674 standard errors, and both frames have some.
  EXPECT_NEAR(differences[differences.size() / 2] / (0.674 * std::sqrt(2.0) * error), 1.0, 0.2);
}

TEST_F(LiveTracerTest, OnePassTellsNothingOfItsError) {
  LiveTracer live = tracer(FrameContent::Powers, 2);
  EXPECT_TRUE(std::isinf(live.render(bins_.pose()).report.median_error_db));
  EXPECT_TRUE(std::isfinite(live.render(bins_.pose()).report.median_error_db));
}

TEST_F(LiveTracerTest, TargetsAnswerWhereTheSceneLetsThemBeSeen) {
  LiveTracer live = tracer(FrameContent::Powers, 2);
  live::Pose pose = bins_.pose();
  const double bare = copolar_total(live.render(pose).powers_m2);
  LiveTracer other = tracer(FrameContent::Powers, 2);
  // North of a house, below its eaves: hidden from the south. And above its roof.
  for (const double height_m : {1.0, 8.0}) {
    const std::vector<radar::Target> targets{target_at({0.0, 3.5, height_m}, 1e4F)};
    pose.targets = targets;
    LiveTracer with = tracer(FrameContent::Powers, 2);
    const live::Frame& frame = with.render(pose);
    const bool is_seen = height_m > 7.0;
    EXPECT_EQ(frame.report.targets, is_seen ? 1U : 0U);
    EXPECT_NEAR(copolar_total(frame.powers_m2) - bare, is_seen ? 2e4 : 0.0, 1.0);
  }
}

TEST_F(LiveTracerTest, WhatStandsBehindTheBoxOfATargetIsDark) {
  scene::Scene plane = physics_test::level_scene(lambert("ground", 0.5), 256.0);
  const trace::SceneGeometry geometry(plane, trace::Footing::Terrain);
  for (const FrameContent content : {FrameContent::Powers, FrameContent::Amplitudes}) {
    LiveTracer live(plane, geometry, bins_.settings(content), {.rays_per_cell = 8});
    live::Pose pose = bins_.pose();
    // 10 m long, wide and high: its shadow reaches 17 m north of its northern side.
    const std::vector<radar::Target> box{target_at({0.0, -5.0, 5.0}, 1e-6F, {10.0, 10.0, 10.0})};
    pose.targets = box;
    const live::Frame& frame = live.render(pose);
    const auto power_of = [&](std::size_t beam, std::size_t range) {
      const std::size_t bin = beam * bins_.count + range;
      return content == FrameContent::Powers ? static_cast<double>(frame.powers_m2[4 * bin])
                                             : static_cast<double>(std::norm(frame.amplitudes_m[4 * bin]));
    };
    // Bins are 2 m: those from 4 to 12 m north, within 3 m of the middle, and the same far to the left.
    double hidden = 0.0, open = 0.0;
    for (std::size_t range = 14; range < 18; ++range) {
      for (std::size_t beam = 10; beam < 14; ++beam) {
        hidden += power_of(beam, range);
        open += power_of(beam - 9, range);
      }
    }
    EXPECT_LT(hidden, 1e-5 * open);
    EXPECT_GT(open, 0.0);
  }
}

TEST_F(LiveTracerTest, BeginsAnewWhenSomethingElseIsToBeSeen) {
  LiveTracer live = tracer(FrameContent::Powers, 2);
  live::Pose pose = bins_.pose();
  std::vector<radar::Target> targets{target_at({0.0, 0.0, 20.0}, 1.0F), target_at({0.0, 30.0, 2.0}, 1.0F, {4, 2, 2})};
  targets[0].track = radar::Track::straight({0.0, 0.0, 20.0}, {10.0, 0.0, 0.0});
  pose.targets = targets;
  live.render(pose);
  pose.moment.time_s = 1.0;
  EXPECT_EQ(live.render(pose).report.rays_per_cell, 4U) << "a point moves, and hides nothing";
  targets[1].track = radar::Track::straight({0.0, 30.0, 2.0}, {10.0, 0.0, 0.0});
  EXPECT_EQ(live.render(pose).report.rays_per_cell, 2U) << "a box has moved";
  EXPECT_EQ(live.render(pose).report.rays_per_cell, 4U);
  pose.position.x += 0.1;
  EXPECT_EQ(live.render(pose).report.rays_per_cell, 2U) << "the radar has moved";
  pose.first_range_m += 1.0;
  EXPECT_EQ(live.render(pose).report.rays_per_cell, 2U) << "the bins have moved";
}

/// Middle of the power in range, by the radar's own reckoning of its bins.
double mean_range_m(const live::Frame& frame) {
  double power = 0.0, moment = 0.0;
  for (std::size_t bin = 0; bin < frame.powers_m2.size() / 4; ++bin) {
    const double range_m =
        frame.grid.first_range_m + (static_cast<double>(bin % frame.grid.ranges) + 0.5) * frame.grid.range_step_m;
    power += static_cast<double>(frame.powers_m2[4 * bin]);
    moment += static_cast<double>(frame.powers_m2[4 * bin]) * range_m;
  }
  return moment / power;
}

TEST_F(LiveTracerTest, RangesAreThoseOfACurvedEarth) {
  scene::Scene dark = physics_test::level_scene(lambert("dark", 1e-9), 256.0);
  const scene::MaterialIndex bright = dark.material_index(lambert("bright", 0.9));
  dark.ground = {{-128.0, 128.0, 16.0, 16, 16}, Array2D<scene::MaterialIndex>(16, 16, 0)};
  // A square of 16 m whose middle lies 40 m east and 24 m north.
  dark.ground.material(10, 6) = bright;
  const trace::SceneGeometry geometry(dark, trace::Footing::Terrain);
  Bins bins{.count = 100, .bin_m = 2.0};
  const Vec2d middle{40.0, 24.0};
  for (const double refraction : {4.0 / 3.0, 1e9}) {
    live::LiveSettings settings = bins.settings(FrameContent::Powers);
    settings.refraction = refraction;
    LiveTracer live(dark, geometry, settings, {.rays_per_cell = 8});
    const live::Pose pose = bins.pose();
    const radar::CurvedEarth earth{.refraction = refraction};
    const double distance_m = std::hypot(middle.x - pose.position.x, middle.y - pose.position.y);
    EXPECT_NEAR(mean_range_m(live.render(pose)), earth.slant_range_m(pose.position.z, 0.0, distance_m), 0.1);
  }
}

TEST_F(LiveTracerTest, AllRoundThereIsNoSeam) {
  scene::Scene plane = physics_test::level_scene(lambert("ground", 0.5), 256.0);
  const trace::SceneGeometry geometry(plane, trace::Footing::Terrain);
  live::LiveSettings settings;
  settings.beams = 30;
  settings.ranges = 4;
  settings.beam_step_rad = 2.0 * pi / 30.0;
  settings.range_step_m = 2.0;
  settings.threads = 2;
  live::Pose pose;
  pose.position = {0.0, 0.0, 300.0};
  pose.first_azimuth_rad = 0.3;
  pose.first_range_m = 310.0;
  for (const FrameContent content : {FrameContent::Powers, FrameContent::Amplitudes}) {
    settings.content = content;
    std::vector<double> of_beam(settings.beams);
    const std::uint64_t frames = content == FrameContent::Powers ? 1 : 60;
    for (settings.seed = 1; settings.seed <= frames; ++settings.seed) {
      LiveTracer live(plane, geometry, settings, {.rays_per_cell = 4, .lattice_m = 1.0});
      const live::Frame& frame = live.render(pose);
      for (std::size_t bin = 0; bin < settings.beams * settings.ranges; ++bin) {
        of_beam[bin / settings.ranges] += content == FrameContent::Powers
                                              ? static_cast<double>(frame.powers_m2[4 * bin])
                                              : static_cast<double>(std::norm(frame.amplitudes_m[4 * bin]));
      }
    }
    const double mean = std::accumulate(of_beam.begin(), of_beam.end(), 0.0) / static_cast<double>(settings.beams);
    for (const std::size_t beam : {std::size_t{0}, settings.beams - 1}) {
      // Without what comes from across the seam an eighth would be missing.
      EXPECT_NEAR(of_beam[beam] / mean, 1.0, content == FrameContent::Powers ? 0.02 : 0.25) << "beam " << beam;
    }
  }
}

/// Half a bin of slant range is 90 m of ground here: 87° below the horizon.
TEST(LiveTracerOverLevelGround, ABinHasItsPowerBeItTheFirstTheLastOrBetween) {
  const auto scene = physics_test::level_scene(lambert("ground", 0.1), 1200.0);
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  constexpr double bin_m = 6.0, first_m = 10'003.0;
  // Of the bin that begins at `first_m`, in a frame of others before and beyond it.
  const auto power_with = [&](int before, int beyond) {
    const live::LiveSettings settings{.content = FrameContent::Powers,
                                      .beams = 10,
                                      .ranges = static_cast<std::size_t>(before + 1 + beyond),
                                      .beam_step_rad = 0.02,
                                      .range_step_m = bin_m,
                                      .threads = 2,
                                      .refraction = 1e9};
    LiveTracer tracer(scene, geometry, settings, {.rays_per_cell = 8, .max_bounces = 1, .lattice_m = 4.0});
    const live::Frame& frame =
        tracer.render({.position = {0.0, 0.0, 10e3}, .first_range_m = first_m - bin_m * static_cast<double>(before)});
    double sum = 0.0;
    for (std::size_t beam = 2; beam + 2 < settings.beams; ++beam)
      sum += sum_of_bin(frame.powers_m2, beam * settings.ranges + static_cast<std::size_t>(before));
    return sum;
  };
  const double between = power_with(1, 1);
  EXPECT_NEAR(power_with(0, 1) / between, 1.0, 0.01) << "first";
  EXPECT_NEAR(power_with(1, 0) / between, 1.0, 0.01) << "last";
}

TEST_F(LiveTracerTest, ASmallAreaIsChosenToBeTracedAndAWideOneIsNot) {
  const LiveTracer live = tracer(FrameContent::Powers);
  const render::DetailQuestion question = live.question(bins_.pose());
  EXPECT_NEAR(question.area_m2, 48.0 * 48.0, 0.02 * 48.0 * 48.0);
  EXPECT_NEAR(question.grazing_rad, elevation_rad, 1e-3);
  EXPECT_NEAR(question.tallest_object_m, 7.0, 1e-6);
  const render::DetailChoice choice = render::choose_detail(question);
  EXPECT_NEAR(choice.cell_m, bins_.bin_m, 0.02);
  EXPECT_EQ(choice.level, 0) << render::explained(choice);
  render::DetailQuestion wide = question;
  wide.area_m2 = 1e8;
  EXPECT_EQ(render::choose_detail(wide).level, 1);
}

TEST_F(LiveTracerTest, BinsBeyondTheSceneAreDark) {
  LiveTracer live = tracer(FrameContent::Amplitudes, 2);
  live::Pose pose = bins_.pose();
  pose.first_range_m += 2000.0;
  const live::Frame& frame = live.render(pose);
  EXPECT_EQ(frame.report.cells, 0U);
  EXPECT_TRUE(std::ranges::all_of(frame.amplitudes_m, [](auto a) { return a == std::complex<float>{}; }));
}

TEST_F(LiveTracerTest, WhatCannotBeTracedIsRefused) {
  EXPECT_THROW(tracer(FrameContent::Powers, 0), Error);
  EXPECT_THROW(LiveTracer(scene_, geometry_, bins_.settings(FrameContent::Powers), {.most_cells = 0.0}), Error);
  const trace::SceneGeometry on_a_plane(scene_, trace::Footing::LevelPlane);
  EXPECT_THROW(LiveTracer(scene_, on_a_plane, bins_.settings(FrameContent::Powers)), Error);
  LiveTracer live = tracer(FrameContent::Powers, 2);
  live::Pose pose = bins_.pose();
  pose.position.z = 1.0;
  pose.first_range_m = -pose.position.y;
  const live::Frame& frame = live.render(bins_.pose());
  const std::vector<float> before(frame.powers_m2.begin(), frame.powers_m2.end());
  EXPECT_THROW(live.render(pose), Error);
  EXPECT_EQ(frame.grid.first_range_m, bins_.pose().first_range_m);
  EXPECT_THAT(frame.powers_m2, testing::ElementsAreArray(before));
  EXPECT_NO_THROW(live::check_holds(frame, "test"));
  EXPECT_GT(copolar_total(live.render(bins_.pose()).powers_m2), 0.0) << "a refused pose leaves a tracer that works";
}

TEST_F(LiveTracerTest, SaysWhatItCanTraceAsItDoes) {
  LiveTracer live = tracer(FrameContent::Powers, 2);
  EXPECT_TRUE(live.can_trace(bins_.pose()));
  EXPECT_NO_THROW(live.render(bins_.pose()));
  // From beside the scene, to either side of where rays begin.
  live::Pose pose = bins_.pose();
  pose.first_range_m = 380.0;
  pose.position = {0.0, -400.0, geometry_.highest_m() + 3.0};
  EXPECT_TRUE(live.can_trace(pose));
  EXPECT_NO_THROW(live.render(pose));
  // Past the highest point rays come down hundreds of kilometres away, or never.
  for (const double above_m : {1.01, 0.99, 0.0, -3.0}) {
    pose.position.z = geometry_.highest_m() + above_m;
    EXPECT_FALSE(live.can_trace(pose)) << above_m;
    EXPECT_THROW(live.render(pose), Error) << above_m;
  }
  LiveTracer few(scene_, geometry_, bins_.settings(FrameContent::Powers), {.lattice_m = 1.0, .most_cells = 10.0});
  EXPECT_FALSE(few.can_trace(bins_.pose()));
  EXPECT_THROW(few.render(bins_.pose()), Error);
  // Bins that see nothing of the scene are dark from anywhere.
  live::Pose away = bins_.pose();
  away.position = {0.0, -80e3, 0.0};
  EXPECT_TRUE(live.can_trace(away));
  EXPECT_NO_THROW(live.render(away));
}

/// A hill of 30 m in the middle of level ground.
scene::Scene hill_scene() {
  scene::Scene scene = physics_test::level_scene(lambert("ground", 0.5), 128.0);
  Array2D<float> heights(17, 17, 0.0F);
  heights(8, 8) = 30.0F;
  scene.terrain = {scene.extent.west_m, scene.extent.north_m, 8.0, std::move(heights)};
  return scene;
}

// From 3 km above the hill its top lays over by √(2 · 3 km · 30 m) = 424 m, and bins that begin above the ground begin
// at the foot of the radar: 16,000 cells of a metre answer, of 10 million that echoes might land on.
TEST_F(LiveTracerTest, AmplitudesTakeMemoryForCellsThatAnswer) {
  if (!memory_is_ours) GTEST_SKIP() << "measures memory";
  const scene::Scene scene = hill_scene();
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  live::LiveSettings settings;
  settings.beams = 1570;
  settings.ranges = 256;
  settings.beam_step_rad = 0.004;
  settings.range_step_m = 2.0;
  settings.threads = 1;
  LiveTracer live(scene, geometry, settings, {.rays_per_cell = 2, .lattice_m = 1.0});
  live::Pose pose;
  pose.position = {0.0, 0.0, 3000.0};
  pose.first_range_m = 2900.0;
  ASSERT_TRUE(live.can_trace(pose));
  const long before_kib = peak_memory_kib();
  live.render(pose);
  // Bins are promised to take 124 bytes each, of which the frame's 32 are there already, and cells 61.
  const double promised = 1570.0 * 256.0 * 92.0 + 128.0 * 128.0 * 61.0;
  EXPECT_LT(1024.0 * static_cast<double>(peak_memory_kib() - before_kib), 2.0 * promised);
}

// Near the foot of the radar cells are wider than beams: those that reach into the outermost lie beside them.
TEST_F(LiveTracerTest, WithSpeckleCellsBesideTheBeamsCount) {
  const scene::Scene plane = physics_test::level_scene(lambert("ground", 0.5), 256.0);
  const trace::SceneGeometry geometry(plane, trace::Footing::Terrain);
  live::LiveSettings settings;
  settings.beams = 4;
  settings.ranges = 16;
  settings.beam_step_rad = 0.05;
  settings.range_step_m = 2.0;
  live::Pose pose;
  pose.position = {0.0, 0.0, 300.0};
  pose.first_range_m = 290.0;
  pose.first_azimuth_rad = -0.1;
  // The rectangle about a sector of 5 and one of 13 beams, of echoes half a beam and half a beam and four beside them.
  const double far_m = std::sqrt(324.0 * 324.0 - 300.0 * 300.0);
  const auto cells = [&](double beams) { return far_m * 2.0 * far_m * std::sin(0.5 * beams * 0.05); };
  const LiveTraceSettings tracing{.rays_per_cell = 2, .lattice_m = 1.0, .most_cells = 0.5 * (cells(5) + cells(13))};
  for (const FrameContent content : {FrameContent::Powers, FrameContent::Amplitudes}) {
    settings.content = content;
    LiveTracer live(plane, geometry, settings, tracing);
    const bool fits = content == FrameContent::Powers;
    EXPECT_EQ(live.can_trace(pose), fits);
    if (fits)
      EXPECT_NO_THROW(live.render(pose));
    else
      EXPECT_THROW(live.render(pose), Error);
  }
}

TEST_F(LiveTracerTest, MoreBouncesThanAnEchoCountsAreRefused) {
  const auto made = [&](int max_bounces) {
    return LiveTracer(scene_, geometry_, bins_.settings(FrameContent::Powers), {.max_bounces = max_bounces});
  };
  EXPECT_NO_THROW(made(255));
  EXPECT_THROW(made(256), Error);
  EXPECT_THROW(made(0), Error);
}

TEST_F(LiveTracerTest, AStepOfAScanCountsTheTargetsThatItsBeamsSee) {
  std::vector<radar::Target> targets(2);
  const double far_m = slant_range_m * std::cos(elevation_rad);
  live::Pose pose = bins_.pose();
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const double azimuth_rad =
        pose.first_azimuth_rad + (i == 0 ? 4.5 : 15.5) * bins_.settings(FrameContent::Powers).beam_step_rad;
    targets[i].track = radar::Track::straight(Vec3d{pose.position.x, pose.position.y, 12.0} +
                                              Vec3d{std::sin(azimuth_rad), std::cos(azimuth_rad), 0.0} * far_m);
    targets[i].rcs_m2 = radar::Channels{1.0F, 1.0F, 0.0F, 1.0F};
  }
  pose.targets = targets;
  LiveTracer live = tracer(FrameContent::Powers, 2);
  EXPECT_EQ(live.render(pose).report.targets, 2U);
  EXPECT_EQ(live.scan(pose, 0, 8).report.targets, 1U);
  EXPECT_EQ(live.scan(pose, 12, 12).report.targets, 1U);
  EXPECT_EQ(live.scan(pose, 8, 4).report.targets, 0U);
}

}  // namespace
}  // namespace sigmascape::simulate
