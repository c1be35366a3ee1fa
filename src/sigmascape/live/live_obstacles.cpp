#include "sigmascape/live/live_obstacles.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "sigmascape/radar/rectangle_parts.h"

namespace sigmascape::live {
namespace {

constexpr std::size_t least_pages = 8;
/// Tiles that a mosaic may be wide times high, most of them without a page.
constexpr double most_in_block = 4096.0;

/// Of the tiles that the budget holds, those that a frame may lay out; their parents take a quarter of as many more.
double share_of(LiveObstacles::Part part) {
  return part == LiveObstacles::Part::UnderBins ? 0.55 : 0.15;
}

void want(const atlas::TileAddress& tile, std::vector<atlas::TileAddress>& wanted) {
  if (wanted.size() < wanted.capacity() && std::ranges::find(wanted, tile) == wanted.end()) wanted.push_back(tile);
}

radar::Rectangle whole_patches(const atlas::AtlasDescription& description) {
  const double side_m = description.patches.side_m();
  const radar::Rectangle& extent = description.extent;
  return {std::floor(extent.west_m / side_m) * side_m, std::floor(extent.south_m / side_m) * side_m,
          std::ceil(extent.east_m / side_m) * side_m, std::ceil(extent.north_m / side_m) * side_m};
}

}  // namespace

LiveObstacles::LiveObstacles(const atlas::Store& atlas, std::size_t budget_bytes, atlas::Scrutiny scrutiny)
    : budget_bytes_(std::max(budget_bytes, least_pages * ObstacleSource::most_bytes())),
      cache_(std::make_unique<Cache>(std::make_shared<const ObstacleSource>(atlas, scrutiny), budget_bytes_)),
      extent_(whole_patches(atlas.description())),
      tallest_m_(cache_->source().tallest_m()) {
  load_coarsest_level();
}

void LiveObstacles::load_coarsest_level() {
  const atlas::TileBlock block = tiles_of(cache_->source().levels() - 1);
  std::vector<atlas::TileAddress> all;
  for (std::size_t number = 0; number < block.size(); ++number) all.push_back(block.at(number));
  cache_->load(all);
}

std::size_t LiveObstacles::level_for(double step_m) const {
  std::size_t level = 0;
  while (level + 1 < cache_->source().levels() && atlas::texel_side_m(patches(), level + 1) <= step_m) ++level;
  return level;
}

atlas::TileBlock LiveObstacles::tiles_for(const Wish& wish, Part part) const {
  const radar::Rectangle area = radar::common_part(wish.ground.bounds(), extent_);
  const double most = share_of(part) * static_cast<double>(cache_->most_pages());
  atlas::TileBlock block = atlas::tiles_over(patches(), area, wish.level);
  const auto fits = [&] {
    const auto in_block = static_cast<double>(block.size());
    const double met = wish.ground.squares_met(atlas::tile_side_m(patches(), block.level));
    return in_block <= most_in_block && std::min(in_block, met) <= most;
  };
  while (block.level + 1 < cache_->source().levels() && !fits())
    block = atlas::tiles_over(patches(), area, block.level + 1);
  return block;
}

const ObstaclePage* LiveObstacles::best(const Cache::View& there, const atlas::TileAddress& tile,
                                        std::vector<atlas::TileAddress>& wanted) const {
  const std::size_t coarsest = cache_->source().levels() - 1;
  const ObstaclePage* page = there.find(tile);
  if (page == nullptr || page->another_try.is_due()) want(tile, wanted);
  atlas::TileAddress above = tile;
  for (std::size_t up = 1; above.level < coarsest && (up == 1 || page == nullptr); ++up) {
    above = above.parent();
    const ObstaclePage* const there_above = there.find(above);
    if (there_above != nullptr ? there_above->another_try.is_due() : up == 1) want(above, wanted);
    if (page == nullptr) page = there_above;
  }
  return page;
}

template <typename Each>
void LiveObstacles::for_each_tile(const atlas::TileBlock& block, const GroundSector& ground, Each each) const {
  for (std::size_t row = 0; row < block.down; ++row) {
    for (std::size_t column = 0; column < block.across; ++column) {
      const atlas::TileAddress tile = block.at(column, row);
      if (ground.may_meet(atlas::texels_of(patches(), tile).extent())) each(column, row, tile);
    }
  }
}

std::size_t LiveObstacles::lay_out(const Cache::View& there, const Wish& wish, Part part, ObstacleMosaic& mosaic,
                                   std::vector<atlas::TileAddress>& wanted) const {
  const atlas::TileBlock block = tiles_for(wish, part);
  mosaic.reset(patches(), block);
  std::size_t coarser = 0;
  for_each_tile(block, wish.ground, [&](std::size_t column, std::size_t row, const atlas::TileAddress& tile) {
    const ObstaclePage* const page = best(there, tile, wanted);
    if (page != nullptr) mosaic.put(column, row, *page);
    const bool is_as_wished = page != nullptr && page->level() == wish.level && page->levels_lacking == 0;
    if (!is_as_wished) ++coarser;
  });
  return coarser;
}

void LiveObstacles::look_ahead(const Cache::View& there, const Wish& wish,
                               std::vector<atlas::TileAddress>& wanted) const {
  for_each_tile(tiles_for(wish, Part::UnderBins), wish.ground,
                [&](std::size_t, std::size_t, const atlas::TileAddress& tile) { (void)best(there, tile, wanted); });
}

}  // namespace sigmascape::live
