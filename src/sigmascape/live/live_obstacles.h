#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "sigmascape/live/ground_sector.h"
#include "sigmascape/live/obstacle_mosaic.h"
#include "sigmascape/live/obstacle_source.h"
#include "sigmascape/live/tile_cache.h"

namespace sigmascape::live {

/// What stands on the ground of live frames, of an atlas of any size that keeps it apart from the textures: tiles of
/// all levels, of which those in use are in memory. Safe to use from any number of threads.
class LiveObstacles {
 public:
  using Cache = TileCache<ObstacleSource>;

  /// Reads the coarsest level, a few tiles, which stays. The budget is that of all tiles; eight are held at least.
  LiveObstacles(const atlas::Store& atlas, std::size_t budget_bytes,
                atlas::Scrutiny scrutiny = atlas::Scrutiny::Content);

  [[nodiscard]] Cache& cache() { return *cache_; }
  [[nodiscard]] const Cache& cache() const { return *cache_; }
  /// Of all tiles together.
  [[nodiscard]] std::size_t budget_bytes() const { return budget_bytes_; }
  /// Of the whole atlas; an upper bound.
  [[nodiscard]] float tallest_m() const { return tallest_m_; }

  /// The coarsest level whose squares are no larger than a sweep's steps, else the finest.
  [[nodiscard]] std::size_t level_for(double step_m) const;

  /// Where obstacles are wanted: of a level, under a piece of ground.
  struct Wish {
    std::size_t level = 0;
    GroundSector ground;
  };
  /// The squares that a sweep goes over, from the first node on, and those before, which may be fewer.
  enum class Part { UnderBins, BeforeBins };
  /// Lays out the best there is where it is wished for; of the next coarser levels where a frame's share of the tiles
  /// that the budget holds would not do. What would have been better, and its parents, which then stand in for
  /// what is met next, are added to `wanted`, as far as its memory goes. Returns how many tiles are coarser than wished
  /// for. The mosaic lives as long as `there`.
  [[nodiscard]] std::size_t lay_out(const Cache::View& there, const Wish& wish, Part part, ObstacleMosaic& mosaic,
                                    std::vector<atlas::TileAddress>& wanted) const;
  /// Adds to `wanted` what laying it out would.
  void look_ahead(const Cache::View& there, const Wish& wish, std::vector<atlas::TileAddress>& wanted) const;

  /// Tiles of a level with which the atlas shares ground.
  [[nodiscard]] atlas::TileBlock tiles_of(std::size_t level) const {
    return atlas::tiles_over(patches(), extent_, level);
  }

 private:
  [[nodiscard]] const atlas::PatchGrid& patches() const { return cache_->source().description().patches; }
  /// Those for a wish, of its level or a coarser one.
  [[nodiscard]] atlas::TileBlock tiles_for(const Wish& wish, Part part) const;
  /// Calls `each(column, row, tile)` for the tiles of a block that may share ground with the sector.
  template <typename Each>
  void for_each_tile(const atlas::TileBlock& block, const GroundSector& ground, Each each) const;
  /// The page for a tile or for an ancestor; null when not even the coarsest is there. Wants what is missing, and anew
  /// what may have been mended.
  [[nodiscard]] const ObstaclePage* best(const Cache::View& there, const atlas::TileAddress& tile,
                                         std::vector<atlas::TileAddress>& wanted) const;
  void load_coarsest_level();

  std::size_t budget_bytes_;
  std::unique_ptr<Cache> cache_;
  radar::Rectangle extent_;  // of all patches together
  float tallest_m_;
};

}  // namespace sigmascape::live
