#include "frame_cost.h"

#include <algorithm>
#include <vector>

#include "figures.h"

namespace sigmascape::bench {

namespace {

bool lacks(const live::FrameReport& report) {
  return report.coarse + report.dark + report.coarse_obstacles > 0 || report.terrain_error_m > 0.0;
}

}  // namespace

const live::Frame& settled(live::LiveRenderer& renderer, live::LiveGround& ground, const live::Pose& pose) {
  const live::Frame* frame = &renderer.render(pose);
  for (int again = 0; again < 50 && lacks(frame->report); ++again) {
    ground.wait_until_loaded();
    frame = &renderer.render(pose);
  }
  return *frame;
}

FrameCost frame_cost(live::LiveRenderer& renderer, live::LiveGround& ground, const live::Pose& pose, int repetitions) {
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
