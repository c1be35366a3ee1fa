#include "sigmascape/receiver/target_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <vector>

#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/window_response.h"

namespace sigmascape::receiver {
namespace {

constexpr double frequency_hz = 10e9;
const TargetFramePose pose{.position = {300.0, -20'000.0, 4000.0},
                           .first_azimuth_rad = -0.05,
                           .first_range_m = 18'000.0,
                           .earth = radar::CurvedEarth::flat()};

/// Of 100 beams by 400 ranges; two bins a resolution cell.
TargetFrameBins bins_of(bool responses) {
  TargetFrameBins bins{
      .frequency_hz = frequency_hz, .beams = 100, .ranges = 400, .beam_step_rad = 1e-3, .range_step_m = 10.0};
  if (!responses) return bins;
  const radar::WindowResponse pulse(radar::Window{});
  const double cells_a_bin = pulse.half_power_width() / 2.0;
  bins.along = PointResponse::of([&](double offset) { return pulse.voltage(offset * cells_a_bin); });
  bins.across = PointResponse::of([](double offset) { return std::exp2(-0.25 * offset * offset); });
  return bins;
}

radar::Target target_at(double azimuth_rad, double range_m, float rcs_m2) {
  const double below_m = 4000.0, distance_m = std::sqrt(range_m * range_m - below_m * below_m);
  radar::Target target;
  target.track = radar::Track::straight(
      pose.position + Vec3d{distance_m * std::sin(azimuth_rad), distance_m * std::cos(azimuth_rad), -below_m});
  target.rcs_m2 = radar::Channels{rcs_m2, 0.5F * rcs_m2, 0.1F * rcs_m2, -0.3F * rcs_m2};
  return target;
}

std::vector<radar::Target> many_targets(std::uint64_t count) {
  std::vector<radar::Target> targets;
  for (std::uint64_t i = 0; i < count; ++i) {
    targets.push_back(target_at(-0.06 + 0.12 * static_cast<double>(unit_float(hashed(i, 1))),
                                17'900.0 + 4200.0 * static_cast<double>(unit_float(hashed(i, 2))), 10.0F));
    targets.back().fluctuation = radar::Swerling::Case1;
    targets.back().seed = i;
  }
  return targets;
}

std::vector<float> powers_of(TargetFrame& frame, const TargetFrameBins& bins) {
  std::vector<float> powers(4 * bins.beams * bins.ranges);
  frame.add_powers(0, bins.beams, powers);
  return powers;
}
std::vector<std::complex<float>> amplitudes_of(TargetFrame& frame, const TargetFrameBins& bins) {
  std::vector<std::complex<float>> amplitudes(4 * bins.beams * bins.ranges);
  frame.add_amplitudes(0, bins.beams, amplitudes);
  return amplitudes;
}

struct Moments {
  double power = 0.0, beam = 0.0, range = 0.0;
};
template <typename PowerOf>
Moments moments_of(const TargetFrameBins& bins, const PowerOf& power_of) {
  Moments sum;
  for (std::size_t beam = 0; beam < bins.beams; ++beam) {
    for (std::size_t range = 0; range < bins.ranges; ++range) {
      const double power = power_of(4 * (beam * bins.ranges + range));
      sum.power += power;
      sum.beam += power * (static_cast<double>(beam) + 0.5);
      sum.range += power * (static_cast<double>(range) + 0.5);
    }
  }
  return {sum.power, sum.beam / sum.power, sum.range / sum.power};
}

class TargetFrameOf : public ::testing::TestWithParam<bool> {};

/// Wherever in a bin a target lies, its cross-section is in the frame, about its place: in power to rounding, in
/// amplitude by the sum of squares.
TEST_P(TargetFrameOf, a_target_keeps_its_cross_section_and_place) {
  const TargetFrameBins bins = bins_of(GetParam());
  TargetFrame frame(bins);
  for (std::uint64_t i = 0; i < 100; ++i) {
    const double beam = 20.0 + 60.0 * static_cast<double>(unit_float(hashed(i, 3)));
    const double range = 20.0 + 300.0 * static_cast<double>(unit_float(hashed(i, 4)));
    const std::vector<radar::Target> targets{target_at(-0.05 + beam * 1e-3, 18'000.0 + range * 10.0, 10.0F)};
    frame.look(targets, pose, {});
    const auto powers = powers_of(frame, bins);
    const Moments of_power = moments_of(bins, [&](std::size_t bin) { return static_cast<double>(powers[bin]); });
    EXPECT_NEAR(of_power.power, 10.0, 1e-5);
    EXPECT_NEAR(of_power.beam, beam, 0.02);
    EXPECT_NEAR(of_power.range, range, 0.02);
    double correlated = 0.0;
    for (std::size_t bin = 0; bin < powers.size(); bin += 4) correlated += static_cast<double>(powers[bin + 3]);
    EXPECT_NEAR(correlated, -3.0, 1e-5);

    const auto amplitudes = amplitudes_of(frame, bins);
    const Moments of_amplitude =
        moments_of(bins, [&](std::size_t bin) { return static_cast<double>(std::norm(amplitudes[bin])); });
    EXPECT_NEAR(of_amplitude.power, 10.0, 1e-4);
    EXPECT_NEAR(of_amplitude.beam, beam, 0.02);
    EXPECT_NEAR(of_amplitude.range, range, 0.02);
  }
}

/// The same bytes for teams of any size and for beams cut in any pieces.
TEST_P(TargetFrameOf, bytes_do_not_depend_on_threads_or_pieces) {
  const TargetFrameBins bins = bins_of(GetParam());
  const auto targets = many_targets(3000);
  TargetFrame frame(bins);
  frame.look(targets, pose, {1.0, 7, 0});
  const auto amplitudes = amplitudes_of(frame, bins);
  const auto powers = powers_of(frame, bins);
  for (const unsigned threads : {2U, 5U}) {
    WorkerTeam team(threads);
    TargetFrame again(bins);
    again.look(targets, pose, {1.0, 7, 0}, {}, &team);
    EXPECT_EQ(again.seen(), frame.seen());
    std::vector<std::complex<float>> pieces(amplitudes.size());
    std::vector<float> power_pieces(powers.size());
    const std::size_t a_piece = 7, count = (bins.beams + a_piece - 1) / a_piece;
    team.run(count, [&](std::size_t index, unsigned) {
      const std::size_t piece = count - 1 - index, first = piece * a_piece;
      const std::size_t beams = std::min(a_piece, bins.beams - first);
      again.add_amplitudes(first, beams, pieces);
      again.add_powers(first, beams, power_pieces);
    });
    EXPECT_EQ(pieces, amplitudes);
    EXPECT_EQ(power_pieces, powers);
  }
}

/// Elevations of a table are those over the target's own horizontal.
TEST_P(TargetFrameOf, a_table_is_read_at_the_grazing_angle_of_the_curved_earth) {
  const TargetFrameBins bins = bins_of(GetParam());
  TargetFrame frame(bins);
  TargetFramePose far = pose;
  far.earth = {};
  far.first_range_m = 98e3;
  radar::RcsTable table;
  table.azimuths_rad = {0.0, pi};
  table.elevations_rad = {0.0, radians_from_deg(10.0)};
  table.frequencies_hz = {frequency_hz};
  const radar::Channels of_ten{10.0F, 10.0F, 0.0F, 10.0F};
  table.rcs_m2 = {{}, {}, of_ten, of_ten};  // as many square metres as degrees
  radar::Target target;
  target.rcs_m2 = table;
  target.track = radar::Track::straight({pose.position.x, pose.position.y + 100e3, 20.0});
  frame.look({&target, 1}, far, {});
  const auto powers = powers_of(frame, bins);
  const Moments seen = moments_of(bins, [&](std::size_t bin) { return static_cast<double>(powers[bin]); });
  EXPECT_NEAR(seen.power, deg_from_radians(std::asin(far.earth.sin_grazing(4000.0, 20.0, 100e3))), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(SharedAndResponse, TargetFrameOf, ::testing::Bool());

/// None of ten thousand is left out for being weak.
TEST(TargetFrame, holds_every_target_within_it) {
  const TargetFrameBins bins = bins_of(false);
  std::vector<radar::Target> targets;
  double all = 0.0;
  for (std::uint64_t i = 0; i < 10'000; ++i) {
    const float rcs = i % 2 == 0 ? 1e-6F : 1.0F;
    targets.push_back(target_at(-0.048 + 0.096 * static_cast<double>(unit_float(hashed(i, 1))),
                                18'020.0 + 3960.0 * static_cast<double>(unit_float(hashed(i, 2))), rcs));
    all += static_cast<double>(rcs);
  }
  TargetFrame frame(bins);
  frame.look(targets, pose, {});
  EXPECT_EQ(frame.seen(), targets.size());
  const auto powers = powers_of(frame, bins);
  const Moments sum = moments_of(bins, [&](std::size_t bin) { return static_cast<double>(powers[bin]); });
  EXPECT_NEAR(sum.power / all, 1.0, 1e-5);
}

/// A frame that goes round has no edge: what lies across its seam is shared between the last and the first beam.
TEST(TargetFrame, closes_all_round) {
  for (const bool responses : {false, true}) {
    TargetFrameBins bins = bins_of(responses);
    bins.beam_step_rad = 2.0 * pi / static_cast<double>(bins.beams);
    TargetFramePose round = pose;
    round.first_azimuth_rad = 0.3;
    TargetFrame frame(bins);
    for (const double beam : {0.1, 99.9, 50.0, 0.5}) {
      const std::vector<radar::Target> targets{target_at(0.3 + beam * bins.beam_step_rad, 19'000.0, 10.0F)};
      frame.look(targets, round, {});
      const auto powers = powers_of(frame, bins);
      const Moments sum = moments_of(bins, [&](std::size_t bin) { return static_cast<double>(powers[bin]); });
      EXPECT_NEAR(sum.power, 10.0, 1e-5) << beam;
    }
  }
}

TEST(TargetFrame, loses_what_is_hidden_and_weakens_what_is_half_seen) {
  const TargetFrameBins bins = bins_of(false);
  const std::vector<radar::Target> targets{target_at(-0.03, 19'000.0, 10.0F), target_at(0.0, 19'000.0, 10.0F),
                                           target_at(0.03, 19'000.0, 10.0F)};
  TargetFrame frame(bins);
  frame.look(targets, pose, {}, [](const TargetFrame::Seen& seen) {
    EXPECT_NEAR(seen.distance_m, std::sqrt(19'000.0 * 19'000.0 - 4000.0 * 4000.0), 1e-6);
    return seen.beam < 40.0 ? 0.0F : seen.beam < 60.0 ? 0.25F : 1.0F;
  });
  EXPECT_EQ(frame.seen(), 2U);
  const auto powers = powers_of(frame, bins);
  const Moments sum = moments_of(bins, [&](std::size_t bin) { return static_cast<double>(powers[bin]); });
  EXPECT_NEAR(sum.power, 12.5, 1e-5);
}

/// A step of an eighth of a wavelength away turns the phase back by a quarter turn, at any range.
TEST(TargetFrame, keeps_the_phase_of_the_way) {
  const TargetFrameBins bins = bins_of(false);
  const double wavelength = wavelength_m(frequency_hz), range_m = 20'003.0;
  TargetFrame frame(bins);
  const auto amplitude_at = [&](double at_m) {
    const std::vector<radar::Target> targets{target_at(0.0005, at_m, 10.0F)};
    frame.look(targets, pose, {});
    std::complex<float> brightest;
    for (const auto& a : amplitudes_of(frame, bins)) {
      if (std::norm(a) > std::norm(brightest)) brightest = a;
    }
    return brightest;
  };
  const std::complex<float> near = amplitude_at(range_m), far = amplitude_at(range_m + wavelength / 8.0);
  EXPECT_NEAR(std::arg(far / near), -pi / 2.0, 1e-2);
  EXPECT_NEAR(
      std::arg(near * std::polar(1.0F, static_cast<float>(std::remainder(4.0 * pi * range_m / wavelength, 2.0 * pi)))),
      0.0, 1e-2);
}

/// What is told apart of a frame: the echoes have together what the bins got, and the bins are what they were.
TEST(TargetFrame, tells_apart_what_it_adds) {
  for (const bool responses : {false, true}) {
    for (const bool round : {false, true}) {
      TargetFrameBins bins = bins_of(responses);
      TargetFramePose from = pose;
      if (round) bins.beam_step_rad = 2.0 * pi / static_cast<double>(bins.beams);
      std::vector<radar::Target> targets = many_targets(500);
      for (std::uint64_t i = 0; round && i < targets.size(); ++i)
        targets[i] = target_at(2.0 * pi * static_cast<double>(unit_float(hashed(i, 1))),
                               18'000.0 + 7.0 * static_cast<double>(i), 10.0F);
      if (round) targets.push_back(target_at(pose.first_azimuth_rad + 0.1 * bins.beam_step_rad, 19'000.0, 10.0F));
      TargetFrame frame(bins);
      frame.look(targets, from, {});
      frame.tell_apart(0, bins.beams);
      std::vector<float> before(4 * bins.beams * bins.ranges);
      for (std::size_t i = 0; i < before.size(); ++i) before[i] = unit_float(hashed(i, 5));
      std::vector<float> powers = before;
      for (std::size_t beam = 0; beam < bins.beams; beam += 20) frame.add_powers(beam, 20, powers);
      double added = 0.0, echoed = 0.0;
      for (std::size_t i = 0; i < powers.size(); i += 4)
        added += static_cast<double>(powers[i]) - static_cast<double>(before[i]);
      std::uint32_t last_beam = 0;
      for (const EchoInBeam& of_beam : frame.apart().echoes) {
        echoed += static_cast<double>(of_beam.echo.rcs_m2.vv);
        EXPECT_GE(of_beam.beam, last_beam);
        last_beam = of_beam.beam;
        EXPECT_NEAR(static_cast<double>(of_beam.echo.sin_depression), 4000.0 / of_beam.echo.range_m, 1e-6);
      }
      EXPECT_GT(added, 1000.0);
      EXPECT_NEAR(echoed / added, 1.0, 1e-5) << responses << round;
      const auto bins_before = frame.apart().bins;
      for (std::size_t i = bins_before.size(); i-- > 0;) {
        const auto& [bin, rcs_m2] = bins_before[i];
        const std::array of_bin{rcs_m2.vv, rcs_m2.hh, rcs_m2.hv, rcs_m2.re_vvhh};
        std::ranges::copy(of_bin, powers.begin() + 4 * static_cast<std::ptrdiff_t>(bin));
      }
      EXPECT_EQ(powers, before);
    }
  }
}

TEST(TargetFrame, keeps_what_other_beams_hold) {
  const TargetFrameBins bins = bins_of(false);
  TargetFrame frame(bins);
  std::vector<float> powers(4 * bins.beams * bins.ranges);
  const auto draw = [&](const std::vector<radar::Target>& targets, std::size_t first, std::size_t count) {
    frame.look(targets, pose, {});
    frame.tell_apart(first, count);
    frame.add_powers(first, count, powers);
    std::vector<std::uint32_t> beams;
    for (const EchoInBeam& of_beam : frame.apart().echoes) beams.push_back(of_beam.beam);
    return beams;
  };
  // In beams 29 and 30 and in 69 and 70.
  const std::vector<radar::Target> one{target_at(-0.02, 19'000.0, 10.0F)}, other{target_at(0.02, 19'000.0, 10.0F)};
  EXPECT_EQ(draw(one, 0, 100), (std::vector<std::uint32_t>{29, 30}));
  EXPECT_EQ(draw(other, 50, 20), (std::vector<std::uint32_t>{29, 30, 69}));
  EXPECT_EQ(draw(other, 20, 10), (std::vector<std::uint32_t>{30, 69}));
  EXPECT_EQ(draw(one, 60, 40), (std::vector<std::uint32_t>{30}));
  EXPECT_EQ(draw({}, 0, 100), std::vector<std::uint32_t>{});
}

/// Ranges are those over the curved Earth: 200 km away on the sea, the point lies 2.4 km below the level plane.
TEST(TargetFrame, follows_the_curved_earth) {
  TargetFrameBins bins = bins_of(false);
  TargetFramePose high{.position = {0.0, 0.0, 10'000.0}, .first_azimuth_rad = -0.05, .first_range_m = 199'000.0};
  radar::Target target;
  target.track = radar::Track::straight({0.0, 200'000.0, 0.0});
  target.rcs_m2 = radar::Channels{1.0F, 1.0F, 0.0F, 1.0F};
  TargetFrame frame(bins);
  frame.look({&target, 1}, high, {});
  const auto powers = powers_of(frame, bins);
  const Moments sum = moments_of(bins, [&](std::size_t bin) { return static_cast<double>(powers[bin]); });
  EXPECT_NEAR(high.first_range_m + sum.range * bins.range_step_m,
              radar::CurvedEarth{}.slant_range_m(10'000.0, 0.0, 200'000.0), 0.5);
  EXPECT_GT(radar::CurvedEarth{}.slant_range_m(10'000.0, 0.0, 200'000.0) - std::hypot(200'000.0, 10'000.0), 100.0);
}

}  // namespace
}  // namespace sigmascape::receiver
