#include "sigmascape/live/stand_in_ground.h"

#include <map>
#include <utility>

#include "sigmascape/base/parallel.h"
#include "sigmascape/live/coarse_look.h"

namespace sigmascape::live {

StandInGround::Layout::Layout(const PageSource& source)
    : tiles(atlas::tiles_over(source.description().patches, source.description().extent, source.levels() - 1)),
      azimuths(source.aspects().azimuth_cells()),
      elevations(source.aspects().elevation_cells()),
      ground_pages(source.ground_pages()) {}

PageKey StandInGround::Layout::key_of(std::size_t page) const {
  const atlas::TileAddress tile = tiles.at(page / pages_a_tile());
  const std::size_t aspects = page % pages_a_tile();
  if (aspects >= azimuths * elevations) {
    return PageKey::bare_ground(tile, static_cast<std::uint32_t>(aspects - azimuths * elevations));
  }
  return {tile, {static_cast<std::uint32_t>(aspects / elevations), static_cast<std::uint32_t>(aspects % elevations)}};
}

std::size_t StandInGround::bytes_of(const PageSource& source, std::size_t side) {
  return Layout(source).pages() * source.most_bytes(side);
}

std::size_t StandInGround::side_within(const PageSource& source, std::size_t most_bytes) {
  std::size_t side = atlas::tile_side;
  while (side > least_side && bytes_of(source, side) > most_bytes) side /= 2;
  return side;
}

StandInGround::StandInGround(const PageSource& source, std::size_t side)
    : layout_(source), side_(side), pages_(layout_.pages()) {
  for (std::size_t page = 0; page < pages_.size(); ++page) {
    pages_[page].key = layout_.key_of(page);
    pages_[page].make_room(side_, source.looks_a_page());
  }
  read_looks(source);
  parallel_for(layout_.tiles.size(), 0, [&](std::size_t tile, unsigned) { find_relief(source, tile); });
}

void StandInGround::read_looks(const PageSource& source) {
  struct Place {
    GroundPage* page;
    std::size_t look;
  };
  std::map<std::pair<atlas::TileAddress, PageSource::StoredLook>, std::vector<Place>> places;
  for (GroundPage& page : pages_) {
    const auto looks = source.looks_of(page.key);
    for (std::size_t look = 0; look < page.looks; ++look) {
      if (looks[look].tiles != nullptr) places[{page.key.tile, looks[look]}].push_back({&page, look});
    }
  }
  const std::vector<std::pair<std::pair<atlas::TileAddress, PageSource::StoredLook>, std::vector<Place>>> all(
      places.begin(), places.end());
  parallel_for(all.size(), 0, [&](std::size_t number, unsigned) {
    const auto& [stored, wanted_in] = all[number];
    const CoarseLook look = coarse_look(*stored.second.tiles, stored.first, stored.second.index, side_);
    if (look.scale == 0.0) return;
    for (const Place& place : wanted_in) {
      place.page->put_look(place.look, look.halves, static_cast<float>(look.scale));
    }
  });
  for (const auto& [stored, wanted_in] : all) {
    for (const Place& place : wanted_in) {
      if (place.page->scale[place.look] == 0.0F) place.page->blocks.clear();
    }
  }
}

void StandInGround::find_relief(const PageSource& source, std::size_t tile) {
  const std::span pages = std::span(pages_).subspan(tile * layout_.pages_a_tile(), layout_.pages_a_tile());
  // The last is one of bare ground where there are any, and has everything.
  GroundPage& of_all = pages.back();
  source.fill_relief(of_all);
  for (GroundPage& page : pages.first(pages.size() - 1)) {
    page.height_m = of_all.height_m;
    page.stands_on_coarser_terrain = of_all.stands_on_coarser_terrain;
    page.shortages = of_all.shortages;
    if (!page.key.is_bare_ground()) continue;
    page.slope = of_all.slope;
    page.top_m = of_all.top_m;
  }
}

const GroundPage* StandInGround::find(const PageKey& key) const {
  const auto tile = layout_.tiles.number_of(key.tile);
  if (!tile) return nullptr;
  const std::size_t in_tile = key.is_bare_ground() ? layout_.azimuths * layout_.elevations + key.aspects.elevation
                                                   : key.aspects.azimuth * layout_.elevations + key.aspects.elevation;
  const GroundPage& page = pages_[*tile * layout_.pages_a_tile() + in_tile];
  return page.blocks.empty() ? nullptr : &page;
}

}  // namespace sigmascape::live
