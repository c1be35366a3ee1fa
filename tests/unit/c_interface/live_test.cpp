#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <vector>

#include "scratch_folder.h"
#include "unit/c_interface/atlas_of_even_ground.h"
#include "unit/c_interface/said_in_c.h"
#include "unit/live/live_ground_example.h"

#include "sigmascape/atlas/terrain_file.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/c_interface/sigmascape.h"
#include "sigmascape/radar/target.h"
#include "sigmascape/simulate/live_tracer.h"
#include "sigmascape/terrain/pyramid_builder.h"

namespace sigmascape {
namespace {

class LiveFromC : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<ScratchFolder>();
    write_atlas_of_even_ground(folder_->path("atlas"));
  }
  static void TearDownTestSuite() { folder_.reset(); }
  [[nodiscard]] static std::string atlas() { return folder_->path("atlas").string(); }
  static inline std::unique_ptr<ScratchFolder> folder_;
};

TEST_F(LiveFromC, GivesTheFrameOfTheCppInterface) {
  const live::ExampleView view;
  live::LiveSettings wanted = view.settings(live::FrameContent::Amplitudes);
  wanted.seed = 5;
  wanted.cells_per_bin = 1.0;
  const auto shared = live::LiveGround::open(atlas(), 10e9);
  live::LiveRenderer expected(shared, wanted);
  expected.render(view.pose());
  shared->wait_until_loaded();
  const live::Frame& cpp = expected.render(view.pose());

  sigmascape_ground* ground = sigmascape_open_ground(atlas().c_str(), 10e9, 0);
  ASSERT_NE(ground, nullptr) << sigmascape_last_error();
  sigmascape_settings settings = said_in_c(wanted);
  sigmascape_renderer* renderer = sigmascape_make_renderer(ground, &settings);
  ASSERT_NE(renderer, nullptr) << sigmascape_last_error();
  // The renderer keeps the ground.
  const sigmascape_pose pose = said_in_c(view.pose());
  sigmascape_frame frame;
  ASSERT_EQ(sigmascape_render(renderer, &pose, &frame), 0);
  EXPECT_EQ(sigmascape_wait_for_pages(ground), 0);
  sigmascape_close_ground(ground);
  ASSERT_EQ(sigmascape_scan(renderer, &pose, 0, settings.beams, &frame), 0);
  EXPECT_EQ(frame.powers_m2, nullptr);
  ASSERT_NE(frame.amplitudes_m, nullptr);
  EXPECT_EQ(frame.lit, cpp.report.lit);
  EXPECT_EQ(std::memcmp(frame.amplitudes_m, cpp.amplitudes_m.data(), cpp.amplitudes_m.size_bytes()), 0);
  sigmascape_free_renderer(renderer);
}

TEST_F(LiveFromC, TargetsAnswer) {
  const std::string table = folder_->path("nose.csv").string();
  std::ofstream(table) << "azimuth_deg, vv_dbsm, hh_dbsm\n0, 20, 20\n180, 20, 20\n";
  const live::ExampleView view;
  const live::LiveSettings wanted = view.settings(live::FrameContent::Powers);
  sigmascape_ground* ground = sigmascape_open_ground(atlas().c_str(), 10e9, 0);
  ASSERT_NE(ground, nullptr) << sigmascape_last_error();
  sigmascape_settings settings = said_in_c(wanted);
  settings.content = SIGMASCAPE_POWERS;
  sigmascape_renderer* renderer = sigmascape_make_renderer(ground, &settings);
  ASSERT_NE(renderer, nullptr) << sigmascape_last_error();
  sigmascape_pose pose = said_in_c(view.pose());
  const auto power = [&](std::size_t* seen) {
    sigmascape_frame frame;
    EXPECT_EQ(sigmascape_render(renderer, &pose, &frame), 0) << sigmascape_last_error();
    sigmascape_wait_for_pages(ground);
    EXPECT_EQ(sigmascape_render(renderer, &pose, &frame), 0) << sigmascape_last_error();
    *seen = frame.targets;
    double sum = 0.0;
    for (std::size_t i = 0; i < frame.beams * frame.ranges; ++i) sum += static_cast<double>(frame.powers_m2[4 * i]);
    return sum;
  };
  std::size_t seen = 0;
  const double alone = power(&seen);
  EXPECT_EQ(seen, 0U);

  // One stands, one is carried out of the bins between two moments, one has a table of 20 dB m².
  const Vec2d middle = view.target;
  const sigmascape_way_point way[2] = {{0.0, {middle.x + 20.0, middle.y, 2.0}},
                                       {10.0, {middle.x + 9e3, middle.y, 2.0}}};
  sigmascape_target targets[3] = {};
  targets[0].position_m[0] = middle.x;
  targets[0].position_m[1] = middle.y;
  targets[0].position_m[2] = 2.0;
  targets[0].rcs_m2[0] = 50.0F;
  targets[1] = targets[0];
  targets[1].way_points = way;
  targets[1].way_point_count = 2;
  targets[2] = targets[0];
  targets[2].rcs_table = table.c_str();
  ASSERT_EQ(sigmascape_set_targets(renderer, targets, 3), 0) << sigmascape_last_error();
  EXPECT_NEAR(power(&seen) - alone, 200.0, 0.5);
  EXPECT_EQ(seen, 3U);
  pose.time_s = 10.0;
  EXPECT_NEAR(power(&seen) - alone, 150.0, 0.5);
  EXPECT_EQ(seen, 2U);

  const double seen_m2 = static_cast<double>(view.beams * view.ranges) * view.bin_m * view.bin_m;
  // With a size it hides the ground under it, and more behind it.
  sigmascape_target box = targets[0];
  for (float& rcs : box.rcs_m2) rcs = 0.0F;
  ASSERT_EQ(sigmascape_set_targets(renderer, &box, 1), 0) << sigmascape_last_error();
  const double open = power(&seen);
  box.size_m[0] = box.size_m[1] = 40.0;
  box.size_m[2] = 2.0 * box.position_m[2];
  ASSERT_EQ(sigmascape_set_targets(renderer, &box, 1), 0) << sigmascape_last_error();
  EXPECT_LT(power(&seen), open - 40.0 * 40.0 * alone / seen_m2);
  ASSERT_EQ(sigmascape_set_targets(renderer, targets, 3), 0) << sigmascape_last_error();

  targets[2].rcs_table = "/nowhere.csv";
  EXPECT_NE(sigmascape_set_targets(renderer, targets, 3), 0);
  EXPECT_NE(std::string(sigmascape_last_error()).find("/nowhere.csv"), std::string::npos);
  targets[0].swerling = 7;
  EXPECT_NE(sigmascape_set_targets(renderer, targets, 1), 0);
  EXPECT_NE(sigmascape_set_targets(renderer, nullptr, 1), 0);
  EXPECT_NEAR(power(&seen) - alone, 150.0, 0.5) << "those before stay";
  ASSERT_EQ(sigmascape_set_targets(renderer, nullptr, 0), 0);
  EXPECT_EQ(power(&seen), alone);
  sigmascape_free_renderer(renderer);
  sigmascape_close_ground(ground);
}

TEST_F(LiveFromC, DefaultsAreThoseOfTheCppInterface) {
  const live::LiveSettings live;
  const sigmascape_settings settings = sigmascape_default_settings();
  EXPECT_EQ(settings.content == SIGMASCAPE_AMPLITUDES, live.content == live::FrameContent::Amplitudes);
  EXPECT_EQ(settings.beams, live.beams);
  EXPECT_EQ(settings.ranges, live.ranges);
  EXPECT_EQ(settings.beam_step_rad, live.beam_step_rad);
  EXPECT_EQ(settings.range_step_m, live.range_step_m);
  EXPECT_EQ(settings.cells_per_bin, live.cells_per_bin);
  EXPECT_EQ(settings.seed, live.seed);
  EXPECT_EQ(settings.threads, live.threads);
  EXPECT_EQ(settings.refraction, live.refraction);

  const simulate::LiveTraceSettings traced;
  const sigmascape_tracing tracing = sigmascape_default_tracing();
  EXPECT_EQ(tracing.frequency_hz, traced.frequency_hz);
  EXPECT_EQ(tracing.rays_per_cell, traced.rays_per_cell);
  EXPECT_EQ(tracing.max_bounces, traced.max_bounces);
  EXPECT_EQ(tracing.lattice_m, traced.lattice_m);
}

/// A target of 100 m² in the middle of the example's view, and what frames have more by it than the ground alone.
class OneTargetFromC {
 public:
  OneTargetFromC(const std::string& atlas, const live::ExampleView& view) : pose(said_in_c(view.pose())) {
    target.position_m[0] = view.target.x;
    target.position_m[1] = view.target.y;
    target.position_m[2] = 2.0;
    target.rcs_m2[0] = 100.0F;
    ground_ = sigmascape_open_ground(atlas.c_str(), 10e9, 0);
    sigmascape_settings settings = said_in_c(view.settings(live::FrameContent::Powers));
    settings.content = SIGMASCAPE_POWERS;
    renderer_ = sigmascape_make_renderer(ground_, &settings);
    if (renderer_ == nullptr) throw Error("C interface", sigmascape_last_error(), "see the test");
    frame();
    EXPECT_EQ(sigmascape_wait_for_pages(ground_), 0);
    alone_ = vv();
  }
  ~OneTargetFromC() {
    sigmascape_free_renderer(renderer_);
    sigmascape_close_ground(ground_);
  }
  OneTargetFromC(const OneTargetFromC&) = delete;
  OneTargetFromC& operator=(const OneTargetFromC&) = delete;

  /// VV of every bin [beam][range] over that of the ground.
  std::vector<double> added() {
    EXPECT_EQ(sigmascape_set_targets(renderer_, &target, 1), 0) << sigmascape_last_error();
    std::vector<double> powers = vv();
    for (std::size_t i = 0; i < powers.size(); ++i) powers[i] -= alone_[i];
    return powers;
  }
  double added_m2() {
    const std::vector<double> powers = added();
    return std::accumulate(powers.begin(), powers.end(), 0.0);
  }

  sigmascape_target target = {};
  sigmascape_pose pose;

 private:
  sigmascape_frame frame() {
    sigmascape_frame made = {};
    EXPECT_EQ(sigmascape_render(renderer_, &pose, &made), 0) << sigmascape_last_error();
    return made;
  }
  std::vector<double> vv() {
    const sigmascape_frame made = frame();
    std::vector<double> powers;
    for (std::size_t i = 0; i < made.beams * made.ranges; ++i)
      powers.push_back(static_cast<double>(made.powers_m2[4 * i]));
    return powers;
  }

  sigmascape_ground* ground_ = nullptr;
  sigmascape_renderer* renderer_ = nullptr;
  std::vector<double> alone_;
};

TEST_F(LiveFromC, TargetsFluctuateByTheirCaseSeedDwellAndPulse) {
  const live::ExampleView view;
  OneTargetFromC one(atlas(), view);
  const auto at = [&](std::uint64_t dwell, std::uint64_t pulse) {
    one.pose.dwell = dwell;
    one.pose.pulse = pulse;
    return one.added_m2();
  };
  one.target.seed = 7;
  EXPECT_NEAR(at(3, 0), 100.0, 0.1);
  for (const int by_dwell : {1, 3}) {
    one.target.swerling = by_dwell;
    EXPECT_NEAR(at(3, 5) / at(3, 0), 1.0, 1e-6) << by_dwell;
    EXPECT_GT(std::abs(at(4, 0) / at(3, 0) - 1.0), 0.01) << by_dwell;
  }
  for (const int by_pulse : {2, 4}) {
    one.target.swerling = by_pulse;
    EXPECT_GT(std::abs(at(3, 5) / at(3, 0) - 1.0), 0.01) << by_pulse;
    EXPECT_GT(std::abs(at(4, 0) / at(3, 0) - 1.0), 0.01) << by_pulse;
  }
  // As the same target of the C++ interface does, which is held to the distributions elsewhere.
  for (const int swerling : {0, 1, 2, 3, 4}) {
    radar::Target same;
    same.track = radar::Track::straight(Vec3d{view.target.x, view.target.y, 2.0});
    same.rcs_m2 = radar::Channels{100.0F, 0.0F, 0.0F, 0.0F};
    same.fluctuation = static_cast<radar::Swerling>(swerling);
    for (const std::uint64_t seed : {7U, 8U}) {
      one.target.swerling = swerling;
      one.target.seed = same.seed = seed;
      const auto rcs = radar::rcs_of(same, view.pose().position, 10e9, {.time_s = 0.0, .dwell = 9, .pulse = 2});
      EXPECT_NEAR(at(9, 2) / static_cast<double>(rcs.vv), 1.0, 1e-3) << swerling << ", seed " << seed;
    }
  }
}

TEST_F(LiveFromC, TargetsMoveByTheirVelocity) {
  // Seen from the east under 13°, and so coming nearer.
  const live::ExampleView view{.azimuth_deg = 90.0};
  OneTargetFromC one(atlas(), view);
  one.target.velocity_mps[0] = 30.0;
  const auto mean_range_m = [&](double time_s) {
    one.pose.time_s = time_s;
    const std::vector<double> powers = one.added();
    double sum = 0.0, moment = 0.0;
    for (std::size_t i = 0; i < powers.size(); ++i) {
      sum += powers[i];
      moment += powers[i] * static_cast<double>(i % view.ranges);
    }
    return moment / sum * view.settings(live::FrameContent::Powers).range_step_m;
  };
  EXPECT_NEAR(mean_range_m(0.0) - mean_range_m(5.0), 150.0 * std::cos(radians_from_deg(13.0)), 1.0);
}

TEST_F(LiveFromC, TablesTurnWithTheHeading) {
  const std::string table = folder_->path("long.csv").string();
  std::ofstream(table) << "azimuth_deg, vv_dbsm, hh_dbsm\n0, 20, 20\n90, 0, 0\n180, 20, 20\n270, 0, 0\n";
  const live::ExampleView view;
  OneTargetFromC one(atlas(), view);
  one.target.rcs_table = table.c_str();
  one.target.heading_rad = radians_from_deg(view.azimuth_deg);
  EXPECT_NEAR(one.added_m2(), 100.0, 0.5);
  one.target.heading_rad += radians_from_deg(90.0);
  EXPECT_NEAR(one.added_m2(), 1.0, 0.02);
}

TEST_F(LiveFromC, SaysWhatIsWrong) {
  EXPECT_EQ(sigmascape_open_ground("/nowhere", 10e9, 0), nullptr);
  EXPECT_NE(std::string(sigmascape_last_error()).find("/nowhere"), std::string::npos);
  EXPECT_EQ(sigmascape_open_ground(nullptr, 10e9, 0), nullptr);
  EXPECT_NE(sigmascape_wait_for_pages(nullptr), 0);
  EXPECT_NE(std::string(sigmascape_last_error()).find("ground: is null"), std::string::npos);
  EXPECT_EQ(sigmascape_open_ground(atlas().c_str(), 3e9, 0), nullptr);
  EXPECT_NE(std::string(sigmascape_last_error()).find("GHz"), std::string::npos) << sigmascape_last_error();
  const sigmascape_settings settings = sigmascape_default_settings();
  EXPECT_EQ(sigmascape_make_renderer(nullptr, &settings), nullptr);
  sigmascape_ground* ground = sigmascape_open_ground(atlas().c_str(), 10e9, 0);
  ASSERT_NE(ground, nullptr);
  sigmascape_settings none = settings;
  none.beams = 0;
  EXPECT_EQ(sigmascape_make_renderer(ground, &none), nullptr);
  sigmascape_settings overflowing = settings;
  overflowing.beams = std::size_t{1} << 33U;
  overflowing.ranges = std::size_t{1} << 31U;
  overflowing.beam_step_rad = 1e-12;
  EXPECT_EQ(sigmascape_make_renderer(ground, &overflowing), nullptr);
  sigmascape_settings wide = settings;
  wide.beams = 1;
  wide.beam_step_rad = 1.0;
  EXPECT_EQ(sigmascape_make_renderer(ground, &wide), nullptr);
  EXPECT_NE(std::string(sigmascape_last_error()).find("an eighth of a turn"), std::string::npos);
  sigmascape_settings of_nothing = settings;
  constexpr int no_content = 7;
  std::memcpy(&of_nothing.content, &no_content, sizeof no_content);
  EXPECT_EQ(sigmascape_make_renderer(ground, &of_nothing), nullptr);
  sigmascape_close_ground(ground);
}

TEST_F(LiveFromC, PosesAndTargetsThatAreNowhereAreRefused) {
  sigmascape_ground* ground = sigmascape_open_ground(atlas().c_str(), 10e9, 0);
  ASSERT_NE(ground, nullptr) << sigmascape_last_error();
  sigmascape_settings settings = sigmascape_default_settings();
  settings.beams = settings.ranges = 8;
  sigmascape_renderer* renderer = sigmascape_make_renderer(ground, &settings);
  ASSERT_NE(renderer, nullptr) << sigmascape_last_error();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  sigmascape_frame frame;
  const auto said_of_pose = [&](auto spoil) {
    sigmascape_pose pose = said_in_c(live::ExampleView().pose());
    spoil(pose);
    EXPECT_NE(sigmascape_render(renderer, &pose, &frame), 0);
    return std::string(sigmascape_last_error());
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(said_of_pose([&](auto& pose) { pose.position_m[0] = nan; }), HasSubstr("stands at (nan, "));
  EXPECT_THAT(said_of_pose([&](auto& pose) { pose.position_m[2] = infinite; }), HasSubstr("inf) m"));
  EXPECT_THAT(said_of_pose([&](auto& pose) { pose.first_azimuth_rad = nan; }), HasSubstr("first beam at nan rad"));
  EXPECT_THAT(said_of_pose([&](auto& pose) { pose.first_range_m = -5.0; }),
              HasSubstr("first range at -5 m; give 0 to"));
  EXPECT_THAT(said_of_pose([&](auto& pose) { pose.velocity_mps[1] = infinite; }), HasSubstr("flies at"));
  EXPECT_THAT(said_of_pose([&](auto& pose) { pose.time_s = nan; }), HasSubstr("time nan s"));

  const auto said_of_target = [&](auto spoil) {
    sigmascape_target target = {};
    target.rcs_m2[0] = 1.0F;
    spoil(target);
    EXPECT_NE(sigmascape_set_targets(renderer, &target, 1), 0);
    return std::string(sigmascape_last_error());
  };
  EXPECT_THAT(said_of_target([&](auto& target) { target.position_m[1] = nan; }), HasSubstr("target 0: moves in a way"));
  EXPECT_THAT(said_of_target([&](auto& target) { target.rcs_m2[1] = -1.0F; }), HasSubstr("cross-section"));
  EXPECT_THAT(said_of_target([&](auto& target) { target.size_m[2] = nan; }), HasSubstr("size"));
  // VV of 1 m2 and no HH have nothing in common; of VV and HH of 1 m2 and 4 m2 it is 2 m2 at most.
  EXPECT_THAT(said_of_target([&](auto& target) { target.rcs_m2[3] = 1.0F; }), HasSubstr("Re VV HH*"));
  EXPECT_THAT(said_of_target([&](auto& target) { target.rcs_m2[1] = 4.0F, target.rcs_m2[3] = -2.1F; }),
              HasSubstr("Re VV HH*"));
  sigmascape_target alike = {};
  alike.rcs_m2[0] = 1.0F, alike.rcs_m2[1] = 4.0F, alike.rcs_m2[3] = -2.0F;
  EXPECT_EQ(sigmascape_set_targets(renderer, &alike, 1), 0) << sigmascape_last_error();
  EXPECT_THAT(said_of_target([&](auto& target) { target.way_point_count = 2; }), HasSubstr("2 way-points at null"));
  const sigmascape_way_point way[2] = {{0.0, {}}, {1.0, {infinite, 0.0, 0.0}}};
  EXPECT_THAT(said_of_target([&](auto& target) { target.way_points = way, target.way_point_count = 2; }),
              HasSubstr("moves in a way"));

  // A step of a scan that ends beyond the last beam takes those that are there; of none there would be stale beams.
  const sigmascape_pose pose = said_in_c(live::ExampleView().pose());
  EXPECT_EQ(sigmascape_scan(renderer, &pose, 3, std::numeric_limits<std::size_t>::max(), &frame), 0);
  for (const std::size_t first : {settings.beams, std::numeric_limits<std::size_t>::max()}) {
    EXPECT_NE(sigmascape_scan(renderer, &pose, first, 2, &frame), 0);
    EXPECT_THAT(sigmascape_last_error(),
                HasSubstr(fmt::format("first_beam: is {}, and there are {} beams; give 0 to {}", first, settings.beams,
                                      settings.beams - 1)));
  }
  EXPECT_NE(sigmascape_scan(renderer, &pose, 0, 0, &frame), 0);
  EXPECT_THAT(sigmascape_last_error(), HasSubstr("count: is 0"));

  // What tracers and flights alone can tell.
  EXPECT_LT(sigmascape_advised_detail(renderer, &pose), 0);
  EXPECT_STREQ(sigmascape_last_error(), "tracer: is a renderer of another kind; give one of sigmascape_make_tracer");
  EXPECT_LT(sigmascape_textured_share(renderer), 0.0);
  EXPECT_STREQ(sigmascape_last_error(), "flight: is a renderer of another kind; give one of sigmascape_make_flight");
  sigmascape_free_renderer(renderer);
  sigmascape_close_ground(ground);
}

/// What an example prints over an atlas.
std::string printed_by(const char* example, const std::string& atlas, const std::string& output) {
  const Vec2d middle = live::ExampleGround{}.middle();
  const std::string command = std::string(example) + " " + atlas + " " + std::to_string(middle.x) + " " +
                              std::to_string(middle.y) + " > " + output;
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  std::ifstream file(output);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST_F(LiveFromC, TheExamplesRunOverTerrainInOneFileAndInTiles) {
  const std::string tiled = folder_->path("tiled").string();
  std::filesystem::copy(atlas(), tiled, std::filesystem::copy_options::recursive);
  std::filesystem::remove(std::filesystem::path(tiled) / atlas::terrain_name);
  terrain::build_pyramid(std::filesystem::path(tiled) / atlas::terrain_pyramid_name, live::ExampleGround{}.terrain(),
                         atlas::Store::open(tiled).description().frame);
  for (const char* example : {SIGMASCAPE_EXAMPLE_C, SIGMASCAPE_EXAMPLE_CPP}) {
    const std::string output = folder_->path("output.txt").string();
    const std::string whole = printed_by(example, atlas(), output);
    EXPECT_NE(whole.find("lit"), std::string::npos) << whole;
    EXPECT_EQ(whole.find(" 0 lit"), std::string::npos) << whole;
    EXPECT_EQ(printed_by(example, tiled, output), whole);
  }
}

}  // namespace
}  // namespace sigmascape
