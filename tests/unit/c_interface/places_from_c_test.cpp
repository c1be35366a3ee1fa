#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <string>

#include "scratch_folder.h"
#include "unit/c_interface/said_in_c.h"
#include "unit/live/live_ground_example.h"

#include "sigmascape/atlas/terrain_file.h"
#include "sigmascape/c_interface/sigmascape.h"
#include "sigmascape/terrain/height_field_file.h"

namespace sigmascape {
namespace {

/// An atlas about 0° N, 0° E, over an even slope.
class PlacesFromC : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<ScratchFolder>();
    example_.sigma0 = [](const radar::Look& look) { return live::constant_gamma(0.1, look); };
    example_.height_m = [](Vec2d way) { return 50.0 + 0.1 * way.x; };
    const auto store = example_.store(folder_->path("atlas"));
    terrain::write_height_field(folder_->path("atlas") / atlas::terrain_name, example_.terrain(),
                                store.description().frame.proj());
    atlas::vouch_for_terrain(store);
    ground_ = sigmascape_open_ground(folder_->path("atlas").string().c_str(), 10e9, 0);
  }
  static void TearDownTestSuite() {
    sigmascape_close_ground(ground_);
    folder_.reset();
  }
  void SetUp() override { ASSERT_NE(ground_, nullptr) << sigmascape_last_error(); }

  static inline live::ExampleGround example_;
  static inline std::unique_ptr<ScratchFolder> folder_;
  static inline sigmascape_ground* ground_ = nullptr;
};

using ::testing::HasSubstr;

TEST_F(PlacesFromC, DegreesBecomeMetresAndTurnBack) {
  // A degree of the meridian from the equator is 110 574.389 m on the WGS 84 ellipsoid. One of the equator, of the
  // radius a and the second eccentricity e'², is a (λ + (1 + e'²) λ³/6) in a transverse Mercator projection (Snyder,
  // Map Projections, USGS 1395, Eq. 8-9).
  const double degree_rad = std::acos(-1.0) / 180.0, cube = degree_rad * degree_rad * degree_rad;
  const double east_m = 6378137.0 * (degree_rad + 1.00673949674 * cube / 6.0);
  double position_m[3] = {};
  ASSERT_EQ(sigmascape_place_in_frame(ground_, 1.0, 0.0, 321.0, position_m), 0) << sigmascape_last_error();
  EXPECT_NEAR(position_m[0], 0.0, 1e-3);
  EXPECT_NEAR(position_m[1], 110574.389, 1e-2);
  EXPECT_EQ(position_m[2], 321.0);
  ASSERT_EQ(sigmascape_place_in_frame(ground_, 0.0, 1.0, 0.0, position_m), 0) << sigmascape_last_error();
  EXPECT_NEAR(position_m[0], east_m, 1e-2);
  EXPECT_NEAR(position_m[1], 0.0, 1e-3);

  const double place_m[3] = {east_m, 0.0, 17.0};
  double latitude_deg = 9.0, longitude_deg = 9.0, height_m = 9.0;
  ASSERT_EQ(sigmascape_place_on_globe(ground_, place_m, &latitude_deg, &longitude_deg, &height_m), 0);
  EXPECT_NEAR(latitude_deg, 0.0, 1e-7);
  EXPECT_NEAR(longitude_deg, 1.0, 1e-7);
  EXPECT_EQ(height_m, 17.0);
  EXPECT_EQ(sigmascape_place_on_globe(ground_, place_m, nullptr, nullptr, nullptr), 0);
}

TEST_F(PlacesFromC, PlacesThatAreNowhereAreRefused) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  double position_m[3] = {1.0, 2.0, 3.0};
  EXPECT_NE(sigmascape_place_in_frame(ground_, 91.0, 0.0, 0.0, position_m), 0);
  EXPECT_THAT(sigmascape_last_error(), HasSubstr("latitude 91"));
  EXPECT_NE(sigmascape_place_in_frame(ground_, 0.0, nan, 0.0, position_m), 0);
  EXPECT_NE(sigmascape_place_in_frame(ground_, 0.0, 179.0, 0.0, position_m), 0);
  EXPECT_THAT(sigmascape_last_error(), HasSubstr("does not reach"));
  EXPECT_NE(sigmascape_place_in_frame(nullptr, 0.0, 0.0, 0.0, position_m), 0);
  EXPECT_THAT(sigmascape_last_error(), HasSubstr("ground: is null"));
  EXPECT_NE(sigmascape_place_in_frame(ground_, 0.0, 0.0, 0.0, nullptr), 0);
  EXPECT_THAT(position_m, testing::ElementsAre(1.0, 2.0, 3.0)) << "what is refused leaves it";
  const double nowhere_m[3] = {nan, 0.0, 0.0};
  EXPECT_NE(sigmascape_place_on_globe(ground_, nowhere_m, nullptr, nullptr, nullptr), 0);
  EXPECT_THAT(sigmascape_last_error(), HasSubstr("nowhere on the globe"));
  EXPECT_NE(sigmascape_place_on_globe(ground_, nullptr, nullptr, nullptr, nullptr), 0);
}

TEST_F(PlacesFromC, TheAtlasSaysWhatItCoversAndHowHighItsGroundIs) {
  sigmascape_rectangle extent = {};
  ASSERT_EQ(sigmascape_extent(ground_, &extent), 0) << sigmascape_last_error();
  EXPECT_EQ(extent.west_m, 0.0);
  EXPECT_EQ(extent.south_m, 0.0);
  EXPECT_EQ(extent.east_m, example_.side_m());
  EXPECT_EQ(extent.north_m, example_.side_m());
  EXPECT_NE(sigmascape_extent(ground_, nullptr), 0);

  double height_m = 0.0;
  for (const Vec2d way : {Vec2d{0.0, 0.0}, {-123.0, 45.0}, {310.0, -7.0}}) {
    const Vec2d place = example_.middle() + way;
    ASSERT_EQ(sigmascape_ground_height(ground_, place.x, place.y, &height_m), 0) << sigmascape_last_error();
    EXPECT_NEAR(height_m, 50.0 + 0.1 * way.x, 1e-2);
  }
  height_m = 7.0;
  EXPECT_NE(sigmascape_ground_height(ground_, -50e3, 0.0, &height_m), 0);
  EXPECT_THAT(sigmascape_last_error(), HasSubstr("has no terrain"));
  // 100 m of it lie beside the atlas; its last tile reaches further.
  EXPECT_NE(sigmascape_ground_height(ground_, example_.side_m() + 110.0, 0.0, &height_m), 0);
  EXPECT_NE(sigmascape_ground_height(ground_, std::nan(""), 0.0, &height_m), 0);
  EXPECT_EQ(height_m, 7.0);
  EXPECT_NE(sigmascape_ground_height(ground_, 0.0, 0.0, nullptr), 0);
}

TEST_F(PlacesFromC, AFrameSaysThatTheRadarIsBelowTheGround) {
  const live::ExampleView view;
  sigmascape_settings settings = said_in_c(view.settings(live::FrameContent::Powers));
  sigmascape_renderer* renderer = sigmascape_make_renderer(ground_, &settings);
  ASSERT_NE(renderer, nullptr) << sigmascape_last_error();
  const Vec2d high = example_.middle() + Vec2d{500.0, 0.0};
  sigmascape_pose pose = said_in_c(view.pose());
  pose.position_m[0] = high.x;
  pose.position_m[1] = high.y;
  const auto below_m = [&](double radar_m) {
    pose.position_m[2] = radar_m;
    sigmascape_frame frame = {};
    EXPECT_EQ(sigmascape_render(renderer, &pose, &frame), 0) << sigmascape_last_error();
    sigmascape_wait_for_pages(ground_);
    EXPECT_EQ(sigmascape_render(renderer, &pose, &frame), 0) << sigmascape_last_error();
    return frame.below_ground_m;
  };
  EXPECT_NEAR(below_m(100.0 - 20.0), 20.0, 0.5);
  EXPECT_EQ(below_m(100.0 + 20.0), 0.0);
  pose.position_m[2] = -5000.0;
  sigmascape_frame frame = {};
  EXPECT_NE(sigmascape_render(renderer, &pose, &frame), 0);
  EXPECT_THAT(sigmascape_last_error(), HasSubstr("below all ground"));
  sigmascape_free_renderer(renderer);
}

}  // namespace
}  // namespace sigmascape
