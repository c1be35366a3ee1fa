#include "results/bake.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include "sigmascape/atlas/building_file.h"
#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/atlas/obstacle_file.h"
#include "sigmascape/base/processor_stopwatch.h"
#include "sigmascape/geo/atomic_file.h"

namespace sigmascape::cli {
namespace {

/// Notes how long each texture took and passes the progress on.
class BakeTimer final : public ProgressListener {
 public:
  BakeTimer(std::filesystem::path file, ProgressListener& next) : file_(std::move(file)), next_(next) {
    std::ifstream stream(file_);
    if (!stream) return;
    try {
      seconds_ = nlohmann::json::parse(stream).get<std::vector<double>>();
    } catch (const nlohmann::json::exception&) {
      // Textures that are there are not baked again to be timed: their times are unknown, as of another run's.
    }
  }

  void advanced(std::string_view task, double done, double total, std::string_view unit) override {
    // Textures come in order; those that an earlier run baked are passed over at once and keep their time.
    const bool is_whole = task == "bake" && done == std::floor(done);
    if (is_whole && done > static_cast<double>(seconds_.size())) {
      // Of those that another run baked, or one that ended before it could write, no time is known: they are said to be
      // done before the first of this run.
      const auto count = static_cast<std::size_t>(done);
      if (done_ && done == *done_ + 1.0) {
        seconds_.resize(count - 1, unknown);
        seconds_.push_back(watch_.seconds());
      } else {
        seconds_.resize(count, unknown);
      }
      geo::write_atomically(file_, nlohmann::json(seconds_).dump());
    }
    if (is_whole) {
      watch_ = {};
      done_ = done;
    }
    next_.advanced(task, done, total, unit);
  }

  /// Of each texture; where none is known the mean of the others.
  [[nodiscard]] std::vector<double> seconds(std::size_t textures) const {
    std::vector<double> seconds = seconds_;
    seconds.resize(textures, unknown);
    std::vector<double> known;
    std::ranges::copy_if(seconds, std::back_inserter(known), [](double one) { return one != unknown; });
    const double sum = std::accumulate(known.begin(), known.end(), 0.0);
    std::ranges::replace(seconds, unknown, known.empty() ? 0.0 : sum / static_cast<double>(known.size()));
    return seconds;
  }

 private:
  static constexpr double unknown = -1.0;

  std::filesystem::path file_;
  ProgressListener& next_;
  ProcessorStopwatch watch_;
  std::optional<double> done_;  ///< what was whole last
  std::vector<double> seconds_;
};

std::pair<atlas::Store, std::vector<double>> timed_bake(const scene::Scene& scene, const bake::BakeSettings& settings,
                                                        const std::filesystem::path& folder,
                                                        ProgressListener& progress) {
  BakeTimer timer(folder / "bake_seconds.json", progress);
  bake::bake(scene, settings, folder, timer);
  auto store = atlas::Store::open(folder);
  const std::size_t textures = store.units().size();
  return {std::move(store), timer.seconds(textures)};
}

/// What a store holds of the ground and buildings apart from textures; it serves every look.
std::uintmax_t bytes_apart(const atlas::Store& store) {
  if (!atlas::keeps_ground_apart(store)) return 0;
  std::uintmax_t bytes = 0;
  if (atlas::keeps_buildings_apart(store.description()))
    bytes += std::filesystem::file_size(store.folder() / atlas::buildings_name);
  for (const auto& file : std::filesystem::recursive_directory_iterator(store.folder() / "ground")) {
    if (file.path().extension() == ".tif") bytes += file.file_size();
  }
  const atlas::LayerPyramid obstacles = atlas::obstacle_pyramid(store);
  for (std::size_t level = 0; level <= obstacles.levels(); ++level) {
    for (const atlas::PyramidTile& tile : obstacles.tiles(level)) {
      bytes += std::filesystem::file_size(store.folder() / obstacles.file_of(tile));
    }
  }
  return bytes;
}

/// What of the area of the atlas's patches is the scene's own; the rest of them, of what lies around or empty, is
/// loaded with it but is no need of maps of the scene.
double needed_share(const atlas::AtlasDescription& atlas) {
  const double patch_m2 = atlas.patches.side_m() * atlas.patches.side_m();
  return atlas.extent.width_m() * atlas.extent.height_m() /
         (patch_m2 * static_cast<double>(atlas.patches.covering(atlas.extent).size()));
}

}  // namespace

TimedBake::TimedBake(const scene::Scene& scene, const bake::BakeSettings& settings, const std::filesystem::path& folder,
                     ProgressListener& progress)
    : TimedBake(timed_bake(scene, settings, folder, progress)) {}

AtlasCost TimedBake::cost_of(const atlas::AspectSelection& selection, const atlas::Atlas& atlas) const {
  const auto looks = atlas::selected_looks(store_.description().aspects, selection);
  const double needed_bytes = needed_share(store_.description()) * static_cast<double>(atlas.memory_bytes());
  AtlasCost cost{.looks = looks.size(), .store_bytes = 0, .memory_bytes = static_cast<std::size_t>(needed_bytes)};
  const auto units = store_.units();
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (std::ranges::find(looks, units[i].look) == looks.end()) continue;
    cost.store_bytes +=
        std::filesystem::file_size(store_.folder() / store_.texture_path(units[i].patch, units[i].look));
    cost.bake_seconds += unit_seconds_[i];
  }
  cost.store_bytes += bytes_apart(store_);
  return cost;
}

}  // namespace sigmascape::cli
