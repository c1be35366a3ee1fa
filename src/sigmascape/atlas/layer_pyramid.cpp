#include "sigmascape/atlas/layer_pyramid.h"

#include <tuple>

#include "sigmascape/atlas/half_cog.h"
#include "sigmascape/base/sha256.h"

namespace sigmascape::atlas {

LayerPyramid::LayerPyramid(const Store& store, std::unique_ptr<const PyramidLayer> layer)
    : PyramidTiles(store.description().patches, store.description().extent), store_(store), layer_(std::move(layer)) {}

std::optional<std::string> LayerPyramid::made_from(const PyramidTile& tile) const {
  Sha256 sha;
  for (const auto& part : parts_of(tile)) {
    if (!part) {
      sha.add("black");
      continue;
    }
    const auto record = texture_record(store_, file_of(*part));
    if (!record) return std::nullopt;
    sha.add(record->sha256);
  }
  return sha.hex_digest();
}

std::optional<StoreFault> LayerPyramid::fault_of(const PyramidTile& tile, Scrutiny scrutiny) const {
  const std::filesystem::path file = file_of(tile);
  auto found = layer_->found(file, scrutiny);
  if (found.fault) return std::move(found.fault);
  if (found.record->made_from == made_from(tile)) return std::nullopt;
  return StoreFault{file, "was made from other files than now are one level below"};
}

bool LayerPyramid::is_done(const PyramidTile& tile, Scrutiny scrutiny) const {
  return !fault_of(tile, scrutiny);
}

std::optional<PyramidQuarter> LayerPyramid::quarter(const PyramidTile& part) const {
  const std::filesystem::path file = file_of(part);
  const auto [record, fault] = layer_->found(file, Scrutiny::Content);
  if (fault) return std::nullopt;
  const std::size_t coarsest = part.level == 0 ? store_.description().patches.stored_levels() - 1 : 0;
  std::vector<Half> halves(tile_side * tile_side * std::tuple_size_v<BandNames>);
  if (!read_half_tile(store_.folder() / file, coarsest, 0, halves)) return std::nullopt;
  return PyramidQuarter{*record, {tile_side, record->scale, {std::move(halves)}}};
}

bool LayerPyramid::make(const PyramidTile& tile) const {
  const auto origin = made_from(tile);
  if (!origin) return false;
  const auto parts = parts_of(tile);
  PyramidQuarters quarters;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!parts[i]) continue;
    quarters[i] = quarter(*parts[i]);
    if (!quarters[i]) return false;
  }
  layer_->write(tile, quarters, *origin);
  return true;
}

std::size_t LayerPyramid::make_above(const std::vector<PatchIndex>& patches, Scrutiny scrutiny,
                                     MakingNotes* notes) const {
  std::size_t written = 0;
  for (std::size_t level = 1; level <= levels(); ++level) {
    std::vector<PatchIndex> wanted;
    for (const PatchIndex& patch : patches) wanted.push_back(tile_over(patch, level).south_west);
    const auto place = [](const PatchIndex& patch) { return std::tuple(patch.y, patch.x); };
    std::ranges::sort(wanted, {}, place);
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
    for (const PatchIndex& south_west : wanted) {
      const PyramidTile tile{level, south_west};
      auto fault = fault_of(tile, scrutiny);
      if (!fault) continue;
      const bool is_made = make(tile);
      written += is_made ? 1 : 0;
      if (notes == nullptr) continue;
      if (!is_made) notes->left_out.push_back(tile);
      if (is_made && !fault->is_absent) notes->mended.push_back(std::move(*fault));
    }
  }
  return written;
}

std::vector<StoreFault> LayerPyramid::hindrances(const std::vector<PyramidTile>& left_out) const {
  std::vector<StoreFault> faults;
  for (const PyramidTile& tile : left_out) {
    // What is higher up waits for a file of the pyramid, which is left out itself.
    if (tile.level != 1) continue;
    for (const auto& patch : parts_of(tile)) {
      if (!patch) continue;
      if (auto fault = layer_->found(file_of(*patch), Scrutiny::Content).fault) faults.push_back(std::move(*fault));
    }
  }
  return faults;
}

std::vector<StoreFault> LayerPyramid::verify(Scrutiny scrutiny) const {
  std::vector<StoreFault> faults;
  for (std::size_t level = 1; level <= levels(); ++level) {
    for (const PyramidTile& tile : tiles(level)) {
      auto fault = fault_of(tile, scrutiny);
      if (fault && made_from(tile)) faults.push_back(std::move(*fault));
    }
  }
  return faults;
}

}  // namespace sigmascape::atlas
