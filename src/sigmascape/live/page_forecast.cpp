#include "sigmascape/live/page_forecast.h"

#include <algorithm>

#include "sigmascape/atlas/tile_block.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/rectangle_parts.h"

namespace sigmascape::live {
namespace {

/// Whether a square of ground, from the radar, shares area with the sector; looked at along a few lines.
bool meets(const Sector& sector, double west_m, double south_m, double side_m) {
  for (const double part : {0.001, 0.25, 0.5, 0.75, 0.999}) {
    const Sector::Stretches stretches = sector.along_row(south_m + part * side_m);
    for (std::size_t s = 0; s < stretches.count; ++s) {
      if (stretches.of[s].west_m < west_m + side_m && stretches.of[s].east_m > west_m) return true;
    }
  }
  return false;
}

class Forecast {
 public:
  Forecast(const PagesThere& there, const PageSource& source, double below_m, std::vector<PageKey>& wanted)
      : there_(there), source_(source), below_m_(std::max(below_m, 1.0)), wanted_(wanted) {}

  /// The pages of a tile whose south-western corner lies there from the radar.
  void add_tile(const atlas::TileAddress& tile, Vec2d corner, double side_m) {
    // Near the radar a tile spans many aspects.
    const Vec2d nearest{std::clamp(0.0, corner.x, corner.x + side_m), std::clamp(0.0, corner.y, corner.y + side_m)};
    const double aspects_across = 4.0 * side_m / std::max(length(nearest), side_m / 4.0);
    const auto steps = static_cast<int>(std::clamp(aspects_across, 1.0, 8.0));
    for (int j = 0; j <= steps; ++j) {
      for (int i = 0; i <= steps; ++i) add_aspect(tile, corner + Vec2d{1.0 * i, 1.0 * j} * (side_m / steps));
    }
  }

 private:
  void add_aspect(const atlas::TileAddress& tile, Vec2d point) {
    const auto cotangent = static_cast<float>(length(point) / below_m_);
    const atlas::AspectCells& aspects = source_.aspects();
    add({tile, {aspects.azimuth_cell(azimuth_of(point) + pi), aspects.elevation_cell(cotangent)}});
    const atlas::AspectCells* const ground = source_.ground_aspects();
    if (ground == nullptr) return;
    const std::uint32_t elevation = ground->elevation_cell(cotangent);
    for (const std::uint32_t e : {elevation, elevation + 1U}) {
      const std::uint32_t page = e / static_cast<std::uint32_t>(GroundPage::elevations);
      if (page < source_.ground_pages()) add(PageKey::bare_ground(tile, page));
    }
  }

  void add(const PageKey& key) {
    if (wanted_.size() == wanted_.capacity() || there_.has(key)) return;
    const auto same = [&key](const PageKey& other) { return other == key; };
    if (std::ranges::none_of(wanted_, same)) wanted_.push_back(key);
  }

  PagesThere there_;
  const PageSource& source_;
  double below_m_;
  std::vector<PageKey>& wanted_;
};

}  // namespace

void add_forecast(const PagesThere& there, const PageSource& source, const ForecastView& view,
                  std::vector<PageKey>& wanted) {
  const atlas::AtlasDescription& atlas = source.description();
  const double tile_m = atlas::tile_side_m(atlas.patches, view.level);
  const radar::Rectangle seen =
      radar::common_part(radar::moved(view.sector.bounds(), {view.radar.x, view.radar.y}), atlas.extent);
  const atlas::TileBlock tiles = atlas::tiles_over(atlas.patches, seen, view.level);
  Forecast forecast(there, source, view.radar.z - view.ground_height_m, wanted);
  for (std::size_t number = 0; number < tiles.size(); ++number) {
    const atlas::TileAddress tile = tiles.at(number);
    const Vec2d corner{tile.x * tile_m - view.radar.x, tile.y * tile_m - view.radar.y};
    if (meets(view.sector, corner.x, corner.y, tile_m)) forecast.add_tile(tile, corner, tile_m);
  }
}

}  // namespace sigmascape::live
