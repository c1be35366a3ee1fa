#include "sigmascape/live/live_ground.h"

#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>

#include "sigmascape/atlas/building_file.h"
#include "sigmascape/atlas/building_textures.h"
#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/atlas/terrain_file.h"
#include "sigmascape/base/error.h"
#include "sigmascape/terrain/height_field_file.h"
#include "sigmascape/terrain/pyramid_faults.h"
#include "sigmascape/terrain/pyramid_files.h"
#include "sigmascape/terrain/pyramid_levels.h"

namespace sigmascape::live {
namespace {

/// Of the budget, the parts that tiles of terrain, windows of them, tiles of obstacles, and what stands in for pages
/// may take.
constexpr std::size_t tile_part = 32, window_part = 8, obstacle_part = 8, stand_in_part = 8;

/// Frames take from textures what buildings return directly.
void check_buildings(const atlas::Store& store) {
  const atlas::AtlasDescription& description = store.description();
  if (!atlas::keeps_buildings_apart(description) || atlas::keeps_building_textures(description)) return;
  throw Error(store.folder().string(), "keeps its buildings apart, which maps know but live frames do not",
              "bake an atlas with --buildings both, or without the option, for live frames");
}

std::unique_ptr<LiveObstacles> obstacles_of(const atlas::Store& store, const CacheOptions& options) {
  if (!atlas::keeps_ground_apart(store)) return nullptr;
  return std::make_unique<LiveObstacles>(store, options.budget_bytes / obstacle_part, options.scrutiny);
}

/// As far from a frame's origin as a radar may stand; false for what is no number.
bool is_within_reach(Vec2d place) {
  constexpr double furthest_m = 1e7;
  return std::abs(place.x) <= furthest_m && std::abs(place.y) <= furthest_m;
}

/// What is not for pages.
std::size_t beside_pages(const CacheOptions& options, const LiveObstacles* obstacles) {
  return options.budget_bytes / tile_part + options.budget_bytes / window_part +
         (obstacles != nullptr ? obstacles->budget_bytes() : 0);
}

/// Texels a side of the pages that stand in. Throws Error when they leave no room for a single other.
std::size_t side_of_stand_in(const PageSource& source, std::size_t budget_bytes, std::size_t others) {
  const std::size_t side = StandInGround::side_within(source, budget_bytes / stand_in_part);
  const std::size_t stand_in = StandInGround::bytes_of(source, side), page = source.most_bytes();
  if (budget_bytes < others + stand_in + page) {
    throw Error("live ground", fmt::format("has a budget of {} bytes", budget_bytes),
                fmt::format("terrain and obstacles take {} of them, the coarsest ground of all looks {} and a single "
                            "page {}; give enough for some tens of pages",
                            others, stand_in, page));
  }
  return side;
}

std::shared_ptr<const PageSource> source_of(const atlas::Store& store, const LiveTerrain& terrain,
                                            const LiveObstacles* obstacles, double frequency_hz,
                                            atlas::Scrutiny scrutiny) {
  check_buildings(store);
  atlas::check_frequency(store.description().aspects, frequency_hz);
  const HeightSource heights = [&terrain](const radar::GroundGrid& cells, std::span<float> height_m) {
    return terrain.fill_heights(cells, height_m);
  };
  if (obstacles == nullptr) {
    return std::make_shared<const PageSource>(store, heights, frequency_hz, std::nullopt, scrutiny);
  }
  const atlas::Store ground = atlas::open_ground_store(store);
  const SlopeSource slopes = [&terrain](const radar::GroundGrid& cells, std::span<terrain::PackedSlope> slope) {
    return terrain.fill_slopes(cells, slope);
  };
  const TopSource tops = [obstacles](const atlas::TileAddress& tile, std::span<float> top_m) {
    return obstacles->cache().source().fill_tops(tile, top_m);
  };
  return std::make_shared<const PageSource>(store, heights, frequency_hz, BareGround{ground, slopes, tops}, scrutiny);
}

std::shared_ptr<terrain::TerrainPyramid> terrain_beside(const atlas::Store& store, const CacheOptions& options) {
  const std::filesystem::path folder = store.folder() / atlas::terrain_pyramid_name;
  if (!terrain::holds_pyramid(folder)) {
    const terrain::HeightField field = terrain::read_height_field(atlas::vouched_terrain(store, options.scrutiny));
    return std::shared_ptr<terrain::TerrainPyramid>(new terrain::TerrainPyramid(terrain::pyramid_in_memory(field)));
  }
  return std::shared_ptr<terrain::TerrainPyramid>(
      new terrain::TerrainPyramid(terrain::open_pyramid(folder, options.budget_bytes / tile_part)));
}

unsigned checked_loaders(const CacheOptions& options) {
  if (options.loaders > most_loaders) {
    throw Error("page cache, loaders", fmt::format("is {}", options.loaders),
                fmt::format("give a number from 1 to {}", most_loaders));
  }
  return options.loaders;
}

}  // namespace

LiveGround::LiveGround(const atlas::Store& store, std::shared_ptr<terrain::TerrainPyramid> terrain, double frequency_hz,
                       const CacheOptions& options)
    : frequency_hz_(frequency_hz),
      terrain_(std::move(terrain), options.budget_bytes / window_part),
      obstacles_(obstacles_of(store, options)),
      source_(source_of(store, terrain_, obstacles_.get(), frequency_hz, options.scrutiny)),
      stand_in_(*source_, side_of_stand_in(*source_, options.budget_bytes, beside_pages(options, obstacles_.get()))),
      pages_(source_,
             options.budget_bytes - beside_pages(options, obstacles_.get()) -
                 StandInGround::bytes_of(*source_, stand_in_.side()),
             checked_loaders(options), terrain_.pyramid().patience()) {}

LiveGround::LiveGround(const atlas::Store& store, const terrain::HeightField& terrain, double frequency_hz,
                       const CacheOptions& options)
    : LiveGround(
          store,
          std::shared_ptr<terrain::TerrainPyramid>(new terrain::TerrainPyramid(terrain::pyramid_in_memory(terrain))),
          frequency_hz, options) {}

std::shared_ptr<LiveGround> LiveGround::open(const std::filesystem::path& atlas_folder, double frequency_hz,
                                             const CacheOptions& options) {
  const atlas::Store store = atlas::Store::open(atlas_folder);
  return std::make_shared<LiveGround>(store, terrain_beside(store, options), frequency_hz, options);
}

Vec2d LiveGround::place_in_frame(geo::GeographicPosition place) const {
  if (!(std::abs(place.latitude_deg) <= 90.0) || !(std::abs(place.longitude_deg) <= 360.0)) {
    throw Error("place",
                fmt::format("lies at latitude {:g}°, longitude {:g}°", place.latitude_deg, place.longitude_deg),
                "give degrees of WGS 84, north and east of 0 positive");
  }
  const Vec2d position = geo::position_in_frame(description().frame, place);
  if (!is_within_reach(position)) {
    throw Error("place",
                fmt::format("lies at latitude {:g}°, longitude {:g}°, and the atlas' frame about {:g}°, {:g}° does not "
                            "reach there",
                            place.latitude_deg, place.longitude_deg, description().frame.latitude_deg(),
                            description().frame.longitude_deg()),
                "give a place nearer to the atlas");
  }
  return position;
}

geo::GeographicPosition LiveGround::place_on_globe(Vec2d place) const {
  const geo::GeographicPosition on_globe = is_within_reach(place)
                                               ? geo::place_on_globe(description().frame, place)
                                               : geo::GeographicPosition{std::numeric_limits<double>::quiet_NaN(), 0.0};
  if (!std::isfinite(on_globe.latitude_deg) || !std::isfinite(on_globe.longitude_deg)) {
    throw Error("place",
                fmt::format("at ({:g}, {:g}) m of the atlas' frame lies nowhere on the globe", place.x, place.y),
                "give metres east and north of the frame's origin");
  }
  return on_globe;
}

GroundReport LiveGround::report() const {
  const terrain::TerrainPyramid& tiles = terrain_.pyramid();
  return {.pages = pages_.report(),
          .obstacles = obstacles_ ? std::as_const(*obstacles_).cache().report() : CacheReport{},
          .terrain_bytes = tiles.resident_bytes(),
          .terrain_faults = tiles.faults().size()};
}

void LiveGround::wait_until_loaded() {
  pages_.wait_until_loaded();
  terrain_.windows().wait_until_loaded();
  if (obstacles_) obstacles_->cache().wait_until_loaded();
}

}  // namespace sigmascape::live
