#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "frame_numbers.h"
#include "live_ground_example.h"

namespace sigmascape::live {
namespace {

double high_waves(double along_m) {
  return 1.0 + 0.8 * std::sin(2.0 * pi * along_m / 256.0);
}

/// Texels of 4 m with waves from west to east.
ExampleGround fine_ground(int patches_a_side) {
  ExampleGround ground = even_example();
  ground.patches_a_side = patches_a_side;
  ground.pattern = [](const radar::Look&, Vec2d from_middle) { return static_cast<float>(high_waves(from_middle.x)); };
  return ground;
}

/// That is level 0; the coarser ones are of something else: four times the power, and waves from south to north.
atlas::Store unlike_levels(const std::filesystem::path& folder) {
  const ExampleGround fine = fine_ground(2);
  ExampleGround coarse = fine;
  coarse.pattern = [](const radar::Look&, Vec2d from_middle) {
    return static_cast<float>(4.0 * high_waves(from_middle.y));
  };
  atlas::Store store = coarse.store(folder);
  atlas::Pyramid(store).make_above(store.units());
  fine.write_patterned(store);
  return store;
}

/// Bins that are narrower across than along: from 4 km away two a texel of 8 m would be enough, from 2.8 km they ask
/// for texels of 4 m.
const ExampleView view{.target = {512.0, 512.0}, .beams = 24, .ranges = 24, .bin_m = 24.0};

LiveSettings bins(FrameContent content) {
  LiveSettings settings = view.settings(content);
  settings.beam_step_rad *= 0.85;
  return settings;
}

Pose from_nearby() {
  Pose pose = view.pose();
  const Vec3d target{view.target.x, view.target.y, 0.0};
  pose.position = target + (pose.position - target) * 0.7;
  pose.first_range_m -= 0.3 * view.slant_range_m;
  return pose;
}

double root_mean_square(const std::vector<float>& numbers) {
  double sum = 0.0;
  for (const double number : numbers) sum += number * number;
  return std::sqrt(sum / static_cast<double>(numbers.size()));
}

/// Frames while level 0 gives way to level 1 before a radar that stands still, and what either shows by itself.
class ChangeOfLevel : public testing::TestWithParam<FrameContent> {
 protected:
  static constexpr int frames = 30;

  [[nodiscard]] static std::vector<float> alone(const ExampleGround& example, const atlas::Store& store,
                                                std::size_t level) {
    const auto ground = example.over(store);
    LiveRenderer renderer(ground, bins(GetParam()));
    const Frame& frame = settled_frame(renderer, *ground, view.pose());
    EXPECT_EQ(frame.report.level, level);
    EXPECT_EQ(frame.report.coarse + frame.report.dark, 0U);
    return numbers_of(frame);
  }
};

TEST_P(ChangeOfLevel, SharesThePowerOfEveryBinBetweenTheTwo) {
  const ScratchFolder folder;
  // Of a single patch there is no other level.
  const ExampleGround only_fine = fine_ground(1), both = fine_ground(2);
  const std::vector<float> fine = alone(only_fine, only_fine.store(folder.path("fine")), 0);
  const atlas::Store store = unlike_levels(folder.path("both"));
  const std::vector<float> coarse = alone(both, store, 1);
  const double size = root_mean_square(fine);
  ASSERT_GT(root_mean_square(coarse), 1.5 * size) << "the levels are unlike";

  const auto ground = both.over(store);
  LiveRenderer renderer(ground, bins(GetParam()));
  ASSERT_EQ(settled_frame(renderer, *ground, from_nearby()).report.level, 0U);
  // Pages of both levels, seen from where the change begins.
  for (int frame = 0; frame < 2; ++frame) {
    LiveRenderer changing(ground, bins(GetParam()));
    changing.render(from_nearby());
    changing.render(view.pose());
    ground->wait_until_loaded();
  }

  for (int frame = 1; frame <= frames + 3; ++frame) {
    const Frame& shown = renderer.render(view.pose());
    ASSERT_EQ(shown.report.coarse + shown.report.dark, 0U) << frame;
    const double share = std::min(1.0, static_cast<double>(frame) / frames);
    // Of I/Q it is the squares that are shared.
    const bool is_power = GetParam() == FrameContent::Powers;
    const double of_fine = is_power ? 1.0 - share : std::sqrt(1.0 - share),
                 of_coarse = is_power ? share : std::sqrt(share);
    const std::vector<float> numbers = numbers_of(shown);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      ASSERT_NEAR(numbers[i], of_fine * fine[i] + of_coarse * coarse[i], 1e-4 * size) << "frame " << frame << ", " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OfEither, ChangeOfLevel, testing::Values(FrameContent::Powers, FrameContent::Amplitudes));

}  // namespace
}  // namespace sigmascape::live
