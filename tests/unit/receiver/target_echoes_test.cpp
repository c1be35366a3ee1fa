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

// Half a bin beyond the last azimuth lies the edge of the first: both have the same, and nothing is lost.
TEST(AddEchoes, ComesInAtTheOtherEndWhereBinsGoRound) {
  radar::Radar radar;
  radar.position = {0.0, 0.0, 3000.0};
  radar.beam_width_rad = 0.1;
  const std::vector<Vec3d> about{{-500, -500, 0}, {500, 500, 0}, {0, 0, 0}};
  const radar::RangeAzimuthGrid bins = grid_covering(radar, about);
  ASSERT_TRUE(bins.goes_round());
  const radar::Echo echo{.range_m = 3020.0, .cross = bins.first_azimuth_rad, .rcs_m2 = {2.0F, 1.0F, 0.5F, -1.0F}};
  radar::RangeAzimuthImage image{bins, radar.position, Array2D<radar::Channels>(bins.azimuths, bins.ranges)};
  add_echoes(image, radar, {&echo, 1});
  radar::Channels sum;
  for (const radar::Channels& bin : image.rcs_m2.values()) sum += bin;
  EXPECT_NEAR(sum.vv, 2.0F, 1e-4F);
  EXPECT_NEAR(sum.re_vvhh, -1.0F, 1e-4F);
  for (std::size_t row = 0; row < bins.ranges; ++row) {
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(image.rcs_m2(k, row).hv, image.rcs_m2(bins.azimuths - 1 - k, row).hv, 1e-6F) << k << ", " << row;
  }
}

// What a table of the beam has to the right of its axis is met when the axis stands to the left, as of the ground.
TEST(AddEchoes, SpreadAsTheGroundDoes) {
  radar::Radar radar;
  radar.position = {0.0, -8000.0, 3000.0};
  radar::TabulatedBeam aside;
  for (double offset = -3.0; offset <= 3.0; offset += 0.05)
    aside.samples.push_back({offset, std::exp2(-4.0 * std::pow(offset - 0.5, 2.0))});
  radar.antenna.azimuth = aside;
  const std::vector<Vec3d> corners{{-60, -60, 0}, {60, -60, 0}, {60, 60, 0}, {-60, 60, 0}};
  const radar::RangeAzimuthGrid bins = grid_covering(radar, corners);
  // In the middle of a bin, where sharing changes nothing.
  const auto middle = [](double first, double step, std::size_t count) {
    return first + (std::floor(static_cast<double>(count) / 2.0) + 0.5) * step;
  };
  const radar::Echo echo{.range_m = middle(bins.first_range_m, bins.range_step_m, bins.ranges),
                         .cross = middle(bins.first_azimuth_rad, bins.azimuth_step_rad, bins.azimuths),
                         .rcs_m2 = {1.0F, 1.0F, 0.0F, 1.0F}};
  radar::RangeAzimuthImage image{bins, radar.position, Array2D<radar::Channels>(bins.azimuths, bins.ranges)};
  add_echoes(image, radar, {&echo, 1});
  RangeAzimuthReceiver receiver(radar, bins);
  receiver.add({&echo, 1});
  const auto of_ground = receiver.image();
  for (std::size_t i = 0; i < image.rcs_m2.size(); ++i)
    EXPECT_NEAR(image.rcs_m2.values()[i].vv, of_ground.rcs_m2.values()[i].vv, 1e-6F) << i;
}

}  // namespace
}  // namespace sigmascape::receiver
