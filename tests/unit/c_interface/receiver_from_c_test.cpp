#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "scratch_folder.h"
#include "unit/c_interface/atlas_of_even_ground.h"
#include "unit/c_interface/said_in_c.h"
#include "unit/live/live_ground_example.h"

#include "sigmascape/c_interface/sigmascape.h"
#include "sigmascape/live/live_receiver.h"
#include "sigmascape/radar/radar_file.h"

namespace sigmascape {
namespace {

std::string radar_text(const std::string& frequency_ghz, const std::string& antenna) {
  return "[radar]\nfrequency_ghz = " + frequency_ghz + "\nrange_resolution_m = 24.0\nbeam_width_deg = 0.35\n" +
         antenna + "[map]\ncell_m = 12.0\n";
}

/// A renderer over ground that answers, in bins of which the radars tell every other from the next.
class ReceiverFromC : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<ScratchFolder>();
    write_atlas_of_even_ground(folder_->path("atlas"));
    std::ofstream(radar_file()) << radar_text(
        "10.0", "[antenna]\nelevation_shape = \"gaussian\"\nelevation_width_deg = 12.0\ntilt_deg = -13.0\n");
    std::ofstream(even_radar_file()) << radar_text("10.0", "");
  }
  static void TearDownTestSuite() { folder_.reset(); }
  [[nodiscard]] static std::string radar_file() { return folder_->path("radar.toml").string(); }
  [[nodiscard]] static std::string even_radar_file() { return folder_->path("even.toml").string(); }

  ReceiverFromC() {
    ground_ = sigmascape_open_ground(folder_->path("atlas").string().c_str(), 10e9, 0);
    sigmascape_settings settings = said_in_c(view_.settings(live::FrameContent::Powers));
    settings.content = SIGMASCAPE_POWERS;
    renderer_ = sigmascape_make_renderer(ground_, &settings);
  }
  ~ReceiverFromC() override {
    sigmascape_free_renderer(renderer_);
    sigmascape_close_ground(ground_);
  }
  void settle(const sigmascape_pose& pose) {
    sigmascape_frame frame;
    ASSERT_EQ(sigmascape_render(renderer_, &pose, &frame), 0) << sigmascape_last_error();
    ASSERT_EQ(sigmascape_wait_for_pages(ground_), 0);
    ASSERT_EQ(sigmascape_render(renderer_, &pose, &frame), 0);
  }
  [[nodiscard]] static std::vector<float> numbers(const sigmascape_heard& heard) {
    return {heard.signal_w, heard.signal_w + heard.beams * heard.ranges};
  }

  static inline std::unique_ptr<ScratchFolder> folder_;
  live::ExampleView view_;
  sigmascape_ground* ground_ = nullptr;
  sigmascape_renderer* renderer_ = nullptr;
};

TEST_F(ReceiverFromC, HearsWhatTheCppInterfaceHears) {
  sigmascape_target target = {};
  std::ranges::copy(std::array{view_.target.x, view_.target.y, 100.0}, target.position_m);
  std::ranges::copy(std::array{1e4F, 1e4F, 0.0F, 1e4F}, target.rcs_m2);
  ASSERT_EQ(sigmascape_set_targets(renderer_, &target, 1), 0);
  const sigmascape_pose pose = said_in_c(view_.pose());
  settle(pose);
  sigmascape_receiver* receiver = sigmascape_make_receiver(radar_file().c_str(), SIGMASCAPE_HH, ground_, nullptr, 1);
  ASSERT_NE(receiver, nullptr) << sigmascape_last_error();
  sigmascape_heard heard;
  ASSERT_EQ(sigmascape_hear(receiver, renderer_, &heard), 0) << sigmascape_last_error();

  const auto shared = live::LiveGround::open(folder_->path("atlas").string(), 10e9);
  live::LiveRenderer renderer(shared, view_.settings(live::FrameContent::Powers));
  radar::Target same;
  same.track = radar::Track::straight(Vec3d{view_.target.x, view_.target.y, 100.0});
  same.rcs_m2 = radar::Channels{1e4F, 1e4F, 0.0F, 1e4F};
  live::Pose from = view_.pose();
  from.targets = {&same, 1};
  const live::Frame& frame = live::settled_frame(renderer, *shared, from);
  const radar::Radar radar = radar::read_radar_file(radar_file(), radar::PlaceOfRadar::Optional).radar;
  live::LiveReceiver expected(radar, radar::Polarization::HH, shared);
  const live::HeardPower& cpp = expected.hear(frame);
  EXPECT_THAT(numbers(heard), testing::ElementsAreArray(cpp.signal_w));
  EXPECT_EQ(heard.noise_w, cpp.noise_w);
  EXPECT_EQ(heard.beams, view_.beams);
  EXPECT_EQ(heard.ranges, view_.ranges);
  EXPECT_EQ(heard.first_range_m, frame.grid.first_range_m);
  EXPECT_EQ(heard.first_azimuth_rad, frame.grid.first_azimuth_rad);
  // The target by far outdoes the ground.
  EXPECT_GT(std::ranges::max(numbers(heard)), 100.0F * numbers(heard)[heard.ranges / 2]);
  sigmascape_free_receiver(receiver);
}

TEST_F(ReceiverFromC, IsMadeOfTheTextOfAFile) {
  settle(said_in_c(view_.pose()));
  std::ifstream file(radar_file());
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::string folder = std::filesystem::path(radar_file()).parent_path().string();
  std::vector<std::vector<float>> signals;
  for (sigmascape_receiver* receiver :
       {sigmascape_make_receiver(radar_file().c_str(), SIGMASCAPE_VV, ground_, nullptr, 1),
        sigmascape_make_receiver_of_text(text.c_str(), folder.c_str(), SIGMASCAPE_VV, ground_, nullptr, 1)}) {
    ASSERT_NE(receiver, nullptr) << sigmascape_last_error();
    sigmascape_heard heard;
    ASSERT_EQ(sigmascape_hear(receiver, renderer_, &heard), 0) << sigmascape_last_error();
    const auto signal = numbers(heard);
    signals.emplace_back(signal.begin(), signal.end());
    sigmascape_free_receiver(receiver);
  }
  EXPECT_EQ(signals[0], signals[1]);
  EXPECT_EQ(
      sigmascape_make_receiver_of_text("[radar]\nfrequency_ghz = -1\n", nullptr, SIGMASCAPE_VV, ground_, nullptr, 1),
      nullptr);
  EXPECT_THAT(sigmascape_last_error(), testing::HasSubstr("radar.frequency_ghz"));
  EXPECT_EQ(sigmascape_make_receiver_of_text(nullptr, nullptr, SIGMASCAPE_VV, ground_, nullptr, 1), nullptr);
}

TEST_F(ReceiverFromC, TheGroundTellsWhatOfItIsThere) {
  settle(said_in_c(view_.pose()));
  sigmascape_ground_report report;
  ASSERT_EQ(sigmascape_report(ground_, &report), 0) << sigmascape_last_error();
  EXPECT_GT(report.pages, 0U);
  EXPECT_GE(report.page_bytes, report.pages * 256U * 256U);
  EXPECT_GE(report.loaded, report.pages);
  EXPECT_EQ(report.evicted, 0U);
  EXPECT_EQ(report.refused, 0U);
  EXPECT_EQ(report.damaged, 0U);
  EXPECT_GT(report.terrain_bytes, 0U);
  EXPECT_EQ(report.terrain_faults, 0U);
  EXPECT_NE(sigmascape_report(ground_, nullptr), 0);
  EXPECT_NE(sigmascape_report(nullptr, &report), 0);
}

TEST_F(ReceiverFromC, StepsComeToTheWholeFrame) {
  sigmascape_pose before = said_in_c(view_.pose());
  before.position_m[0] += 200.0;
  settle(before);
  sigmascape_receiver* receiver = sigmascape_make_receiver(radar_file().c_str(), SIGMASCAPE_VV, ground_, nullptr, 2);
  sigmascape_heard heard;
  ASSERT_EQ(sigmascape_hear(receiver, renderer_, &heard), 0);
  EXPECT_EQ(heard.changed, view_.beams);
  const sigmascape_pose pose = said_in_c(view_.pose());
  sigmascape_frame frame;
  for (std::size_t first = 0; first < view_.beams; first += 16) {
    ASSERT_EQ(sigmascape_scan(renderer_, &pose, first, 16, &frame), 0);
    ASSERT_EQ(sigmascape_wait_for_pages(ground_), 0);
    ASSERT_EQ(sigmascape_hear(receiver, renderer_, &heard), 0);
    EXPECT_LE(heard.first_changed, first);
    EXPECT_GT(heard.changed, 16U);
    EXPECT_LT(heard.changed, view_.beams);
  }
  sigmascape_receiver* at_once = sigmascape_make_receiver(radar_file().c_str(), SIGMASCAPE_VV, ground_, nullptr, 1);
  sigmascape_heard whole;
  ASSERT_EQ(sigmascape_hear(at_once, renderer_, &whole), 0);
  EXPECT_EQ(numbers(heard), numbers(whole));
  // Of one that has missed a step both are heard.
  ASSERT_EQ(sigmascape_scan(renderer_, &before, 0, 8, &frame), 0);
  ASSERT_EQ(sigmascape_scan(renderer_, &before, 8, 8, &frame), 0);
  ASSERT_EQ(sigmascape_hear(receiver, renderer_, &heard), 0);
  EXPECT_GT(heard.changed, 16U);
  EXPECT_LT(heard.changed, view_.beams);
  ASSERT_EQ(sigmascape_hear(at_once, renderer_, &whole), 0);
  EXPECT_EQ(numbers(heard), numbers(whole));
  sigmascape_free_receiver(receiver);
  sigmascape_free_receiver(at_once);
}

TEST_F(ReceiverFromC, StepsThatWereMissedAfterAWholeFrameAreHeard) {
  constexpr std::size_t whole_frames = 12, receivers = 24;
  const sigmascape_pose pose = said_in_c(view_.pose());
  sigmascape_frame frame;
  for (std::size_t number = 0; number < whole_frames; ++number)
    ASSERT_EQ(sigmascape_render(renderer_, &pose, &frame), 0) << sigmascape_last_error();
  std::vector<sigmascape_receiver*> made;
  sigmascape_heard heard;
  for (std::size_t number = 0; number < receivers; ++number) {
    made.push_back(sigmascape_make_receiver(even_radar_file().c_str(), SIGMASCAPE_VV, nullptr, nullptr, 1));
    ASSERT_EQ(sigmascape_hear(made.back(), renderer_, &heard), 0) << sigmascape_last_error();
  }
  sigmascape_pose beside = pose;
  beside.position_m[0] += 100.0;
  ASSERT_EQ(sigmascape_scan(renderer_, &beside, 0, 8, &frame), 0);
  for (std::size_t number = 0; number < receivers; ++number) {
    ASSERT_EQ(sigmascape_scan(renderer_, &pose, 32, 8, &frame), 0);
    ASSERT_EQ(sigmascape_hear(made[number], renderer_, &heard), 0);
    const std::vector<float> late = numbers(heard);
    sigmascape_receiver* fresh =
        sigmascape_make_receiver(even_radar_file().c_str(), SIGMASCAPE_VV, nullptr, nullptr, 1);
    ASSERT_EQ(sigmascape_hear(fresh, renderer_, &heard), 0);
    EXPECT_EQ(late, numbers(heard)) << "missed steps: " << number + 1;
    sigmascape_free_receiver(fresh);
    sigmascape_free_receiver(made[number]);
  }
}

TEST_F(ReceiverFromC, APoseThatIsRefusedLeavesTheLastFrameToBeHeard) {
  const sigmascape_pose pose = said_in_c(view_.pose());
  settle(pose);
  sigmascape_receiver* receiver =
      sigmascape_make_receiver(even_radar_file().c_str(), SIGMASCAPE_VV, nullptr, nullptr, 1);
  sigmascape_heard heard;
  ASSERT_EQ(sigmascape_hear(receiver, renderer_, &heard), 0) << sigmascape_last_error();
  const std::vector<float> before = numbers(heard);
  sigmascape_pose below = pose;
  std::ranges::copy(std::array{view_.target.x, view_.target.y, -500.0}, below.position_m);
  sigmascape_frame frame;
  EXPECT_NE(sigmascape_scan(renderer_, &below, 0, 8, &frame), 0);
  ASSERT_EQ(sigmascape_hear(receiver, renderer_, &heard), 0) << sigmascape_last_error();
  EXPECT_EQ(numbers(heard), before);
  ASSERT_EQ(sigmascape_scan(renderer_, &pose, 8, 8, &frame), 0);
  ASSERT_EQ(sigmascape_hear(receiver, renderer_, &heard), 0);
  EXPECT_LT(heard.changed, view_.beams);
  EXPECT_EQ(numbers(heard), before);
  sigmascape_free_receiver(receiver);
}

TEST_F(ReceiverFromC, SaysWhyItCannotHear) {
  EXPECT_EQ(sigmascape_make_receiver("nowhere.toml", SIGMASCAPE_VV, ground_, nullptr, 0), nullptr);
  EXPECT_THAT(sigmascape_last_error(), testing::HasSubstr("nowhere.toml"));
  EXPECT_EQ(sigmascape_make_receiver(nullptr, SIGMASCAPE_VV, ground_, nullptr, 0), nullptr);
  EXPECT_EQ(sigmascape_make_receiver(radar_file().c_str(), SIGMASCAPE_VV, nullptr, nullptr, 0), nullptr);
  EXPECT_THAT(sigmascape_last_error(), testing::HasSubstr("elevations apart"));
  sigmascape_polarization of_no_polarization;
  constexpr int no_polarization = 7;
  std::memcpy(&of_no_polarization, &no_polarization, sizeof no_polarization);
  EXPECT_EQ(sigmascape_make_receiver(radar_file().c_str(), of_no_polarization, ground_, nullptr, 0), nullptr);

  sigmascape_receiver* receiver =
      sigmascape_make_receiver(even_radar_file().c_str(), SIGMASCAPE_VV, nullptr, nullptr, 0);
  ASSERT_NE(receiver, nullptr) << sigmascape_last_error();
  sigmascape_heard heard = {};
  EXPECT_NE(sigmascape_hear(receiver, renderer_, &heard), 0);
  EXPECT_THAT(sigmascape_last_error(), testing::HasSubstr("nothing has been drawn"));
  EXPECT_NE(sigmascape_hear(receiver, nullptr, &heard), 0);
  EXPECT_NE(sigmascape_hear(nullptr, renderer_, &heard), 0);
  settle(said_in_c(view_.pose()));
  EXPECT_NE(sigmascape_hear(receiver, renderer_, nullptr), 0);
  EXPECT_EQ(heard.signal_w, nullptr);
  EXPECT_EQ(sigmascape_hear(receiver, renderer_, &heard), 0);
  sigmascape_free_receiver(receiver);

  std::ofstream(folder_->path("s_band.toml")) << radar_text("3.0", "");
  receiver =
      sigmascape_make_receiver(folder_->path("s_band.toml").string().c_str(), SIGMASCAPE_VV, nullptr, nullptr, 0);
  ASSERT_NE(receiver, nullptr) << sigmascape_last_error();
  EXPECT_NE(sigmascape_hear(receiver, renderer_, &heard), 0);
  EXPECT_THAT(sigmascape_last_error(), testing::HasSubstr("3 GHz"));
  sigmascape_free_receiver(receiver);
  sigmascape_free_receiver(nullptr);
}

}  // namespace
}  // namespace sigmascape
