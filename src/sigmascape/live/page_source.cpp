#include "sigmascape/live/page_source.h"

#include <algorithm>
#include <utility>

#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/radar/answering_tops.h"

namespace sigmascape::live {
namespace {

using atlas::Half;
using atlas::tile_side;

/// Of each of fewer squares [row][column] from those that it covers.
void find_coarser_tops(std::span<const float> finer, std::size_t finer_side, std::span<float> coarser,
                       std::size_t side) {
  const std::size_t each = finer_side / side;
  std::ranges::fill(coarser, 0.0F);
  for (std::size_t row = 0; row < finer_side; ++row) {
    for (std::size_t column = 0; column < finer_side; ++column) {
      float& top_m = coarser[row / each * side + column / each];
      top_m = std::max(top_m, finer[row * finer_side + column]);
    }
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

std::size_t PageSource::most_bytes(std::size_t side) const {
  const std::size_t of_looks = looks_a_page() * GroundPage::channels * sizeof(Half);
  const std::size_t of_relief = sizeof(float) + (bare_ground_ ? sizeof(terrain::PackedSlope) + sizeof(float) : 0);
  return side * side * (of_looks + of_relief) + sizeof(GroundPage);
}

std::array<PageSource::StoredLook, atlas::AspectCells::most_looks> PageSource::looks_of(const PageKey& key) const {
  if (key.is_bare_ground()) return looks_of_ground(key.aspects.elevation);
  std::array<StoredLook, atlas::AspectCells::most_looks> looks;
  const auto indices = aspects_.looks_of(key.aspects);
  for (std::size_t look = 0; look < looks_a_page(); ++look) looks[look] = {&tiles_, indices[look]};
  return looks;
}

std::array<PageSource::StoredLook, atlas::AspectCells::most_looks> PageSource::looks_of_ground(
    std::uint32_t page) const {
  std::array<StoredLook, atlas::AspectCells::most_looks> looks;
  if (!bare_ground_) return looks;
  const std::size_t elevations = bare_ground_->tiles.description().aspects.elevations_rad.size();
  const std::size_t frequencies = looks_a_page() / GroundPage::elevations;
  for (std::size_t look = 0; look < looks_a_page(); ++look) {
    const std::size_t elevation = page * GroundPage::elevations + look / frequencies;
    if (elevation >= elevations) break;
    const auto indices = bare_ground_->aspects.looks_of({0, static_cast<std::uint32_t>(elevation)});
    // Those of one elevation and azimuth lie four apart, a frequency each.
    looks[look] = {&bare_ground_->tiles, indices[4 * (look % frequencies)]};
  }
  return looks;
}

bool PageSource::fill(GroundPage& page) const {
  if (page.key.is_bare_ground() && !bare_ground_) return false;
  page.make_room(tile_side, looks_a_page());
  page.scale.fill(0.0F);
  const auto looks = looks_of(page.key);
  std::vector<Half> halves(atlas::TileReader::tile_halves);
  for (std::size_t look = 0; look < page.looks; ++look) {
    if (looks[look].tiles == nullptr) continue;
    const double scale = looks[look].tiles->read(page.key.tile, looks[look].index,
                                                 std::span<Half, atlas::TileReader::tile_halves>(halves));
    if (scale == 0.0) return false;
    page.put_look(look, halves, static_cast<float>(scale));
  }
  fill_relief(page);
  return true;
}

void PageSource::fill_relief(GroundPage& page) const {
  const radar::GroundGrid texels = page.texels(description().patches);
  page.shortages.clear();
  const auto keep = [&page](Shortage shortage) {
    if (shortage) page.shortages.push_back(std::move(shortage));
  };
  keep(heights_(texels, page.height_m));
  page.stands_on_coarser_terrain = page.lacks_something();
  if (!page.key.is_bare_ground()) return;
  keep(bare_ground_->slopes(texels, page.slope));
  if (page.side == tile_side) {
    keep(bare_ground_->tops(page.key.tile, page.top_m));
  } else {
    std::vector<float> top_m(tile_side * tile_side);
    keep(bare_ground_->tops(page.key.tile, top_m));
    find_coarser_tops(top_m, tile_side, page.top_m, page.side);
  }
  radar::add_what_comes_from_afar(page.top_m, atlas::from_afar(description()));
}

bool PageSource::can_be_better(const GroundPage& page) {
  return std::ranges::any_of(page.shortages, [](const Shortage& shortage) { return shortage(); });
}

bool PageSource::renew(const GroundPage& former, GroundPage& page) const {
  page.make_room(former.side, former.looks);
  page.blocks = former.blocks;
  page.scale = former.scale;
  fill_relief(page);
  return true;
}

}  // namespace sigmascape::live
