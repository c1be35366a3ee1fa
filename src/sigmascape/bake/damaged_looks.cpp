#include "sigmascape/bake/damaged_looks.h"

#include <filesystem>
#include <utility>

#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/bake/job.h"

namespace sigmascape::bake {

std::vector<atlas::StoreFault> damaged_looks(const atlas::Store& store, const Shard& shard, atlas::Scrutiny scrutiny) {
  std::vector<atlas::StoreFault> damaged;
  const JobList jobs(store.description());
  for (std::size_t number = 0; number < jobs.size(); ++number) {
    if (!shard.has(number)) continue;
    const Job job = jobs[number];
    for (const atlas::LookIndex look : job.looks) {
      const std::filesystem::path texture = store.texture_path(job.patch, look);
      // The item is written last, so that there was a whole look where there is one.
      if (!std::filesystem::exists(store.folder() / atlas::item_path(texture))) continue;
      if (auto fault = atlas::texture_fault(store.folder(), texture, scrutiny)) damaged.push_back(std::move(*fault));
    }
  }
  return damaged;
}

}  // namespace sigmascape::bake
