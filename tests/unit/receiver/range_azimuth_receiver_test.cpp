#include "sigmascape/receiver/range_azimuth_receiver.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

#include "scratch_folder.h"

#include "sigmascape/base/units.h"

namespace sigmascape::receiver {
namespace {

radar::Radar example_radar(Vec3d position = {0, -10'000, 3000}) {
  radar::Radar radar;
  radar.position = position;
  radar.range_resolution_m = 3.0;
  radar.beam_width_rad = 0.002;
  return radar;
}

/// Level ground about the origin.
std::vector<Vec3d> square(double half_side_m) {
  return {{-half_side_m, -half_side_m, 0},
          {half_side_m, -half_side_m, 0},
          {half_side_m, half_side_m, 0},
          {-half_side_m, half_side_m, 0}};
}

radar::Echo echo_at(const radar::Radar& radar, Vec3d point) {
  const Vec3d away = point - radar.position;
  return {.range_m = length(away), .cross = azimuth_of(away), .rcs_m2 = {1.0F, 2.0F, 0.5F, -1.0F}};
}

/// A response sampled at offsets from the point that answers, and its width at half of the power at no offset.
class Response {
 public:
  void add(double offset, double power) { samples_.push_back({offset, power}); }
  [[nodiscard]] double half_power_width() {
    std::ranges::sort(samples_, {}, &Vec2d::x);
    const double half = 0.5 * std::ranges::max(samples_, {}, &Vec2d::y).y;
    const auto crossing = [half](Vec2d below, Vec2d above) {
      // Of a Gaussian the logarithm is smooth.
      const double part = std::log(half / below.y) / std::log(above.y / below.y);
      return below.x + part * (above.x - below.x);
    };
    double left = 0.0, right = 0.0;
    for (std::size_t i = 0; i + 1 < samples_.size(); ++i) {
      if (samples_[i].y < half && samples_[i + 1].y >= half && left == 0.0)
        left = crossing(samples_[i], samples_[i + 1]);
      if (samples_[i].y >= half && samples_[i + 1].y < half) right = crossing(samples_[i + 1], samples_[i]);
    }
    return right - left;
  }

 private:
  std::vector<Vec2d> samples_;
};

/// Mean response, over where in its bin the point lies, along range and along azimuth.
void expect_widths(double oversampling) {
  const radar::Radar radar = example_radar();
  const radar::RangeAzimuthGrid grid = grid_covering(radar, square(60.0), oversampling);
  Response in_range, in_azimuth;
  const double range_row = std::floor(static_cast<double>(grid.ranges) / 2.0),
               azimuth_column = std::floor(static_cast<double>(grid.azimuths) / 2.0);
  for (int k = 0; k < 16; ++k) {
    const double within = (k + 0.5) / 16.0 - 0.5;
    for (const bool along_range : {true, false}) {
      const double row = range_row + 0.5 + (along_range ? within : 0.0),
                   column = azimuth_column + 0.5 + (along_range ? 0.0 : within);
      const radar::Echo echo{.range_m = grid.first_range_m + row * grid.range_step_m,
                             .cross = grid.first_azimuth_rad + column * grid.azimuth_step_rad,
                             .rcs_m2 = {1, 1, 1, 1}};
      RangeAzimuthReceiver receiver(radar, grid);
      receiver.add({&echo, 1});
      const auto image = receiver.image();
      for (int off = -20; off <= 20; ++off) {
        const auto c = static_cast<std::size_t>(azimuth_column) + (along_range ? 0U : static_cast<std::size_t>(off));
        const auto r = static_cast<std::size_t>(range_row) + (along_range ? static_cast<std::size_t>(off) : 0U);
        if (c >= grid.azimuths || r >= grid.ranges) continue;
        const double power = static_cast<double>(image.rcs_m2(c, r).vv);
        if (along_range) {
          in_range.add((off - within) * grid.range_step_m, power);
        } else {
          in_azimuth.add((off - within) * grid.azimuth_step_rad, power);
        }
      }
    }
  }
  EXPECT_NEAR(in_range.half_power_width() / radar.range_resolution_m, 1.0, 0.02) << oversampling << " bins a cell";
  EXPECT_NEAR(in_azimuth.half_power_width() / (radar.beam_width_rad / std::numbers::sqrt2), 1.0, 0.02)
      << oversampling << " bins a cell";
}

TEST(RangeAzimuthReceiver, EchoesOfOneAzimuthAreTheSameWhenAddedAtOnce) {
  radar::Radar radar = example_radar();
  radar.antenna.elevation = radar::GaussianBeam{};
  radar.antenna.tilt_rad = -0.29;
  radar.receiver.last_range_m = 10'460.0;
  const auto grid = grid_covering(radar, square(100.0));
  RangeAzimuthReceiver one_by_one(radar, grid), at_once(radar, grid);
  for (std::size_t column = 0; column < grid.azimuths; column += 3) {
    std::vector<radar::Echo> echoes;
    // Middles of columns, and places between them.
    const double place = static_cast<double>(column) + (column % 2 == 0 ? 0.5 : 0.8);
    const double azimuth = grid.first_azimuth_rad + place * grid.azimuth_step_rad;
    for (double distance_m = 9'900.0; distance_m < 10'100.0; distance_m += 0.7) {
      echoes.push_back(echo_at(radar, radar.position + Vec3d{distance_m * std::sin(azimuth),
                                                             distance_m * std::cos(azimuth), -radar.position.z}));
      echoes.back().sin_depression = 0.3F;
    }
    one_by_one.add(echoes);
    at_once.add_at_azimuth(azimuth, echoes);
  }
  const auto a = one_by_one.image(), b = at_once.image();
  double greatest = 0.0;
  for (std::size_t i = 0; i < a.rcs_m2.size(); ++i) {
    const auto one = static_cast<double>(a.rcs_m2.values()[i].hh), other = static_cast<double>(b.rcs_m2.values()[i].hh);
    ASSERT_EQ(std::isnan(one), std::isnan(other));
    if (std::isnan(one)) continue;  // beyond the gate
    greatest = std::max(greatest, one);
    ASSERT_NEAR(one, other, 1e-6 * one + 1e-9);
  }
  EXPECT_GT(greatest, 0.1);
}

TEST(RangeAzimuthReceiver, HalfPowerWidthsAreThoseOfPulseAndTwoWayBeam) {
  expect_widths(2.0);
  expect_widths(4.0);
}

TEST(RangeAzimuthReceiver, ResponsesKeepPowerAndCentroid) {
  const radar::Radar radar = example_radar();
  const radar::RangeAzimuthGrid grid = grid_covering(radar, square(60.0));
  for (const Vec3d point : {Vec3d{0, 0, 0}, {-31.3, 12.7, 0}, {59.0, -59.0, 0}}) {
    const radar::Echo echo = echo_at(radar, point);
    RangeAzimuthReceiver receiver(radar, grid);
    receiver.add({&echo, 1});
    const auto image = receiver.image();
    double power = 0.0, hh = 0.0, hv = 0.0, correlation = 0.0, range = 0.0, azimuth = 0.0;
    for (std::size_t r = 0; r < grid.ranges; ++r) {
      for (std::size_t a = 0; a < grid.azimuths; ++a) {
        const radar::Channels& bin = image.rcs_m2(a, r);
        power += static_cast<double>(bin.vv);
        hh += static_cast<double>(bin.hh);
        hv += static_cast<double>(bin.hv);
        correlation += static_cast<double>(bin.re_vvhh);
        range +=
            static_cast<double>(bin.vv) * (grid.first_range_m + (static_cast<double>(r) + 0.5) * grid.range_step_m);
        azimuth += static_cast<double>(bin.vv) *
                   (grid.first_azimuth_rad + (static_cast<double>(a) + 0.5) * grid.azimuth_step_rad);
      }
    }
    EXPECT_NEAR(power, 1.0, 1e-5);
    EXPECT_NEAR(hh, 2.0, 2e-5);
    EXPECT_NEAR(hv, 0.5, 5e-6);
    EXPECT_NEAR(correlation, -1.0, 1e-5);
    EXPECT_NEAR(range / power, echo.range_m, 1e-3 * radar.range_resolution_m);
    EXPECT_NEAR(azimuth / power, echo.cross, 1e-3 * radar.beam_width_rad);
  }
}

// Whichever way the radar looks, all of the ground lies within the bins, and a small sector stays small.
TEST(GridCovering, HoldsAllCornersFromAnyDirection) {
  for (int degrees = 0; degrees < 360; degrees += 15) {
    const double azimuth = radians_from_deg(degrees);
    const radar::Radar radar = example_radar({10e3 * std::sin(azimuth), 10e3 * std::cos(azimuth), 3000});
    const auto corners = square(100.0);
    const radar::RangeAzimuthGrid grid = grid_covering(radar, corners);
    EXPECT_LT(static_cast<double>(grid.azimuths) * grid.azimuth_step_rad, 0.045) << degrees << "°";
    EXPECT_LT(static_cast<double>(grid.ranges) * grid.range_step_m, 320.0) << degrees << "°";
    RangeAzimuthReceiver receiver(radar, grid);
    for (const Vec3d corner : corners) {
      const radar::Echo echo = echo_at(radar, corner);
      receiver.add({&echo, 1});
    }
    EXPECT_NEAR(receiver.bins().total()[0], 4.0, 1e-5) << degrees << "°";
  }
}

TEST(GridCovering, StepsArePartsOfAResolutionCell) {
  const radar::Radar radar = example_radar();
  const radar::RangeAzimuthGrid grid = grid_covering(radar, square(50.0), 4.0);
  EXPECT_DOUBLE_EQ(grid.range_step_m, 0.75);
  EXPECT_DOUBLE_EQ(grid.azimuth_step_rad, 0.002 / std::numbers::sqrt2 / 4.0);
}

// Echoes may name the same direction by another turn.
TEST(RangeAzimuthReceiver, TakesAzimuthsFromAnyTurn) {
  for (const Vec3d position : {Vec3d{0, 10e3, 3000}, {0, -10e3, 3000}}) {
    const radar::Radar radar = example_radar(position);
    const radar::RangeAzimuthGrid grid = grid_covering(radar, square(60.0));
    for (const double turns : {-1.0, 0.0, 1.0}) {
      RangeAzimuthReceiver receiver(radar, grid);
      for (const double east : {-20.0, 20.0}) {
        radar::Echo echo = echo_at(radar, {east, 0, 0});
        echo.cross += turns * 2.0 * pi;
        receiver.add({&echo, 1});
      }
      EXPECT_NEAR(receiver.bins().total()[0], 2.0, 1e-5);
      // Seen from the north the east is on the left: azimuths below south.
      const double middle = grid.first_azimuth_rad + 0.5 * static_cast<double>(grid.azimuths) * grid.azimuth_step_rad;
      EXPECT_NEAR(std::abs(std::remainder(middle - (position.y > 0 ? pi : 0.0), 2.0 * pi)), 0.0, 1e-3);
    }
  }
}

TEST(RangeAzimuthReceiver, WhatLeavesTheGateIsLost) {
  const radar::Radar radar = example_radar();
  const radar::RangeAzimuthGrid grid = grid_covering(radar, square(60.0));
  RangeAzimuthReceiver receiver(radar, grid);
  radar::Echo echo = echo_at(radar, {0, 0, 0});
  echo.range_m -= 1000.0;
  receiver.add({&echo, 1});
  echo.range_m += 1000.0;
  echo.cross += 0.5;
  receiver.add({&echo, 1});
  EXPECT_EQ(receiver.bins().total()[0], 0.0);
  EXPECT_EQ(receiver.bins().overflows(), 0U);
}

TEST(GridCovering, TakesInNoMoreThanATurn) {
  radar::Radar radar = example_radar();
  radar.beam_width_rad = radians_from_deg(80.0);
  const auto grid = grid_covering(radar, square(100.0));
  EXPECT_TRUE(grid.goes_round());
  EXPECT_NEAR(static_cast<double>(grid.azimuths) * grid.azimuth_step_rad, 2.0 * pi, 1e-9);
}

// Right below itself a radar has all azimuths, and its last beam lies next to its first.
TEST(GridCovering, GoesAllRoundWhenTheRadarStandsOverAPoint) {
  radar::Radar radar = example_radar({10.0, -20.0, 300.0});
  radar.beam_width_rad = 0.05;
  std::vector<Vec3d> points = square(100.0);
  EXPECT_FALSE(grid_covering(radar, points).goes_round());
  points.push_back({10.0, -20.0, 0.0});
  const radar::RangeAzimuthGrid grid = grid_covering(radar, points);
  ASSERT_TRUE(grid.goes_round());
  EXPECT_LE(grid.azimuth_step_rad, 0.05 / std::numbers::sqrt2 / 2.0);
  EXPECT_LT(grid.first_range_m, 300.0);

  const auto response_at = [&](double azimuth_rad) {
    const radar::Echo echo{.range_m = 310.0, .cross = azimuth_rad, .rcs_m2 = {1, 1, 1, 1}};
    RangeAzimuthReceiver receiver(radar, grid);
    receiver.add({&echo, 1});
    return receiver.image();
  };
  constexpr std::size_t steps = 29;
  for (const double within : {0.1, 0.5, 0.9}) {
    const double azimuth_rad = grid.first_azimuth_rad + within * grid.azimuth_step_rad;
    const auto across = response_at(azimuth_rad);
    const auto inside = response_at(azimuth_rad + static_cast<double>(steps) * grid.azimuth_step_rad);
    double power = 0.0;
    for (std::size_t row = 0; row < grid.ranges; ++row) {
      for (std::size_t column = 0; column < grid.azimuths; ++column) {
        const float here = across.rcs_m2(column, row).vv;
        ASSERT_NEAR(here, inside.rcs_m2((column + steps) % grid.azimuths, row).vv, 1e-6F);
        power += static_cast<double>(here);
      }
    }
    EXPECT_NEAR(power, 1.0, 1e-4) << within;
  }
}

// exp(−8 ln 2 (ε/θ)²) both ways, however narrow the beam is and wherever it points.
TEST(RangeAzimuthReceiver, HearsThroughTheElevationPattern) {
  struct Case {
    double tilt_deg, width_deg, offset_deg;
  };
  for (const Case& c : {Case{-5.0, 3.0, 1.1}, {-60.0, 0.02, 0.011}, {-60.0, 0.02, 0.002}, {-90.0, 1.0, 0.43}}) {
    radar::Radar radar = example_radar();
    radar.antenna.elevation = radar::GaussianBeam{};
    radar.antenna.elevation_width_rad = radians_from_deg(c.width_deg);
    radar.antenna.tilt_rad = radians_from_deg(c.tilt_deg);
    radar::Echo echo = echo_at(radar, {0, 0, 0});
    echo.sin_depression = static_cast<float>(std::sin(radians_from_deg(-c.tilt_deg - c.offset_deg)));
    RangeAzimuthReceiver receiver(radar, grid_covering(radar, square(60.0)));
    receiver.add({&echo, 1});
    // As far off as the sine says in single precision.
    const double offset_deg = -c.tilt_deg - deg_from_radians(std::asin(static_cast<double>(echo.sin_depression)));
    const double expected = std::exp(-8.0 * std::numbers::ln2 * std::pow(offset_deg / c.width_deg, 2));
    EXPECT_NEAR(db_from_linear(receiver.bins().total()[0]), db_from_linear(expected), 0.02)
        << c.tilt_deg << "° " << c.width_deg << "°";
  }
}

// The power that comes back from r through air, as though it came from where it appears: σ (r'/r)⁴ exp(−2α(r − r')).
TEST(RangeAzimuthReceiver, FoldedEchoesKeepThePowerThatTheyHad) {
  radar::Radar radar = example_radar();
  radar.atmosphere_per_m = 1e-4;
  radar.receiver.first_range_m = 10'000.0;
  radar.waveform.pulse_repetition_hz = speed_of_light_mps / (2.0 * 3000.0);
  const radar::RangeAzimuthGrid grid = grid_covering(radar, square(60.0));
  radar::Echo echo = echo_at(radar, {0, 0, 0});
  const double appears_m = echo.range_m;
  echo.range_m += 3000.0;
  RangeAzimuthReceiver receiver(radar, grid);
  receiver.add({&echo, 1});
  EXPECT_NEAR(receiver.bins().total()[0],
              std::pow(appears_m / (appears_m + 3000.0), 4) * std::exp(-2.0 * 1e-4 * 3000.0), 1e-5);
}

TEST(RangeAzimuthReceiver, BrighterThanTheSumsIsAnError) {
  const radar::Radar radar = example_radar();
  RangeAzimuthReceiver receiver(radar, grid_covering(radar, square(60.0)));
  radar::Echo echo = echo_at(radar, {0, 0, 0});
  echo.rcs_m2 = echo.rcs_m2 * 1e9F;
  receiver.add({&echo, 1});
  EXPECT_THAT(message_of_error([&] { static_cast<void>(receiver.image()); }),
              testing::HasSubstr("a bin is brighter than the sums can hold"));
}

}  // namespace
}  // namespace sigmascape::receiver
