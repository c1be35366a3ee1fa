#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <span>

#include "sigmascape/atlas/half.h"
#include "sigmascape/atlas/pyramid.h"
#include "sigmascape/atlas/store.h"

namespace sigmascape::atlas {

/// A square of tile_side × tile_side texels of one level, numbered on the world lattice: tile (0, 0) has its
/// south-western corner at the origin of the local frame, x counts eastward and y northward, at every level.
struct TileAddress {
  std::size_t level = 0;
  int x = 0;
  int y = 0;

  friend constexpr bool operator==(const TileAddress&, const TileAddress&) = default;
  friend constexpr auto operator<=>(const TileAddress&, const TileAddress&) = default;

  /// The tile of the next coarser level that covers this one.
  [[nodiscard]] constexpr TileAddress parent() const {
    return {level + 1, x >= 0 ? x / 2 : (x - 1) / 2, y >= 0 ? y / 2 : (y - 1) / 2};
  }
};

/// Side of a texel of that level.
[[nodiscard]] constexpr double texel_side_m(const PatchGrid& patches, std::size_t level) {
  return patches.texel_m * static_cast<double>(std::uint64_t{1} << level);
}

/// The texels of a tile, north up.
[[nodiscard]] radar::GroundGrid texels_of(const PatchGrid& patches, const TileAddress& tile);

/// Reads single tiles of a store, as a renderer wants them that holds only what it looks at. Levels that are coarser
/// than a patch come from the pyramid above the patches.
///
/// Any number of threads may read at once. A texture is held against its item when its first tile is read; one that is
/// not as that says counts as not there, and so does a tile that does not decode.
class TileReader {
 public:
  explicit TileReader(const Store& store, Scrutiny scrutiny = Scrutiny::Content)
      : store_(store), pyramid_(store_), scrutiny_(scrutiny) {}
  TileReader(const TileReader&) = delete;
  TileReader& operator=(const TileReader&) = delete;

  static constexpr std::size_t tile_halves = tile_side * tile_side * radar::Channels::count;

  /// Number of levels that the store can have: those of the patches and those of the pyramid above them.
  [[nodiscard]] std::size_t levels() const;

  /// Fills `halves` ([row][column][channel]) with one tile of one look. Returns σ0 of a stored 1, or 0 when the store
  /// has no such tile, or none that can be read.
  [[nodiscard]] double read(const TileAddress& tile, LookIndex look, std::span<Half, tile_halves> halves) const;

  [[nodiscard]] const AtlasDescription& description() const { return store_.description(); }
  /// Textures met so far that have an item but are not as it says.
  [[nodiscard]] std::size_t damaged() const;

 private:
  /// Where a tile stands: a texture, a level within it and a number there.
  struct Place {
    std::filesystem::path texture;
    std::size_t level = 0, index = 0;
  };
  [[nodiscard]] Place place_of(const TileAddress& tile, LookIndex look) const;
  [[nodiscard]] double scale_of(const std::filesystem::path& texture) const;

  Store store_;
  Pyramid pyramid_;
  Scrutiny scrutiny_;
  mutable std::mutex guard_;
  mutable std::map<std::filesystem::path, double> scales_;  // 0 of the damaged ones
};

}  // namespace sigmascape::atlas
