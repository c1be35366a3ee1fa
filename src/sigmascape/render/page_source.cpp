#include "sigmascape/render/page_source.h"

#include <algorithm>
#include <utility>

namespace sigmascape::render {
namespace {

using atlas::Half;
using atlas::tile_side;

/// From [row][column][channel] of one look to its part of all blocks.
void spread_over_blocks(std::span<const Half> halves, std::size_t look, GroundPage& page) {
  const Half* from = halves.data();
  Half* to = page.blocks.data() + look * GroundPage::look_halves;
  for (std::size_t block = 0; block < tile_side * tile_side / GroundPage::vector; ++block) {
    for (std::size_t column = 0; column < GroundPage::vector; ++column) {
      for (std::size_t channel = 0; channel < GroundPage::channels; ++channel) {
        to[channel * GroundPage::vector + column] = from[column * GroundPage::channels + channel];
      }
    }
    from += GroundPage::look_halves;
    to += page.block_halves();
  }
}

}  // namespace

PageSource::PageSource(const atlas::Store& store, HeightSource heights, double frequency_hz,
                       const std::optional<BareGround>& bare_ground, atlas::Scrutiny scrutiny)
    : tiles_(store, scrutiny), heights_(std::move(heights)), aspects_(store.description().aspects, frequency_hz) {
  if (bare_ground) bare_ground_.emplace(*bare_ground, frequency_hz, scrutiny);
}

std::uint32_t PageSource::ground_pages() const {
  if (!bare_ground_) return 0;
  const std::size_t elevations = bare_ground_->tiles.description().aspects.elevations_rad.size();
  return static_cast<std::uint32_t>((elevations + GroundPage::elevations - 1) / GroundPage::elevations);
}

std::size_t PageSource::most_bytes() const {
  GroundPage example;
  constexpr std::size_t texels = tile_side * tile_side;
  example.blocks.reserve(texels * aspects_.looks_a_cell() * GroundPage::channels);
  example.height_m.reserve(texels);
  if (bare_ground_) {
    example.slope.reserve(texels);
    example.top_m.reserve(texels);
  }
  return example.bytes();
}

bool PageSource::fill(GroundPage& page) const {
  page.looks = aspects_.looks_a_cell();
  page.blocks.resize(tile_side * tile_side * page.looks * GroundPage::channels);
  page.height_m.resize(tile_side * tile_side);
  if (page.key.is_bare_ground()) return fill_ground(page);
  const auto looks = aspects_.looks_of(page.key.aspects);
  std::vector<Half> halves(atlas::TileReader::tile_halves);
  for (std::size_t look = 0; look < page.looks; ++look) {
    if (!fill_look(tiles_, looks[look], look, page, halves)) return false;
  }
  heights_(atlas::texels_of(tiles_.description().patches, page.key.tile), page.height_m);
  return true;
}

bool PageSource::fill_ground(GroundPage& page) const {
  if (!bare_ground_) return false;
  page.slope.resize(tile_side * tile_side);
  page.top_m.resize(tile_side * tile_side);
  const std::size_t elevations = bare_ground_->tiles.description().aspects.elevations_rad.size();
  const std::size_t frequencies = page.looks / GroundPage::elevations;
  std::vector<Half> halves(atlas::TileReader::tile_halves);
  for (std::size_t look = 0; look < page.looks; ++look) {
    const std::size_t elevation = page.key.aspects.elevation * GroundPage::elevations + look / frequencies;
    page.scale[look] = 0.0F;
    if (elevation >= elevations) continue;
    const auto looks = bare_ground_->aspects.looks_of({0, static_cast<std::uint32_t>(elevation)});
    // Those of one elevation and azimuth lie four apart, a frequency each.
    if (!fill_look(bare_ground_->tiles, looks[4 * (look % frequencies)], look, page, halves)) return false;
  }
  heights_(atlas::texels_of(tiles_.description().patches, page.key.tile), page.height_m);
  bare_ground_->relief(page.key.tile, page.slope, page.top_m);
  return true;
}

bool PageSource::fill_look(const atlas::TileReader& tiles, atlas::LookIndex index, std::size_t look, GroundPage& page,
                           std::vector<Half>& halves) {
  const double scale = tiles.read(page.key.tile, index, std::span<Half, atlas::TileReader::tile_halves>(halves));
  if (scale == 0.0) return false;
  page.scale[look] = static_cast<float>(scale);
  spread_over_blocks(halves, look, page);
  return true;
}

}  // namespace sigmascape::render
