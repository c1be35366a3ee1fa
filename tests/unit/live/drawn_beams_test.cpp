#include "sigmascape/live/drawn_beams.h"

#include <gtest/gtest.h>

#include "sigmascape/base/error.h"
#include "sigmascape/live/frame.h"

namespace sigmascape::live {
namespace {

/// A frame of six beams.
Frame frame_of(const DrawnBeams& beams, std::uint64_t drawing) {
  Frame frame;
  frame.grid.azimuths = beams.all().size();
  frame.beams = beams.all();
  frame.drawing = drawing;
  return frame;
}

TEST(DrawnBeams, SayWhenTheyWereDrawnAndFromWhere) {
  DrawnBeams beams(6);
  const Vec3d here{1.0, 2.0, 3.0}, there{4.0, 5.0, 6.0};
  beams.begin(0, 6);
  const std::uint64_t first = beams.end(here);
  beams.begin(2, 2);
  const std::uint64_t second = beams.end(there, {0.0, 7.0, 0.0});
  EXPECT_GT(first, 0U);
  EXPECT_GT(second, first);
  for (std::size_t beam = 0; beam < 6; ++beam) {
    const bool is_of_second = beam == 2 || beam == 3;
    EXPECT_EQ(beams.all()[beam].drawing, is_of_second ? second : first) << beam;
    EXPECT_EQ(beams.all()[beam].radar, is_of_second ? there : here) << beam;
    EXPECT_EQ(beams.all()[beam].velocity_mps, (is_of_second ? Vec3d{0.0, 7.0, 0.0} : Vec3d{})) << beam;
  }
  EXPECT_EQ(drawn_last(beams.all()).radar, there);
  EXPECT_NO_THROW(check_holds(frame_of(beams, second), "test"));
}

TEST(DrawnBeams, AFrameThatNobodyHasDrawnHoldsNothing) {
  EXPECT_THROW(check_holds({}, "test"), Error);
  const DrawnBeams beams(6);
  EXPECT_THROW(check_holds(frame_of(beams, 0), "test"), Error);
}

TEST(DrawnBeams, WhatWasToldOfAFrameHoldsUntilTheNextIsBegun) {
  DrawnBeams beams(6);
  beams.begin(0, 6);
  const Frame frame = frame_of(beams, beams.end({}));
  EXPECT_NO_THROW(check_holds(frame, "test"));
  beams.begin(4, 1);
  EXPECT_THROW(check_holds(frame, "test"), Error);
}

TEST(DrawnBeams, WhatADrawingLeftThatBrokeOffIsNoFrameUntilItIsDrawnAgain) {
  DrawnBeams beams(6);
  beams.begin(0, 6);
  beams.end({});
  beams.begin(0, 3);
  beams.begin(3, 3);
  EXPECT_THROW(check_holds(frame_of(beams, beams.end({})), "test"), Error);
  beams.begin(0, 3);
  EXPECT_NO_THROW(check_holds(frame_of(beams, beams.end({})), "test"));
}

TEST(DrawnBeams, BeamsOfAnotherFrameAreTakenWithWhenTheyWereDrawn) {
  DrawnBeams from(6), to(6);
  from.begin(0, 6);
  const std::uint64_t drawing = from.end({7.0, 8.0, 9.0});
  to.begin(1, 2);
  to.end_as_in(from.all());
  EXPECT_EQ(to.all()[0].drawing, 0U);
  EXPECT_EQ(to.all()[1].drawing, drawing);
  EXPECT_EQ(to.all()[2].radar, (Vec3d{7.0, 8.0, 9.0}));
  EXPECT_EQ(to.all()[3].drawing, 0U);
}

}  // namespace
}  // namespace sigmascape::live
