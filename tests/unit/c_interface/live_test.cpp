#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <gtest/gtest.h>

#include "scratch_folder.h"
#include "unit/render/live_ground_example.h"

#include "sigmascape/c_interface/sigmascape.h"
#include "sigmascape/terrain/height_field_file.h"

namespace sigmascape {
namespace {

class LiveFromC : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<ScratchFolder>();
    render::ExampleGround example;
    example.sigma0 = [](const radar::Look& look) { return render::constant_gamma(0.1, look); };
    const auto store = example.store(folder_->path("atlas"));
    terrain::write_height_field(folder_->path("atlas") / atlas::terrain_name, example.terrain(),
                                store.description().frame.proj());
  }
  static void TearDownTestSuite() { folder_.reset(); }
  [[nodiscard]] static std::string atlas() { return folder_->path("atlas").string(); }
  static inline std::unique_ptr<ScratchFolder> folder_;
};

TEST_F(LiveFromC, GivesTheFrameOfTheCppInterface) {
  const render::ExampleView view;
  const render::LiveSettings wanted = view.settings(render::FrameContent::Amplitudes);
  const auto shared = render::LiveGround::open(atlas(), 10e9);
  render::LiveRenderer expected(shared, wanted);
  expected.render(view.pose());
  shared->wait_until_loaded();
  const render::Frame& cpp = expected.render(view.pose());

  sigmascape_ground* ground = sigmascape_open_ground(atlas().c_str(), 10e9, 0);
  ASSERT_NE(ground, nullptr) << sigmascape_last_error();
  sigmascape_settings settings = sigmascape_default_settings();
  settings.beams = wanted.beams;
  settings.ranges = wanted.ranges;
  settings.beam_step_rad = wanted.beam_step_rad;
  settings.range_step_m = wanted.range_step_m;
  settings.refraction = wanted.refraction;
  sigmascape_renderer* renderer = sigmascape_make_renderer(ground, &settings);
  ASSERT_NE(renderer, nullptr) << sigmascape_last_error();
  // The renderer keeps the ground.
  const render::Pose at = view.pose();
  const sigmascape_pose pose{{at.position.x, at.position.y, at.position.z}, at.first_azimuth_rad, at.first_range_m, {}};
  sigmascape_frame frame;
  ASSERT_EQ(sigmascape_render(renderer, &pose, &frame), 0);
  sigmascape_wait_for_pages(ground);
  sigmascape_close_ground(ground);
  ASSERT_EQ(sigmascape_scan(renderer, &pose, 0, settings.beams, &frame), 0);
  EXPECT_EQ(frame.powers_m2, nullptr);
  ASSERT_NE(frame.amplitudes_m, nullptr);
  EXPECT_EQ(frame.lit, cpp.report.lit);
  EXPECT_EQ(std::memcmp(frame.amplitudes_m, cpp.amplitudes_m.data(), cpp.amplitudes_m.size_bytes()), 0);
  sigmascape_free_renderer(renderer);
}

TEST_F(LiveFromC, SaysWhatIsWrong) {
  EXPECT_EQ(sigmascape_open_ground("/nowhere", 10e9, 0), nullptr);
  EXPECT_NE(std::string(sigmascape_last_error()).find("/nowhere"), std::string::npos);
  EXPECT_EQ(sigmascape_open_ground(nullptr, 10e9, 0), nullptr);
  EXPECT_EQ(sigmascape_open_ground(atlas().c_str(), 3e9, 0), nullptr);
  EXPECT_NE(std::string(sigmascape_last_error()).find("GHz"), std::string::npos) << sigmascape_last_error();
  const sigmascape_settings settings = sigmascape_default_settings();
  EXPECT_EQ(sigmascape_make_renderer(nullptr, &settings), nullptr);
  sigmascape_ground* ground = sigmascape_open_ground(atlas().c_str(), 10e9, 0);
  ASSERT_NE(ground, nullptr);
  sigmascape_settings none = settings;
  none.beams = 0;
  EXPECT_EQ(sigmascape_make_renderer(ground, &none), nullptr);
  sigmascape_close_ground(ground);
}

TEST_F(LiveFromC, TheExamplesRun) {
  const Vec2d middle = render::ExampleGround{}.middle();
  for (const char* example : {SIGMASCAPE_EXAMPLE_C, SIGMASCAPE_EXAMPLE_CPP}) {
    const std::string output = folder_->path("output.txt").string();
    const std::string command = std::string(example) + " " + atlas() + " " + std::to_string(middle.x) + " " +
                                std::to_string(middle.y) + " > " + output;
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
    std::ifstream file(output);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    EXPECT_NE(text.find("lit"), std::string::npos) << text;
    EXPECT_EQ(text.find("0 lit"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace sigmascape
