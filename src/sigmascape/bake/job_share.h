#pragma once

#include <cstddef>

#include "sigmascape/bake/job.h"
#include "sigmascape/bake/shard.h"

namespace sigmascape::bake {

/// Which of an atlas' jobs fall to a share. Nothing of it shows in what is written.
///
/// Of many patches, 50 a share, each falls to one share whole, which so makes what rays need of it once for all its
/// aspects; of fewer the jobs are dealt one by one, for patches differ in the time that they take, and a share that got
/// some dear ones would keep all waiting. docs/decisions/0162-many-patches-are-dealt-whole.md.
class JobShare {
 public:
  JobShare(const JobList& jobs, const Shard& shard);

  [[nodiscard]] bool has(std::size_t job) const;
  /// Whether what is made once for a patch, such as its ground, falls to the share: with the patch's looks where each
  /// is whole, else every so many.
  [[nodiscard]] bool has_patch(std::size_t patch) const;
  [[nodiscard]] bool has_whole_patches() const { return has_whole_patches_; }

 private:
  Shard shard_;
  std::size_t aspects_, columns_;
  bool has_whole_patches_;
  std::size_t step_;  // by how many shares a patch is ahead of the one north of it, where they are dealt whole
};

}  // namespace sigmascape::bake
