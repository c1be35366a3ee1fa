#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>
#include <ranges>
#include <vector>

#include "drawn_by_hand.h"
#include "level_ground_watts.h"
#include "live_ground_example.h"

#include "sigmascape/base/error.h"
#include "sigmascape/live/frame_image.h"
#include "sigmascape/radar/radar_equation.h"
#include "sigmascape/radar/range_response.h"
#include "sigmascape/receiver/range_azimuth_receiver.h"
#include "sigmascape/receiver/receive_chain.h"
#include "sigmascape/receiver/target_echoes.h"

namespace sigmascape::live {
namespace {

constexpr std::size_t middle_beam = 24, middle_range = 32;

/// Frames of targets over level ground that answers as strongly as asked for, 900 m below the radar and 4 km away, in
/// bins of which the radar tells every other from the next.
class HeardFrame : public testing::Test {
 protected:
  explicit HeardFrame(double gamma = 0.0) {
    ExampleGround example;
    example.azimuths = 1;
    example.elevations_deg = {2.0, 37.0};
    example.sigma0 = [gamma](const radar::Look& look) { return constant_gamma(gamma, look); };
    ground_ = example.over(example.store(folder_.path("atlas")));
    view_.target = example.middle();
    view_.beams = 49;
    view_.ranges = 65;
    view_.azimuth_deg = 180.0;
  }

  [[nodiscard]] LiveSettings settings(FrameContent content = FrameContent::Powers, unsigned threads = 2) const {
    LiveSettings settings = view_.settings(content, threads);
    settings.refraction = 4.0 / 3.0;
    return settings;
  }
  [[nodiscard]] radar::Radar radar() const {
    const LiveSettings bins = settings();
    radar::Radar radar;
    radar.position = view_.pose().position;
    radar.frequency_hz = 10e9;
    radar.range_resolution_m = 2.0 * bins.range_step_m;
    radar.beam_width_rad = 2.0 * bins.beam_step_rad;
    return radar;
  }
  [[nodiscard]] double range_m(double bin) const { return view_.pose().first_range_m + bin * settings().range_step_m; }
  [[nodiscard]] double azimuth_rad(double beam) const {
    return view_.pose().first_azimuth_rad + beam * settings().beam_step_rad;
  }
  /// At a place in bins, so high, over a flat Earth the distance and over the round one found from there.
  [[nodiscard]] radar::Target target(double beam, double range, double height_m, float rcs_m2) const {
    const Vec3d radar = view_.pose().position;
    double distance_m = range_m(range);
    for (int turn = 0; turn < 40; ++turn) {
      const double too_far_m = radar::CurvedEarth{}.slant_range_m(radar.z, height_m, distance_m) - range_m(range);
      distance_m -= too_far_m;
    }
    const Vec2d outwards{std::sin(azimuth_rad(beam)), std::cos(azimuth_rad(beam))};
    radar::Target target;
    target.track =
        radar::Track::straight(Vec3d{radar.x + distance_m * outwards.x, radar.y + distance_m * outwards.y, height_m});
    target.rcs_m2 = radar::Channels{rcs_m2, 0.5F * rcs_m2, 0.1F * rcs_m2, -0.3F * rcs_m2};
    return target;
  }
  /// Of a frame that is drawn anew with those targets.
  [[nodiscard]] radar::RangeAzimuthImage heard(const std::vector<radar::Target>& targets, const radar::Radar& radar,
                                               FrameContent content = FrameContent::Powers, unsigned threads = 2) {
    LiveRenderer renderer(ground_, settings(content, threads));
    Pose pose = view_.pose();
    pose.targets = targets;
    const Frame& frame = settled_frame(renderer, *ground_, pose);
    return image_of(frame, radar, ground_below(frame, *ground_));
  }

  ScratchFolder folder_;
  std::shared_ptr<LiveGround> ground_;
  ExampleView view_;
};

class HeardFrameOverGround : public HeardFrame {
 protected:
  HeardFrameOverGround() : HeardFrame(0.1) {}
};

double db_between(float value, float reference) {
  return db_from_linear(static_cast<double>(value) / static_cast<double>(reference));
}

TEST_F(HeardFrame, ATargetHasTheGainInElevationTowardsItselfHoweverHighItFlies) {
  constexpr double width_deg = 10.0, tilt_deg = -13.0;
  radar::Radar even = radar(), narrow = radar();
  narrow.antenna.elevation = radar::GaussianBeam{};
  narrow.antenna.elevation_width_rad = radians_from_deg(width_deg);
  narrow.antenna.tilt_rad = radians_from_deg(tilt_deg);
  for (const double height_m : {0.0, 100.0, 300.0, 600.0, 850.0}) {
    const std::vector<radar::Target> targets{target(24.5, 32.5, height_m, 1e4F)};
    const Vec3d at = targets.front().track.position_at(0.0), from = view_.pose().position;
    const double rise_m = radar::CurvedEarth{}.bent(at, {from.x, from.y}).z - from.z;
    const double widths = (deg_from_radians(std::asin(rise_m / range_m(32.5))) - tilt_deg) / width_deg;
    // Twice 10 lg exp(−4 ln 2 (φ/θ)²).
    const double expected_db = -80.0 * std::numbers::ln2 * std::numbers::log10e * widths * widths;
    for (const FrameContent content : {FrameContent::Powers, FrameContent::Amplitudes}) {
      const auto weighted = heard(targets, narrow, content), unweighted = heard(targets, even, content);
      EXPECT_NEAR(
          db_between(weighted.rcs_m2(middle_beam, middle_range).vv, unweighted.rcs_m2(middle_beam, middle_range).vv),
          expected_db, 0.02)
          << height_m << " m up";
    }
  }
}

// A radar that states no gate listens from the frame's first range on, in which bins hold half of what is there.
TEST_F(HeardFrame, ATargetJustBeforeTheFirstRangeFadesAsItDoesInTheBins) {
  const auto peak = [&](double range) {
    const std::vector<radar::Target> targets{target(24.5, range, 0.0, 1e4F)};
    const radar::RangeAzimuthImage image = heard(targets, radar());
    return std::ranges::max(image.rcs_m2.values(), {}, &radar::Channels::vv).vv;
  };
  const float within = peak(8.5);
  for (const double before : {0.05, 0.2, 0.4}) {
    const double part = static_cast<double>(peak(-before) / within);
    EXPECT_GT(part, 0.3 * (0.5 - before)) << before;
    EXPECT_LT(part, 0.5) << before;
  }
}

TEST_F(HeardFrame, ATargetHasTheWattsOfTheRadarEquationWhereverInABinItLies) {
  radar::Radar radar = this->radar();
  radar.antenna.gain = 1000.0;
  radar.waveform.peak_power_w = 2000.0;
  const double lambda_m = wavelength_m(radar.frequency_hz);
  for (const auto& [beams_off, ranges_off] : {std::pair{0.0, 0.0}, {0.5, 0.0}, {0.0, 0.5}, {-0.3, 0.4}}) {
    const std::vector<radar::Target> targets{target(24.5 + beams_off, 32.5 + ranges_off, 500.0, 1e6F)};
    const auto watts = receiver::received_power(radar, heard(targets, radar), radar::Polarization::VV);
    // In the middle of its bin, off the target by so much: two bins are the beam's one-way half-power width.
    const double beam = std::exp(-8.0 * std::numbers::ln2 * std::pow(beams_off / 2.0, 2.0));
    const double pulse = radar::RangeResponse::of_width(radar.range_resolution_m, radar.waveform.window)
                             .power(ranges_off * settings().range_step_m);
    const double expected_w = 2000.0 * 1e6 * lambda_m * lambda_m * 1e6 /
                              (std::pow(4.0 * pi, 3.0) * std::pow(range_m(32.5), 4.0)) *
                              radar::compression_gain(radar) * beam * pulse;
    EXPECT_NEAR(db_from_linear(static_cast<double>(watts.signal_w(middle_beam, middle_range)) / expected_w), 0.0, 0.05)
        << beams_off << ", " << ranges_off;
  }
}

/// 2 kW and 30 dB, with bins of so many widths of the pulse and of the two-way beam.
radar::Radar radar_of_widths_a_bin(radar::Radar radar, const LiveSettings& bins, double along, double across) {
  radar.range_resolution_m = bins.range_step_m / along;
  radar.beam_width_rad = std::numbers::sqrt2 * bins.beam_step_rad / across;
  radar.antenna.gain = 1000.0;
  radar.waveform.peak_power_w = 2000.0;
  return radar;
}

constexpr double bins_in_widths[] = {0.5, 1.0, 2.0, 4.0};

TEST_F(HeardFrameOverGround, EvenGroundHasTheWattsOfTheRadarEquationHoweverWideTheBinsAre) {
  const Pose pose = view_.pose();
  LiveRenderer renderer(ground_, settings());
  const Frame& frame = settled_frame(renderer, *ground_, pose);
  const auto below = ground_below(frame, *ground_);
  for (const double along : bins_in_widths) {
    for (const double across : bins_in_widths) {
      const radar::Radar radar = radar_of_widths_a_bin(this->radar(), settings(), along, across);
      const auto watts = receiver::received_power(radar, image_of(frame, radar, below), radar::Polarization::VV);
      double sum_w = 0.0, expected_w = 0.0;
      for (std::size_t range = 20; range + 20 < view_.ranges; ++range) {
        const double r_m = range_m(static_cast<double>(range) + 0.5), sigma0 = 0.1 * pose.position.z / r_m;
        for (std::size_t beam = 10; beam + 10 < view_.beams; ++beam) {
          sum_w += static_cast<double>(watts.signal_w(beam, range));
          expected_w += level_ground_w(radar, r_m, sigma0);
        }
      }
      EXPECT_NEAR(db_from_linear(sum_w / expected_w), 0.0, 0.1) << along << " widths along, " << across << " across";
    }
  }
}

TEST_F(HeardFrame, ATargetHasTheWattsOfTheRadarEquationHoweverWideTheBinsAre) {
  for (const double along : bins_in_widths) {
    for (const double across : bins_in_widths) {
      const radar::Radar radar = radar_of_widths_a_bin(this->radar(), settings(), along, across);
      const std::vector<radar::Target> targets{target(24.5, 32.5, 500.0, 1e6F)};
      const auto watts = receiver::received_power(radar, heard(targets, radar), radar::Polarization::VV);
      const double expected_w = radar::received_power_w(radar, 1e6, range_m(32.5)) * radar::compression_gain(radar);
      EXPECT_NEAR(db_from_linear(static_cast<double>(watts.signal_w(middle_beam, middle_range)) / expected_w), 0.0,
                  0.05)
          << along << " widths along, " << across << " across";
    }
  }
}

TEST_F(HeardFrameOverGround, ARadarOfAnotherFrequencyThanTheGroundIsRefused) {
  LiveRenderer renderer(ground_, settings());
  const Pose pose = view_.pose();
  const Frame& frame = renderer.render(pose);
  radar::Radar radar = this->radar();
  radar.frequency_hz = 3e9;
  try {
    (void)image_of(frame, radar);
    FAIL() << "the ground is of 10 GHz";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("3 GHz"));
    EXPECT_THAT(error.what(), testing::HasSubstr("10 GHz"));
  }
  radar.frequency_hz = 10.05e9;
  EXPECT_NO_THROW((void)image_of(frame, radar));
}

// A frame may reach so far that its ground lies half a beam lower over one Earth than over another.
TEST_F(HeardFrameOverGround, DepressionsAreThoseOfTheFramesOwnEarth) {
  radar::Radar radar = this->radar();
  radar.antenna.elevation = radar::GaussianBeam{};
  radar.antenna.elevation_width_rad = radians_from_deg(2.0);
  radar.antenna.tilt_rad = radians_from_deg(-12.0);
  const Pose pose = view_.pose();
  LiveSettings tight = settings();
  tight.refraction = 0.1;
  LiveRenderer renderer(ground_, tight);
  const Frame& frame = settled_frame(renderer, *ground_, pose);
  const GroundHeight sea = [](Vec2d) { return 0.0; };
  radar::Radar even = radar;
  even.antenna.elevation = radar::EvenBeam{};
  const auto weighted = image_of(frame, radar, sea), unweighted = image_of(frame, even);
  // Law of cosines at the radar, between the middle of the Earth and the ground.
  const double radius_m = 0.1 * radar::CurvedEarth{}.mean_radius_m, r_m = range_m(32.5);
  const double centre_m = radius_m + pose.position.z;
  const double sine = (r_m * r_m + centre_m * centre_m - radius_m * radius_m) / (2.0 * r_m * centre_m);
  const double widths = (12.0 - deg_from_radians(std::asin(sine))) / 2.0;
  EXPECT_NEAR(
      db_between(weighted.rcs_m2(middle_beam, middle_range).vv, unweighted.rcs_m2(middle_beam, middle_range).vv),
      -80.0 * std::numbers::ln2 * std::numbers::log10e * widths * widths, 0.05);
}

TEST_F(HeardFrameOverGround, TargetsTakeNothingFromTheGroundThatTheyStandOnAndAddTheirEchoes) {
  // Several in one bin, such as meet the ground with any phase, and one at the edge of the frame.
  std::vector<radar::Target> targets{target(24.5, 32.5, 0.0, 3.0F), target(24.7, 32.9, 0.0, 1e5F),
                                     target(24.9, 32.1, 300.0, 7.0F), target(10.1, 50.0, 5.0, 40.0F)};
  radar::Radar radar = this->radar();
  radar.antenna.elevation = radar::GaussianBeam{};
  radar.antenna.elevation_width_rad = radians_from_deg(10.0);
  radar.antenna.tilt_rad = radians_from_deg(-13.0);
  for (const FrameContent content : {FrameContent::Powers, FrameContent::Amplitudes}) {
    const auto with = heard(targets, radar, content), without = heard({}, radar, content);
    radar::RangeAzimuthImage alone{with.grid, with.radar_position,
                                   Array2D<radar::Channels>(with.grid.azimuths, with.grid.ranges)};
    std::vector<radar::Echo> echoes = receiver::target_echoes(targets, radar, {});
    const Vec3d from = radar.position;
    for (std::size_t i = 0; i < targets.size(); ++i) {
      const Vec3d at = targets[i].track.position_at(0.0);
      echoes[i].range_m = radar::CurvedEarth{}.slant_range_m(from.z, at.z, std::hypot(at.x - from.x, at.y - from.y));
    }
    receiver::add_echoes(alone, radar, echoes);
    for (std::size_t i = 0; i < with.rcs_m2.size(); ++i) {
      const auto of_ground = static_cast<double>(without.rcs_m2.values()[i].vv);
      const auto of_targets = static_cast<double>(alone.rcs_m2.values()[i].vv);
      // Distance and height of the echoes are good to some millimetres.
      ASSERT_NEAR(static_cast<double>(with.rcs_m2.values()[i].vv), of_ground + of_targets,
                  1e-5 * of_ground + 2e-3 * of_targets)
          << i;
    }
  }
}

TEST_F(HeardFrameOverGround, BytesDoNotDependOnThreads) {
  std::vector<radar::Target> targets;
  for (int i = 0; i < 60; ++i) targets.push_back(target(0.8 * i, 5.0 + 0.37 * i * i / 20.0, 3.0 * i, 10.0F));
  const auto of_one = heard(targets, radar(), FrameContent::Amplitudes, 1);
  const auto of_three = heard(targets, radar(), FrameContent::Amplitudes, 3);
  EXPECT_TRUE(std::ranges::equal(of_one.rcs_m2.values(), of_three.rcs_m2.values()));
}

TEST_F(HeardFrame, ATargetThatTwoStepsOfAScanShareIsHeardAsInOneFrame) {
  // One of which two steps have a part each, and one that the second step alone sees.
  std::vector<radar::Target> targets{target(16.1, 32.5, 500.0, 1e4F), target(30.3, 20.0, 200.0, 1e4F)};
  Pose pose = view_.pose();
  pose.targets = targets;
  LiveRenderer whole(ground_, settings()), scanning(ground_, settings());
  const auto at_once = image_of(settled_frame(whole, *ground_, pose), radar());
  const Frame* swept = &settled_frame(scanning, *ground_, pose);
  for (const std::size_t first : {0U, 16U, 32U, 48U})
    swept = &scanning.scan(pose, first, std::min(49U - first, std::size_t{16}));
  const auto in_steps = image_of(*swept, radar());
  for (std::size_t i = 0; i < at_once.rcs_m2.size(); ++i) {
    const auto expected = static_cast<double>(at_once.rcs_m2.values()[i].vv);
    ASSERT_NEAR(static_cast<double>(in_steps.rcs_m2.values()[i].vv), expected, 1e-5 * expected) << i;
  }
}

TEST_F(HeardFrame, OfAScanEveryBeamHasTheEchoesOfItsOwnStep) {
  // Seen in the first step only; when the others are drawn it stands behind the radar.
  std::vector<radar::Target> targets{target(8.5, 32.5, 500.0, 1e4F)};
  Pose pose = view_.pose();
  pose.targets = targets;
  LiveRenderer renderer(ground_, settings());
  settled_frame(renderer, *ground_, pose);
  const auto peak = [&](const Frame& frame) { return image_of(frame, radar()).rcs_m2(8, middle_range).vv; };
  const float seen = peak(renderer.scan(pose, 0, 16));
  EXPECT_GT(seen, 0.0F);
  pose.targets = {};
  EXPECT_EQ(peak(renderer.scan(pose, 16, 16)), seen);
  EXPECT_EQ(peak(renderer.scan(pose, 0, 16)), 0.0F);
}

/// A bin by itself, as an echo from its middle.
radar::Echo echo_of(const radar::RangeAzimuthGrid& grid, std::size_t beam, std::size_t range, float rcs_m2) {
  return {.range_m = grid.first_range_m + (static_cast<double>(range) + 0.5) * grid.range_step_m,
          .cross = grid.first_azimuth_rad + (static_cast<double>(beam) + 0.5) * grid.azimuth_step_rad,
          .rcs_m2 = {rcs_m2, 0.0F, 0.0F, 0.0F},
          .bounces = 1};
}

/// Bins that hold power in some places, heard from a frame and by the receiver of offline maps.
class HeardBins : public testing::Test {
 protected:
  HeardBins() : powers_(4 * grid_.azimuths * grid_.ranges, 0.0F) {
    radar_.range_resolution_m = 100.0;
    radar_.beam_width_rad = 0.02;
    radar_.waveform.pulse_length_s = 1e-6;
  }
  void put(std::size_t beam, std::size_t range) {
    powers_[4 * (beam * grid_.ranges + range)] = 1000.0F;
    echoes_.push_back(echo_of(grid_, beam, range, 1000.0F));
  }
  /// Holds the one against the other, bin by bin, and gives back how many are heard.
  std::size_t heard_as_offline() const {
    Frame frame;
    frame.grid = grid_;
    frame.powers_m2 = powers_;
    DrawnByHand drawn(grid_.azimuths);
    drawn.draw(frame, {});
    const auto live = image_of(frame, radar_);
    receiver::RangeAzimuthReceiver receiver(radar_, grid_);
    receiver.add(echoes_);
    const auto offline = receiver.image();
    std::size_t heard = 0;
    for (std::size_t i = 0; i < live.rcs_m2.size(); ++i) {
      const float here = live.rcs_m2.values()[i].vv, there = offline.rcs_m2.values()[i].vv;
      EXPECT_EQ(std::isnan(here), std::isnan(there)) << i;
      if (std::isnan(there)) continue;
      ++heard;
      // What a bin of ground has it has from all over the bin, an echo from its middle.
      EXPECT_NEAR(here, there, 2e-3F * std::abs(there) + 1e-6F) << i;
    }
    return heard;
  }

  radar::RangeAzimuthGrid grid_{3000.0, 50.0, 60, -0.1, 0.01, 20};
  std::vector<float> powers_;
  std::vector<radar::Echo> echoes_;
  radar::Radar radar_;
};

TEST_F(HeardBins, OutsideTheRangeGateNothingIsHeard) {
  radar_.receiver.first_range_m = 4000.0;
  radar_.receiver.last_range_m = 5000.0;
  for (const std::size_t range : {5U, 19U, 21U, 30U, 39U, 41U, 55U}) put(10, range);
  // 20 ranges of the gate, and one at either end of which maps read.
  EXPECT_EQ(heard_as_offline(), 22 * grid_.azimuths);
}

TEST_F(HeardBins, WhatLiesBeyondTheUnambiguousRangeFoldsIntoTheGate) {
  // 1 km after the gate's opening.
  radar_.waveform.pulse_repetition_hz = speed_of_light_mps / 2000.0;
  radar_.waveform.pulse_length_s = 1e-7;
  radar_.atmosphere_per_m = 1e-5;
  for (const std::size_t range : {3U, 24U, 47U}) put(10, range);
  // 20 ranges, and one at either end of which maps read, but for those that the pulse eclipses.
  const std::size_t heard = heard_as_offline();
  EXPECT_GE(heard, 18 * grid_.azimuths);
  EXPECT_LE(heard, 22 * grid_.azimuths);
  radar_.receiver.first_range_m = 3510.0;
  put(4, 7);  // before the gate: a pulse later it is in it
  EXPECT_GE(heard_as_offline(), 18 * grid_.azimuths);
}

TEST_F(HeardBins, AFrameBeyondAGateIsNotHeardAtAll) {
  radar_.receiver.first_range_m = 500.0;
  radar_.receiver.last_range_m = 2000.0;
  put(10, 30);
  EXPECT_EQ(heard_as_offline(), 0U);
}

TEST_F(HeardBins, AzimuthsThatTheScanNeverComesToAreNotHeard) {
  radar_.scan = {.kind = radar::ScanKind::Sector, .azimuth_rad = 0.0, .sector_width_rad = 0.08};
  for (const std::size_t beam : {2U, 6U, 10U, 17U}) put(beam, 30);
  const std::size_t heard = heard_as_offline();
  EXPECT_GT(heard, 8 * grid_.ranges - 1);
  EXPECT_LT(heard, 12 * grid_.ranges);
}

}  // namespace
}  // namespace sigmascape::live
