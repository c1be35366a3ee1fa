#include "results/truth.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "made_rows.h"
#include "scratch_folder.h"

#include "sigmascape/scene/paper_scene.h"

namespace sigmascape::cli {
namespace {

constexpr PlannedView seen_from_the_south_east = {.azimuth_deg = 130.0, .elevation_deg = 20.0};

PlannedView of_rays(std::uint32_t samples) {
  PlannedView view = seen_from_the_south_east;
  view.traced_samples = samples;
  return view;
}

double squared_difference(const radar::GroundMap& a, const radar::GroundMap& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.sigma0.size(); ++i) {
    const double difference = a.sigma0.values()[i].vv - b.sigma0.values()[i].vv;
    sum += difference * difference;
  }
  return sum;
}

class TracedTruth : public testing::Test {
 protected:
  MeasuredScene scene_{"hills", scene::paper_scene({.scale = 0.1})};
  ResultsPlan plan_ = made_plan();
  ScratchFolder folder_;

  Truth truth(std::uint32_t samples) const {
    return traced_truth(scene_, of_rays(samples), plan_, folder_.path("truth"));
  }
};

TEST_F(TracedTruth, OfMoreRaysGoesOnFromTheRaysThatAreThere) {
  const Truth few = truth(2);
  const Truth more = truth(8);
  EXPECT_EQ(samples_kept(scene_, of_rays(2), plan_, folder_.path("truth")), 8U);
  EXPECT_GT(more.trace_seconds, few.trace_seconds);

  // The rays that were there are a quarter of all: what they alone found counts so much, no more and no less.
  double least = 1.0;
  for (std::size_t i = 0; i < few.first.sigma0.size(); ++i)
    if (few.first.sigma0.values()[i].vv > 0.0F)
      least = std::min(least, double{more.first.sigma0.values()[i].vv} / few.first.sigma0.values()[i].vv);
  EXPECT_NEAR(least, 0.25, 1e-5);
  // Four times as many rays that know nothing of one another halve the noise; heavy tails make it a little less.
  EXPECT_LT(squared_difference(more.first, more.second), 0.6 * squared_difference(few.first, few.second));
}

TEST_F(TracedTruth, OfFewerRaysLeavesTheBetterMapsWhereTheyAre) {
  const Truth more = truth(8);
  const Truth few = truth(2);
  EXPECT_EQ(few.first.metadata.at("truth_samples_per_cell"), "2");
  EXPECT_EQ(samples_kept(scene_, of_rays(2), plan_, folder_.path("truth")), 8U);
  EXPECT_EQ(squared_difference(truth(8).first, more.first), 0.0);
}

TEST_F(TracedTruth, IsReadAgainAsItWasTraced) {
  const Truth traced = truth(2);
  const Truth again = truth(2);
  EXPECT_EQ(squared_difference(traced.first, again.first), 0.0);
  EXPECT_EQ(traced.trace_seconds, again.trace_seconds);
}

}  // namespace
}  // namespace sigmascape::cli
