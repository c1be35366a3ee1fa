#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "drawn_by_hand.h"
#include "frame_numbers.h"
#include "live_ground_example.h"

#include "sigmascape/atlas/atlas.h"
#include "sigmascape/atlas/pyramid.h"
#include "sigmascape/live/frame_image.h"
#include "sigmascape/radar/radar_equation.h"
#include "sigmascape/receiver/receive_chain.h"
#include "sigmascape/render/ground_renderer.h"

namespace sigmascape::live {
namespace {

radar::Target standing(Vec2d place, double height_m, float rcs_m2 = 10.0F) {
  radar::Target target;
  target.track = radar::Track::straight(Vec3d{place.x, place.y, height_m});
  target.rcs_m2 = radar::Channels{rcs_m2, 0.5F * rcs_m2, 0.1F * rcs_m2, -0.3F * rcs_m2};
  return target;
}

/// All tests look at one atlas; what they make of its ground is their own.
class LiveTargetsTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<ScratchFolder>();
    store_ = std::make_unique<atlas::Store>(level_ground().store(folder_->path("atlas")));
    atlas::Pyramid(*store_).make_above(store_->units());
  }
  static void TearDownTestSuite() {
    store_.reset();
    folder_.reset();
  }
  static ExampleGround level_ground() {
    ExampleGround ground;
    ground.sigma0 = [](const radar::Look& look) { return constant_gamma(0.01, look); };
    return ground;
  }
  static inline std::unique_ptr<ScratchFolder> folder_;
  static inline std::unique_ptr<atlas::Store> store_;
};

/// What a target adds to a frame, in powers and, as |a|², in amplitudes; VV of all bins together.
struct Added {
  double power_m2 = 0.0, amplitude_m2 = 0.0;
  std::size_t level = 0, seen = 0;
};

Added added_by(const std::vector<radar::Target>& targets, const std::shared_ptr<LiveGround>& ground,
               const ExampleView& view) {
  Added added;
  Pose pose = view.pose();
  for (const FrameContent content : {FrameContent::Powers, FrameContent::Amplitudes}) {
    LiveRenderer renderer(ground, view.settings(content));
    pose.targets = {};
    const Frame& empty = settled_frame(renderer, *ground, pose);
    const std::vector<float> powers(empty.powers_m2.begin(), empty.powers_m2.end());
    const std::vector<std::complex<float>> amplitudes(empty.amplitudes_m.begin(), empty.amplitudes_m.end());
    pose.targets = targets;
    const Frame& frame = renderer.render(pose);
    added.level = frame.report.level;
    added.seen = frame.report.targets;
    for (std::size_t i = 0; i < powers.size(); i += 4) {
      added.power_m2 += static_cast<double>(frame.powers_m2[i]) - static_cast<double>(powers[i]);
    }
    for (std::size_t i = 0; i < amplitudes.size(); i += 4) {
      added.amplitude_m2 += static_cast<double>(std::norm(frame.amplitudes_m[i] - amplitudes[i]));
    }
  }
  return added;
}

TEST_F(LiveTargetsTest, TenSquareMetresAreTenSquareMetresAtEveryLevel) {
  const auto ground = level_ground().over(*store_);
  std::size_t coarsest = 0;
  for (const double bin_m : {8.0, 16.0, 32.0, 64.0}) {
    ExampleView view;
    view.bin_m = bin_m;
    view.ranges = view.beams = 24;
    const std::vector<radar::Target> targets{standing(view.target + Vec2d{3.0, 7.0}, 1.5)};
    const Added added = added_by(targets, ground, view);
    EXPECT_NEAR(db_from_linear(added.power_m2 / 10.0), 0.0, 0.01) << bin_m;
    EXPECT_NEAR(db_from_linear(added.amplitude_m2 / 10.0), 0.0, 0.01) << bin_m;
    coarsest = std::max(coarsest, added.level);
  }
  EXPECT_EQ(coarsest, ground->coarsest_level());
}

TEST_F(LiveTargetsTest, OnlyTerrainHidesThemHoweverCoarse) {
  ExampleGround ridge = level_ground();
  ridge.height_m = [](Vec2d p) { return std::abs(p.y) < 40.0 ? 30.0 : 0.0; };
  const auto ground = ridge.over(*store_);
  for (const double bin_m : {8.0, 48.0}) {
    ExampleView view;
    view.bin_m = bin_m;
    view.azimuth_deg = 0.0;
    // Seen from the north under 13°: in the open, on the ridge, in its shadow, and above the shadow.
    const auto seen = [&](double north_m, double height_m) {
      const std::vector<radar::Target> targets{standing(view.target + Vec2d{0.0, north_m}, height_m)};
      return added_by(targets, ground, view);
    };
    EXPECT_NEAR(seen(80.0, 1.0).power_m2, 10.0, 0.1) << bin_m;
    EXPECT_NEAR(seen(0.0, 31.0).power_m2, 10.0, 0.1) << bin_m;
    EXPECT_EQ(seen(-90.0, 1.0).seen, 0U) << bin_m;
    EXPECT_NEAR(seen(-90.0, 40.0).power_m2, 10.0, 0.1) << bin_m;
  }
}

/// Settled frames from the south under 3°, 8 km away, of bins that are much longer than the terrain's nodes lie apart.
struct LongBins {
  explicit LongBins(const std::shared_ptr<LiveGround>& ground) : renderer(ground, settings()), pose(view.pose()) {
    pose.first_range_m = view.slant_range_m - 750.0;
    settled_frame(renderer, *ground, pose);
  }

  ExampleView view = [] {
    ExampleView from_afar;
    from_afar.azimuth_deg = 180.0;
    from_afar.elevation_deg = 3.0;
    from_afar.slant_range_m = 8000.0;
    from_afar.bin_m = 16.0;
    from_afar.beams = 16;
    from_afar.ranges = 20;
    return from_afar;
  }();
  LiveRenderer renderer;
  Pose pose;

 private:
  [[nodiscard]] LiveSettings settings() const {
    LiveSettings settings = view.settings(FrameContent::Powers);
    settings.range_step_m = 75.0;
    return settings;
  }
};

// Drawn terrain may be coarser than that on which targets were put, and lie above them.
TEST_F(LiveTargetsTest, GroundThatIsDrawnTooHighBuriesNoTarget) {
  ExampleGround slope = level_ground();
  for (const double rise : {0.0, 0.1}) {
    slope.height_m = [rise](Vec2d p) { return rise * p.y; };
    const auto ground = slope.over(*store_);
    LongBins bins(ground);
    auto& [view, renderer, pose] = bins;
    for (const double buried_m : {0.0, 0.05, 0.3, 2.0}) {
      std::vector<radar::Target> targets;
      for (double ahead_m = -200.0; ahead_m < 200.0; ahead_m += 7.3) {
        const Vec2d place = view.target + Vec2d{0.2 * ahead_m, ahead_m};
        targets.push_back(standing(place, slope.height_m(place) - buried_m));
      }
      pose.targets = targets;
      EXPECT_EQ(renderer.render(pose).report.targets, targets.size()) << rise << ", " << buried_m << " m deep";
    }
  }
}

TEST_F(LiveTargetsTest, ARidgeHidesTheSameThingsInEveryFrameHoweverLongItsBinsAre) {
  // 8 m wide at its top and as steep as 34°, between bins of 75 m; it crosses the beams straight and askew.
  for (const double askew : {0.0, 0.3}) {
    ExampleGround ridge = level_ground();
    ridge.height_m = [askew](Vec2d p) {
      return std::clamp(40.0 - (std::abs(p.y + askew * p.x) - 4.0) / 1.5, 0.0, 40.0);
    };
    const auto ground = ridge.over(*store_);
    LongBins bins(ground);
    auto& [view, renderer, pose] = bins;
    for (const double distance_m : {70.0, 130.0, 400.0}) {
      for (const double above_line_m : {-6.0, -3.0, 1.0}) {
        std::size_t seen = 0, frames = 0;
        for (double ahead_m = 0.0; ahead_m < 80.0; ahead_m += 2.9, ++frames) {
          pose.position.y = view.pose().position.y + ahead_m;
          // Over the farther edge of the top, which is the last to hide it. Drawn ridges, whose
          // nodes are 16 m apart, lie up to three metres lower.
          const Vec3d radar = pose.position;
          const double to_edge_m = view.target.y + 4.0 - radar.y;
          const double slope = (40.0 - radar.z) / to_edge_m;
          const double height_m = radar.z + slope * (to_edge_m + distance_m) + above_line_m;
          const std::vector<radar::Target> targets{standing({radar.x, radar.y + to_edge_m + distance_m}, height_m)};
          pose.targets = targets;
          seen += renderer.render(pose).report.targets;
        }
        EXPECT_EQ(seen, above_line_m > 0.0 ? frames : 0U) << askew << ", " << distance_m << ", " << above_line_m;
      }
    }
  }
}

TEST_F(LiveTargetsTest, CrownsDimThemByTheWayThatTheirOwnLineGoesThroughThem) {
  const ScratchFolder folder;
  constexpr float top_m = 15.0F, extinction_per_m = 0.02F;
  ExampleGround wood = level_ground();
  wood.bare_sigma0 = wood.sigma0;
  wood.obstacle = [](Vec2d) { return radar::Obstacle{0.0F, 0.5F, top_m, extinction_per_m}; };
  const auto ground = wood.over(wood.store(folder.path("atlas")));
  ExampleView view;
  view.bin_m = 8.0;
  for (const double height_m : {2.0, 8.0, 60.0, 200.0}) {
    const std::vector<radar::Target> targets{standing(view.target, height_m)};
    const double way_m =
        std::max(static_cast<double>(top_m) - height_m, 0.0) / std::sin(radians_from_deg(view.elevation_deg));
    const Added added = added_by(targets, ground, view);
    const double through = std::exp(-static_cast<double>(extinction_per_m) * way_m);
    EXPECT_NEAR(added.power_m2 / (10.0 * through), 1.0, 0.08) << height_m << " m";
    EXPECT_EQ(added.seen, 1U) << height_m << " m";
  }
}

/// Squares over a slope are as high above all of it as the roof is above their lowest ground.
TEST_F(LiveTargetsTest, AreSeenOnARoofOverSlopingGround) {
  const ScratchFolder folder;
  const double slope = std::tan(radians_from_deg(10.0)), roof_m = 9.37, half_side_m = 16.0;
  ExampleGround hillside = level_ground();
  hillside.bare_sigma0 = hillside.sigma0;
  hillside.height_m = [slope](Vec2d p) { return slope * p.x; };
  hillside.obstacle = [&](Vec2d square) {
    if (std::max(std::abs(square.x), std::abs(square.y)) > half_side_m) return radar::Obstacle{};
    const double lowest_m = slope * (square.x - 0.5 * hillside.texel_m);
    return radar::Obstacle{.solid_top_m = static_cast<float>(roof_m - lowest_m)};
  };
  const auto ground = hillside.over(hillside.store(folder.path("atlas")));
  for (const double azimuth_deg : {0.0, 90.0, 270.0}) {
    ExampleView view{.elevation_deg = 12.0};
    view.azimuth_deg = azimuth_deg;
    view.bin_m = 8.0;
    for (const double across_m : {-14.0, 0.0, 9.0}) {
      const Vec2d place = view.target + Vec2d{across_m, 0.3 * across_m};
      EXPECT_NEAR(added_by({standing(place, roof_m + 0.05)}, ground, view).power_m2, 10.0, 0.1)
          << azimuth_deg << " " << across_m;
      EXPECT_EQ(added_by({standing(place, roof_m - 4.0)}, ground, view).seen, 0U) << azimuth_deg << " " << across_m;
    }
  }
}

TEST_F(LiveTargetsTest, AreSeenStraightBelowTheRadar) {
  const auto ground = level_ground().over(*store_);
  LiveRenderer renderer(ground, {.beams = 64, .ranges = 64, .beam_step_rad = 2.0 * pi / 64.0, .range_step_m = 8.0});
  const std::vector<radar::Target> targets{standing({0.0, 0.0}, 2.0)};
  Pose pose;
  pose.position = {0.0, 0.0, 300.0};
  pose.first_range_m = 250.0;
  pose.targets = targets;
  EXPECT_EQ(renderer.render(pose).report.targets, 1U);
}

TEST_F(LiveTargetsTest, StandOnTheGroundOfTheFrame) {
  // Coarse terrain lies above these hollows; what was put on their floors is seen all the same.
  ExampleGround hollows = level_ground();
  hollows.height_m = [](Vec2d p) { return 3.0 * std::cos(p.x / 24.0 * 2.0 * pi) * std::cos(p.y / 24.0 * 2.0 * pi); };
  const auto ground = hollows.over(*store_);
  ExampleView view{.elevation_deg = 5.0};
  view.bin_m = 64.0;
  view.ranges = view.beams = 24;
  std::vector<radar::Target> targets;
  for (int i = 0; i < 8; ++i) targets.push_back(standing(view.target + Vec2d{12.0 + 24.0 * i, 0.0}, -3.0));
  EXPECT_EQ(added_by(targets, ground, view).seen, 8U);
}

TEST_F(LiveTargetsTest, AScanGivesTheBytesOfAFrame) {
  const auto ground = level_ground().over(*store_);
  const ExampleView view;
  std::vector<radar::Target> targets;
  for (int i = 0; i < 500; ++i) {
    targets.push_back(standing(view.target + Vec2d{-200.0 + 0.8 * i, 150.0 * std::sin(0.7 * i)}, 2.0));
  }
  Pose pose = view.pose();
  pose.targets = targets;
  LiveRenderer at_once(ground, view.settings(FrameContent::Amplitudes, 1));
  LiveRenderer scanning(ground, view.settings(FrameContent::Amplitudes, 3));
  const Frame& whole = settled_frame(at_once, *ground, pose);
  EXPECT_GT(whole.report.targets, 400U);
  settled_frame(scanning, *ground, pose);
  for (std::size_t beam = 0; beam < view.beams; beam += 16) scanning.scan(pose, beam, 16);
  const Frame& swept = scanning.scan(pose, 0, 16);
  EXPECT_TRUE(std::ranges::equal(whole.amplitudes_m, swept.amplitudes_m));
}

TEST_F(LiveTargetsTest, AMoverIsWhereItsTrackSaysAtTheMoment) {
  const auto ground = level_ground().over(*store_);
  ExampleView view;
  view.azimuth_deg = 0.0;
  radar::Target mover = standing(view.target, 1.0, 1e6F);
  mover.track = radar::Track::straight(Vec3d{view.target.x, view.target.y, 1.0}, Vec3d{0.0, -30.0, 0.0});
  const std::vector<radar::Target> targets{mover};
  LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
  Pose pose = view.pose();
  pose.targets = targets;
  settled_frame(renderer, *ground, pose);
  const auto range_of_target = [&](double time_s) {
    pose.moment.time_s = time_s;
    const Frame& frame = renderer.render(pose);
    double sum = 0.0, moment = 0.0;
    for (std::size_t i = 0; i < frame.powers_m2.size(); i += 4) {
      if (frame.powers_m2[i] < 1e4F) continue;
      sum += static_cast<double>(frame.powers_m2[i]);
      moment += static_cast<double>(frame.powers_m2[i]) * static_cast<double>(i / 4 % view.ranges);
    }
    return moment / sum * frame.grid.range_step_m;
  };
  // Away from the radar in the north, which sees it under 13°.
  EXPECT_NEAR(range_of_target(5.0) - range_of_target(0.0), 150.0 * std::cos(radians_from_deg(13.0)), 1.0);
}

radar::Target box_at(Vec2d foot, Vec3d size_m, double heading_deg = 0.0) {
  radar::Target box = standing(foot, 0.5 * size_m.z, 0.0F);
  box.size_m = size_m;
  box.heading_rad = radians_from_deg(heading_deg);
  return box;
}

/// VV of all bins [beam][range], m².
std::vector<float> powers_of(const std::vector<radar::Target>& targets, const std::shared_ptr<LiveGround>& ground,
                             const ExampleView& view) {
  LiveRenderer renderer(ground, view.settings(FrameContent::Powers));
  Pose pose = view.pose();
  pose.targets = targets;
  const Frame& frame = settled_frame(renderer, *ground, pose);
  std::vector<float> vv;
  for (std::size_t i = 0; i < frame.powers_m2.size(); i += 4) vv.push_back(frame.powers_m2[i]);
  return vv;
}

double sum_of(const std::vector<float>& numbers) {
  double sum = 0.0;
  for (const float number : numbers) sum += static_cast<double>(number);
  return sum;
}

/// What a box takes from a map, in m² of VV, and from how many bins.
struct Taken {
  double power_m2 = 0.0;
  std::size_t bins = 0, brighter = 0;
  std::vector<double> of_bin_m2 = {};
};

Taken taken_away(const std::vector<float>& without, const std::vector<float>& with) {
  Taken result{.power_m2 = sum_of(without) - sum_of(with)};
  for (std::size_t bin = 0; bin < with.size(); ++bin) {
    if (with[bin] != without[bin]) ++result.bins;
    if (with[bin] > without[bin]) ++result.brighter;
    result.of_bin_m2.push_back(static_cast<double>(without[bin]) - static_cast<double>(with[bin]));
  }
  return result;
}

/// The radar map of the offline renderer in the same bins.
std::vector<float> offline_powers(const std::vector<radar::Target>& targets, const atlas::Store& store,
                                  const terrain::HeightField& terrain, const ExampleView& view) {
  const LiveSettings settings = view.settings(FrameContent::Powers);
  const Pose pose = view.pose();
  radar::Radar radar;
  radar.position = pose.position;
  radar.range_resolution_m = settings.range_step_m;
  radar.beam_width_rad = settings.beam_step_rad;
  const radar::RangeAzimuthGrid grid{pose.first_range_m,     settings.range_step_m,  settings.ranges,
                                     pose.first_azimuth_rad, settings.beam_step_rad, settings.beams};
  render::RenderCounts counts;
  const radar::RangeAzimuthImage image =
      render::GroundRenderer(atlas::load_atlas(store), terrain)
          .render(radar, store.description().extent, grid, {.targets = targets}, counts);
  std::vector<float> vv;
  for (std::size_t beam = 0; beam < grid.azimuths; ++beam) {
    for (std::size_t range = 0; range < grid.ranges; ++range) vv.push_back(image.rcs_m2(beam, range).vv);
  }
  return vv;
}

TEST_F(LiveTargetsTest, ABoxDarkensItsShadowAndNothingElse) {
  // Long enough a shadow that a texel's width at its edges does not matter.
  const auto ground = level_ground().over(*store_);
  ExampleView view;
  view.azimuth_deg = 0.0;
  view.bin_m = 8.0;
  const Vec3d size{30.0, 60.0, 20.0};
  const std::vector<radar::Target> targets{box_at(view.target + Vec2d{0.0, 40.0}, size)};
  const std::vector<float> open = powers_of({}, ground, view), shaded = powers_of(targets, ground, view);
  const Taken live = taken_away(open, shaded);
  EXPECT_EQ(live.brighter, 0U);

  // Seen from the north: from the near face to where the line of sight over the far edge of the roof comes down.
  const Vec3d radar = view.pose().position;
  const double centre_m = radar.y - (view.target.y + 40.0), near_m = centre_m - 15.0;
  const double far_m = (centre_m + 15.0) * radar.z / (radar.z - size.z);
  // Its sides run away from the corners of the near face.
  const double area_m2 = size.y / near_m * 0.5 * (far_m * far_m - near_m * near_m);
  const double middle_m = 0.5 * (near_m + far_m);
  const double sigma0 = 0.01 * radar.z / std::hypot(radar.z, middle_m);
  EXPECT_NEAR(live.power_m2 / (area_m2 * sigma0), 1.0, 0.03);
  // Bins that the shadow covers, with those that share its edges.
  const double covered = (size.y * far_m / near_m / 8.0 + 3.0) * ((far_m - near_m) / 8.0 + 3.0);
  EXPECT_LE(static_cast<double>(live.bins), covered);
  EXPECT_GE(static_cast<double>(live.bins), 0.7 * covered);
  // They lie where the shadow is, to a bin.
  const auto middle = static_cast<double>(view.beams) / 2.0;
  const Pose pose = view.pose();
  const LiveSettings bins = view.settings(FrameContent::Powers);
  for (std::size_t bin = 0; bin < open.size(); ++bin) {
    if (open[bin] == shaded[bin]) continue;
    const double range_m = pose.first_range_m + (static_cast<double>(bin % view.ranges) + 0.5) * bins.range_step_m;
    const double away_m = std::sqrt(range_m * range_m - radar.z * radar.z);
    const double aside_m = (static_cast<double>(bin / view.ranges) + 0.5 - middle) * bins.beam_step_rad * away_m;
    EXPECT_GT(away_m, near_m - 12.0) << bin;
    EXPECT_LT(away_m, far_m + 12.0) << bin;
    EXPECT_LT(std::abs(aside_m), 0.5 * size.y * away_m / near_m + 12.0) << bin;
  }
}

TEST_F(LiveTargetsTest, ABoxFarOverTheEarthShadesByItsOwnHorizontal) {
  // From 2334.7 m a place 100 km away at sea level is seen under 1° (the triangle with the centre of the Earth of 4/3
  // radius), though it lies 1.67° below the radar: 10 m hide 10/tan 1° = 573 m; over a flat Earth, under 1.34°, 428 m.
  constexpr double distance_m = 100e3, height_m = 2334.7;
  const auto ground = level_ground().over(*store_);
  const Vec2d place = ExampleGround{}.middle() + Vec2d{0.0, -300.0};
  LiveSettings settings;
  settings.content = FrameContent::Powers;
  settings.beams = 96;
  settings.ranges = 110;
  settings.beam_step_rad = 8.0 / distance_m;
  settings.range_step_m = 8.0;
  settings.threads = 2;
  Pose pose;
  pose.position = {place.x, place.y - distance_m, height_m};
  pose.first_azimuth_rad = -48.0 * settings.beam_step_rad;
  pose.first_range_m = radar::CurvedEarth{}.slant_range_m(height_m, 0.0, distance_m) - 100.0;
  const Vec3d size{10.0, 300.0, 10.0};
  const std::vector<radar::Target> targets{box_at(place, size)};
  LiveRenderer renderer(ground, settings);
  const auto power_m2 = [&] {
    const Frame& frame = settled_frame(renderer, *ground, pose);
    EXPECT_EQ(frame.report.dark, 0U);
    return total_vv(frame);
  };
  const double open = power_m2();
  pose.targets = targets;
  const double shaded = power_m2();
  // As much of the frame's ground as the power that is gone: all of it returns the same, nearly.
  const double frame_m2 = distance_m * settings.beam_step_rad * 96.0 * settings.range_step_m * 110.0;
  const double shadow_m = (open - shaded) / open * frame_m2 / size.y - size.x;
  EXPECT_NEAR(shadow_m / (10.0 / std::tan(radians_from_deg(1.0))), 1.0, 0.03);
}

TEST_F(LiveTargetsTest, ShadowsAreThoseOfTheOfflineMap) {
  const ExampleGround example = level_ground();
  const auto ground = example.over(*store_);
  for (const double azimuth_deg : {0.0, 75.0}) {
    ExampleView view;
    view.azimuth_deg = azimuth_deg;
    view.bin_m = 8.0;
    const std::vector<radar::Target> targets{box_at(view.target + Vec2d{20.0, 30.0}, {50.0, 30.0, 15.0}, 40.0),
                                             box_at(view.target + Vec2d{-60.0, -45.0}, {40.0, 40.0, 10.0}, 15.0)};
    const Taken live = taken_away(powers_of({}, ground, view), powers_of(targets, ground, view));
    const Taken offline = taken_away(offline_powers({}, *store_, example.terrain(), view),
                                     offline_powers(targets, *store_, example.terrain(), view));
    EXPECT_GT(offline.power_m2, 0.0);
    EXPECT_NEAR(live.power_m2 / offline.power_m2, 1.0, 0.04) << azimuth_deg;
    double elsewhere_m2 = 0.0;
    for (std::size_t bin = 0; bin < live.of_bin_m2.size(); ++bin)
      elsewhere_m2 += std::abs(live.of_bin_m2[bin] - offline.of_bin_m2[bin]);
    EXPECT_LT(elsewhere_m2, 0.2 * offline.power_m2) << azimuth_deg;
  }
}

TEST_F(LiveTargetsTest, ShadowsGoOverTheEdgeOfAGroupOfBeams) {
  // Beams 32 to 95 of 128 are cut in two groups; seen on their own they are one. The box stands just right of the cut,
  // and part of its shadow is shared with the beam left of it.
  const auto ground = level_ground().over(*store_);
  ExampleView view;
  view.azimuth_deg = 0.0;
  view.bin_m = 8.0;
  view.beams = 128;
  Pose pose = view.pose();
  // Looking south, azimuths grow towards the west.
  const std::vector<radar::Target> targets{box_at(view.target + Vec2d{-4.0, 0.0}, {4.0, 4.0, 30.0})};
  pose.targets = targets;
  LiveSettings settings = view.settings(FrameContent::Powers);
  LiveRenderer wide(ground, settings);
  const std::vector<float> cut = [&] {
    const Frame& frame = settled_frame(wide, *ground, pose);
    return std::vector<float>(frame.powers_m2.begin(), frame.powers_m2.end());
  }();
  settings.beams = 64;
  pose.first_azimuth_rad += 32.0 * settings.beam_step_rad;
  LiveRenderer narrow(ground, settings);
  const Frame& whole = settled_frame(narrow, *ground, pose);
  for (std::size_t beam = 24; beam < 40; ++beam) {
    for (std::size_t range = 0; range < view.ranges; ++range) {
      const float here = whole.powers_m2[(beam * view.ranges + range) * 4];
      const float there = cut[((beam + 32) * view.ranges + range) * 4];
      EXPECT_NEAR(there, here, 0.002F) << beam << ' ' << range;
    }
  }
}

TEST_F(LiveTargetsTest, ShadowsOfAScanAreThoseOfAFrame) {
  const auto ground = level_ground().over(*store_);
  ExampleView view;
  view.beams = 160;
  std::vector<radar::Target> targets;
  for (int i = 0; i < 60; ++i) {
    targets.push_back(
        box_at(view.target + Vec2d{-300.0 + 10.0 * i, 150.0 * std::sin(0.7 * i)}, {12.0, 5.0, 6.0}, 7.0 * i));
  }
  Pose pose = view.pose();
  pose.targets = targets;
  LiveRenderer at_once(ground, view.settings(FrameContent::Amplitudes, 1));
  LiveRenderer scanning(ground, view.settings(FrameContent::Amplitudes, 3));
  const Frame& whole = settled_frame(at_once, *ground, pose);
  settled_frame(scanning, *ground, pose);
  for (std::size_t beam = 0; beam < view.beams; beam += 16) scanning.scan(pose, beam, 16);
  const Frame& swept = scanning.scan(pose, 0, 16);
  EXPECT_TRUE(std::ranges::equal(whole.amplitudes_m, swept.amplitudes_m));
  pose.targets = {};
  const std::size_t lit = whole.report.lit;
  EXPECT_GT(at_once.render(pose).report.lit, lit);
}

TEST_F(LiveTargetsTest, AStepOfAScanCountsThoseThatItsBeamsSee) {
  const auto ground = level_ground().over(*store_);
  const Vec2d middle = ExampleGround{}.middle();
  LiveSettings settings;
  settings.content = FrameContent::Powers;
  settings.beams = 36;
  settings.ranges = 64;
  settings.beam_step_rad = 2.0 * pi / 36.0;
  settings.range_step_m = 8.0;
  settings.threads = 2;
  Pose pose{.position = {middle.x, middle.y, 500.0}, .first_range_m = 450.0};
  // In the middles of beams 4, 5 and 20, and a tenth of a beam beside the first: with a share in the last.
  std::vector<radar::Target> targets;
  for (const double beam : {4.5, 5.5, 20.5, 0.1}) {
    const double azimuth_rad = beam * settings.beam_step_rad;
    targets.push_back(standing(middle + Vec2d{std::sin(azimuth_rad), std::cos(azimuth_rad)} * 400.0, 2.0, 1e4F));
  }
  pose.targets = targets;
  LiveRenderer whole(ground, settings), scanning(ground, settings);
  EXPECT_EQ(settled_frame(whole, *ground, pose).report.targets, 4U);
  const auto seen_by = [&](std::size_t first, std::size_t count) {
    return scanning.scan(pose, first, count).report.targets;
  };
  EXPECT_EQ(seen_by(10, 6), 0U);
  EXPECT_EQ(seen_by(4, 1), 1U);
  EXPECT_EQ(seen_by(2, 8), 2U);
  EXPECT_EQ(seen_by(35, 1), 1U) << "the one beside the first beam";
  EXPECT_EQ(seen_by(0, 1), 1U);
  EXPECT_EQ(seen_by(0, 36), 4U);
}

TEST_F(LiveTargetsTest, HaveTheWattsOfTheRadarEquationHoweverFineTheBins) {
  const auto ground = level_ground().over(*store_);
  const Vec2d middle = ExampleGround{}.middle();
  constexpr double rcs_m2 = 1e9, resolution_m = 15.0, beam_rad = 0.02, distance_m = 9000.0, height_m = 1000.0;
  for (const FrameContent content : {FrameContent::Powers, FrameContent::Amplitudes}) {
    for (const double bins_a_cell : {0.5, 1.0, 2.0, 4.0}) {
      LiveSettings settings;
      settings.content = content;
      settings.beams = settings.ranges = 41;
      settings.beam_step_rad = beam_rad / bins_a_cell;
      settings.range_step_m = resolution_m / bins_a_cell;
      const radar::CurvedEarth earth{.refraction = settings.refraction};
      const double range_m = earth.slant_range_m(height_m, 200.0, distance_m);
      Pose pose{.position = {middle.x, middle.y - distance_m, height_m},
                .first_azimuth_rad = -20.5 * settings.beam_step_rad,
                .first_range_m = range_m - 20.5 * settings.range_step_m};
      const std::vector<radar::Target> targets{standing(middle, 200.0, rcs_m2)};
      pose.targets = targets;
      LiveRenderer renderer(ground, settings);
      const Frame& frame = settled_frame(renderer, *ground, pose);
      radar::Radar radar;
      radar.position = pose.position;
      radar.frequency_hz = 10e9;
      radar.range_resolution_m = resolution_m;
      radar.beam_width_rad = beam_rad;
      radar.antenna.gain = 1000.0;
      radar.waveform.peak_power_w = 2000.0;
      const auto received = receiver::received_power(radar, image_of(frame, radar), radar::Polarization::VV);
      const double lambda_m = wavelength_m(10e9);
      const double expected_w = 2000.0 * 1e6 * lambda_m * lambda_m * rcs_m2 /
                                (std::pow(4.0 * pi, 3.0) * std::pow(range_m, 4.0)) * radar::compression_gain(radar);
      EXPECT_NEAR(db_from_linear(static_cast<double>(received.signal_w(20, 20)) / expected_w), 0.0, 0.05)
          << bins_a_cell << " bins a resolution cell";
    }
  }
}

TEST_F(LiveTargetsTest, TheBeamIsLaidOverTheFirstBeamAndTheLastWhereTheyMeet) {
  std::vector<float> powers(16 * 4 * 4, 0.0F);
  Frame frame;
  frame.grid = {1000.0, 10.0, 4, 0.0, 2.0 * pi / 16.0, 16};
  frame.powers_m2 = powers;
  powers[2 * 4] = 1.0F;  // of beam 0
  radar::Radar radar;
  radar.range_resolution_m = 10.0;
  radar.beam_width_rad = 2.0 * frame.grid.azimuth_step_rad;
  DrawnByHand drawn(frame.grid.azimuths);
  drawn.draw(frame, {});
  const radar::RangeAzimuthImage image = image_of(frame, radar);
  EXPECT_GT(image.rcs_m2(1, 2).vv, 0.1F);
  EXPECT_FLOAT_EQ(image.rcs_m2(15, 2).vv, image.rcs_m2(1, 2).vv);
}

}  // namespace
}  // namespace sigmascape::live
