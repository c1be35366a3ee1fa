#include "sigmascape/atlas/pyramid.h"

#include <iterator>
#include <map>
#include <memory>
#include <utility>

#include "sigmascape/atlas/mip_chain.h"
#include "sigmascape/atlas/stac_item.h"
#include "sigmascape/atlas/texture_file.h"

namespace sigmascape::atlas {
namespace {

std::filesystem::path path_of(const Store& store, const PyramidTile& tile, LookIndex look) {
  return folder_of(tile) / store.texture_path(tile.south_west, look).filename();
}

class Sigma0Layer final : public PyramidLayer {
 public:
  Sigma0Layer(const Store& store, LookIndex look) : store_(store), look_(look) {}

  [[nodiscard]] std::filesystem::path file_of(const PyramidTile& tile) const override {
    return path_of(store_, tile, look_);
  }

  [[nodiscard]] FoundTexture found(const std::filesystem::path& file, Scrutiny scrutiny) const override {
    return found_texture(store_, file, scrutiny);
  }

  void write(const PyramidTile& tile, const PyramidQuarters& quarters, const std::string& made_from) const override {
    const Array2D<radar::Channels> texels = area_mean(joined(quarters, decoded));
    const std::filesystem::path file = file_of(tile);
    write_texture(store_, tile, file, encoded(MipChain{texels}, fitting_scale(texels), pyramid_bits), sigma0_bands,
                  [&](TextureRecord record) {
                    record.made_from = made_from;
                    return pyramid_item_text(store_.description(), tile, look_, file, record);
                  });
  }

 private:
  const Store& store_;
  LookIndex look_;
};

}  // namespace

Pyramid::Pyramid(const Store& store)
    : PyramidTiles(store.description().patches, store.description().extent), store_(store) {}

LayerPyramid Pyramid::of(LookIndex look) const {
  return {store_, std::make_unique<Sigma0Layer>(store_, look)};
}

std::filesystem::path Pyramid::texture_path(const PyramidTile& tile, LookIndex look) const {
  return path_of(store_, tile, look);
}

bool Pyramid::is_done(const PyramidTile& tile, LookIndex look, Scrutiny scrutiny) const {
  return of(look).is_done(tile, scrutiny);
}

bool Pyramid::make(const PyramidTile& tile, LookIndex look) const {
  return of(look).make(tile);
}

std::size_t Pyramid::make_above(const std::vector<Unit>& units, Scrutiny scrutiny) const {
  std::map<LookIndex, std::vector<PatchIndex>> patches;
  for (const Unit& unit : units) patches[unit.look].push_back(unit.patch);
  std::size_t written = 0;
  for (const auto& [look, of_look] : patches) written += make_above(of_look, look, scrutiny);
  return written;
}

std::size_t Pyramid::make_above(const std::vector<PatchIndex>& patches, LookIndex look, Scrutiny scrutiny,
                                MakingNotes* notes) const {
  return of(look).make_above(patches, scrutiny, notes);
}

std::vector<StoreFault> Pyramid::hindrances(const std::vector<PyramidTile>& left_out, LookIndex look) const {
  return of(look).hindrances(left_out);
}

HalfTexture Pyramid::read_halves(const PyramidTile& tile, LookIndex look) const {
  return read_texture(store_, texture_path(tile, look), tile_side, 1,
                      "finish the bake, or make the pyramid with 'sigmascape atlas pyramid'");
}

std::vector<StoreFault> Pyramid::verify(Scrutiny scrutiny) const {
  std::vector<StoreFault> faults;
  for (LookIndex look = 0; look < store_.description().aspects.look_count(); ++look) {
    std::ranges::move(of(look).verify(scrutiny), std::back_inserter(faults));
  }
  return faults;
}

}  // namespace sigmascape::atlas
