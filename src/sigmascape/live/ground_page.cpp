#include "sigmascape/live/ground_page.h"

namespace sigmascape::live {

radar::GroundGrid GroundPage::texels(const atlas::PatchGrid& patches) const {
  radar::GroundGrid grid = atlas::texels_of(patches, key.tile);
  grid.cell_m *= static_cast<double>(atlas::tile_side) / static_cast<double>(side);
  grid.columns = grid.rows = side;
  return grid;
}

void GroundPage::make_room(std::size_t texels_a_side, std::size_t look_count) {
  side = texels_a_side;
  looks = look_count;
  blocks.resize(side * side * looks * channels);
  height_m.resize(side * side);
  if (!key.is_bare_ground()) return;
  slope.resize(side * side);
  top_m.resize(side * side);
}

void GroundPage::put_look(std::size_t look, std::span<const atlas::Half> halves, float sigma0_of_stored_1) {
  scale[look] = sigma0_of_stored_1;
  const atlas::Half* from = halves.data();
  atlas::Half* to = blocks.data() + look * look_halves;
  for (std::size_t block = 0; block < side * side / vector; ++block) {
    for (std::size_t column = 0; column < vector; ++column) {
      for (std::size_t channel = 0; channel < channels; ++channel) {
        to[channel * vector + column] = from[column * channels + channel];
      }
    }
    from += look_halves;
    to += block_halves();
  }
}

}  // namespace sigmascape::live
