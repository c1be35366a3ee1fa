#pragma once

#include <cstddef>
#include <span>

#include "sigmascape/atlas/store.h"
#include "sigmascape/atlas/tile_address.h"
#include "sigmascape/atlas/vouched_files.h"
#include "sigmascape/radar/obstacle.h"

namespace sigmascape::atlas {

/// Reads what stands on single tiles of an atlas that keeps its ground apart, as a renderer wants them that holds only
/// what it looks at. Levels and addresses are those of TileReader, and each coarser level is made from the finer one by
/// radar::merged.
///
/// Any number of threads may read at once. A file is held against its item when its first tile is read; one that is not
/// as that says counts as not there, and so does a tile that does not decode.
class ObstacleTiles {
 public:
  /// Throws Error when it comes to know that obstacles of the atlas are of a former kind, without coarser levels.
  explicit ObstacleTiles(const Store& atlas, Scrutiny scrutiny = Scrutiny::Content);
  ObstacleTiles(const ObstacleTiles&) = delete;
  ObstacleTiles& operator=(const ObstacleTiles&) = delete;

  static constexpr std::size_t tile_texels = tile_side * tile_side;

  /// Number of levels that the atlas can have: those of the patches and those of the pyramid above them.
  [[nodiscard]] std::size_t levels() const;

  /// Fills `obstacles` ([row][column], north up, tile_side²) with one tile. Nothing stands on a tile under which the
  /// atlas has no patch: that is no fault. False when the atlas has no such level, or its tile is not there or cannot
  /// be read; what is in `obstacles` then is of no meaning.
  [[nodiscard]] bool read(const TileAddress& tile, std::span<radar::Obstacle> obstacles) const;

  /// Nothing on any tile of any level, solid or crown, is higher above its ground. Of patches whose obstacles have no
  /// item nothing is known, and they count as bare, as they do for read.
  [[nodiscard]] float tallest_m() const { return tallest_m_; }

  /// Files met so far that have an item but are not as it says or do not decode, as those of a former kind beneath
  /// levels that are none, or that are missing although the atlas has patches there.
  [[nodiscard]] std::size_t damaged() const { return files_.damaged() + files_.missing(); }
  [[nodiscard]] const AtlasDescription& description() const { return store_.description(); }

 private:
  Store store_;
  PyramidTiles places_;
  VouchedFiles files_;
  float tallest_m_ = 0.0F;
};

}  // namespace sigmascape::atlas
