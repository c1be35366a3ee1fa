#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "physics/ground_with_box.h"
#include "unit/live/live_ground_example.h"
#include "validation/validation_record.h"

#include "sigmascape/atlas/pyramid.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::physics_test {
namespace {

constexpr std::string_view live_targets_group = "Targets";
constexpr float rcs_m2 = 10.0F;

std::vector<radar::Target> one_at(Vec3d position) {
  radar::Target target;
  target.track = radar::Track::straight(position);
  target.rcs_m2 = radar::Channels{rcs_m2, rcs_m2, 0.0F, rcs_m2};
  return {target};
}

void expect_ten(const std::string& name, double measured_m2) {
  validation::expect_close(
      {live_targets_group, "10 m², " + name, 10.0, db_from_linear(measured_m2), 0.1, "dBm²", "weights sum to one"});
}

/// What it adds to the path-traced picture of the ground about it.
TEST(LiveTargets, answer_with_ten_square_metres_at_level_0) {
  const scene::Scene scene = ground_with_box(0.0, false);
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  radar::Radar radar;
  radar.frequency_hz = frequency_hz;
  radar.position = radar::position_seeing({}, pi, radians_from_deg(seen_elevation_deg), 5e3);
  radar.range_resolution_m = 2.0;
  radar.beam_width_rad = 2.0 * std::sqrt(2.0) / 5e3;
  const auto total = [&](const std::vector<radar::Target>& targets) {
    trace::TraceCounts counts;
    const auto image = simulate::traced_image(scene, geometry, radar, {-60.0, -60.0, 60.0, 60.0},
                                              {.cell_m = 2.0, .samples_per_cell = 4, .targets = targets}, counts);
    double sum = 0.0;
    for (const radar::Channels& bin : image.rcs_m2.values()) sum += static_cast<double>(bin.vv);
    return sum;
  };
  expect_ten("level of detail 0, path-traced", total(one_at({7.0, -11.0, 1.0})) - total({}));
}

/// And to live frames, from the finest level of the textures to the coarsest.
TEST(LiveTargets, answer_with_ten_square_metres_at_every_live_level) {
  const ScratchFolder folder;
  live::ExampleGround example;
  example.sigma0 = [](const radar::Look& look) { return live::constant_gamma(0.01, look); };
  const atlas::Store store = example.store(folder.path("atlas"));
  atlas::Pyramid(store).make_above(store.units());
  const auto ground = example.over(store);
  for (const double bin_m : {8.0, 16.0, 64.0}) {
    live::ExampleView view;
    view.bin_m = bin_m;
    view.ranges = view.beams = 24;
    live::LiveRenderer renderer(ground, view.settings(live::FrameContent::Powers));
    const auto total = [](const live::Frame& frame) {
      double sum = 0.0;
      for (std::size_t i = 0; i < frame.powers_m2.size(); i += 4) sum += static_cast<double>(frame.powers_m2[i]);
      return sum;
    };
    live::Pose pose = view.pose();
    const double alone = total(live::settled_frame(renderer, *ground, pose));
    const auto targets = one_at({view.target.x + 7.0, view.target.y - 11.0, 1.0});
    pose.targets = targets;
    const live::Frame& frame = renderer.render(pose);
    const std::size_t level = frame.report.level + 1;
    expect_ten("live frame at level of detail " + std::to_string(level) + ", bins of " +
                   std::to_string(static_cast<int>(bin_m)) + " m",
               total(frame) - alone);
  }
}

}  // namespace
}  // namespace sigmascape::physics_test
