#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "sigmascape/base/array2d.h"
#include "sigmascape/base/failed_lately.h"
#include "sigmascape/terrain/height_tile.h"

namespace sigmascape::terrain {

/// A tile that could not be had.
struct TileFault {
  TileKey key;
  std::string message;
};

/// Between which heights ground lies.
struct HeightBounds {
  float lowest_m = 0.0F, highest_m = 0.0F;
};

/// Terrain of any size in bounded memory: tiles at all levels, read when wanted and forgotten when others need the
/// room.
///
/// The last level's only tile is read at once and kept: whatever else fails, there is ground. Any number of threads may
/// ask at once. Tiles are handed out as shared pointers, so that what a frame has taken stays as it is, whatever is
/// forgotten meanwhile; reading a tile in hand takes no lock.
class TerrainPyramid {
 public:
  /// Reads one tile; throws Error, or whatever the system does, when it is missing or damaged.
  using Reader = std::function<std::shared_ptr<const HeightTile>(TileKey)>;

  /// `extent` is that of the heights it was made from. `summaries` holds one array a level, [column, row]. Throws what
  /// `reader` throws for the last level's tile.
  TerrainPyramid(const PyramidLayout& layout, const radar::Rectangle& extent,
                 std::vector<Array2D<TileSummary>> summaries, Reader reader, std::size_t budget_bytes,
                 std::chrono::milliseconds patience = before_another_try);

  [[nodiscard]] const PyramidLayout& layout() const { return layout_; }
  /// Where there is ground. The last tiles may reach further east and south, with heights that only fill them up.
  [[nodiscard]] const radar::Rectangle& extent() const { return extent_; }
  [[nodiscard]] int levels() const { return layout_.levels(); }
  [[nodiscard]] const TileSummary& summary(TileKey key) const {
    return summaries_[static_cast<std::size_t>(key.level)](key.column, key.row);
  }

  /// Of the ground of all levels under a rectangle and somewhat around it.
  [[nodiscard]] HeightBounds bounds_over(const radar::Rectangle& ground) const;
  /// What holds for all tiles of a level under a rectangle; for the nearest ones where there are none.
  [[nodiscard]] TileSummary summary_over(const radar::Rectangle& ground, int level) const;

  /// The tile if it is in memory, else nothing; never waits for a disk.
  [[nodiscard]] std::shared_ptr<const HeightTile> resident(TileKey key);
  /// The tile, read if need be; nothing when it cannot be had, which is then remembered as a fault and not tried again
  /// for a while (FailedLately).
  [[nodiscard]] std::shared_ptr<const HeightTile> load(TileKey key);

  /// How long tiles that could not be had are left alone.
  [[nodiscard]] std::chrono::milliseconds patience() const { return failed_.patience(); }

  [[nodiscard]] std::size_t resident_bytes() const;
  [[nodiscard]] std::size_t budget_bytes() const { return budget_bytes_; }
  /// Every tile that could not be had when it was last tried.
  [[nodiscard]] std::vector<TileFault> faults() const;

 private:
  struct Held {
    std::shared_ptr<const HeightTile> tile;
    std::uint64_t last_use = 0;
  };
  void make_room();

  PyramidLayout layout_;
  radar::Rectangle extent_;
  std::vector<Array2D<TileSummary>> summaries_;
  Reader reader_;
  std::size_t budget_bytes_;
  mutable std::mutex guard_;
  std::map<TileKey, Held> held_;
  std::map<TileKey, std::string> faults_;
  FailedLately<TileKey> failed_;
  std::uint64_t clock_ = 0;
};

}  // namespace sigmascape::terrain
