#include "sigmascape/live/live_receiver.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mutex>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "counted_allocations.h"
#include "drawn_by_hand.h"
#include "level_ground_watts.h"
#include "live_ground_example.h"
#include "terrain_short_of_tiles.h"

#include "sigmascape/base/error.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/live/frame_image.h"
#include "sigmascape/radar/noise.h"
#include "sigmascape/radar/radar_equation.h"
#include "sigmascape/receiver/receive_chain.h"

namespace sigmascape::live {
namespace {

using radar::Polarization;

Vec3d high_above(Vec2d place = {}) {
  return {place.x, place.y, 1500.0};
}

/// A frame of made bins, speckled by lot, with targets of which two beams hold a part each, as live frames have them.
class MadeFrame {
 public:
  MadeFrame(const radar::RangeAzimuthGrid& grid, std::uint64_t seed, std::size_t targets)
      : drawn_(grid.azimuths), powers_(4 * grid.azimuths * grid.ranges) {
    for (std::size_t i = 0; i < powers_.size(); ++i) powers_[i] = -10.0F * std::log(1.0F - unit_float(hashed(seed, i)));
    frame_.grid = grid;
    frame_.earth = radar::CurvedEarth{};
    for (std::size_t number = 0; number < targets; ++number) add_target(hashed(seed, number, 7));
    std::ranges::stable_sort(echoes_, {}, &receiver::EchoInBeam::beam);
    std::ranges::stable_sort(before_, {}, [&](const receiver::BinBefore& bin) { return bin.bin / grid.ranges; });
    frame_.powers_m2 = powers_;
    frame_.targets = {echoes_, before_};
    drawn_.draw(frame_, high_above());
  }
  /// As it was drawn last, at first from high above the origin.
  [[nodiscard]] const Frame& frame() const { return frame_; }
  [[nodiscard]] Frame& frame() { return frame_; }
  const Frame& drawn_from(Vec3d radar) {
    drawn_.draw(frame_, radar);
    return frame_;
  }
  const Frame& drawn_from(Vec3d radar, std::size_t first_beam, std::size_t count) {
    drawn_.draw(frame_, radar, first_beam, count);
    return frame_;
  }

 private:
  void add_target(std::uint64_t lot) {
    const radar::RangeAzimuthGrid& grid = frame_.grid;
    const double beam = 0.5 + static_cast<double>(unit_float(hashed(lot, 1))) * static_cast<double>(grid.azimuths - 1),
                 range = 0.5 + static_cast<double>(unit_float(hashed(lot, 2))) * static_cast<double>(grid.ranges - 1);
    const auto first = static_cast<std::size_t>(beam - 0.5);
    const auto far_part = static_cast<float>(beam - 0.5 - static_cast<double>(first));
    for (const auto& [holder, part] : {std::pair{first, 1.0F - far_part}, {first + 1, far_part}}) {
      if (holder >= grid.azimuths) continue;
      const float rcs_m2 = 1e4F * part;
      echoes_.push_back({.beam = static_cast<std::uint32_t>(holder),
                         .echo = {.range_m = grid.first_range_m + range * grid.range_step_m,
                                  .cross = grid.first_azimuth_rad + beam * grid.azimuth_step_rad,
                                  .rcs_m2 = {rcs_m2, 0.5F * rcs_m2, 0.1F * rcs_m2, 0.2F * rcs_m2},
                                  .bounces = 1,
                                  .sin_depression = 0.2F * unit_float(hashed(lot, 3))}});
      const std::size_t bin = holder * grid.ranges + static_cast<std::size_t>(range);
      const auto held = std::span(powers_).subspan(4 * bin, 4);
      before_.push_back({.bin = static_cast<std::uint32_t>(bin), .rcs_m2 = {held[0], held[1], held[2], held[3]}});
      held[0] += rcs_m2;
    }
  }

  DrawnByHand drawn_;
  std::vector<float> powers_;
  std::vector<receiver::EchoInBeam> echoes_;
  std::vector<receiver::BinBefore> before_;
  Frame frame_;
};

constexpr radar::RangeAzimuthGrid sector{3000.0, 50.0, 90, -0.1, 0.01, 40};
constexpr radar::RangeAzimuthGrid turn{3000.0, 50.0, 70, 0.3, 2.0 * pi / 90.0, 90};

/// Tells every other bin from the next, both ways.
radar::Radar radar_of(const radar::RangeAzimuthGrid& grid) {
  radar::Radar radar;
  radar.range_resolution_m = 2.0 * grid.range_step_m;
  radar.beam_width_rad = 2.0 * grid.azimuth_step_rad;
  radar.waveform.pulse_length_s = 1e-6;
  return radar;
}

radar::Radar with_beam_in_elevation(radar::Radar radar) {
  radar.antenna.elevation = radar::GaussianBeam{};
  radar.antenna.elevation_width_rad = radians_from_deg(20.0);
  radar.antenna.tilt_rad = radians_from_deg(-18.0);
  return radar;
}

double hills_m(Vec2d place) {
  return 150.0 * std::sin(place.x / 900.0) * std::cos(place.y / 700.0);
}

/// Bin by bin: watts are those of a whole image, those of the brightest bin a millionth of a part off at most, and NaN
/// where they are.
void expect_as_whole_image(const HeardPower& heard, const radar::Radar& radar, const radar::RangeAzimuthImage& image,
                           Polarization polarization) {
  const receiver::ReceivedPower expected = receiver::received_power(radar, image, polarization);
  ASSERT_EQ(heard.grid, expected.grid);
  EXPECT_EQ(heard.noise_w, expected.noise_w);
  std::size_t told = 0;
  for (std::size_t beam = 0; beam < heard.grid.azimuths; ++beam) {
    for (std::size_t range = 0; range < heard.grid.ranges; ++range) {
      const float here = heard.signal_w[beam * heard.grid.ranges + range], there = expected.signal_w(beam, range);
      ASSERT_EQ(std::isnan(here), std::isnan(there)) << beam << ", " << range;
      if (std::isnan(there)) continue;
      ++told;
      ASSERT_NEAR(here, there, 5e-5F * there) << beam << ", " << range;
    }
  }
  EXPECT_GT(told, 0U);
}

struct Hearing {
  std::string name;
  radar::RangeAzimuthGrid grid;
  std::function<void(radar::Radar&)> change = [](radar::Radar&) {};
  std::size_t targets = 0;
};

class LiveReceiverAsOffline : public testing::TestWithParam<Hearing> {};

TEST_P(LiveReceiverAsOffline, WattsAreThoseOfAWholeImage) {
  const auto& [name, grid, change, targets] = GetParam();
  const MadeFrame made(grid, 5, targets);
  const GroundHeight hills = hills_m;
  for (const Polarization polarization : {Polarization::VV, Polarization::HV}) {
    radar::Radar even = radar_of(grid);
    change(even);
    LiveReceiver of_even(even, polarization, {}, 2);
    expect_as_whole_image(of_even.hear(made.frame()), even, image_of(made.frame(), even), polarization);
    const radar::Radar narrow = with_beam_in_elevation(even);
    LiveReceiver of_narrow(narrow, polarization, hills, 2);
    expect_as_whole_image(of_narrow.hear(made.frame()), narrow, image_of(made.frame(), narrow, hills), polarization);
  }
}

INSTANTIATE_TEST_SUITE_P(All, LiveReceiverAsOffline,
                         testing::Values(Hearing{"Sector", sector}, Hearing{"Turn", turn},
                                         Hearing{"SectorWithTargets", sector, [](radar::Radar&) {}, 60},
                                         Hearing{"TurnWithTargets", turn, [](radar::Radar&) {}, 60},
                                         Hearing{"WideBins", turn,
                                                 [](radar::Radar& radar) {
                                                   radar.range_resolution_m /= 5.0;
                                                   radar.beam_width_rad /= 5.0;
                                                 }},
                                         Hearing{"FineBins", sector,
                                                 [](radar::Radar& radar) {
                                                   radar.range_resolution_m *= 4.0;
                                                   radar.beam_width_rad *= 6.0;
                                                 },
                                                 60},
                                         Hearing{"Gate", sector,
                                                 [](radar::Radar& radar) {
                                                   radar.receiver.first_range_m = 3510.0;
                                                   radar.receiver.last_range_m = 5000.0;
                                                 },
                                                 60},
                                         Hearing{"Folding", sector,
                                                 [](radar::Radar& radar) {
                                                   radar.waveform.pulse_repetition_hz = speed_of_light_mps / 2000.0;
                                                   radar.waveform.pulse_length_s = 1e-7;
                                                   radar.atmosphere_per_m = 1e-5;
                                                   radar.receiver.first_range_m = 3510.0;
                                                 },
                                                 60},
                                         Hearing{"Scan", sector,
                                                 [](radar::Radar& radar) {
                                                   radar.scan = {.kind = radar::ScanKind::Sector,
                                                                 .azimuth_rad = 0.0,
                                                                 .sector_width_rad = 0.1};
                                                 }}),
                         [](const auto& hearing) { return hearing.param.name; });

/// Level ground that answers, 900 m below the radar and 4 km away, in bins of which the radar tells every other from
/// the next, and targets on it.
class LiveReceiverOverGround : public testing::Test {
 protected:
  LiveReceiverOverGround() {
    ExampleGround example;
    example.azimuths = 1;
    example.elevations_deg = {2.0, 37.0};
    example.sigma0 = [](const radar::Look& look) { return constant_gamma(0.1, look); };
    example.height_m = [](Vec2d way) { return 20.0 * std::sin(way.x / 150.0); };
    store_.emplace(example.store(folder_.path("atlas")));
    ground_ = example.over(*store_);
    view_.target = example.middle();
    view_.beams = 49;
    view_.ranges = 65;
    view_.azimuth_deg = 180.0;
    for (std::size_t i = 0; i < 40; ++i) {
      radar::Target target;
      const double x = static_cast<double>(i % 8) * 60.0 - 200.0, y = static_cast<double>(i / 8) * 60.0 - 100.0;
      target.track = radar::Track::straight(Vec3d{view_.target.x + x, view_.target.y + y, 200.0});
      target.rcs_m2 = radar::Channels{1e3F, 1e3F, 0.0F, 1e3F};
      targets_.push_back(target);
    }
  }
  [[nodiscard]] radar::Radar radar() const {
    const LiveSettings bins = view_.settings(FrameContent::Powers);
    radar::Radar radar = with_beam_in_elevation({});
    radar.position = view_.pose().position;
    radar.range_resolution_m = 2.0 * bins.range_step_m;
    radar.beam_width_rad = 2.0 * bins.beam_step_rad;
    return radar;
  }
  [[nodiscard]] Pose pose() const {
    Pose pose = view_.pose();
    pose.targets = targets_;
    return pose;
  }
  [[nodiscard]] std::vector<float> heard_at_once(const Pose& pose, unsigned threads = 1) {
    LiveRenderer renderer(ground_, view_.settings(FrameContent::Powers));
    LiveReceiver receiver(radar(), Polarization::VV, ground_, threads);
    const auto signal_w = receiver.hear(settled_frame(renderer, *ground_, pose)).signal_w;
    return {signal_w.begin(), signal_w.end()};
  }

  ScratchFolder folder_;
  std::optional<atlas::Store> store_;
  std::shared_ptr<LiveGround> ground_;
  ExampleView view_;
  std::vector<radar::Target> targets_;
};

TEST_F(LiveReceiverOverGround, ATurnInStepsComesToTheBytesOfTheWholeFrame) {
  const std::vector<float> expected = heard_at_once(pose());
  LiveRenderer renderer(ground_, view_.settings(FrameContent::Powers));
  LiveReceiver receiver(radar(), Polarization::VV, ground_, 2);
  // What is there before is another frame, of another place and other targets.
  Pose before = pose();
  before.position.x += 300.0;
  before.targets = std::span(targets_).first(20);
  receiver.hear(settled_frame(renderer, *ground_, before));
  HeardPower heard;
  for (const std::size_t first : {16U, 32U, 48U, 0U}) heard = receiver.hear(renderer.scan(pose(), first, 16));
  EXPECT_THAT(heard.signal_w, testing::ElementsAreArray(expected));
}

// Of a radar that flies along while its antenna turns.
TEST_F(LiveReceiverOverGround, WhoHearsNowAndThenHearsWhatOneDoesWhoHearsEveryStep) {
  LiveRenderer renderer(ground_, view_.settings(FrameContent::Powers));
  Pose pose = this->pose();
  const Frame* frame = &settled_frame(renderer, *ground_, pose);
  LiveReceiver every(radar(), Polarization::VV, ground_, 1), every_third(radar(), Polarization::VV, ground_, 1);
  for (std::size_t step = 0; step < 14; ++step) {
    pose.position.x += 30.0;
    frame = &renderer.scan(pose, step % 7 * 7, 7);
    every.hear(*frame);
    if (step % 3 == 1) every_third.hear(*frame);
  }
  LiveReceiver late(radar(), Polarization::VV, ground_, 2);
  const HeardPower& heard = late.hear(*frame);
  EXPECT_THAT(heard.signal_w, testing::ElementsAreArray(every.hear(*frame).signal_w));
  EXPECT_THAT(heard.signal_w, testing::ElementsAreArray(every_third.hear(*frame).signal_w));
  expect_as_whole_image(heard, radar(), image_of(*frame, radar(), ground_below(*frame, *ground_)), Polarization::VV);
}

TEST_F(LiveReceiverOverGround, BeamsThatWereNeverDrawnAreDark) {
  LiveRenderer renderer(ground_, view_.settings(FrameContent::Powers));
  const Frame& frame = renderer.scan(pose(), 40, 9);
  LiveReceiver receiver(radar(), Polarization::VV, ground_, 1);
  const HeardPower& heard = receiver.hear(frame);
  EXPECT_EQ(std::ranges::max(heard.signal_w.first(20 * view_.ranges)), 0.0F);
  EXPECT_GT(std::ranges::max(heard.signal_w), 0.0F);
  expect_as_whole_image(heard, radar(), image_of(frame, radar(), ground_below(frame, *ground_)), Polarization::VV);
}

TEST_F(LiveReceiverOverGround, AStepChangesNoBeamsButThoseThatItTells) {
  LiveRenderer renderer(ground_, view_.settings(FrameContent::Powers));
  LiveReceiver receiver(radar(), Polarization::VV, ground_, 1);
  Pose pose = this->pose();
  const HeardPower& heard = receiver.hear(settled_frame(renderer, *ground_, pose));
  const std::vector<float> before(heard.signal_w.begin(), heard.signal_w.end());
  pose.position.x += 40.0;
  pose.targets = {};
  receiver.hear(renderer.scan(pose, 20, 4));
  EXPECT_LT(heard.first_changed, 20U);
  EXPECT_GT(heard.first_changed + heard.changed, 24U);
  EXPECT_LT(heard.changed, 24U);
  for (std::size_t beam = 0; beam < view_.beams; ++beam) {
    const bool told = beam >= heard.first_changed && beam < heard.first_changed + heard.changed;
    const bool of_step = beam >= 20 && beam < 24;
    const auto first = static_cast<std::ptrdiff_t>(beam * view_.ranges),
               end = first + static_cast<std::ptrdiff_t>(view_.ranges);
    const bool same = std::equal(before.begin() + first, before.begin() + end, heard.signal_w.begin() + first);
    if (!told) {
      EXPECT_TRUE(same) << beam;
    }
    if (of_step) {
      EXPECT_FALSE(same) << beam;
    }
  }
}

TEST_F(LiveReceiverOverGround, BytesDoNotDependOnThreads) {
  EXPECT_EQ(heard_at_once(pose(), 1), heard_at_once(pose(), 3));
}

TEST_F(LiveReceiverOverGround, WattsAreThoseOfAWholeImageOverTheGroundBelow) {
  for (const FrameContent content : {FrameContent::Powers, FrameContent::Amplitudes}) {
    LiveRenderer renderer(ground_, view_.settings(content));
    const Frame& frame = settled_frame(renderer, *ground_, pose());
    LiveReceiver receiver(radar(), Polarization::HH, ground_, 1);
    expect_as_whole_image(receiver.hear(frame), radar(), image_of(frame, radar(), ground_below(frame, *ground_)),
                          Polarization::HH);
  }
}

// A radar that is not there yet hears what one hears that has come from far away.
TEST_F(LiveReceiverOverGround, NothingIsWrongByBeingKept) {
  LiveRenderer renderer(ground_, view_.settings(FrameContent::Powers));
  LiveReceiver receiver(radar(), Polarization::VV, ground_, 1);
  Pose pose = this->pose();
  for (const double away_m : {3000.0, 1400.0, 700.0, 100.0, 1.0, 0.0}) {
    pose.position.y = this->pose().position.y - away_m;
    receiver.hear(renderer.render(pose));
  }
  const auto signal_w = receiver.hear(settled_frame(renderer, *ground_, pose)).signal_w;
  EXPECT_THAT(signal_w, testing::ElementsAreArray(heard_at_once(pose)));
}

/// A turn of beams seen from near the middle of the example.
constexpr radar::RangeAzimuthGrid close_turn{150.0, 1.5, 200, 0.0, 2.0 * pi / 64.0, 64};

// Over several metres of rise a metre of way, steps from one place of the ground to the next know little of where they
// end.
TEST_F(LiveReceiverOverGround, HeightsOfSteepGroundDoNotDependOnWhatWasKept) {
  ExampleGround example;
  example.height_m = [](Vec2d p) {
    return 60.0 * std::sin(p.x / 24.0) * std::cos(p.y / 31.0) + 40.0 * std::sin(p.x / 7.0) * std::sin(p.y / 9.0);
  };
  example.terrain_spacing_m = 2.0;
  const auto steep = example.over(*store_);
  MadeFrame made(close_turn, 5, 0);
  const radar::Radar radar = with_beam_in_elevation(radar_of(close_turn));
  for (int number = 0; number < 6; ++number) {
    Vec3d here = high_above(example.middle() + Vec2d{37.3, 11.1} * static_cast<double>(number));
    here.z = 220.0 + 10.0 * number;
    Vec3d there = here;
    there.x += number % 2 == 0 ? 112.0 : -112.0;  // nearly all that is kept beside
    LiveReceiver fresh(radar, Polarization::VV, steep, 1), receiver(radar, Polarization::VV, steep, 1);
    receiver.hear(made.drawn_from(there));
    const Frame& frame = made.drawn_from(here);
    EXPECT_THAT(receiver.hear(frame).signal_w, testing::ElementsAreArray(fresh.hear(frame).signal_w));
  }
}

TEST_F(LiveReceiverOverGround, TilesThatCouldNotBeHadAreHeardOverAsSoonAsTheyCan) {
  ExampleGround example;
  example.height_m = hills_m;
  std::atomic<bool> is_short = true;
  const auto short_ground = std::make_shared<LiveGround>(*store_, short_of(example.terrain(), is_short), 10e9);
  MadeFrame made(close_turn, 5, 0);
  const radar::Radar radar = with_beam_in_elevation(radar_of(close_turn));
  const Vec3d here{example.middle().x, example.middle().y, 300.0};
  LiveReceiver expected(radar, Polarization::VV, example.over(*store_), 1),
      receiver(radar, Polarization::VV, short_ground, 1);
  const auto whole = expected.hear(made.drawn_from(here)).signal_w;
  const HeardPower& heard = receiver.hear(made.frame());
  EXPECT_THAT(heard.signal_w, testing::Not(testing::ElementsAreArray(whole)));
  is_short = false;
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  receiver.hear(made.frame());
  EXPECT_THAT(heard.signal_w, testing::ElementsAreArray(whole));
  EXPECT_EQ(receiver.hear(made.frame()).changed, 0U) << "once";
}

TEST_F(LiveReceiverOverGround, AWindowThatLacksTilesIsTakenAnewWhenThereIsSomethingBetter) {
  ExampleGround example;
  std::atomic<bool> is_short = true;
  KeptGround kept(std::make_shared<LiveGround>(*store_, short_of(example.terrain(), is_short), 10e9));
  const auto cover = [&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    kept.cover(close_turn, example.middle(), {});
    return kept.windows();
  };
  EXPECT_EQ(cover(), 1U);
  EXPECT_EQ(cover(), 1U) << "there is nothing better";
  is_short = false;
  EXPECT_EQ(cover(), 2U);
  EXPECT_EQ(cover(), 2U) << "nothing is lacking";
}

TEST_F(LiveReceiverOverGround, OneWindowOfTheGroundServesAFlight) {
  KeptGround kept(ground_);
  LiveRenderer renderer(ground_, view_.settings(FrameContent::Powers));
  const radar::RangeAzimuthGrid& grid = renderer.render(view_.pose()).grid;
  const Vec2d foot{view_.pose().position.x, view_.pose().position.y};
  for (int metre = 0; metre < 1000; ++metre) kept.cover(grid, foot + Vec2d{static_cast<double>(metre), 0.0}, {});
  EXPECT_EQ(kept.windows(), 1U);
  kept.cover(grid, foot + Vec2d{1200.0, 0.0}, {});
  EXPECT_EQ(kept.windows(), 2U);
}

TEST_F(LiveReceiverOverGround, NothingIsAllocatedOnceItHasHeardAll) {
  LiveRenderer renderer(ground_, view_.settings(FrameContent::Powers));
  LiveReceiver receiver(radar(), Polarization::VV, ground_, 2);
  Pose pose = this->pose();
  settled_frame(renderer, *ground_, pose);
  Frame frame = renderer.scan(pose, 8, 8);
  DrawnByHand again(view_.beams);
  again.draw(frame, pose.position);
  receiver.hear(frame);
  const std::size_t before = allocations();
  for (int step = 0; step < 10; ++step) {
    pose.position.x += 1.0;
    again.draw(frame, pose.position, 8, 8);
    receiver.hear(frame);
    again.draw(frame, pose.position);
    receiver.hear(frame);
  }
  for (int step = 0; step < 3; ++step) {
    frame.grid.first_range_m += 1.0;
    frame.grid.first_azimuth_rad += 1e-4;
    again.draw(frame, pose.position);
    receiver.hear(frame);
  }
  EXPECT_EQ(allocations(), before);
}

TEST(LiveReceiver, EvenGroundHasTheWattsOfTheRadarEquation) {
  ExampleGround example;
  example.azimuths = 1;
  example.elevations_deg = {2.0, 37.0};
  example.sigma0 = [](const radar::Look& look) { return constant_gamma(0.1, look); };
  const ScratchFolder folder;
  const auto ground = example.over(example.store(folder.path("atlas")));
  ExampleView view;
  view.target = example.middle();
  const LiveSettings bins = view.settings(FrameContent::Powers);
  radar::Radar radar;
  radar.range_resolution_m = 2.0 * bins.range_step_m;
  radar.beam_width_rad = 2.0 * bins.beam_step_rad;
  radar.antenna.gain = 1000.0;
  radar.waveform.peak_power_w = 2000.0;
  const Pose pose = view.pose();
  LiveRenderer renderer(ground, bins);
  LiveReceiver receiver(radar, Polarization::VV);
  const HeardPower& heard = receiver.hear(settled_frame(renderer, *ground, pose));
  double sum_w = 0.0, expected_w = 0.0;
  for (std::size_t range = 20; range + 20 < view.ranges; ++range) {
    const double r_m = pose.first_range_m + (static_cast<double>(range) + 0.5) * bins.range_step_m;
    for (std::size_t beam = 10; beam + 10 < view.beams; ++beam) {
      sum_w += static_cast<double>(heard.signal_w[beam * view.ranges + range]);
      expected_w += level_ground_w(radar, r_m, 0.1 * pose.position.z / r_m);
    }
  }
  EXPECT_NEAR(db_from_linear(sum_w / expected_w), 0.0, 0.1);
  EXPECT_DOUBLE_EQ(heard.noise_w, radar::noise_power_w(radar));
  EXPECT_EQ(receiver.noise_w(), heard.noise_w);
}

TEST(LiveReceiver, ATargetInTheMiddleOfABinHasTheWattsOfTheRadarEquation) {
  const std::vector<float> dark(4 * sector.azimuths * sector.ranges, 0.0F);
  const double range_m = sector.first_range_m + 30.5 * sector.range_step_m;
  const std::vector<receiver::EchoInBeam> echoes{
      {.beam = 17,
       .echo = {.range_m = range_m,
                .cross = sector.first_azimuth_rad + 17.5 * sector.azimuth_step_rad,
                .rcs_m2 = {250.0F, 0.0F, 0.0F, 0.0F},
                .bounces = 1,
                .sin_depression = static_cast<float>(std::sin(radians_from_deg(28.0)))}}};
  Frame frame;
  frame.grid = sector;
  frame.powers_m2 = dark;
  frame.targets = {echoes, {}};
  DrawnByHand drawn(sector.azimuths);
  drawn.draw(frame, high_above());
  const radar::Radar radar = with_beam_in_elevation(radar_of(sector));
  LiveReceiver receiver(radar, Polarization::VV, GroundHeight(hills_m));
  const HeardPower& heard = receiver.hear(frame);
  // 10° beside the axis of a beam of 20°: twice 3 dB.
  const double expected_w = radar::received_power_w(radar, 250.0, range_m) * radar::compression_gain(radar) / 4.0;
  EXPECT_NEAR(db_from_linear(static_cast<double>(heard.signal_w[17 * sector.ranges + 30]) / expected_w), 0.0, 0.02);
  EXPECT_EQ(heard.signal_w[30 * sector.ranges + 30], 0.0F);
}

TEST(LiveReceiver, RoundTheTurnAStepIsHeardOnItsOtherSide) {
  const MadeFrame made(turn, 3, 20), made_before(turn, 4, 20);
  Frame frame = made.frame(), before = made_before.frame();
  DrawnByHand drawn(turn.azimuths);
  LiveReceiver receiver(radar_of(turn), Polarization::VV);
  drawn.draw(before, high_above());
  const HeardPower& heard = receiver.hear(before);
  drawn.draw(frame, high_above(), 0, 2);
  receiver.hear(frame);
  EXPECT_GT(heard.first_changed, turn.azimuths / 2);
  EXPECT_GT((heard.first_changed + heard.changed) % turn.azimuths, 2U);
  const float last = heard.signal_w[(turn.azimuths - 1) * turn.ranges + 20];
  for (std::size_t first = 2; first < turn.azimuths; first += 2) {
    drawn.draw(frame, high_above(), first, 2);
    receiver.hear(frame);
  }
  LiveReceiver at_once(radar_of(turn), Polarization::VV);
  EXPECT_THAT(heard.signal_w, testing::ElementsAreArray(at_once.hear(frame).signal_w));
  EXPECT_NE(heard.signal_w[(turn.azimuths - 1) * turn.ranges + 20], last);
}

TEST(LiveReceiver, RoundTheTurnNoMoreIsHeardThanLiesBetweenTheBeamsThatWereDrawn) {
  MadeFrame made(turn, 3, 0);
  LiveReceiver receiver(radar_of(turn), Polarization::VV);
  receiver.hear(made.frame());
  made.drawn_from(high_above(), 5, 1);
  const std::size_t of_one = receiver.hear(made.frame()).changed;
  made.drawn_from(high_above(), turn.azimuths - 3, 1);
  made.drawn_from(high_above(), 2, 1);
  const HeardPower& heard = receiver.hear(made.frame());
  EXPECT_EQ(heard.changed, of_one + 5);
  EXPECT_EQ(heard.first_changed, turn.azimuths - 3 - (of_one - 1) / 2);
  EXPECT_EQ(receiver.hear(made.frame()).changed, 0U) << "nothing was drawn since";
}

TEST(LiveReceiver, OtherBinsAreAllHeardAnew) {
  const MadeFrame first(sector, 3, 20);
  radar::RangeAzimuthGrid moved = sector;
  moved.first_range_m += 200.0;
  moved.first_azimuth_rad += 0.3;
  radar::RangeAzimuthGrid wider = sector;
  wider.range_step_m *= 1.5;
  wider.azimuths = 50;
  const radar::Radar radar = with_beam_in_elevation(radar_of(sector));
  LiveReceiver receiver(radar, Polarization::VV, GroundHeight(hills_m), 1);
  receiver.hear(first.frame());
  for (const radar::RangeAzimuthGrid& grid : {moved, wider, sector}) {
    const MadeFrame next(grid, 8, 20);
    const HeardPower& heard = receiver.hear(next.frame());
    EXPECT_EQ(heard.grid, grid);
    EXPECT_EQ(heard.changed, grid.azimuths);
    LiveReceiver at_once(radar, Polarization::VV, GroundHeight(hills_m), 1);
    EXPECT_THAT(heard.signal_w, testing::ElementsAreArray(at_once.hear(next.frame()).signal_w));
  }
}

TEST(LiveReceiver, BeamsAreWeighedFromWhereTheyWereDrawn) {
  MadeFrame made(sector, 3, 0);
  const radar::Radar radar = with_beam_in_elevation(radar_of(sector));
  const GroundHeight hills = hills_m;
  const auto heard_at_once = [&] {
    LiveReceiver receiver(radar, Polarization::VV, hills);
    const auto signal_w = receiver.hear(made.frame()).signal_w;
    return std::vector<float>(signal_w.begin(), signal_w.end());
  };
  const Vec3d here = high_above(), there = high_above({400.0, 100.0});
  made.drawn_from(there);
  const std::vector<float> from_there = heard_at_once();
  made.drawn_from(here);
  const std::vector<float> from_here = heard_at_once();
  LiveReceiver receiver(radar, Polarization::VV, hills);
  receiver.hear(made.frame());
  const auto signal_w = receiver.hear(made.drawn_from(there, 0, 20)).signal_w;
  const std::size_t ranges = sector.ranges;
  for (const auto& [beam, expected] : {std::pair{std::size_t{5}, &from_there}, {std::size_t{35}, &from_here}}) {
    EXPECT_TRUE(std::ranges::equal(signal_w.subspan(beam * ranges, ranges),
                                   std::span(*expected).subspan(beam * ranges, ranges)))
        << beam;
  }
  EXPECT_NE(from_here, from_there);
  EXPECT_THAT(heard_at_once(), testing::ElementsAreArray(signal_w)) << "who comes late hears the same";
}

// A window of the ground is larger than what the bins look at by a quarter of their farthest range.
TEST(LiveReceiver, HeightsAreAskedForNoFartherThanWhatIsCovered) {
  MadeFrame made(close_turn, 3, 0);
  const double last_m = close_turn.first_range_m + static_cast<double>(close_turn.ranges) * close_turn.range_step_m;
  for (const double up_m : {120.0, 250.0, 1000.0}) {
    double farthest_m = 0.0;
    const GroundHeight steep = [&](Vec2d place) {
      farthest_m = std::max(farthest_m, std::hypot(place.x, place.y));
      return 40.0 * std::sin(place.x / 40.0) * std::cos(place.y / 48.0) + 40.0 * std::sin(place.x / 7.0);
    };
    LiveReceiver receiver(with_beam_in_elevation(radar_of(close_turn)), Polarization::VV, steep, 1);
    receiver.hear(made.drawn_from({0.0, 0.0, up_m}));
    EXPECT_GT(farthest_m, up_m < last_m ? 0.9 * last_m : 0.0) << up_m;
    EXPECT_LT(farthest_m, 1.021 * last_m) << up_m;
  }
}

/// Hills that tell how many threads ask for their height at once: each waits for the other.
class WatchedHills {
 public:
  [[nodiscard]] GroundHeight heights() {
    return [this](Vec2d place) {
      wait_for_another();
      return hills_m(place);
    };
  }
  void watch() { is_watched_ = true; }
  [[nodiscard]] std::size_t threads() const { return at_work_.size(); }

 private:
  void wait_for_another() {
    if (!is_watched_) return;
    std::unique_lock lock(guard_);
    if (at_work_.insert(std::this_thread::get_id()).second) another_.notify_all();
    if (!another_.wait_for(lock, std::chrono::seconds(5), [this] { return at_work_.size() > 1; })) is_watched_ = false;
  }

  std::atomic<bool> is_watched_ = false;
  std::mutex guard_;
  std::condition_variable another_;
  std::set<std::thread::id> at_work_;
};

constexpr radar::RangeAzimuthGrid many_ranges{3000.0, 15.0, 512, -0.1, 4e-3, 64};

TEST(LiveReceiver, ThreadsShareTheWeighingOfAStep) {
  MadeFrame made(many_ranges, 3, 0);
  WatchedHills hills;
  LiveReceiver receiver(with_beam_in_elevation(radar_of(many_ranges)), Polarization::VV, hills.heights(), 2);
  receiver.hear(made.frame());
  hills.watch();
  receiver.hear(made.drawn_from(high_above({1.0, 0.0}), 8, 8));
  EXPECT_EQ(hills.threads(), 2U);
}

TEST(LiveReceiver, ThreadsShareTheWeighingOfManySmallStepsThatAreHeardTogether) {
  MadeFrame made(many_ranges, 3, 0);
  WatchedHills hills;
  LiveReceiver receiver(with_beam_in_elevation(radar_of(many_ranges)), Polarization::VV, hills.heights(), 2);
  receiver.hear(made.frame());
  for (std::size_t beam = 0; beam < many_ranges.azimuths; ++beam)
    made.drawn_from(high_above({static_cast<double>(beam), 0.0}), beam, 1);
  hills.watch();
  receiver.hear(made.frame());
  EXPECT_EQ(hills.threads(), 2U);
}

TEST(LiveReceiver, WhatHoldsTheSignalStaysWhereItIsWhenMoreBinsAreHeard) {
  const MadeFrame small(sector, 3, 0), large(turn, 3, 0);
  LiveReceiver receiver(radar_of(sector), Polarization::VV);
  EXPECT_EQ(receiver.signal(), nullptr);
  const auto heard = receiver.hear(small.frame()).signal_w;
  const auto held = receiver.signal();
  ASSERT_EQ(held->data(), heard.data());
  const std::vector<float> before = *held;
  receiver.hear(large.frame());
  EXPECT_NE(receiver.signal(), held);
  EXPECT_EQ(*held, before);
}

TEST(LiveReceiver, PowerForPicturesIsTheSameTheOtherWayRound) {
  const MadeFrame made(sector, 3, 5);
  LiveReceiver receiver(radar_of(sector), Polarization::VV);
  const HeardPower& heard = receiver.hear(made.frame());
  const receiver::ReceivedPower power = received_power(heard);
  EXPECT_EQ(power.grid, sector);
  EXPECT_EQ(power.noise_w, heard.noise_w);
  EXPECT_EQ(power.signal_w(7, 31), heard.signal_w[7 * sector.ranges + 31]);
}

template <typename Call>
std::string refused(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "is not refused";
}

// Of a radar's mode nothing is taken: a frame's beams are where it scans.
TEST(LiveReceiver, BeamsThatAScanNeverComesToAreUnheardInEveryMode) {
  const MadeFrame made(sector, 3, 0);
  radar::Radar radar = radar_of(sector);
  const double middle_rad =
      sector.first_azimuth_rad + 0.5 * static_cast<double>(sector.azimuths) * sector.azimuth_step_rad;
  radar.scan = {.kind = radar::ScanKind::Fixed, .azimuth_rad = middle_rad};
  const auto unheard = [&](radar::Mode mode) {
    radar.mode = mode;
    LiveReceiver receiver(radar, Polarization::VV);
    const std::span<const float> signal_w = receiver.hear(made.frame()).signal_w;
    return std::ranges::count_if(signal_w, [](float watts) { return std::isnan(watts); });
  };
  EXPECT_GT(unheard(radar::Mode::RealBeam), 0);
  EXPECT_EQ(unheard(radar::Mode::Spotlight), unheard(radar::Mode::RealBeam));
}

TEST(LiveReceiver, RefusesWhatWouldGiveWattsThatNobodyReceives) {
  EXPECT_THAT(refused([] { LiveReceiver({}, Polarization::Sum); }), testing::HasSubstr("sum of polarizations"));
  EXPECT_THAT(refused([] { LiveReceiver(with_beam_in_elevation({}), Polarization::VV); }),
              testing::HasSubstr("elevations apart"));
  MadeFrame made(sector, 3, 0);
  LiveReceiver receiver(radar_of(sector), Polarization::VV);
  made.frame().frequency_hz = 3e9;
  EXPECT_THAT(refused([&] { receiver.hear(made.frame()); }), testing::HasSubstr("3 GHz"));
  made.frame().frequency_hz = 10.05e9;
  EXPECT_NO_THROW(receiver.hear(made.frame()));
}

TEST(LiveReceiver, RefusesBinsThatHoldAnotherFrame) {
  LiveReceiver receiver(radar_of(sector), Polarization::VV);
  EXPECT_THAT(refused([&] { receiver.hear({}); }), testing::HasSubstr("nothing has been drawn"));
  MadeFrame made(sector, 3, 0);
  const Frame before = made.frame();
  made.drawn_from(high_above(), 3, 1);
  EXPECT_THAT(refused([&] { receiver.hear(before); }), testing::HasSubstr("before the next is drawn"));
  EXPECT_THAT(refused([&] { (void)image_of(before); }), testing::HasSubstr("before the next is drawn"));
  EXPECT_NO_THROW(receiver.hear(made.frame()));
}

}  // namespace
}  // namespace sigmascape::live
