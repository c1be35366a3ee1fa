#include "sigmascape/live/frame_image.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

#include "drawn_by_hand.h"
#include "live_ground_example.h"

#include "sigmascape/base/error.h"
#include "sigmascape/radar/echo.h"
#include "sigmascape/receiver/range_azimuth_receiver.h"

namespace sigmascape::live {
namespace {

constexpr double tilt_deg = -15.0, width_deg = 6.0, radar_height_m = 3000.0;

/// Resolves two bins of OneBin in range and in azimuth.
radar::Radar radar_with(radar::BeamShape elevation) {
  radar::Radar radar;
  radar.position = {0.0, 0.0, radar_height_m};
  radar.range_resolution_m = 20.0;
  radar.beam_width_rad = 0.02;
  radar.antenna.elevation = std::move(elevation);
  radar.antenna.elevation_width_rad = radians_from_deg(width_deg);
  radar.antenna.tilt_rad = radians_from_deg(tilt_deg);
  return radar;
}

/// A frame of which one bin holds power, its middle `range_m` away and due north.
class OneBin {
 public:
  explicit OneBin(double range_m, double power_m2 = 1000.0) : powers_(std::size_t{21 * 21 * 4}, 0.0F) {
    powers_[(10 * 21 + 10) * 4] = static_cast<float>(power_m2);
    frame_.grid = {range_m - 10.5 * 10.0, 10.0, 21, -10.5 * 0.01, 0.01, 21};
    frame_.powers_m2 = powers_;
    drawn_.draw(frame_, {0.0, 0.0, radar_height_m});
  }
  [[nodiscard]] const Frame& frame() const { return frame_; }

  /// By how much the beam's elevation weakens it, both ways.
  [[nodiscard]] double lost_db(const GroundHeight& ground, const radar::CurvedEarth& earth) const {
    Frame frame = frame_;
    frame.earth = earth;
    const auto peak = [&](const radar::Radar& radar) {
      return static_cast<double>(image_of(frame, radar, ground).rcs_m2(10, 10).vv);
    };
    return db_from_linear(peak(radar_with(radar::GaussianBeam{})) / peak(radar_with(radar::EvenBeam{})));
  }

 private:
  std::vector<float> powers_;
  Frame frame_;
  DrawnByHand drawn_{21};
};

/// Twice 10 lg exp(−4 ln 2 (φ/θ)²).
double gaussian_db(double elevation_rad, double beam_tilt_deg = tilt_deg) {
  const double widths = (elevation_rad - radians_from_deg(beam_tilt_deg)) / radians_from_deg(width_deg);
  return -80.0 * std::numbers::ln2 * std::numbers::log10e * widths * widths;
}

GroundHeight level(double ground_m) {
  return [ground_m](Vec2d) { return ground_m; };
}

TEST(FrameImage, BinsHaveTheGainInElevationTowardsLevelGround) {
  for (const double below_deg : {12.0, 15.0, 20.0}) {
    for (const double ground_m : {0.0, 800.0}) {
      const double range_m = (radar_height_m - ground_m) / std::sin(radians_from_deg(below_deg));
      EXPECT_NEAR(OneBin(range_m).lost_db(level(ground_m), radar::CurvedEarth::flat()),
                  gaussian_db(radians_from_deg(-below_deg)), 0.01)
          << below_deg << "° below, over ground at " << ground_m << " m";
    }
  }
}

TEST(FrameImage, GroundThatRisesIsMetNearer) {
  // Where h = d/10 and d² + (H − h)² = r², d solves (1 + 1/100) d² − H d/5 + H² − r² = 0.
  const double slope = 0.1, range_m = 9000.0, a = 1.0 + slope * slope, b = -2.0 * slope * radar_height_m,
               c = radar_height_m * radar_height_m - range_m * range_m;
  const double distance_m = (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
  const double below_m = radar_height_m - slope * distance_m;
  EXPECT_NEAR(OneBin(range_m).lost_db([&](Vec2d place) { return slope * place.y; }, radar::CurvedEarth::flat()),
              gaussian_db(-std::asin(below_m / range_m)), 0.01);
  EXPECT_GT(std::asin(radar_height_m / range_m) - std::asin(below_m / range_m), radians_from_deg(5.0)) << "it tells";
}

/// Two hundred bins of 5 m due north, in which the radar tells each from the next.
class FineBins {
 public:
  explicit FineBins(double middle_m) : powers_(std::size_t{bins * 4}, 0.0F) {
    for (std::size_t bin = 0; bin < bins; ++bin) powers_[4 * bin] = 1e6F;
    frame_.grid = {middle_m - 0.5 * bins * bin_m, bin_m, bins, -0.005, 0.01, 1};
    frame_.earth = radar::CurvedEarth::flat();
    frame_.powers_m2 = powers_;
    drawn_.draw(frame_, {0.0, 0.0, radar_height_m});
  }
  [[nodiscard]] double range_m(std::size_t bin) const {
    return frame_.grid.first_range_m + (static_cast<double>(bin) + 0.5) * bin_m;
  }
  /// By how much the beam's elevation weakens each, both ways.
  [[nodiscard]] std::vector<double> lost_db(const GroundHeight& ground, double beam_tilt_deg) const {
    const auto image = [&](radar::BeamShape elevation) {
      radar::Radar radar = radar_with(std::move(elevation));
      radar.range_resolution_m = 0.01;
      radar.beam_width_rad = 1e-4;
      radar.antenna.tilt_rad = radians_from_deg(beam_tilt_deg);
      return image_of(frame_, radar, ground);
    };
    const auto weighted = image(radar::GaussianBeam{}), even = image(radar::EvenBeam{});
    std::vector<double> lost;
    for (std::size_t bin = 0; bin < bins; ++bin) {
      const double left = static_cast<double>(weighted.rcs_m2(0, bin).vv) / static_cast<double>(even.rcs_m2(0, bin).vv);
      lost.push_back(db_from_linear(left));
    }
    return lost;
  }

  static constexpr std::size_t bins = 200;

 private:
  static constexpr double bin_m = 5.0;
  std::vector<float> powers_;
  Frame frame_;
  DrawnByHand drawn_{1};
};

/// Elevations of all ground due north that is as far away, over a flat Earth: where range passes it between steps of a
/// metre, by bisection.
std::vector<double> elevations_at(double range_m, const GroundHeight& ground) {
  const auto farther_by = [&](double north_m) {
    return std::hypot(north_m, radar_height_m - ground({0.0, north_m})) - range_m;
  };
  std::vector<double> elevations;
  for (double near_m = 0.0; near_m < range_m; near_m += 1.0) {
    const bool near_is_farther = farther_by(near_m) > 0.0;
    if ((farther_by(near_m + 1.0) > 0.0) == near_is_farther) continue;
    double low_m = near_m, high_m = near_m + 1.0;
    for (int halving = 0; halving < 40; ++halving) {
      const double middle_m = 0.5 * (low_m + high_m);
      ((farther_by(middle_m) > 0.0) == near_is_farther ? low_m : high_m) = middle_m;
    }
    elevations.push_back(std::asin((ground({0.0, low_m}) - radar_height_m) / range_m));
  }
  return elevations;
}

/// Of each bin that holds ground: how far its loss is from that of the nearest to it among its places.
std::vector<double> errors_db(const FineBins& bins, const GroundHeight& ground, double beam_tilt_deg) {
  const std::vector<double> lost = bins.lost_db(ground, beam_tilt_deg);
  std::vector<double> errors;
  for (std::size_t bin = 0; bin < FineBins::bins; ++bin) {
    std::vector<double> of_places;
    for (const double elevation_rad : elevations_at(bins.range_m(bin), ground))
      of_places.push_back(std::abs(lost[bin] - gaussian_db(elevation_rad, beam_tilt_deg)));
    if (!of_places.empty()) errors.push_back(std::ranges::min(of_places));
  }
  return errors;
}

TEST(FrameImage, SteepLooksEndAtGroundThatHasTheRange) {
  // A step from height to distance and back makes its error tan(slope) tan(depression) times as large: 0.63 times at
  // 20° and 60°, in the middle of the bins, and more than once in nearer ones. Over ground that rises by more than
  // range grows, ranges have several places.
  for (const double slope_deg : {10.0, 20.0, 30.0}) {
    const double wave_m = 1000.0, amplitude_m = std::tan(radians_from_deg(slope_deg)) * wave_m / (2.0 * pi);
    const GroundHeight waves = [&](Vec2d place) { return amplitude_m * std::sin(2.0 * pi * place.y / wave_m); };
    const FineBins bins(radar_height_m / std::sin(radians_from_deg(60.0)));
    const std::vector<double> errors = errors_db(bins, waves, -60.0);
    EXPECT_GT(errors.size(), FineBins::bins * 3 / 4) << slope_deg;
    EXPECT_LT(std::ranges::max(errors), 0.1) << slope_deg;
  }
}

TEST(FrameImage, GroundAheadMayBeNearerThanWhatIsStraightBelow) {
  // A table 2500 m high, whose edge, 600 m ahead, is 781 m away.
  const GroundHeight table = [](Vec2d place) { return std::clamp(50.0 * (place.y - 550.0), 0.0, 2500.0); };
  const std::vector<double> errors = errors_db(FineBins(1500.0), table, -20.0);
  EXPECT_EQ(errors.size(), FineBins::bins);
  EXPECT_LT(std::ranges::max(errors), 0.1);
}

TEST(FrameImage, TheSeaLiesLowerOverARoundEarth) {
  // Law of cosines at the radar, between the middle of the Earth and the sea's surface.
  const radar::CurvedEarth earth{.refraction = 4.0 / 3.0};
  const double radius_m = 1.0 / earth.curvature_per_m(), centre_m = radius_m + radar_height_m, range_m = 120e3;
  const double sin_below = (range_m * range_m + centre_m * centre_m - radius_m * radius_m) / (2.0 * range_m * centre_m);
  const double expected_db = gaussian_db(-std::asin(sin_below));
  EXPECT_NEAR(OneBin(range_m).lost_db(level(0.0), earth), expected_db, 0.01);
  EXPECT_GT(std::abs(gaussian_db(-std::asin(radar_height_m / range_m)) - expected_db), 0.5) << "the Earth tells";
}

TEST(FrameImage, BinsAreWeightedAsOfflineMapsWeightEchoes) {
  const double range_m = radar_height_m / std::sin(radians_from_deg(19.0));
  const OneBin bin(range_m);
  const radar::Radar radar = radar_with(radar::CosecantSquaredBeam{});
  receiver::RangeAzimuthReceiver receiver(radar, bin.frame().grid);
  const std::vector<radar::Echo> echoes{{.range_m = range_m,
                                         .cross = 0.0,
                                         .rcs_m2 = {1000.0F, 0.0F, 0.0F, 0.0F},
                                         .bounces = 1,
                                         .sin_depression = static_cast<float>(radar_height_m / range_m)}};
  receiver.add(echoes);
  const auto offline = receiver.image();
  Frame frame = bin.frame();
  frame.earth = radar::CurvedEarth::flat();
  const auto live = image_of(frame, radar, level(0.0));
  for (const auto& [beam, range] : {std::pair{10U, 10U}, {9U, 10U}, {10U, 12U}}) {
    EXPECT_NEAR(live.rcs_m2(beam, range).vv / offline.rcs_m2(beam, range).vv, 1.0F, 2e-3F) << beam << ", " << range;
  }
}

TEST(FrameImage, AnAntennaThatTellsElevationsApartAsksForTheGround) {
  const OneBin bin(9000.0);
  try {
    (void)image_of(bin.frame(), radar_with(radar::GaussianBeam{}));
    FAIL() << "bins do not say how far below the radar they are";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("ground_below"));
  }
  EXPECT_NO_THROW((void)image_of(bin.frame(), radar_with(radar::EvenBeam{})));
}

TEST(FrameImage, TheGroundBelowAFrameIsItsTerrain) {
  // An even slope is the same at all levels of the terrain.
  ExampleGround example;
  example.sigma0 = [](const radar::Look& look) { return constant_gamma(0.1, look); };
  example.height_m = [](Vec2d way) { return 100.0 + 0.1 * way.x - 0.05 * way.y; };
  const ScratchFolder folder;
  const atlas::Store store = example.store(folder.path("atlas"));
  const auto ground = example.over(store);
  const ExampleView view;
  LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
  const Frame& frame = renderer.render(view.pose());
  const GroundHeight below = ground_below(frame, *ground);
  for (const Vec2d way : {Vec2d{0.0, 0.0}, {217.0, -133.0}, {-300.0, 250.0}})
    EXPECT_NEAR(below(example.middle() + way), example.height_m(way), 1e-2) << way.x;
}

}  // namespace
}  // namespace sigmascape::live
