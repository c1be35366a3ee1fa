#include "sigmascape/simulate/answering_ground.h"

#include <cmath>
#include <gtest/gtest.h>

namespace sigmascape::simulate {
namespace {

constexpr radar::Rectangle mapped_square{-100, -100, 100, 100}, scene{-2000, -2000, 2000, 2000};

radar::Radar above(Vec2d foot, double height_m) {
  radar::Radar radar;
  radar.position = {foot.x, foot.y, height_m};
  radar.range_resolution_m = 4.0;
  radar.beam_width_rad = 0.01;
  return radar;
}

/// How far from the foot ground lies at a range four resolutions beyond that of the edge.
double reach_m(double edge_m, double height_m) {
  const double range_m = std::hypot(edge_m, height_m) + 16.0;
  return std::sqrt(range_m * range_m - height_m * height_m);
}

// Below the radar 16 m of range are a hundred of ground, on whichever side of the edge it stands.
TEST(AnsweringGround, ReachesFarWhereTheRadarStandsCloseToAnEdge) {
  for (const double inside_m : {10.0, 1.0, 0.0}) {
    const radar::Rectangle answering =
        answering_ground(above({-100.0 + inside_m, 0.0}, 400.0), mapped_square, scene, 0.0);
    EXPECT_NEAR(answering.west_m, -100.0 + inside_m - reach_m(inside_m, 400.0), 0.1) << inside_m;
  }
  // From beside it four resolutions reach to the foot.
  EXPECT_LE(answering_ground(above({-150.0, 0.0}, 400.0), mapped_square, scene, 0.0).west_m, -150.0);
}

TEST(AnsweringGround, ReachesAsFarOverGroundBelowTheSea) {
  const radar::Radar over_sea = above({-100.0, 0.0}, 400.0), over_pit = above({-100.0, 0.0}, 0.0);
  EXPECT_EQ(answering_ground(over_pit, mapped_square, scene, -400.0),
            answering_ground(over_sea, mapped_square, scene, 0.0));
}

TEST(AnsweringGround, IsLittleMoreThanTheAreaFromAfar) {
  const radar::Rectangle answering = answering_ground(above({0.0, -20e3}, 2e3), mapped_square, scene, 0.0);
  EXPECT_LT(answering.north_m, 120.0);
  EXPECT_GT(answering.north_m, 115.0);
  EXPECT_EQ(answering_ground(above({0.0, -20e3}, 2e3), mapped_square, mapped_square, 0.0), mapped_square)
      << "beyond the scene there is nothing";
}

}  // namespace
}  // namespace sigmascape::simulate
