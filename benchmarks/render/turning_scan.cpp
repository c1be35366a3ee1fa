#include "turning_scan.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <vector>

#include "figures.h"

#include "sigmascape/base/units.h"
#include "sigmascape/live/live_renderer.h"

namespace sigmascape::bench {
namespace {

constexpr std::size_t beams = 512, beams_a_step = 4, steps_a_turn = beams / beams_a_step;

live::LiveSettings settings() {
  live::LiveSettings settings;
  settings.beam_step_rad = 2.0 * pi / static_cast<double>(beams);
  settings.range_step_m = 24.0;
  settings.cells_per_bin = 1.0;
  return settings;
}

/// A quarter up the ground, on its way north.
live::Pose pose_at(std::size_t step, const radar::Rectangle& extent) {
  constexpr double speed_mps = 250.0, height_m = 3000.0;
  live::Pose pose;
  pose.velocity_mps = {0.0, speed_mps, 0.0};
  pose.first_range_m = 4000.0;
  pose.position = {extent.width_m() / 2.0, extent.height_m() / 4.0 + speed_mps / 60.0 * static_cast<double>(step),
                   height_m};
  return pose;
}

/// What was shown more coarsely than wanted.
struct CoarseCells {
  std::size_t coarse = 0, of = 0;

  void add(const live::FrameReport& report) {
    coarse += report.coarse + report.dark;
    of += report.cells;
  }
  [[nodiscard]] double part() const { return static_cast<double>(coarse) / static_cast<double>(of); }
};

}  // namespace

TurningScan turning_scan(const std::shared_ptr<live::LiveGround>& ground, double seconds) {
  live::LiveRenderer renderer(ground, settings());
  const auto count = static_cast<std::size_t>(60.0 * seconds);
  TurningScan scan;
  std::vector<double> steps;
  CoarseCells first_turn, later;
  const std::uint64_t pages_before = ground->pages().report().loaded;
  const auto begin = std::chrono::steady_clock::now();
  const double start_processor = processor_seconds();
  for (std::size_t step = 0; step < count; ++step) {
    const live::Pose pose = pose_at(step, ground->description().extent);
    const double start = wall_seconds();
    const live::FrameReport& report = renderer.scan(pose, step * beams_a_step % beams, beams_a_step).report;
    steps.push_back(wall_seconds() - start);
    (step < steps_a_turn ? first_turn : later).add(report);
    if (step + 1 == steps_a_turn) scan.pages_first_turn = ground->pages().report().loaded - pages_before;
    if (step + steps_a_turn >= count) scan.terrain_error_m = std::max(scan.terrain_error_m, report.terrain_error_m);
    std::this_thread::sleep_until(begin + std::chrono::microseconds(1'000'000 * (step + 1) / 60));
  }
  scan.processor = (processor_seconds() - start_processor) / static_cast<double>(count);
  scan.pages = ground->pages().report().loaded - pages_before - scan.pages_first_turn;
  std::ranges::sort(steps);
  scan.p99 = steps[count * 99 / 100];
  scan.coarse_first_turn = first_turn.part();
  scan.coarse_part = later.part();
  return scan;
}

}  // namespace sigmascape::bench
