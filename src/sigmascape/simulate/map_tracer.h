#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "sigmascape/simulate/simulate.h"
#include "sigmascape/trace/launch.h"

namespace sigmascape::receiver {
class RangeAzimuthReceiver;
}

namespace sigmascape::simulate {

/// Launch cells of a map that all get so many rays, or LaunchCell::share of them.
struct LaunchShare {
  std::vector<trace::LaunchCell> cells;
  std::uint32_t samples_per_cell = 0;
  std::uint32_t one_in = 1;  ///< of so many cells only one gets its rays, by lot, and stands for as many
};

/// Is told what each ray brought, as though it stood for its whole cell: from several threads at once, told apart by
/// `worker`, but of one cell by one thread and in order.
using RayWatcher =
    std::function<void(const trace::LaunchCell& cell, std::span<const radar::Echo> echoes, unsigned worker)>;

/// Maps of one area from one place, traced one after another. What they share, from the cells that rays are aimed at to
/// the memory of the bins, is made once.
class MapTracer {
 public:
  /// `orders` images a map, by number of bounces: the last holds what came back over more as well. Scene, geometry and
  /// targets are held by reference. `settings.samples_per_cell` and `settings.seed` have no say. Throws Error for a
  /// radar that does not stand above the scene, and for bins that are too many.
  MapTracer(const scene::Scene& scene, const trace::SceneGeometry& geometry, const radar::Radar& radar,
            const radar::Rectangle& area, const TraceSettings& settings, std::size_t orders = 1);
  ~MapTracer();

  [[nodiscard]] const trace::LaunchArea& launch() const { return launch_; }
  [[nodiscard]] const radar::RangeAzimuthGrid& bins() const { return bins_; }

  /// What the rays of the shares bring that `seed` draws, and point targets and targets where the scene lets them be
  /// seen. Throws Error for a bin that is too bright for its sums.
  [[nodiscard]] std::vector<radar::RangeAzimuthImage> map(std::span<const LaunchShare> shares, std::uint64_t seed,
                                                          trace::TraceCounts& counts,
                                                          ProgressListener* progress = nullptr,
                                                          const RayWatcher& watcher = {});

 private:
  void trace_shares(std::span<const LaunchShare> shares, std::uint64_t seed, trace::TraceCounts& counts,
                    ProgressListener* progress, const RayWatcher& watcher);
  void add(std::span<const radar::Echo> echoes);
  [[nodiscard]] std::vector<radar::RangeAzimuthImage> images() const;
  /// Of point targets and targets that the scene lets be seen.
  [[nodiscard]] std::vector<radar::Echo> echoes_of_targets() const;

  const scene::Scene& scene_;
  const trace::SceneGeometry& geometry_;
  radar::Radar radar_;
  TraceSettings settings_;
  trace::LaunchArea launch_;
  radar::RangeAzimuthGrid bins_;
  std::vector<scatter::SurfaceModel> surfaces_;
  std::vector<std::unique_ptr<receiver::RangeAzimuthReceiver>> receivers_;  // [order]
};

}  // namespace sigmascape::simulate
