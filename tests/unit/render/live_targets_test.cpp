#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include "live_ground_example.h"

#include "sigmascape/atlas/pyramid.h"

namespace sigmascape::render {
namespace {

radar::Target standing(Vec2d place, double height_m, float rcs_m2 = 10.0F) {
  radar::Target target;
  target.track = radar::Track::straight(Vec3d{place.x, place.y, height_m});
  target.rcs_m2 = radar::Channels{rcs_m2, 0.5F * rcs_m2, 0.1F * rcs_m2, -0.3F * rcs_m2};
  return target;
}

/// All tests look at one atlas; what they make of its ground is their own.
class LiveTargetsTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<ScratchFolder>();
    store_ = std::make_unique<atlas::Store>(level_ground().store(folder_->path("atlas")));
    atlas::Pyramid(*store_).make_above(store_->units());
  }
  static void TearDownTestSuite() {
    store_.reset();
    folder_.reset();
  }
  static ExampleGround level_ground() {
    ExampleGround ground;
    ground.sigma0 = [](const radar::Look& look) { return constant_gamma(0.01, look); };
    return ground;
  }
  static inline std::unique_ptr<ScratchFolder> folder_;
  static inline std::unique_ptr<atlas::Store> store_;
};

/// What a target adds to a frame, in powers and, as |a|², in amplitudes; VV of all bins together.
struct Added {
  double power_m2 = 0.0, amplitude_m2 = 0.0;
  std::size_t level = 0, seen = 0;
};

Added added_by(const std::vector<radar::Target>& targets, const std::shared_ptr<LiveGround>& ground,
               const ExampleView& view) {
  Added added;
  Pose pose = view.pose();
  for (const FrameContent content : {FrameContent::Powers, FrameContent::Amplitudes}) {
    LiveRenderer renderer(ground, view.settings(content));
    pose.targets = {};
    const Frame& empty = settled_frame(renderer, *ground, pose);
    const std::vector<float> powers(empty.powers_m2.begin(), empty.powers_m2.end());
    const std::vector<std::complex<float>> amplitudes(empty.amplitudes_m.begin(), empty.amplitudes_m.end());
    pose.targets = targets;
    const Frame& frame = renderer.render(pose);
    added.level = frame.report.level;
    added.seen = frame.report.targets;
    for (std::size_t i = 0; i < powers.size(); i += 4) {
      added.power_m2 += static_cast<double>(frame.powers_m2[i]) - static_cast<double>(powers[i]);
    }
    for (std::size_t i = 0; i < amplitudes.size(); i += 4) {
      added.amplitude_m2 += static_cast<double>(std::norm(frame.amplitudes_m[i] - amplitudes[i]));
    }
  }
  return added;
}

TEST_F(LiveTargetsTest, TenSquareMetresAreTenSquareMetresAtEveryLevel) {
  const auto ground = level_ground().over(*store_);
  std::size_t coarsest = 0;
  for (const double bin_m : {8.0, 16.0, 32.0, 64.0}) {
    ExampleView view;
    view.bin_m = bin_m;
    view.ranges = view.beams = 24;
    const std::vector<radar::Target> targets{standing(view.target + Vec2d{3.0, 7.0}, 1.5)};
    const Added added = added_by(targets, ground, view);
    EXPECT_NEAR(db_from_linear(added.power_m2 / 10.0), 0.0, 0.01) << bin_m;
    EXPECT_NEAR(db_from_linear(added.amplitude_m2 / 10.0), 0.0, 0.01) << bin_m;
    coarsest = std::max(coarsest, added.level);
  }
  EXPECT_EQ(coarsest, ground->coarsest_level());
}

TEST_F(LiveTargetsTest, OnlyTerrainHidesThemHoweverCoarse) {
  ExampleGround ridge = level_ground();
  ridge.height_m = [](Vec2d p) { return std::abs(p.y) < 40.0 ? 30.0 : 0.0; };
  const auto ground = ridge.over(*store_);
  for (const double bin_m : {8.0, 48.0}) {
    ExampleView view;
    view.bin_m = bin_m;
    view.azimuth_deg = 0.0;
    // Seen from the north under 13°: in the open, on the ridge, in its shadow, and above the shadow.
    const auto seen = [&](double north_m, double height_m) {
      const std::vector<radar::Target> targets{standing(view.target + Vec2d{0.0, north_m}, height_m)};
      return added_by(targets, ground, view);
    };
    EXPECT_NEAR(seen(80.0, 1.0).power_m2, 10.0, 0.1) << bin_m;
    EXPECT_NEAR(seen(0.0, 31.0).power_m2, 10.0, 0.1) << bin_m;
    EXPECT_EQ(seen(-90.0, 1.0).seen, 0U) << bin_m;
    EXPECT_NEAR(seen(-90.0, 40.0).power_m2, 10.0, 0.1) << bin_m;
  }
}

TEST_F(LiveTargetsTest, StandOnTheGroundOfTheFrame) {
  // Coarse terrain lies above these hollows; what was put on their floors is seen all the same.
  ExampleGround hollows = level_ground();
  hollows.height_m = [](Vec2d p) { return 3.0 * std::cos(p.x / 24.0 * 2.0 * pi) * std::cos(p.y / 24.0 * 2.0 * pi); };
  const auto ground = hollows.over(*store_);
  ExampleView view{.elevation_deg = 5.0};
  view.bin_m = 64.0;
  view.ranges = view.beams = 24;
  std::vector<radar::Target> targets;
  for (int i = 0; i < 8; ++i) targets.push_back(standing(view.target + Vec2d{12.0 + 24.0 * i, 0.0}, -3.0));
  EXPECT_EQ(added_by(targets, ground, view).seen, 8U);
}

TEST_F(LiveTargetsTest, AScanGivesTheBytesOfAFrame) {
  const auto ground = level_ground().over(*store_);
  const ExampleView view;
  std::vector<radar::Target> targets;
  for (int i = 0; i < 500; ++i) {
    targets.push_back(standing(view.target + Vec2d{-200.0 + 0.8 * i, 150.0 * std::sin(0.7 * i)}, 2.0));
  }
  Pose pose = view.pose();
  pose.targets = targets;
  LiveRenderer at_once(ground, view.settings(FrameContent::Amplitudes, 1));
  LiveRenderer scanning(ground, view.settings(FrameContent::Amplitudes, 3));
  const Frame& whole = settled_frame(at_once, *ground, pose);
  EXPECT_GT(whole.report.targets, 400U);
  settled_frame(scanning, *ground, pose);
  for (std::size_t beam = 0; beam < view.beams; beam += 16) scanning.scan(pose, beam, 16);
  const Frame& swept = scanning.scan(pose, 0, 16);
  EXPECT_TRUE(std::ranges::equal(whole.amplitudes_m, swept.amplitudes_m));
}

TEST_F(LiveTargetsTest, AMoverIsWhereItsTrackSaysAtTheMoment) {
  const auto ground = level_ground().over(*store_);
  ExampleView view;
  view.azimuth_deg = 0.0;
  radar::Target mover = standing(view.target, 1.0, 1e6F);
  mover.track = radar::Track::straight(Vec3d{view.target.x, view.target.y, 1.0}, Vec3d{0.0, -30.0, 0.0});
  const std::vector<radar::Target> targets{mover};
  LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
  Pose pose = view.pose();
  pose.targets = targets;
  settled_frame(renderer, *ground, pose);
  const auto range_of_target = [&](double time_s) {
    pose.moment.time_s = time_s;
    const Frame& frame = renderer.render(pose);
    double sum = 0.0, moment = 0.0;
    for (std::size_t i = 0; i < frame.powers_m2.size(); i += 4) {
      if (frame.powers_m2[i] < 1e4F) continue;
      sum += static_cast<double>(frame.powers_m2[i]);
      moment += static_cast<double>(frame.powers_m2[i]) * static_cast<double>(i / 4 % view.ranges);
    }
    return moment / sum * frame.grid.range_step_m;
  };
  // Away from the radar in the north, which sees it under 13°.
  EXPECT_NEAR(range_of_target(5.0) - range_of_target(0.0), 150.0 * std::cos(radians_from_deg(13.0)), 1.0);
}

}  // namespace
}  // namespace sigmascape::render
