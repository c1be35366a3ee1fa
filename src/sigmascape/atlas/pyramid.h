#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sigmascape/atlas/half_texture.h"
#include "sigmascape/atlas/patch_grid.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::atlas {

/// One place in the pyramid above the patches: 256² texels that cover 2ˡᵉᵛᵉˡ × 2ˡᵉᵛᵉˡ patches. Its texture is one tile
/// of the finest level plus the patch's levels down to 256 texels plus `level`.
struct PyramidTile {
  std::size_t level = 1;
  PatchIndex south_west;  ///< the first of its patches; both numbers are multiples of 2ˡᵉᵛᵉˡ

  friend constexpr bool operator==(const PyramidTile&, const PyramidTile&) = default;
};

/// The levels of an atlas that are coarser than one tile a patch, so that a wide view opens few files.
///
/// Each texel is the area mean of σ0 of the four it covers one level below, rounded to the nearest half of ten bits;
/// patches that the atlas does not have count as black, as what lies outside the scene does within a patch. Levels go
/// on until a coarser one would not have fewer files: at the origin of the frame four tiles of any size meet. The files
/// follow from the patches alone, so that whoever makes them makes the same bytes.
class Pyramid {
 public:
  /// Keeps a reference.
  explicit Pyramid(const Store& store);

  [[nodiscard]] std::size_t levels() const { return levels_; }
  /// Places of one level, 1 to levels(), row by row from the north-west.
  [[nodiscard]] std::vector<PyramidTile> tiles(std::size_t level) const;
  [[nodiscard]] PyramidTile tile_over(PatchIndex patch, std::size_t level) const;
  [[nodiscard]] radar::GroundGrid texels_of(const PyramidTile& tile) const;

  /// Path of the texture relative to the store, "pyramid_2/patch_+000_-004/az045.0_el13.0_f10.000GHz.tif".
  [[nodiscard]] std::filesystem::path texture_path(const PyramidTile& tile, LookIndex look) const;

  /// Whether the texture is there, is as its item says, and was made from what is now one level below.
  [[nodiscard]] bool is_done(const PyramidTile& tile, LookIndex look, Scrutiny scrutiny = Scrutiny::Size) const;

  /// Makes one texture from those one level below, if all of those are there and their content is as recorded. Returns
  /// whether it did.
  bool make(const PyramidTile& tile, LookIndex look) const;

  /// Makes, level by level, what is not done and has one of `units` under it. Returns how many textures were written.
  std::size_t make_above(const std::vector<Unit>& units, Scrutiny scrutiny = Scrutiny::Size) const;

  /// The texture as it is stored, one level of 256² texels. Throws Error when it is not there or not as its item says.
  [[nodiscard]] HalfTexture read_halves(const PyramidTile& tile, LookIndex look) const;

  /// What is wrong with the pyramid, by file. Textures that cannot be made yet are no fault.
  [[nodiscard]] std::vector<StoreFault> verify(Scrutiny scrutiny = Scrutiny::Content) const;

 private:
  /// A texture one level below, if the atlas has that place at all.
  struct Source {
    std::filesystem::path texture;
    std::size_t side = tile_side, levels = 1;
  };
  /// North-west, north-east, south-west, south-east.
  using Sources = std::array<std::optional<Source>, 4>;

  [[nodiscard]] Sources sources_of(const PyramidTile& tile, LookIndex look) const;
  /// Names what the sources hold by their recorded hashes; nothing when one has no item.
  [[nodiscard]] std::optional<std::string> made_from(const Sources& sources) const;
  [[nodiscard]] std::optional<StoreFault> fault_of(const PyramidTile& tile, LookIndex look, Scrutiny scrutiny) const;
  [[nodiscard]] bool has(const PyramidTile& tile) const;

  const Store& store_;
  PatchIndex first_, last_;  // south-western and north-eastern patch of the atlas
  std::size_t levels_ = 0;
};

}  // namespace sigmascape::atlas
