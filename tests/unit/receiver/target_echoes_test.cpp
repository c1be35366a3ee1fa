#include "sigmascape/receiver/target_echoes.h"

#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/base/units.h"

namespace sigmascape::receiver {
namespace {

/// However small, far or fast: an echo each, where it is at that moment.
TEST(TargetEchoes, come_from_every_target_at_its_place_and_time) {
  radar::Radar radar;
  radar.position = {0.0, 0.0, 3000.0};
  std::vector<radar::Target> targets(3);
  targets[0].track = radar::Track::straight({4000.0, 0.0, 0.0}, {0.0, 30.0, 0.0});
  targets[1].track = radar::Track::straight({0.0, -90'000.0, 3000.0});
  targets[2].track = radar::Track::straight({-5000.0, 0.0, 0.0});
  for (radar::Target& target : targets) target.rcs_m2 = radar::Channels{1e-6F, 4e-6F, 0.0F, 2e-6F};
  const auto echoes = target_echoes(targets, radar, {100.0, 0, 0});
  ASSERT_EQ(echoes.size(), 3U);
  EXPECT_NEAR(echoes[0].range_m, std::sqrt(4000.0 * 4000.0 + 2.0 * 3000.0 * 3000.0), 1e-9);  // 3 km north by then
  EXPECT_NEAR(echoes[0].cross, std::atan2(4000.0, 3000.0), 1e-12);
  EXPECT_NEAR(echoes[0].sin_depression, 3000.0 / echoes[0].range_m, 1e-6);
  EXPECT_NEAR(std::remainder(echoes[1].cross - pi, 2.0 * pi), 0.0, 1e-12);
  EXPECT_EQ(echoes[1].sin_depression, 0.0F);
  EXPECT_FLOAT_EQ(echoes[2].rcs_m2.hh, 4e-6F);

  const auto scatterers = target_scatterers(targets, radar, {100.0, 0, 0});
  ASSERT_EQ(scatterers.size(), 3U);
  EXPECT_EQ(scatterers[0].position, (Vec3d{4000.0, 3000.0, 0.0}));
  EXPECT_NEAR(std::abs(scatterers[2].amplitude_m.hh), 2e-3, 1e-9);
}

}  // namespace
}  // namespace sigmascape::receiver
