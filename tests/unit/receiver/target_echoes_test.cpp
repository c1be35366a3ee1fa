#include "sigmascape/receiver/target_echoes.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "sigmascape/base/units.h"
#include "sigmascape/receiver/range_azimuth_receiver.h"

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

// The brightest that a file may state is 100 dBsm.
TEST(AddEchoes, HoldsTargetsOfAnyBrightness) {
  radar::Radar radar;
  radar.position = {0.0, -8000.0, 3000.0};
  const std::vector<Vec3d> corners{{-60, -60, 0}, {60, -60, 0}, {60, 60, 0}, {-60, 60, 0}};
  const radar::RangeAzimuthGrid bins = grid_covering(radar, corners);
  for (const float rcs_m2 : {1e-3F, 1.0F, 1e8F, 1e10F}) {
    const radar::Echo echo{.range_m = length(radar.position), .cross = 0.0, .rcs_m2 = {rcs_m2, rcs_m2, 0.0F, rcs_m2}};
    radar::RangeAzimuthImage image{bins, radar.position, Array2D<radar::Channels>(bins.azimuths, bins.ranges)};
    add_echoes(image, radar, {&echo, 1});
    double sum = 0.0;
    for (const radar::Channels& bin : image.rcs_m2.values()) sum += static_cast<double>(bin.vv);
    EXPECT_NEAR(sum / static_cast<double>(rcs_m2), 1.0, 1e-4) << rcs_m2;
  }
}

}  // namespace
}  // namespace sigmascape::receiver
