#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "live_ground_example.h"

#include "sigmascape/base/error.h"

namespace sigmascape::live {
namespace {

constexpr double summit_m = 200.0;

/// A radar somewhere over a dome, which looks north from there.
class LiveBelowGround : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<ScratchFolder>();
    example_.sigma0 = [](const radar::Look& look) { return constant_gamma(0.1, look); };
    example_.height_m = [](Vec2d way) { return summit_m * std::exp(-dot(way, way) / (2.0 * 400.0 * 400.0)); };
    store_ = std::make_unique<atlas::Store>(example_.store(folder_->path("atlas")));
  }
  static void TearDownTestSuite() {
    store_.reset();
    folder_.reset();
  }

  [[nodiscard]] static Pose pose_at(Vec2d way, double height_m, double first_range_m = 600.0) {
    const Vec2d foot = example_.middle() + way;
    return {.position = {foot.x, foot.y, height_m}, .first_azimuth_rad = -0.1, .first_range_m = first_range_m};
  }
  [[nodiscard]] static LiveSettings settings() {
    return {.content = FrameContent::Powers,
            .beams = 20,
            .ranges = 40,
            .beam_step_rad = 0.01,
            .range_step_m = 8.0,
            .threads = 1};
  }
  [[nodiscard]] static double below_ground_m(const Pose& pose) {
    const auto ground = example_.over(*store_);
    LiveRenderer renderer(ground, settings());
    return settled_frame(renderer, *ground, pose).report.below_ground_m;
  }

  static inline ExampleGround example_;
  static inline std::unique_ptr<ScratchFolder> folder_;
  static inline std::unique_ptr<atlas::Store> store_;
};

TEST_F(LiveBelowGround, ARadarInsideAHillIsTold) {
  for (const double first_range_m : {0.0, 600.0}) {
    EXPECT_NEAR(below_ground_m(pose_at({}, summit_m - 50.0, first_range_m)), 50.0, 2.0) << first_range_m;
    EXPECT_EQ(below_ground_m(pose_at({}, summit_m + 10.0, first_range_m)), 0.0) << first_range_m;
    // Beside the hill the same height is above the ground.
    EXPECT_EQ(below_ground_m(pose_at({0.0, -900.0}, summit_m - 50.0, first_range_m)), 0.0) << first_range_m;
  }
}

TEST_F(LiveBelowGround, NoGroundThatIsNotSureIsTold) {
  const auto ground = example_.over(*store_);
  LiveRenderer renderer(ground, settings());
  // Of the first frame, over the coarsest terrain, no more than what is true.
  EXPECT_LE(renderer.render(pose_at({}, summit_m - 50.0)).report.below_ground_m, 50.1);
  EXPECT_EQ(renderer.render(pose_at({}, summit_m + 1.0)).report.below_ground_m, 0.0);
}

TEST_F(LiveBelowGround, ARadarBelowAllGroundIsRefused) {
  const auto ground = example_.over(*store_);
  LiveRenderer renderer(ground, settings());
  const std::size_t cells = renderer.render(pose_at({}, 1000.0)).report.cells;
  try {
    renderer.render(pose_at({}, -5000.0));
    FAIL() << "nothing can be seen from there";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("below all ground"));
  }
  EXPECT_EQ(renderer.render(pose_at({}, 1000.0)).report.cells, cells);
}

TEST_F(LiveBelowGround, ARadarBeyondTheTerrainIsToldBelowTheLowestGroundAndTheSea) {
  const auto ground = example_.over(*store_);
  LiveRenderer renderer(ground, settings());
  const auto below_m = [&](Vec2d way, double height_m) {
    return renderer.render(pose_at(way, height_m)).report.below_ground_m;
  };
  EXPECT_EQ(below_m({0.0, -50e3}, -10.0), 10.0);
  EXPECT_EQ(below_m({0.0, -3000.0}, -1000.0), 1000.0);
  // What ground there may be nobody knows, but none below the sea is known of.
  EXPECT_EQ(below_m({0.0, -50e3}, 10.0), 0.0);
  EXPECT_EQ(below_m({0.0, -900.0}, 1000.0), 0.0);
}

}  // namespace
}  // namespace sigmascape::live
