#pragma once

#include <atomic>
#include <cstddef>
#include <sys/types.h>
#include <vector>

#include "sigmascape/atlas/aspect_grid.h"
#include "sigmascape/atlas/half.h"
#include "sigmascape/atlas/patch_grid.h"
#include "sigmascape/atlas/store.h"

namespace sigmascape::atlas {

/// A patch in memory. All looks of all channels of a texel stand together: [row][column][look][channel].
struct PatchTexels {
  std::vector<std::vector<Half>> levels;  ///< from the finest that is wanted; empty where not read yet
  std::vector<float> scales;              ///< a look: what its halves are multiplied by
};

/// The patches of a store as an Atlas holds them, read when they are asked for and kept. Any number of threads may ask
/// at once; what one was told is there, it may look at while others ask for more. One of them reads at a time. A
/// process that is forked off meanwhile has what was there by then, and reads for itself.
class PatchTable {
 public:
  /// `looks`: which of the store's looks, in this order; levels below `finest_level` are left out.
  PatchTable(Store store, std::vector<LookIndex> looks, std::size_t finest_level, unsigned threads);

  [[nodiscard]] const PatchBlock& block() const { return block_; }
  [[nodiscard]] std::size_t levels() const { return levels_; }  ///< from the finest that is wanted to one texel
  [[nodiscard]] const std::vector<PatchTexels>& patches() const { return patches_; }  ///< in the order of the block

  /// Sees to it that these patches are there, as far as the store has such, from this level on; they are told by their
  /// place in the world. Waits for others that read, unless all is there, and heeds an Interruption meanwhile. Throws
  /// Error when a texture is missing (the bake is not finished) or not as its item says, and when they take more memory
  /// than there is; what was read before stays.
  void read(const PatchBlock& wanted, std::size_t from_level);

  /// Throws Error when any texture is missing or not as long as its item says.
  void check_whole() const;

  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  [[nodiscard]] std::vector<std::size_t> missing(const PatchBlock& wanted, std::size_t first) const;
  void check_whole(const std::vector<std::size_t>& numbers) const;
  void check_room(const std::vector<std::size_t>& numbers, std::size_t first) const;
  void fill(const std::vector<std::size_t>& numbers, std::vector<PatchTexels>& fresh, std::size_t first);
  [[nodiscard]] std::size_t halves_of(std::size_t level) const;

  Store store_;
  std::vector<LookIndex> looks_;
  std::size_t finest_level_;
  unsigned threads_;
  PatchBlock block_;
  std::size_t levels_ = 0;
  std::vector<PatchTexels> patches_;
  std::atomic<pid_t> read_in_ = 0;  ///< the process in which somebody reads
};

}  // namespace sigmascape::atlas
