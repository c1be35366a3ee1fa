#pragma once

#include <filesystem>

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
  std::vector<double> unit_seconds_;  ///< in the order of Store::units
  atlas::Store store_;
};

}  // namespace sigmascape::cli
