#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>

#include "end_to_end/made_scene.h"
#include "scratch_folder.h"
#include "unit/c_interface/said_in_c.h"
#include "unit/live/live_ground_example.h"

#include "sigmascape/atlas/terrain_file.h"
#include "sigmascape/c_interface/sigmascape.h"
#include "sigmascape/scene/scene_file.h"
#include "sigmascape/simulate/live_tracer.h"
#include "sigmascape/terrain/height_field_file.h"

namespace sigmascape {
namespace {

/// Whether so many beams from that one on are the same to the byte, and not all dark.
bool holds_beams_of(const sigmascape_frame& frame, const live::Frame& cpp, std::size_t first_beam, std::size_t count) {
  const auto beams = cpp.amplitudes_m.subspan(first_beam * cpp.grid.ranges * 4, count * cpp.grid.ranges * 4);
  return std::ranges::any_of(beams, [](auto a) { return std::norm(a) > 0.0F; }) &&
         std::memcmp(frame.amplitudes_m + first_beam * cpp.grid.ranges * 8, beams.data(), beams.size_bytes()) == 0;
}

TEST(TracerFromC, GivesTheFrameOfTheCppInterface) {
  const ScratchFolder folder;
  const std::string file = end_to_end::write_made_scene(folder.path("town"), 160.0, 160.0).string();
  live::ExampleView view;
  view.target = {};
  view.bin_m = 4.0;
  view.beams = view.ranges = 24;
  const live::LiveSettings wanted = view.settings(live::FrameContent::Amplitudes);
  const live::Pose pose = view.pose();
  const scene::Scene scene = scene::read_scene(file);
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  simulate::LiveTracer expected(scene, geometry, wanted, {.rays_per_cell = 4, .lattice_m = 1.0});
  const live::Frame& cpp = expected.render(pose);

  sigmascape_scene* opened = sigmascape_open_scene(file.c_str());
  ASSERT_NE(opened, nullptr) << sigmascape_last_error();
  sigmascape_settings settings = said_in_c(wanted);
  sigmascape_tracing tracing = sigmascape_default_tracing();
  tracing.rays_per_cell = 4;
  tracing.lattice_m = 1.0;
  sigmascape_renderer* tracer = sigmascape_make_tracer(opened, &settings, &tracing);
  ASSERT_NE(tracer, nullptr) << sigmascape_last_error();
  // The tracer keeps what it looks at.
  sigmascape_close_scene(opened);

  const sigmascape_pose from = said_in_c(pose);
  sigmascape_frame frame = {};
  ASSERT_EQ(sigmascape_render(tracer, &from, &frame), 0) << sigmascape_last_error();
  EXPECT_EQ(frame.rays_per_cell, 4U);
  EXPECT_EQ(frame.median_error_db, cpp.report.median_error_db);
  ASSERT_EQ(frame.beams * frame.ranges * 4, cpp.amplitudes_m.size());
  EXPECT_TRUE(std::ranges::any_of(cpp.amplitudes_m, [](auto a) { return std::norm(a) > 0.0F; }));
  EXPECT_EQ(std::memcmp(frame.amplitudes_m, cpp.amplitudes_m.data(), cpp.amplitudes_m.size_bytes()), 0);
  EXPECT_EQ(sigmascape_advised_detail(tracer, &from), 0);

  sigmascape_target above = {};
  above.position_m[2] = 40.0;
  above.rcs_m2[0] = 1e4F;
  ASSERT_EQ(sigmascape_set_targets(tracer, &above, 1), 0) << sigmascape_last_error();
  ASSERT_EQ(sigmascape_render(tracer, &from, &frame), 0) << sigmascape_last_error();
  EXPECT_EQ(frame.targets, 1U);
  EXPECT_EQ(frame.rays_per_cell, 8U);

  ASSERT_EQ(sigmascape_set_targets(tracer, nullptr, 0), 0) << sigmascape_last_error();
  const live::Frame& step = expected.scan(pose, 5, 4);
  ASSERT_EQ(sigmascape_scan(tracer, &from, 5, 4, &frame), 0) << sigmascape_last_error();
  EXPECT_EQ(frame.cells, step.report.cells);
  EXPECT_TRUE(holds_beams_of(frame, step, 5, 4));
  sigmascape_free_renderer(tracer);
}

TEST(TracerFromC, TargetsOfTheSceneAnswerBesidesThoseThatAreSet) {
  const ScratchFolder folder;
  const std::filesystem::path file = end_to_end::write_made_scene(folder.path("town"), 160.0, 160.0);
  std::ofstream(file, std::ios::app)
      << "\n[[point_targets]]\nposition_m = [0.0, 0.0]\nheight_m = 40.0\nrcs_dbsm = 40.0\n";
  live::ExampleView view;
  view.target = {};
  view.bin_m = 4.0;
  view.beams = view.ranges = 24;
  sigmascape_scene* scene = sigmascape_open_scene(file.c_str());
  ASSERT_NE(scene, nullptr) << sigmascape_last_error();
  const sigmascape_settings settings = said_in_c(view.settings(live::FrameContent::Powers));
  sigmascape_tracing tracing = sigmascape_default_tracing();
  tracing.rays_per_cell = 1;
  sigmascape_renderer* tracer = sigmascape_make_tracer(scene, &settings, &tracing);
  ASSERT_NE(tracer, nullptr) << sigmascape_last_error();
  sigmascape_close_scene(scene);

  const sigmascape_pose pose = said_in_c(view.pose());
  sigmascape_frame frame = {};
  const auto targets_seen = [&] {
    EXPECT_EQ(sigmascape_render(tracer, &pose, &frame), 0) << sigmascape_last_error();
    return frame.targets;
  };
  EXPECT_EQ(targets_seen(), 1U);
  sigmascape_target above = {};
  above.position_m[2] = 60.0;
  above.rcs_m2[0] = 1e4F;
  ASSERT_EQ(sigmascape_set_targets(tracer, &above, 1), 0) << sigmascape_last_error();
  EXPECT_EQ(targets_seen(), 2U);
  ASSERT_EQ(sigmascape_set_targets(tracer, nullptr, 0), 0) << sigmascape_last_error();
  EXPECT_EQ(targets_seen(), 1U);
  sigmascape_free_renderer(tracer);
}

TEST(FlightFromC, TracesWhatIsSeenCloselyAndLeavesTheRestToTextures) {
  const ScratchFolder folder;
  const std::string file = end_to_end::write_made_scene(folder.path("town"), 160.0, 160.0).string();
  live::ExampleGround example;
  example.sigma0 = [](const radar::Look& look) { return live::constant_gamma(0.1, look); };
  example.scene_hash = scene::scene_hash(scene::read_scene(file));
  const auto store = example.store(folder.path("atlas"));
  terrain::write_height_field(folder.path("atlas") / atlas::terrain_name, example.terrain(),
                              store.description().frame.proj());
  atlas::vouch_for_terrain(store);
  live::ExampleView view;
  view.target = {};
  view.bin_m = 4.0;
  view.beams = view.ranges = 24;
  const live::LiveSettings wanted = view.settings(live::FrameContent::Amplitudes);
  const live::Pose pose = view.pose();
  const scene::Scene scene = scene::read_scene(file);
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  simulate::LiveTracer expected(scene, geometry, wanted, {.rays_per_cell = 4, .lattice_m = example.texel_m});
  const live::Frame& cpp = expected.render(pose);

  sigmascape_scene* town = sigmascape_open_scene(file.c_str());
  sigmascape_ground* ground = sigmascape_open_ground(folder.path("atlas").c_str(), 10e9, 0);
  ASSERT_NE(ground, nullptr) << sigmascape_last_error();
  sigmascape_settings settings = said_in_c(wanted);
  sigmascape_tracing tracing = sigmascape_default_tracing();
  tracing.rays_per_cell = 4;
  sigmascape_renderer* flight = sigmascape_make_flight(town, ground, &settings, &tracing);
  ASSERT_NE(flight, nullptr) << sigmascape_last_error();
  sigmascape_close_scene(town);
  sigmascape_close_ground(ground);

  const sigmascape_pose from = said_in_c(pose);
  sigmascape_frame frame = {};
  ASSERT_EQ(sigmascape_render(flight, &from, &frame), 0) << sigmascape_last_error();
  EXPECT_EQ(sigmascape_textured_share(flight), 0.0);
  EXPECT_EQ(frame.rays_per_cell, 4U);
  EXPECT_EQ(std::memcmp(frame.amplitudes_m, cpp.amplitudes_m.data(), cpp.amplitudes_m.size_bytes()), 0);
  const live::Frame& step = expected.scan(pose, 3, 4);
  ASSERT_EQ(sigmascape_scan(flight, &from, 3, 4, &frame), 0) << sigmascape_last_error();
  EXPECT_EQ(frame.cells, step.report.cells);
  EXPECT_TRUE(holds_beams_of(frame, step, 0, 24)) << "others are left as they were";
  sigmascape_free_renderer(flight);
  EXPECT_LT(sigmascape_textured_share(nullptr), 0.0);
  EXPECT_EQ(sigmascape_make_flight(nullptr, nullptr, &settings, &tracing), nullptr);
}

TEST(TracerFromC, WhatIsWrongIsSaid) {
  EXPECT_EQ(sigmascape_open_scene("/nowhere/scene.toml"), nullptr);
  EXPECT_NE(std::string(sigmascape_last_error()).find("/nowhere/scene.toml"), std::string::npos);
  EXPECT_EQ(sigmascape_open_scene(nullptr), nullptr);
  const sigmascape_settings settings = sigmascape_default_settings();
  const sigmascape_tracing tracing = sigmascape_default_tracing();
  EXPECT_EQ(sigmascape_make_tracer(nullptr, &settings, &tracing), nullptr);
  EXPECT_LT(sigmascape_advised_detail(nullptr, nullptr), 0);
}

}  // namespace
}  // namespace sigmascape
