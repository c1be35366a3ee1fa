#include "sigmascape/simulate/traced_to_error.h"

#include <fmt/format.h>
#include <span>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/base/parallel.h"
#include "sigmascape/simulate/cell_noise.h"
#include "sigmascape/simulate/map_tracer.h"
#include "sigmascape/simulate/pass_sums.h"

namespace sigmascape::simulate {
namespace {

/// Fewer tell too little of their scatter.
constexpr std::uint32_t fewest_passes = 8;

void check(const ErrorGoal& goal) {
  if (goal.median_error_db > 0.0 && goal.samples_a_pass > 0 && goal.most_passes >= fewest_passes) return;
  throw Error("error goal of a traced map",
              fmt::format("asks for {} dB by up to {} passes of {} rays", goal.median_error_db, goal.most_passes,
                          goal.samples_a_pass),
              fmt::format("give a positive error, at least one ray and at least {} passes", fewest_passes));
}

}  // namespace

TracedToError traced_to_error(const scene::Scene& scene, const trace::SceneGeometry& geometry,
                              const radar::Radar& radar, const radar::Rectangle& area, const TraceSettings& settings,
                              const ErrorGoal& goal, trace::TraceCounts& counts, ProgressListener* progress) {
  check(goal);
  MapTracer tracer(scene, geometry, radar, area, settings);
  PassSums sums(tracer.bins(), radar.position, area, scene.terrain.height_at(area.centre()));
  CellNoise noise(tracer.launch(), sums, goal.samples_a_pass, thread_count(settings.threads));
  const RayWatcher watcher = [&noise](const trace::LaunchCell& cell, std::span<const radar::Echo> echoes,
                                      unsigned worker) { noise.add(cell, echoes, worker); };
  std::vector<LaunchShare> shares{{tracer.launch().cells, goal.samples_a_pass}};
  double error_db = 0.0;
  for (std::uint32_t pass = 0; pass < goal.most_passes; ++pass) {
    const RayWatcher of_pass = pass == 0 ? watcher : RayWatcher();
    sums.add(tracer.map(shares, hashed(settings.seed, pass), counts, nullptr, of_pass).front());
    if (pass == 0) shares = noise.shares(goal.samples_a_pass);
    if (pass + 1 < fewest_passes) continue;
    error_db = sums.median_error_db();
    if (progress != nullptr) progress->measured("trace", "median_error_db", error_db);
    if (error_db <= goal.median_error_db) break;
  }
  return {.image = sums.mean(),
          .relative_errors = sums.relative_errors(),
          .median_error_db = error_db,
          .samples_per_cell = sums.passes() * goal.samples_a_pass};
}

}  // namespace sigmascape::simulate
