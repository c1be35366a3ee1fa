#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "live_ground_example.h"

namespace sigmascape::live {
namespace {

/// Beams of 117 m and ranges of 12 m: in each beam there is a ridge and a valley.
class LiveWideBeams : public testing::Test {
 protected:
  static constexpr double wave_m = 117.0;

  [[nodiscard]] static ExampleGround ground_of(std::function<double(Vec2d)> height_m) {
    ExampleGround ground;
    ground.sigma0 = [](const radar::Look& look) { return constant_gamma(0.1, look); };
    ground.height_m = std::move(height_m);
    return ground;
  }
  [[nodiscard]] LiveSettings settings() const {
    LiveSettings settings = view_.settings(FrameContent::Powers);
    settings.beam_step_rad = 0.03;
    return settings;
  }
  [[nodiscard]] Pose pose() const {
    Pose pose = view_.pose();
    pose.first_azimuth_rad = pi - 0.03 * 6.0;
    return pose;
  }
  [[nodiscard]] FrameReport report_of(const ExampleGround& example, const Pose& pose) const {
    const ScratchFolder folder;
    const atlas::Store store = example.store(folder.path("atlas"));
    atlas::Pyramid(store).make_above(store.units());
    const auto ground = example.over(store);
    LiveRenderer renderer(ground, settings());
    return settled_frame(renderer, *ground, pose).report;
  }

  ExampleView view_{.azimuth_deg = 0.0, .beams = 12};
};

/// Ridges that run away from the radar are nowhere steeper along a line of sight than that itself falls. What lies half
/// a beam beyond the outermost lines, a thirteenth of all, has theirs.
TEST_F(LiveWideBeams, SeeAllGroundThatNothingHides) {
  const auto ridges = ground_of([](Vec2d at) { return 10.0 * std::cos(2.0 * pi * at.x / wave_m); });
  const FrameReport report = report_of(ridges, pose());
  EXPECT_EQ(report.dark, 0U);
  EXPECT_GT(static_cast<double>(report.lit), 0.9 * static_cast<double>(report.cells));
}

TEST_F(LiveWideBeams, SeeTargetsInValleysWithinABeam) {
  const auto height_m = [](Vec2d at) { return 10.0 * std::cos(2.0 * pi * at.x / wave_m); };
  const ExampleGround ridges = ground_of(height_m);
  std::vector<radar::Target> targets;
  for (double x = -500.0; x <= 500.0; x += 20.0) {
    radar::Target& target = targets.emplace_back();
    const Vec2d at{x, 0.0};
    target.track = radar::Track::straight({ridges.middle().x + at.x, ridges.middle().y, height_m(at) + 0.5});
    target.rcs_m2 = radar::Channels{1.0F, 1.0F, 0.0F, 1.0F};
  }
  Pose looking = pose();
  looking.targets = targets;
  EXPECT_EQ(report_of(ridges, looking).targets, targets.size());
}

/// What a peak lays over is no length of the bins.
TEST_F(LiveWideBeams, HaveTheLevelOfTheirBinsWhateverStandsBeside) {
  view_.elevation_deg = 37.0;
  const auto level_with = [&](double peak_m) {
    const auto peak = ground_of([peak_m](Vec2d at) { return length(at - Vec2d{0.0, 1000.0}) < 60.0 ? peak_m : 0.0; });
    return report_of(peak, pose()).level;
  };
  EXPECT_EQ(level_with(0.0), 0U);
  EXPECT_EQ(level_with(1000.0), 0U);
}

TEST_F(LiveWideBeams, CountNoTargetsBeyondTheirRanges) {
  const ExampleGround level = ground_of([](Vec2d) { return 0.0; });
  radar::Target beyond;
  beyond.track = radar::Track::straight({level.middle().x, level.middle().y - 500.0, 1.0});
  beyond.rcs_m2 = radar::Channels{1.0F, 1.0F, 0.0F, 1.0F};
  const std::vector<radar::Target> targets{beyond};
  Pose looking = pose();
  looking.targets = targets;
  EXPECT_EQ(report_of(level, looking).targets, 0U);
}

}  // namespace
}  // namespace sigmascape::live
