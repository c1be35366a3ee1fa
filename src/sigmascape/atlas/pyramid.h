#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "sigmascape/atlas/half_texture.h"
#include "sigmascape/atlas/layer_pyramid.h"
#include "sigmascape/atlas/pyramid_tiles.h"
#include "sigmascape/atlas/store.h"

namespace sigmascape::atlas {

/// Of the mantissas of its texels: nothing is left out for their noise.
inline constexpr int pyramid_bits = 10;

/// The levels of σ0 that are coarser than one tile a patch, so that a wide view opens few files.
///
/// Each texel is the area mean of σ0 of the four it covers one level below, rounded to the nearest half of ten bits;
/// patches that the atlas does not have count as black, as what lies outside the scene does within a patch. The files
/// follow from the patches alone, so that whoever makes them makes the same bytes.
class Pyramid : public PyramidTiles {
 public:
  /// Keeps a reference.
  explicit Pyramid(const Store& store);

  /// Path of the texture relative to the store, "pyramid_2/patch_+000_-004/az045.0_el13.0_f10.000GHz.tif"; at level 0
  /// that of the patch.
  [[nodiscard]] std::filesystem::path texture_path(const PyramidTile& tile, LookIndex look) const;

  /// As LayerPyramid's, of one look.
  [[nodiscard]] bool is_done(const PyramidTile& tile, LookIndex look, Scrutiny scrutiny = Scrutiny::Size) const;
  bool make(const PyramidTile& tile, LookIndex look) const;

  /// Makes what is not done and has one of `units` under it. Returns how many textures were written.
  std::size_t make_above(const std::vector<Unit>& units, Scrutiny scrutiny = Scrutiny::Size) const;
  /// The same of one look, of which atlases of many patches need no list with all the others.
  std::size_t make_above(const std::vector<PatchIndex>& patches, LookIndex look, Scrutiny scrutiny,
                         MakingNotes* notes = nullptr) const;
  [[nodiscard]] std::vector<StoreFault> hindrances(const std::vector<PyramidTile>& left_out, LookIndex look) const;

  /// The texture as it is stored, one level of 256² texels. Throws Error when it is not there or not as its item says.
  [[nodiscard]] HalfTexture read_halves(const PyramidTile& tile, LookIndex look) const;

  /// What is wrong with the pyramid, by file. Textures that cannot be made yet are no fault.
  [[nodiscard]] std::vector<StoreFault> verify(Scrutiny scrutiny = Scrutiny::Content) const;

 private:
  [[nodiscard]] LayerPyramid of(LookIndex look) const;

  const Store& store_;
};

}  // namespace sigmascape::atlas
