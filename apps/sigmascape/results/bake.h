#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include "results/table.h"

#include "sigmascape/atlas/atlas.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/bake/bake.h"
#include "sigmascape/base/progress.h"

namespace sigmascape::cli {

/// A store, and the processor time that each of its textures took. The times lie in the store's folder, so that a bake
/// that was broken off keeps them.
class TimedBake {
 public:
  /// Bakes what is not there yet.
  TimedBake(const scene::Scene& scene, const bake::BakeSettings& settings, const std::filesystem::path& folder,
            ProgressListener& progress);

  [[nodiscard]] const atlas::Store& store() const { return store_; }
  /// What a part of the looks takes; `atlas` is that part, loaded.
  [[nodiscard]] AtlasCost cost_of(const atlas::AspectSelection& selection, const atlas::Atlas& atlas) const;

 private:
  explicit TimedBake(std::pair<atlas::Store, std::vector<double>> timed)
      : store_(std::move(timed.first)), unit_seconds_(std::move(timed.second)) {}

  atlas::Store store_;
  std::vector<double> unit_seconds_;  ///< in the order of Store::units
};

}  // namespace sigmascape::cli
