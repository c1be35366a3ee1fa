#include "sigmascape/trace/vertex.h"

#include <gtest/gtest.h>

namespace sigmascape::trace {
namespace {

TEST(Vertex, AFaceThatARayRunsAlongDoesNotStopIt) {
  // A wall of Bilbao and a radar in the south-east, as a ray met it by rounding: the BRDF was 0/0.
  const Vec3f direction{-0.704416037F, 0.704416037F, -0.0871557444F};
  SurfaceHit hit{.position = {}, .normal = {0.707106769F, 0.707106769F, 0.0F}};
  EXPECT_FALSE(stops(hit, direction));
  hit.normal = {0.70710F, -0.70711F, 0.0F};
  EXPECT_TRUE(stops(hit, direction));
  hit = {.position = {}, .normal = {}, .extinction_per_m = 0.1F};
  EXPECT_TRUE(stops(hit, direction)) << "crowns have no normal";
}

}  // namespace
}  // namespace sigmascape::trace
