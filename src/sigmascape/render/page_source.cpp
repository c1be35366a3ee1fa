#include "sigmascape/render/page_source.h"

#include <algorithm>
#include <utility>

namespace sigmascape::render {
namespace {

using atlas::Half;
using atlas::tile_side;

/// From [row][column][channel] of one look to its planes within [row][look][channel][column].
void spread_over_planes(std::span<const Half> halves, std::size_t look, std::size_t looks, std::vector<Half>& planes) {
  for (std::size_t row = 0; row < tile_side; ++row) {
    const Half* from = &halves[row * tile_side * GroundPage::channels];
    Half* to = &planes[(row * looks + look) * GroundPage::channels * tile_side];
    for (std::size_t channel = 0; channel < GroundPage::channels; ++channel) {
      for (std::size_t column = 0; column < tile_side; ++column) {
        to[channel * tile_side + column] = from[column * GroundPage::channels + channel];
      }
    }
  }
}

}  // namespace

PageSource::PageSource(const atlas::Store& store, HeightSource heights, double frequency_hz)
    : tiles_(store), heights_(std::move(heights)), aspects_(store.description().aspects, frequency_hz) {}

bool PageSource::fill(GroundPage& page) const {
  page.looks = aspects_.looks_a_cell();
  page.planes.resize(tile_side * tile_side * page.looks * GroundPage::channels);
  page.height_m.resize(tile_side * tile_side);
  const auto looks = aspects_.looks_of(page.key.aspects);
  std::vector<Half> halves(atlas::TileReader::tile_halves);
  bool found = false;
  for (std::size_t look = 0; look < page.looks; ++look) {
    const double scale =
        tiles_.read(page.key.tile, looks[look], std::span<Half, atlas::TileReader::tile_halves>(halves));
    page.scale[look] = static_cast<float>(scale);
    if (scale == 0.0) std::ranges::fill(halves, Half{0});
    spread_over_planes(halves, look, page.looks, page.planes);
    found = found || scale > 0.0;
  }
  if (found) heights_(atlas::texels_of(tiles_.description().patches, page.key.tile), page.height_m);
  return found;
}

}  // namespace sigmascape::render
