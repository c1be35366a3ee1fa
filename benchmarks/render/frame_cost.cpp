#include "frame_cost.h"

#include <algorithm>
#include <vector>

#include "figures.h"

namespace sigmascape::bench {

namespace {

bool lacks(const render::FrameReport& report) {
  return report.coarse + report.dark + report.coarse_obstacles > 0 || report.terrain_error_m > 0.0;
}

}  // namespace

const render::Frame& settled(render::LiveRenderer& renderer, render::LiveGround& ground, const render::Pose& pose) {
  const render::Frame* frame = &renderer.render(pose);
  for (int again = 0; again < 50 && lacks(frame->report); ++again) {
    ground.wait_until_loaded();
    frame = &renderer.render(pose);
  }
  return *frame;
}

FrameCost frame_cost(render::LiveRenderer& renderer, render::LiveGround& ground, const render::Pose& pose,
                     int repetitions) {
  FrameCost cost;
  cost.report = settled(renderer, ground, pose).report;
  std::vector<double> walls;
  for (int run = 0; run < repetitions; ++run) {
    const double wall = wall_seconds(), processor = processor_seconds();
    (void)renderer.render(pose);
    walls.push_back(wall_seconds() - wall);
    cost.processor = std::min(cost.processor, processor_seconds() - processor);
  }
  std::ranges::sort(walls);
  cost.wall = walls.front();
  cost.median_wall = walls[walls.size() / 2];
  return cost;
}

}  // namespace sigmascape::bench
