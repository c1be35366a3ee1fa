#include "sigmascape/bake/job_share.h"

#include <algorithm>
#include <numeric>

namespace sigmascape::bake {
namespace {

/// From so many on, the slowest share of a landscape with a town or a coast takes a few percent longer than the mean.
constexpr std::size_t enough_patches_a_share = 50;

/// The least distance, squared, between two patches of one share where each row is so many shares ahead of the one
/// north of it.
std::size_t least_square_apart(std::size_t step, std::size_t shares) {
  std::size_t least = shares * shares;
  for (std::size_t rows = 1; rows * rows < least; ++rows) {
    const std::size_t ahead = rows * step % shares, columns = std::min(ahead, shares - ahead);
    least = std::min(least, columns * columns + rows * rows);
  }
  return least;
}

/// The step that keeps patches of one share farthest from one another, so that none gets a coast to itself. It has no
/// divisor in common with the shares, or in a landscape of one column some would get nothing.
std::size_t step_of(std::size_t shares) {
  std::size_t best = 1, farthest = 0;
  for (std::size_t step = 1; 2 * step <= shares; ++step) {
    if (std::gcd(step, shares) > 1) continue;
    const std::size_t apart = least_square_apart(step, shares);
    if (apart <= farthest) continue;
    best = step;
    farthest = apart;
  }
  return best;
}

}  // namespace

JobShare::JobShare(const JobList& jobs, const Shard& shard)
    : shard_(shard),
      aspects_(jobs.aspects()),
      columns_(jobs.patches().columns()),
      has_whole_patches_(jobs.patches().size() / enough_patches_a_share >= shard.count),
      step_(has_whole_patches_ ? step_of(shard.count) : 0) {}

bool JobShare::has(std::size_t job) const {
  return has_whole_patches_ ? has_patch(job / aspects_) : shard_.has(job);
}

bool JobShare::has_patch(std::size_t patch) const {
  if (!has_whole_patches_) return shard_.has(patch);
  const std::size_t column = patch % columns_, row = patch / columns_;
  return (column + row * step_) % shard_.count == shard_.index;
}

}  // namespace sigmascape::bake
