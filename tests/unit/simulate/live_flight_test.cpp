#include "sigmascape/simulate/live_flight.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

#include "physics/level_scene.h"
#include "unit/live/live_ground_example.h"

#include "sigmascape/base/error.h"
#include "sigmascape/live/frame_image.h"
#include "sigmascape/live/live_receiver.h"
#include "sigmascape/simulate/frame_blend.h"

namespace sigmascape::simulate {
namespace {

using live::FrameContent;

constexpr double gamma = 0.1;
constexpr int frames_a_change = 6;

/// Level ground, traced and from textures, with a tower at its edge that no beam comes to: it is what has to be traced.
class LiveFlightTest : public testing::Test {
 protected:
  LiveFlightTest() {
    example_.sigma0 = [](const radar::Look& look) {
      const auto vv = static_cast<float>(gamma * std::sin(look.aspect.elevation_rad));
      return radar::Channels{vv, vv, 0.1F * vv, 0.5F * vv};
    };
    const scatter::Material soil{
        .name = "gamma", .model = scatter::ConstantGammaParameters{gamma, {0.1, 0.5}}, .source = {}};
    scene_ = physics_test::level_scene(soil, 2000.0);
    scene_.prototypes.push_back(scene::box_mesh({4.0F, 4.0F, 30.0F}, 0));
    scene_.instances.push_back({.x_m = 900.0F, .y_m = 900.0F});
    scene::shift(scene_, example_.middle());
    geometry_ = std::make_unique<trace::SceneGeometry>(scene_, trace::Footing::Terrain);
    example_.scene_hash = scene::scene_hash(scene_);
    const atlas::Store store = example_.store(folder_.path("atlas"));
    atlas::Pyramid(store).make_above(store.units());
    ground_ = example_.over(store);
  }

  [[nodiscard]] static live::LiveSettings bins(FrameContent content) {
    live::ExampleView view;
    view.beams = view.ranges = 24;
    view.bin_m = 12.0;
    return view.settings(content);
  }
  /// From that many times as far away as 4 km, so that the beams are as much wider on the ground.
  [[nodiscard]] live::Pose pose(double times) const {
    live::ExampleView view;
    view.beams = view.ranges = 24;
    view.target = example_.middle();
    live::Pose pose = view.pose();
    const Vec3d target{view.target.x, view.target.y, 0.0};
    pose.position = target + (pose.position - target) * times;
    pose.first_range_m += view.slant_range_m * (times - 1.0);
    return pose;
  }
  [[nodiscard]] static LiveFlightSettings settings() {
    LiveFlightSettings settings;
    settings.tracing.rays_per_cell = 2;
    settings.frames_a_change = frames_a_change;
    // Beams cover it at twice the distance.
    settings.detail.largest_traced_m2 = 2.0 * 24.0 * 12.0 * 24.0 * 12.0;
    return settings;
  }
  [[nodiscard]] LiveFlight flight(FrameContent content) const {
    return {scene_, *geometry_, ground_, bins(content), settings()};
  }
  /// As a flight has it.
  [[nodiscard]] LiveTracer tracer(FrameContent content) const {
    return {
        scene_, *geometry_, bins(content), {.frequency_hz = 10e9, .rays_per_cell = 2, .lattice_m = example_.texel_m}};
  }

  ScratchFolder folder_;
  live::ExampleGround example_;
  std::shared_ptr<live::LiveGround> ground_;
  scene::Scene scene_;
  std::unique_ptr<trace::SceneGeometry> geometry_;
};

/// Of every number in a frame: VV, HH, HV and what is fourth, or |a|².
std::vector<double> powers_of(const live::Frame& frame) {
  std::vector<double> powers(frame.powers_m2.begin(), frame.powers_m2.end());
  for (const std::complex<float>& amplitude : frame.amplitudes_m)
    powers.push_back(static_cast<double>(std::norm(amplitude)));
  return powers;
}

double total_db(const std::vector<double>& powers) {
  double sum = 0.0;
  for (std::size_t i = 0; i < powers.size(); i += 4) sum += powers[i];
  return db_from_linear(sum);
}

TEST_F(LiveFlightTest, RefusesTheAtlasOfAnotherScene) {
  scene_.instances.push_back({.x_m = 800.0F, .y_m = 900.0F});
  EXPECT_THAT(message_of_error([&] { static_cast<void>(flight(FrameContent::Powers)); }),
              testing::HasSubstr("live flight: is over an atlas that was baked from another scene than"));
}

TEST_F(LiveFlightTest, NoStepShowsWhereTracingEnds) {
  for (const FrameContent content : {FrameContent::Powers, FrameContent::Amplitudes}) {
    LiveFlight live = flight(content);
    LiveTracer tracer = this->tracer(content);
    live::LiveRenderer renderer(ground_, bins(content));
    live.render(pose(1.9));
    EXPECT_EQ(live.textured_share(), 0.0);
    double share = 0.0, last_db = 0.0, last_traced_db = 0.0, last_textured_db = 0.0;
    for (int step = 0; step < 12; ++step) {
      const live::Pose here = pose(2.7 + 0.07 * step);
      renderer.render(here);
      ground_->wait_until_loaded();
      const std::vector<double> textured = powers_of(renderer.render(here)), traced = powers_of(tracer.render(here));
      const std::vector<double> shown = powers_of(live.render(here));
      EXPECT_GE(live.textured_share(), share);
      EXPECT_LE(live.textured_share() - share, 1.001 / frames_a_change);
      share = live.textured_share();
      for (std::size_t i = 0; i < shown.size(); ++i) {
        const double wanted = (1.0 - share) * traced[i] + share * textured[i];
        ASSERT_NEAR(shown[i], wanted, 1e-5 * (std::abs(traced[i]) + std::abs(textured[i]))) << step << ", " << i;
      }
      const double db = total_db(shown), traced_db = total_db(traced), textured_db = total_db(textured);
      if (step > 0) {
        const double own = std::max(std::abs(traced_db - last_traced_db), std::abs(textured_db - last_textured_db));
        EXPECT_LE(std::abs(db - last_db), own + std::abs(traced_db - textured_db) / frames_a_change + 1e-4) << step;
      }
      last_db = db;
      last_traced_db = traced_db;
      last_textured_db = textured_db;
      EXPECT_EQ(live.explained().find("on the way") != std::string::npos, share > 0.0 && share < 1.0);
    }
    EXPECT_EQ(share, 1.0);
  }
}

TEST_F(LiveFlightTest, TargetsAreToldApartOnTheWayBetweenLevelsToo) {
  for (const FrameContent content : {FrameContent::Powers, FrameContent::Amplitudes}) {
    LiveFlight live = flight(content);
    LiveTracer tracer = this->tracer(content);
    live::LiveRenderer renderer(ground_, bins(content));
    live.render(pose(1.9));
    const Vec2d middle = example_.middle();
    std::vector<radar::Target> targets(3);
    for (std::size_t i = 0; i < targets.size(); ++i) {
      targets[i].track = radar::Track::straight(
          Vec3d{middle.x + 7.0 * static_cast<double>(i), middle.y + 3.0, 100.0 * static_cast<double>(i)});
      targets[i].rcs_m2 = radar::Channels{1e4F, 1e4F, 0.0F, 1e4F};
    }
    radar::Radar radar;
    radar.range_resolution_m = 30.0;
    radar.beam_width_rad = 2.0 * bins(content).beam_step_rad;
    int between = 0;
    for (int step = 0; step < 12; ++step) {
      live::Pose here = pose(2.7 + 0.07 * step);
      here.targets = targets;
      renderer.render(here);
      ground_->wait_until_loaded();
      const auto textured = image_of(renderer.render(here), radar);
      const auto traced = image_of(tracer.render(here), radar);
      const auto shown = image_of(step % 2 == 0 ? live.render(here) : live.scan(here, 0, bins(content).beams), radar);
      const double share = live.textured_share();
      between += share > 0.0 && share < 1.0 ? 1 : 0;
      for (std::size_t i = 0; i < shown.rcs_m2.size(); ++i) {
        const auto of = [i](const radar::RangeAzimuthImage& image) {
          return static_cast<double>(image.rcs_m2.values()[i].vv);
        };
        const double wanted = (1.0 - share) * of(traced) + share * of(textured);
        ASSERT_NEAR(of(shown), wanted, 1e-4 * wanted) << step << ", " << i;
      }
    }
    EXPECT_EQ(between, frames_a_change - 1);
  }
}

TEST_F(LiveFlightTest, AScanFillsTheFrameBeamByBeam) {
  for (const FrameContent content : {FrameContent::Powers, FrameContent::Amplitudes}) {
    for (const double times : {1.5, 4.0}) {
      const live::Pose here = pose(times);
      LiveFlight at_once = flight(content), scanning = flight(content);
      at_once.render(here);
      scanning.render(pose(times + 0.01));
      ground_->wait_until_loaded();
      // A flight that has traced once adds rays.
      LiveFlight fresh = flight(content);
      const std::vector<double> whole = powers_of(times < 2.0 ? fresh.render(here) : at_once.render(here));
      const live::Frame* swept = nullptr;
      for (std::size_t beam = 0; beam < 24; beam += 7) swept = &scanning.scan(here, beam, 7);
      EXPECT_EQ(scanning.textured_share(), times < 2.0 ? 0.0 : 1.0);
      EXPECT_TRUE(powers_of(*swept) == whole) << times;
      EXPECT_EQ(swept->frequency_hz, ground_->frequency_hz());
      EXPECT_EQ(swept->earth.refraction, bins(content).refraction);
      EXPECT_THROW(scanning.scan(here, 24, 7), Error);
    }
  }
}

TEST_F(LiveFlightTest, AScanPassesFromTracingToTexturesStepByStep) {
  const live::Pose near = pose(1.9), far = pose(3.0);
  for (const FrameContent content : {FrameContent::Powers, FrameContent::Amplitudes}) {
    LiveTracer tracer = this->tracer(content);
    live::LiveRenderer renderer(ground_, bins(content));
    renderer.render(far);
    ground_->wait_until_loaded();
    const std::vector<double> textured = powers_of(renderer.render(far)), traced = powers_of(tracer.render(far));
    LiveFlight live = flight(content);
    const std::vector<double> before = powers_of(live.render(near));
    const std::size_t beams_a_step = 24 / frames_a_change, numbers_a_step = before.size() / frames_a_change;
    for (int step = 0; step < frames_a_change; ++step) {
      const auto number = static_cast<std::size_t>(step);
      const std::vector<double> shown = powers_of(live.scan(far, number * beams_a_step, beams_a_step));
      EXPECT_NEAR(live.textured_share(), (step + 1.0) / frames_a_change, 1e-12);
      for (std::size_t i = 0; i < shown.size(); ++i) {
        const std::size_t drawn_in = i / numbers_a_step;
        const double share = (static_cast<double>(drawn_in) + 1.0) / frames_a_change;
        const double wanted = drawn_in > number ? before[i] : (1.0 - share) * traced[i] + share * textured[i];
        ASSERT_NEAR(shown[i], wanted, 1e-5 * (std::abs(traced[i]) + std::abs(textured[i]))) << step << ", " << i;
      }
    }
  }
}

/// Hears what flights show over level ground, with an antenna that tells elevations apart.
live::LiveReceiver receiver_of(const live::LiveSettings& bins) {
  radar::Radar radar;
  radar.range_resolution_m = 2.0 * bins.range_step_m;
  radar.beam_width_rad = 2.0 * bins.beam_step_rad;
  radar.antenna.elevation = radar::GaussianBeam{};
  radar.antenna.elevation_width_rad = radians_from_deg(4.0);
  radar.antenna.tilt_rad = radians_from_deg(-13.0);
  return {radar, radar::Polarization::VV, live::GroundHeight([](Vec2d) { return 0.0; }), 1};
}

TEST_F(LiveFlightTest, BeamsSayFromWhereTheyWereDrawnWhateverDrewThem) {
  LiveFlight live = flight(FrameContent::Powers);
  live::LiveReceiver every = receiver_of(bins(FrameContent::Powers)),
                     every_third = receiver_of(bins(FrameContent::Powers));
  std::vector<Vec3d> drawn_from(24);
  const auto is_as_drawn = [&](const live::Frame& frame) {
    EXPECT_NO_THROW(live::check_holds(frame, "test"));
    for (std::size_t beam = 0; beam < 24; ++beam) EXPECT_EQ(frame.beams[beam].radar, drawn_from[beam]) << beam;
  };
  const auto sees = [&](const live::Frame& frame, const live::Pose& from, std::size_t first, std::size_t count) {
    std::fill_n(drawn_from.begin() + static_cast<std::ptrdiff_t>(first), count, from.position);
    is_as_drawn(frame);
    every.hear(frame);
  };
  sees(live.render(pose(1.9)), pose(1.9), 0, 24);
  // Traced, on the way, and from textures.
  for (int step = 0; step < 2 * frames_a_change; ++step) {
    const std::size_t first = static_cast<std::size_t>(step) % 6 * 4;
    live::Pose here = pose(step < 2 ? 1.9 : 3.0);
    here.position.x += 40.0 * step;
    const live::Frame& frame = live.scan(here, first, 4);
    sees(frame, here, first, 4);
    if (step % 3 == 0) every_third.hear(frame);
    live::LiveReceiver late = receiver_of(bins(FrameContent::Powers));
    EXPECT_THAT(late.hear(frame).signal_w, testing::ElementsAreArray(every.hear(frame).signal_w)) << step;
    EXPECT_THAT(every_third.hear(frame).signal_w, testing::ElementsAreArray(every.hear(frame).signal_w)) << step;
  }
  EXPECT_EQ(live.textured_share(), 1.0);
  const live::Frame before = live.render(pose(3.0));
  EXPECT_NO_THROW(live::check_holds(before, "test"));
  live.scan(pose(3.0), 0, 4);
  live.render(pose(3.0));
  EXPECT_THROW(live::check_holds(before, "test"), Error) << "its bins were drawn into";
}

TEST_F(LiveFlightTest, WhatIsInUseIsKeptNearWhereTheChoiceChanges) {
  LiveFlight from_near = flight(FrameContent::Powers), from_afar = flight(FrameContent::Powers);
  for (const double times : {1.9, 2.1, 1.9, 2.1}) {
    from_near.render(pose(times));
    EXPECT_EQ(from_near.textured_share(), 0.0) << times;
  }
  for (const double times : {2.1, 1.9, 2.1, 1.9}) {
    from_afar.render(pose(times));
    EXPECT_EQ(from_afar.textured_share(), 1.0) << times;
  }
  // Who turns round on the way goes back the same way.
  from_near.render(pose(3.0));
  from_near.render(pose(3.0));
  EXPECT_NEAR(from_near.textured_share(), 2.0 / frames_a_change, 1e-12);
  from_near.render(pose(1.3));
  EXPECT_NEAR(from_near.textured_share(), 1.0 / frames_a_change, 1e-12);
  from_near.render(pose(1.3));
  EXPECT_EQ(from_near.textured_share(), 0.0);
}

// Textures are not shown from below the ground, and here they would be part of what is shown.
TEST_F(LiveFlightTest, ARefusedPoseChangesNothing) {
  LiveFlight live = flight(FrameContent::Powers);
  live.render(pose(1.9));
  live.render(pose(3.0));
  live.render(pose(3.0));
  const double share = live.textured_share();
  ASSERT_NEAR(share, 2.0 / frames_a_change, 1e-12);
  live::Pose below = pose(1.9);
  below.position = {example_.middle().x, example_.middle().y, -1000.0};
  EXPECT_THROW(live.render(below), Error);
  EXPECT_THROW(live.scan(below, 0, 4), Error);
  EXPECT_EQ(live.textured_share(), share);
  live.render(pose(3.0));
  EXPECT_NEAR(live.textured_share(), 3.0 / frames_a_change, 1e-12);
}

TEST_F(LiveFlightTest, WhatCannotBeTracedIsShownFromTextures) {
  LiveFlight live = flight(FrameContent::Powers);
  const LiveTracer tracer = this->tracer(FrameContent::Powers);
  const live::Pose above = pose(1.3);
  live.render(above);
  ASSERT_EQ(live.textured_share(), 0.0);
  EXPECT_TRUE(tracer.can_trace(above));
  // Under the top of the tower, and in frames before that and after.
  live::Pose below = above;
  below.position.z = geometry_->highest_m() - 1.0;
  EXPECT_FALSE(tracer.can_trace(below));
  for (int step = 0; step < 2; ++step) {
    live::LiveRenderer renderer(ground_, bins(FrameContent::Powers));
    renderer.render(below);
    ground_->wait_until_loaded();
    const std::vector<double> textured = powers_of(renderer.render(below));
    EXPECT_TRUE(powers_of(step == 0 ? live.render(below) : live.scan(below, 0, 24)) == textured);
    EXPECT_EQ(live.choice().level, 0);
    EXPECT_EQ(live.textured_share(), 1.0);
    EXPECT_NE(live.explained().find("does not stand above all of the scene"), std::string::npos) << live.explained();
  }
  live.render(above);
  EXPECT_NEAR(live.textured_share(), 1.0 - 1.0 / frames_a_change, 1e-12);
  EXPECT_EQ(live.explained().find("does not stand above"), std::string::npos) << live.explained();
}

TEST_F(LiveFlightTest, WhatIsTooMuchToTraceIsShownFromTextures) {
  LiveFlightSettings few = settings();
  few.tracing.most_cells = 10.0;
  LiveFlight live(scene_, *geometry_, ground_, bins(FrameContent::Powers), few);
  live.render(pose(1.3));
  EXPECT_EQ(live.choice().level, 0);
  EXPECT_EQ(live.textured_share(), 1.0);
}

TEST_F(LiveFlightTest, ExplainsWhichTerrainItsFramesStandOn) {
  live::LiveSettings coarse = bins(FrameContent::Powers);
  coarse.cells_per_bin = 1.0;
  LiveFlight live(scene_, *geometry_, ground_, coarse, settings());
  live.render(pose(4.0));
  ASSERT_EQ(live.choice().level, 2);
  const int terrain_level = ground_->terrain().level_for(2.0 * example_.texel_m);
  ASSERT_EQ(terrain_level, 1);
  EXPECT_NE(live.explained().find("terrain level 1"), std::string::npos) << live.explained();
}

TEST_F(LiveFlightTest, GoesByTrianglesWhereThePapersRuleIsAskedFor) {
  LiveFlightSettings by_triangles = settings();
  by_triangles.detail.rule = render::DetailRule::PixelsPerTriangle;
  LiveFlight live(scene_, *geometry_, ground_, bins(FrameContent::Powers), by_triangles);
  live.render(pose(1.3));
  // Two of the ground and twelve of the tower; two samples a bin.
  const double samples_a_triangle = 2000.0 * 2000.0 / 14.0 / (6.0 * 6.0);
  EXPECT_NEAR(live.choice().pixels_per_triangle / samples_a_triangle, 1.0, 0.05);
  EXPECT_EQ(live.textured_share(), 0.0) << live.explained();
  EXPECT_NE(live.explained().find("a triangle of the full scene covers"), std::string::npos) << live.explained();

  by_triangles.detail.pixels_per_triangle = 1.1 * samples_a_triangle;
  LiveFlight coarse(scene_, *geometry_, ground_, bins(FrameContent::Powers), by_triangles);
  coarse.render(pose(1.3));
  EXPECT_EQ(coarse.textured_share(), 1.0) << coarse.explained();
}

TEST(LiveFlightSettings, MoreIsTracedWhileItIsTraced) {
  const render::DetailSettings detail;
  // Just too large, of things just too low to be seen.
  render::DetailQuestion question{.tallest_object_m = 12.0, .area_m2 = 1.2 * detail.largest_traced_m2};
  EXPECT_GT(render::choose_detail(question, detail).level, 0);
  EXPECT_EQ(render::choose_detail(question, settings_in_use(detail, true)).level, 0);
  question.area_m2 = 0.8 * detail.largest_traced_m2;
  EXPECT_EQ(render::choose_detail(question, detail).level, 0);
  EXPECT_GT(render::choose_detail(question, settings_in_use(detail, false)).level, 0);
  question.area_m2 = 0.0;
  // Shadow over cell, h cot ψ / c, where half is allowed.
  question.tallest_object_m = 0.55 * 2.0 * std::tan(question.grazing_rad);
  EXPECT_EQ(render::choose_detail(question, detail).level, 0);
  EXPECT_GT(render::choose_detail(question, settings_in_use(detail, false)).level, 0);
  question.tallest_object_m *= 0.45 / 0.55;
  EXPECT_GT(render::choose_detail(question, detail).level, 0);
  EXPECT_EQ(render::choose_detail(question, settings_in_use(detail, true)).level, 0);
}

using Amplitudes = std::vector<std::complex<float>>;

Amplitudes blended(const Amplitudes& first, const Amplitudes& second, double second_share) {
  Amplitudes sum(first.size());
  blend_amplitudes(first, second, second_share, sum);
  return sum;
}

TEST(FrameBlend, WhatBothHoldStays) {
  const Amplitudes alike{{1.0F, 2.0F}, {-3.0F, 0.5F}, {0.0F, 0.0F}};
  for (const double share : {0.0, 0.3, 0.5, 1.0}) {
    const Amplitudes sum = blended(alike, alike, share);
    for (std::size_t i = 0; i < alike.size(); ++i) EXPECT_NEAR(std::abs(sum[i] - alike[i]), 0.0F, 1e-6F);
  }
}

TEST(FrameBlend, PowersAreSharedWhateverThePhases) {
  for (const float turn : {0.0F, 1.0F, 2.5F, static_cast<float>(pi)}) {
    const Amplitudes first{{2.0F, 0.0F}, {0.0F, 0.0F}}, second{std::polar(2.0F, turn), {0.0F, 3.0F}};
    for (const double share : {0.0, 0.25, 0.5, 1.0}) {
      const Amplitudes sum = blended(first, second, share);
      EXPECT_NEAR(std::norm(sum[0]), 4.0F, 1e-5F) << turn << ", " << share;
      EXPECT_NEAR(std::norm(sum[1]), 9.0 * share, 1e-5) << turn << ", " << share;
    }
    EXPECT_NEAR(std::abs(blended(first, second, 1.0)[0] - second[0]), 0.0F, 1e-6F);
  }
}

}  // namespace
}  // namespace sigmascape::simulate
