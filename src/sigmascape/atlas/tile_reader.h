#pragma once

#include <memory>
#include <span>

#include "sigmascape/atlas/half.h"
#include "sigmascape/atlas/pyramid.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/atlas/tile_address.h"
#include "sigmascape/atlas/vouched_files.h"

namespace sigmascape::atlas {

/// Reads single tiles of an atlas, as a renderer wants them that holds only what it looks at. Levels that are coarser
/// than a patch come from the pyramid above the patches. What buildings that are kept apart return directly is added,
/// where that has textures of its own.
///
/// Any number of threads may read at once. A texture is held against its item when its first tile is read; one that is
/// not as that says counts as not there, and so does a tile that does not decode.
class TileReader {
 public:
  explicit TileReader(const Store& store, Scrutiny scrutiny = Scrutiny::Content);
  TileReader(const TileReader&) = delete;
  TileReader& operator=(const TileReader&) = delete;

  static constexpr std::size_t tile_halves = tile_side * tile_side * radar::Channels::count;

  /// Number of levels that the store can have: those of the patches and those of the pyramid above them.
  [[nodiscard]] std::size_t levels() const;

  /// Fills `halves` ([row][column][channel]) with one tile of one look. Returns σ0 of a stored 1, or 0 when the store
  /// has no such tile, or none that can be read.
  [[nodiscard]] double read(const TileAddress& tile, LookIndex look, std::span<Half, tile_halves> halves) const;

  [[nodiscard]] const AtlasDescription& description() const { return store_.description(); }
  /// Textures met so far that have an item but are not as it says or do not decode.
  [[nodiscard]] std::size_t damaged() const { return files_.damaged() + (buildings_ ? buildings_->damaged() : 0); }

 private:
  [[nodiscard]] double read_own(const TileAddress& tile, LookIndex look, std::span<Half, tile_halves> halves) const;

  Store store_;
  Pyramid pyramid_;
  VouchedFiles files_;
  std::unique_ptr<const TileReader> buildings_;  // null where they have no textures of their own
};

}  // namespace sigmascape::atlas
