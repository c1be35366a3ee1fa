#include "sigmascape/radar/vantage.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "sigmascape/base/units.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/radar/target_shadows.h"

namespace sigmascape::radar {
namespace {

/// Flies east and climbs, and looks so far off north.
PassingBeam flying_east(double azimuth_deg = 0.0) {
  return {.position = {100.0, -500.0, 300.0},
          .velocity_mps = {80.0, 0.0, 2.0},
          .outwards = horizontal_direction(radians_from_deg(azimuth_deg))};
}

Target moving(Vec3d position, Vec3d velocity_mps) {
  Target target;
  target.track = Track::straight(position, velocity_mps);
  return target;
}

TEST(Vantage, OfOnePlaceIsThatAtTimeZero) {
  const Vantage vantage(Vec3d{1.0, 2.0, 3.0});
  EXPECT_FALSE(vantage.beams());
  EXPECT_EQ(vantage.place_for({500.0, -70.0}), (Vec3d{1.0, 2.0, 3.0}));
  EXPECT_EQ(vantage.time_s_for(moving({500.0, -70.0, 0.0}, {10.0, 0.0, 0.0})), 0.0);
}

TEST(Vantage, OfAStripSeesEveryPlaceUnderOneAzimuth) {
  for (const double azimuth_deg : {0.0, 35.0, -50.0}) {
    const Vantage vantage(flying_east(azimuth_deg));
    for (const Vec2d point : {Vec2d{100.0, 0.0}, {700.0, 40.0}, {-900.0, 2000.0}}) {
      const Vec3d place = vantage.place_for(point);
      const double time_s = (place.x - 100.0) / 80.0;
      EXPECT_NEAR(place.y, -500.0, 1e-9);
      EXPECT_NEAR(place.z, 300.0 + 2.0 * time_s, 1e-9);
      EXPECT_NEAR(std::atan2(point.x - place.x, point.y - place.y), radians_from_deg(azimuth_deg), 1e-12);
    }
  }
  EXPECT_NEAR(Vantage(flying_east()).place_for({700.0, 40.0}).x, 700.0, 1e-9);
}

/// Left and right are seen at once, and as far ahead of broadside.
TEST(Vantage, OfAStripLooksToBothSidesAlike) {
  const Vantage vantage(flying_east(35.0));
  const Vec3d north = vantage.place_for({100.0, 200.0}), south = vantage.place_for({100.0, -1200.0});
  EXPECT_NEAR(north.x, south.x, 1e-9);
  EXPECT_LT(north.x, 100.0);
}

TEST(Vantage, RisesOverARoundEarth) {
  PassingBeam beam = flying_east();
  beam.velocity_mps.z = 0.0;
  beam.earth = CurvedEarth{};
  EXPECT_NEAR(Vantage(beam).place_for({20'100.0, 0.0}).z, 300.0 + beam.earth.drop_m(20'000.0), 1e-6);
}

TEST(Vantage, MeetsMoversWhereTheyAreThen) {
  const Vantage vantage(flying_east(20.0));
  const Target legs = [] {
    Target target;
    target.track = Track::through({{0.0, {400.0, 100.0, 0.0}}, {2.0, {430.0, 100.0, 0.0}}, {9.0, {430.0, 260.0, 0.0}}});
    return target;
  }();
  for (const Target& target : {moving({400.0, 100.0, 0.0}, {15.0, -5.0, 0.0}), legs}) {
    const double time_s = vantage.time_s_for(target);
    const Vec3d there = target.track.position_at(time_s), place = vantage.place_for({there.x, there.y});
    EXPECT_GT(time_s, 0.5);
    EXPECT_NEAR(place.x, 100.0 + 80.0 * time_s, 1e-6);
  }
  EXPECT_EQ(vantage.time_s_for(moving({400.0, 100.0, 0.0}, {200.0, 0.0, 0.0})), 0.0) << "outruns the beam";
}

/// A box 200 m ahead, of which the place at time zero would see the shadow aslant.
TEST(TargetShadows, OfAStripLieStraightBehindWhatThePassingBeamMeets) {
  Target box = moving({300.0, 0.0, 10.0}, {});
  box.size_m = {10.0, 10.0, 20.0};
  const std::vector<Target> targets{box};
  const TargetShadows passing(targets, Vantage(flying_east())), still(targets, 0.0, flying_east().position);
  EXPECT_TRUE(passing.hide({300.0, 25.0, 0.0}));
  EXPECT_TRUE(passing.hide({303.0, 25.0, 0.0}));
  EXPECT_FALSE(passing.hide({310.0, 25.0, 0.0}));
  EXPECT_FALSE(passing.hide({300.0, -25.0, 0.0}));
  EXPECT_FALSE(passing.hide({300.0, 60.0, 0.0}));
  EXPECT_FALSE(still.hide({300.0, 25.0, 0.0}));
  EXPECT_TRUE(still.hide({310.0, 25.0, 0.0}));
}

TEST(TargetShadows, OfAStripAreWhereAMoverIsThen) {
  Target lorry = moving({300.0, 0.0, 10.0}, {20.0, 0.0, 0.0});
  lorry.size_m = {10.0, 10.0, 20.0};
  const std::vector<Target> targets{lorry};
  const TargetShadows shadows(targets, Vantage(flying_east()));
  const double along_m = 300.0 + 20.0 * 200.0 / (80.0 - 20.0);
  EXPECT_TRUE(shadows.hide({along_m, 20.0, 0.0}));
  EXPECT_FALSE(shadows.hide({300.0, 20.0, 0.0}));
}

/// From above a hall of 100 m all of the ground below it is hidden, on either side of the radar, and none beside it.
TEST(TargetShadows, FromAboveABoxLieAllAround) {
  Target hall = moving({100.0, 0.0, 15.0}, {});
  hall.size_m = {100.0, 100.0, 30.0};
  const std::vector<Target> targets{hall};
  for (const Vec3d radar : {Vec3d{130.0, 20.0, 300.0}, {100.0, 0.0, 300.0}, {20.0, 0.0, 300.0}}) {
    const TargetShadows shadows(targets, 0.0, radar);
    for (double x = 52.0; x < 150.0; x += 4.0) {
      for (double y = -48.0; y < 50.0; y += 4.0) EXPECT_TRUE(shadows.hide({x, y, 0.0})) << x << " " << y;
    }
    EXPECT_FALSE(shadows.hide({100.0, 70.0, 0.0}));
    EXPECT_FALSE(shadows.hide({180.0, 0.0, 0.0}));
  }
}

/// h / tan ψ long, ψ the grazing angle of that Earth: from 100 km at 1° a flat one would make it 429 m.
TEST(TargetShadows, OverARoundEarthAreAsLongAsTheGrazingAngleSays) {
  Target box = moving({0.0, 0.0, 5.0}, {});
  box.size_m = {10.0, 10.0, 10.0};
  const std::vector<Target> targets{box};
  const CurvedEarth earth;
  const Vantage far_off(position_seeing({}, pi, radians_from_deg(1.0), 100e3, earth));
  const TargetShadows round(targets, far_off, earth), flat(targets, far_off);
  const double end_m = 5.0 + 10.0 / std::tan(radians_from_deg(1.0));
  // Eq. (2) of the drop is good to a hundredth of that here.
  EXPECT_TRUE(round.hide({0.0, 0.99 * end_m, 0.0}));
  EXPECT_FALSE(round.hide({0.0, 1.02 * end_m, 0.0}));
  EXPECT_FALSE(flat.hide({0.0, 0.99 * end_m, 0.0}));
}

TEST(Vantage, OfARadarIsThatOfItsMode) {
  Radar radar;
  radar.position = {100.0, -500.0, 300.0};
  radar.velocity_mps = {80.0, 0.0, 0.0};
  EXPECT_FALSE(vantage_of(radar, {100.0, 0.0}).beams());
  radar.mode = Mode::Stripmap;
  EXPECT_EQ(vantage_of(radar, {100.0, 0.0}).place_for({260.0, 40.0}), (Vec3d{260.0, -500.0, 300.0}));
  EXPECT_FALSE(vantage_of(radar, {5000.0, -500.0}).beams()) << "towards the course";
  radar.velocity_mps = {};
  EXPECT_FALSE(vantage_of(radar, {100.0, 0.0}).beams()) << "of a radar that stands";
}

TEST(Vantage, OfAStripKeepsToTheAzimuthAtWhichTheScanIsFixed) {
  Radar radar;
  radar.position = {100.0, -500.0, 300.0};
  radar.velocity_mps = {80.0, 0.0, 0.0};
  radar.mode = Mode::Stripmap;
  radar.scan = {.kind = ScanKind::Fixed, .azimuth_rad = radians_from_deg(35.0)};
  const Vec3d place = vantage_of(radar, {100.0, 0.0}).place_for({260.0, 40.0});
  EXPECT_NEAR(place.x, 260.0 - 540.0 * std::tan(radians_from_deg(35.0)), 1e-9);
  EXPECT_NEAR(place.y, -500.0, 1e-9);
}

}  // namespace
}  // namespace sigmascape::radar
