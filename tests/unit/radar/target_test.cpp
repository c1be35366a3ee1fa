#include "sigmascape/radar/target.h"

#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"

namespace sigmascape::radar {
namespace {

TEST(Track, goes_from_way_point_to_way_point_at_even_speed) {
  const Track track =
      Track::through({{10.0, {0.0, 0.0, 0.0}}, {20.0, {100.0, 0.0, 10.0}}, {30.0, {100.0, 50.0, 10.0}}});
  EXPECT_EQ(track.position_at(15.0), (Vec3d{50.0, 0.0, 5.0}));
  EXPECT_EQ(track.velocity_at(15.0), (Vec3d{10.0, 0.0, 1.0}));
  EXPECT_EQ(track.position_at(25.0), (Vec3d{100.0, 25.0, 10.0}));
  EXPECT_EQ(track.velocity_at(25.0), (Vec3d{0.0, 5.0, 0.0}));
  EXPECT_EQ(track.position_at(0.0), (Vec3d{0.0, 0.0, 0.0}));
  EXPECT_EQ(track.position_at(99.0), (Vec3d{100.0, 50.0, 10.0}));
  EXPECT_EQ(track.velocity_at(99.0), (Vec3d{}));
}

TEST(Track, that_is_straight_never_ends) {
  const Track track = Track::straight({1.0, 2.0, 3.0}, {10.0, 0.0, -1.0});
  EXPECT_EQ(track.position_at(-2.0), (Vec3d{-19.0, 2.0, 5.0}));
  EXPECT_EQ(track.velocity_at(1e6), (Vec3d{10.0, 0.0, -1.0}));
}

TEST(Track, counts_from_another_moment) {
  const Track straight = Track::straight({1.0, 2.0, 3.0}, {10.0, 0.0, -1.0});
  const Track legs = Track::through({{10.0, {0.0, 0.0, 0.0}}, {20.0, {100.0, 0.0, 10.0}}});
  for (const Track& track : {straight, legs}) {
    const Track later = track.counted_from(4.0);
    for (const double time_s : {-3.0, 0.0, 7.5, 12.0, 40.0}) {
      EXPECT_EQ(later.position_at(time_s), track.position_at(time_s + 4.0));
      EXPECT_EQ(later.velocity_at(time_s), track.velocity_at(time_s + 4.0));
    }
  }
}

/// Range rates of straight tracks and of legs, against those of every place bent on its own.
TEST(Track, bent_has_the_range_rate_of_the_curved_earth) {
  constexpr CurvedEarth earth;
  constexpr Vec2d foot{0.0, 0.0};
  constexpr Vec3d radar{0.0, 0.0, 10e3};
  constexpr double step_s = 0.01, time_s = 15.0;
  const Track straight = Track::straight({100e3, 5e3, 2000.0}, {250.0, -40.0, 8.0});
  const Track legs = Track::through({{10.0, {100e3, 5e3, 2000.0}}, {20.0, {102e3, 5e3, 2100.0}}, {30.0, {0, 0, 0}}});
  for (const Track& track : {straight, legs}) {
    const auto range_m = [&](double at_s) { return length(earth.bent(track.position_at(at_s), foot) - radar); };
    const Track bent = track.bent(earth, foot, time_s);
    const Vec3d away = bent.position_at(time_s) - radar;
    EXPECT_NEAR(length(away), range_m(time_s), 1e-6);
    const double expected_mps = (range_m(time_s + step_s) - range_m(time_s - step_s)) / (2.0 * step_s);
    EXPECT_NEAR(dot(bent.velocity_at(time_s), normalized(away)), expected_mps, 1e-4);
    EXPECT_GT(std::abs(dot(track.velocity_at(time_s), normalized(away)) - expected_mps), 0.1) << "left unturned";
  }
}

TEST(Track, refuses_way_points_out_of_order) {
  EXPECT_THROW((void)Track::through({}), Error);
  EXPECT_THROW((void)Track::through({{1.0, {}}, {1.0, {1.0, 0.0, 0.0}}}), Error);
}

TEST(Target, answers_by_the_aspect_from_its_nose) {
  RcsTable table;
  table.azimuths_rad = {0.0, pi / 2.0, pi, 1.5 * pi};
  table.elevations_rad = {0.0};
  table.frequencies_hz = {10e9};
  table.rcs_m2 = {
      {1.0F, 1.0F, 0.0F, 1.0F}, {100.0F, 100.0F, 0.0F, 100.0F}, {4.0F, 4.0F, 0.0F, 4.0F}, {9.0F, 9.0F, 0.0F, 9.0F}};
  Target target;
  target.rcs_m2 = table;
  target.track = Track::straight({}, {5.0, 0.0, 0.0});                         // eastward
  EXPECT_NEAR(rcs_of(target, {1000.0, 0.0, 0.0}, 10e9, {}).vv, 1.0, 1e-4);     // from ahead
  EXPECT_NEAR(rcs_of(target, {0.0, -1000.0, 0.0}, 10e9, {}).vv, 100.0, 1e-2);  // from its right
  EXPECT_NEAR(rcs_of(target, {-1000.0, 0.0, 0.0}, 10e9, {}).vv, 4.0, 1e-3);
  EXPECT_NEAR(rcs_of(target, {1000.0, -1000.0, 0.0}, 10e9, {}).vv, 50.5, 1e-2);
  target.track = Track::straight({});
  target.heading_rad = 0.0;
  EXPECT_NEAR(rcs_of(target, {0.0, 1000.0, 0.0}, 10e9, {}).vv, 1.0, 1e-4);
}

/// At 100 km the radar stands 0.67° lower over the target's horizontal than the target lies below the radar's, whether
/// that is reckoned in the local frame or in the straight space, and the nose points where it did.
TEST(Target, answers_by_the_elevation_over_its_own_horizontal) {
  constexpr CurvedEarth earth;
  constexpr Vec3d radar{0.0, 0.0, 10e3}, place{0.0, 100e3, 500.0};
  RcsTable table;
  table.azimuths_rad = {0.0, pi};
  table.elevations_rad = {0.0, radians_from_deg(10.0)};
  table.frequencies_hz = {10e9};
  const Channels none{}, of_ten{10.0F, 10.0F, 0.0F, 10.0F};
  table.rcs_m2 = {none, none, of_ten, of_ten};  // as many square metres as degrees
  Target target;
  target.rcs_m2 = table;
  const double expected_deg = deg_from_radians(std::asin(earth.sin_grazing(radar.z, place.z, 100e3)));
  ASSERT_LT(expected_deg, deg_from_radians(std::atan2(9500.0, 100e3)) - 0.3);
  for (const Vec3d velocity : {Vec3d{}, Vec3d{200.0, 0.0, 0.0}, Vec3d{0.0, 0.0, -50.0}}) {
    target.track = Track::straight(place, velocity);
    target.heading_rad = 0.5;
    EXPECT_NEAR(rcs_of(target, radar, 10e9, {}, earth).vv, expected_deg, 1e-3);
    const Target seen = bent(target, earth, {radar.x, radar.y}, 0.0);
    EXPECT_NEAR(rcs_of(seen, radar, 10e9, {}).vv, expected_deg, 1e-3);
    EXPECT_NEAR(heading_of(seen, 0.0), heading_of(target, 0.0), 1e-9);
  }
}

TEST(Target, keeps_power_and_correlation_in_its_amplitude) {
  const auto amplitude = steady_amplitude({4.0F, 9.0F, 0.25F, -6.0F});
  EXPECT_NEAR(std::norm(amplitude.vv), 4.0, 1e-5);
  EXPECT_NEAR(std::norm(amplitude.hh), 9.0, 1e-5);
  EXPECT_NEAR(std::norm(amplitude.hv), 0.25, 1e-6);
  EXPECT_NEAR((amplitude.vv * std::conj(amplitude.hh)).real(), -6.0, 1e-5);
  const auto half = steady_amplitude({1.0F, 1.0F, 0.0F, 0.5F});
  EXPECT_NEAR((half.vv * std::conj(half.hh)).real(), 0.5, 1e-6);
  EXPECT_NEAR(std::norm(half.hh), 1.0, 1e-6);
}

TEST(Target, hides_what_its_box_covers) {
  Target target;
  target.track = Track::straight({0.0, 0.0, 5.0});
  const Vec3d radar{0.0, -1000.0, 1005.0};                   // 45° above the horizon, from the south
  EXPECT_FALSE(hides(target, 0.0, radar, {0.0, 5.0, 0.0}));  // no size
  target.size_m = {20.0, 4.0, 10.0};                         // heads north: 20 m north–south, 4 m east–west
  EXPECT_TRUE(hides(target, 0.0, radar, {0.0, 15.0, 0.0}));
  EXPECT_FALSE(hides(target, 0.0, radar, {0.0, 21.0, 0.0}));
  EXPECT_FALSE(hides(target, 0.0, radar, {0.0, -11.0, 0.0}));
  EXPECT_FALSE(hides(target, 0.0, radar, {3.0, 15.0, 0.0}));
  target.heading_rad = pi / 2.0;
  EXPECT_TRUE(hides(target, 0.0, radar, {8.0, 11.0, 0.0}));
  EXPECT_FALSE(hides(target, 0.0, radar, {0.0, 15.0, 0.0}));
}

}  // namespace
}  // namespace sigmascape::radar
