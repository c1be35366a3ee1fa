#pragma once

#include <filesystem>
#include <memory>

#include "sigmascape/atlas/store.h"
#include "sigmascape/base/vec.h"
#include "sigmascape/geo/coordinate_transform.h"
#include "sigmascape/live/ground_page.h"
#include "sigmascape/live/live_obstacles.h"
#include "sigmascape/live/live_terrain.h"
#include "sigmascape/live/page_cache.h"
#include "sigmascape/live/stand_in_ground.h"
#include "sigmascape/terrain/height_field.h"

namespace sigmascape::live {

/// What of the ground is in memory, and what could not be had.
struct GroundReport {
  CacheReport pages;      ///< of reflectivity
  CacheReport obstacles;  ///< what stands on the ground, of an atlas that keeps that apart
  std::size_t terrain_bytes = 0;
  std::size_t terrain_faults = 0;  ///< tiles that are missing or damaged, as far as they were asked for
};

/// The ground as live renderers share it: pages of reflectivity that come and go, coarse ones that stay, the terrain
/// and what stands on it, of any size. One for each frequency; safe to use from any number of renderers at once.
class LiveGround {
 public:
  /// Reads the coarsest level of all looks at once, as coarsely as it fits into an eighth of the budget
  /// (StandInGround), the rest when frames ask: no frame is dark where the atlas can be read. Terrain in use takes a
  /// sixth of the budget and, of an atlas that keeps the ground apart, obstacles an eighth, however large the atlas is.
  /// Throws Error when the atlas was not baked near the frequency, its store of bare ground is not there, the budget
  /// does not hold a single page besides, or there are to be more than most_loaders.
  LiveGround(const atlas::Store& store, std::shared_ptr<terrain::TerrainPyramid> terrain, double frequency_hz,
             const CacheOptions& options = {});
  /// The same over terrain in memory.
  LiveGround(const atlas::Store& store, const terrain::HeightField& terrain, double frequency_hz,
             const CacheOptions& options = {});

  /// The atlas in a folder with the terrain beside it: the pyramid (atlas::terrain_pyramid_name) where there is one, in
  /// pieces as frames want them, else the whole of atlas::vouched_terrain. Throws Error when one of them cannot be
  /// read.
  [[nodiscard]] static std::shared_ptr<LiveGround> open(const std::filesystem::path& atlas_folder, double frequency_hz,
                                                        const CacheOptions& options = {});

  [[nodiscard]] double frequency_hz() const { return frequency_hz_; }
  [[nodiscard]] PageCache& pages() { return pages_; }
  [[nodiscard]] const StandInGround& stand_in() const { return stand_in_; }
  [[nodiscard]] LiveTerrain& terrain() { return terrain_; }
  [[nodiscard]] const LiveTerrain& terrain() const { return terrain_; }
  /// What stands on the ground; null where the textures hold its shadows.
  [[nodiscard]] LiveObstacles* obstacles() { return obstacles_.get(); }
  [[nodiscard]] const LiveObstacles* obstacles() const { return obstacles_.get(); }
  [[nodiscard]] const atlas::AspectCells& aspects() const { return pages_.source().aspects(); }
  [[nodiscard]] const atlas::AtlasDescription& description() const { return pages_.source().description(); }
  /// Where a place on the globe lies in the atlas' frame, in which poses and targets are. Throws Error for one that is
  /// nowhere on the globe, or so far away that the frame does not reach it.
  [[nodiscard]] Vec2d place_in_frame(geo::GeographicPosition place) const;
  /// And where a place of the frame lies on the globe. Throws Error for one that lies nowhere.
  [[nodiscard]] geo::GeographicPosition place_on_globe(Vec2d place) const;
  [[nodiscard]] GroundReport report() const;
  /// Of the levels that the store has.
  [[nodiscard]] std::size_t coarsest_level() const { return pages_.source().levels() - 1; }
  /// Returns when everything that frames have asked for is there or cannot be: for callers who would rather wait than
  /// see less. Throws Interrupted when this thread is told to stop (base/interruption.h).
  void wait_until_loaded();

 private:
  double frequency_hz_;
  LiveTerrain terrain_;
  std::unique_ptr<LiveObstacles> obstacles_;
  std::shared_ptr<const PageSource> source_;
  StandInGround stand_in_;
  PageCache pages_;
};

}  // namespace sigmascape::live
