#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sigmascape/atlas/half_texture.h"
#include "sigmascape/atlas/pyramid_tiles.h"
#include "sigmascape/atlas/stac_item.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/base/array2d.h"

namespace sigmascape::atlas {

/// A texture one level below: what its item records and its coarsest level, of 256² texels.
struct PyramidQuarter {
  TextureRecord record;
  HalfTexture coarsest;
};
/// North-west, north-east, south-west, south-east; nothing where the atlas has no patches.
using PyramidQuarters = std::array<std::optional<PyramidQuarter>, 4>;

/// What files stand at the places of a pyramid and at the patches under it: σ0 seen from one look, or obstacles.
class PyramidLayer {
 public:
  PyramidLayer() = default;
  PyramidLayer(const PyramidLayer&) = delete;
  PyramidLayer& operator=(const PyramidLayer&) = delete;
  virtual ~PyramidLayer() = default;

  /// Relative to the store.
  [[nodiscard]] virtual std::filesystem::path file_of(const PyramidTile& tile) const = 0;
  [[nodiscard]] virtual FoundTexture found(const std::filesystem::path& file, Scrutiny scrutiny) const = 0;
  /// Writes the file of a place of level 1 or up, made of the four below, and its item, which records `made_from`.
  virtual void write(const PyramidTile& tile, const PyramidQuarters& quarters, const std::string& made_from) const = 0;
};

/// What the making of levels has to tell besides how many files it wrote.
struct MakingNotes {
  std::vector<PyramidTile> left_out;  ///< could not be made
  std::vector<StoreFault> mended;     ///< something of them was there, with this fault
};

/// The coarser levels of one layer of an atlas: makes them of the patches, and knows which are to be made.
class LayerPyramid : public PyramidTiles {
 public:
  /// Keeps a reference to the store.
  LayerPyramid(const Store& store, std::unique_ptr<const PyramidLayer> layer);

  [[nodiscard]] std::filesystem::path file_of(const PyramidTile& tile) const { return layer_->file_of(tile); }

  /// Whether the file is there, is as its item says, and was made from what is now one level below.
  [[nodiscard]] bool is_done(const PyramidTile& tile, Scrutiny scrutiny = Scrutiny::Size) const;

  /// Makes one file from those one level below, if all of those are there and their content is as recorded. Returns
  /// whether it did.
  bool make(const PyramidTile& tile) const;

  /// Makes, level by level, what is not done and has one of the patches under it. Returns how many files were written;
  /// `notes`, if given, are added to.
  std::size_t make_above(const std::vector<PatchIndex>& patches, Scrutiny scrutiny = Scrutiny::Size,
                         MakingNotes* notes = nullptr) const;

  /// What is wrong with the files of patches that keeps places of the pyramid from being made.
  [[nodiscard]] std::vector<StoreFault> hindrances(const std::vector<PyramidTile>& left_out) const;

  /// What is wrong with it, by file. Files that cannot be made yet are no fault.
  [[nodiscard]] std::vector<StoreFault> verify(Scrutiny scrutiny = Scrutiny::Content) const;

 private:
  /// Names what is one level below by the recorded hashes; nothing when something has no item.
  [[nodiscard]] std::optional<std::string> made_from(const PyramidTile& tile) const;
  [[nodiscard]] std::optional<StoreFault> fault_of(const PyramidTile& tile, Scrutiny scrutiny) const;
  /// Nothing when it is not there or not as recorded.
  [[nodiscard]] std::optional<PyramidQuarter> quarter(const PyramidTile& part) const;

  const Store& store_;
  std::unique_ptr<const PyramidLayer> layer_;
};

/// The texels of four quarters side by side, 512². `decoded` gives the levels of a texture.
template <typename Decode>
auto joined(const PyramidQuarters& quarters, Decode decoded) {
  typename decltype(decoded(HalfTexture{}))::value_type whole(2 * tile_side, 2 * tile_side);
  for (std::size_t i = 0; i < quarters.size(); ++i) {
    if (!quarters[i]) continue;
    const auto texels = std::move(decoded(quarters[i]->coarsest).front());
    for (std::size_t row = 0; row < tile_side; ++row) {
      std::ranges::copy(texels.row(row), whole.row(i / 2 * tile_side + row).subspan(i % 2 * tile_side).begin());
    }
  }
  return whole;
}

}  // namespace sigmascape::atlas
