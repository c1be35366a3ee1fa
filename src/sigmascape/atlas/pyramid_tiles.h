#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "sigmascape/atlas/patch_grid.h"
#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::atlas {

/// One place in the pyramid above the patches: 256² texels that cover 2ˡᵉᵛᵉˡ × 2ˡᵉᵛᵉˡ patches. Its texture is one tile
/// of the finest level plus the patch's levels down to 256 texels plus `level`. At level 0 it is a patch.
struct PyramidTile {
  std::size_t level = 1;
  PatchIndex south_west;  ///< the first of its patches; both numbers are multiples of 2ˡᵉᵛᵉˡ

  friend constexpr bool operator==(const PyramidTile&, const PyramidTile&) = default;
};

/// Its folder relative to the store, "pyramid_2/patch_+000_-004"; at level 0 that of the patch, "patch_+003_-002".
[[nodiscard]] std::filesystem::path folder_of(const PyramidTile& tile);

/// The finest texels of a file that stands there.
[[nodiscard]] radar::GroundGrid texels_of(const PatchGrid& patches, const PyramidTile& tile);

/// The places of the pyramid above the patches of an area. Levels go on until a coarser one would not have fewer
/// places: at the origin of the frame four of any size meet.
class PyramidTiles {
 public:
  PyramidTiles(const PatchGrid& patches, const radar::Rectangle& extent);

  [[nodiscard]] std::size_t levels() const { return levels_; }
  /// Places of one level, 0 to levels(), row by row from the north-west.
  [[nodiscard]] std::vector<PyramidTile> tiles(std::size_t level) const;
  [[nodiscard]] PyramidTile tile_over(PatchIndex patch, std::size_t level) const;
  /// The one that covers it one level above; nothing of those of the coarsest level.
  [[nodiscard]] std::optional<PyramidTile> parent_of(const PyramidTile& tile) const;
  /// Whether a patch of the area lies under it.
  [[nodiscard]] bool has(const PyramidTile& tile) const;
  /// The four one level below a place of level 1 or up: north-west, north-east, south-west, south-east, as far as there
  /// are such.
  [[nodiscard]] std::array<std::optional<PyramidTile>, 4> parts_of(const PyramidTile& tile) const;

 private:
  PatchGrid patches_;
  PatchIndex first_, last_;  // south-western and north-eastern patch of the area
  std::size_t levels_ = 0;
};

}  // namespace sigmascape::atlas
