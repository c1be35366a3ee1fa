#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "sigmascape/live/obstacle_mosaic.h"
#include "sigmascape/radar/obstacle.h"

namespace sigmascape::live {

/// What stands on a block of tiles, each square what `obstacle` says of its centre.
class MadeObstacles {
 public:
  MadeObstacles(const atlas::PatchGrid& patches, const atlas::TileBlock& block,
                const std::function<radar::Obstacle(Vec2d)>& obstacle) {
    mosaic_.reset(patches, block);
    for (std::size_t row = 0; row < block.down; ++row) {
      for (std::size_t column = 0; column < block.across; ++column) {
        pages_.push_back(made_page(patches, block.at(column, row), obstacle));
        mosaic_.put(column, row, *pages_.back());
      }
    }
  }

  [[nodiscard]] const ObstacleMosaic& mosaic() const { return mosaic_; }

  [[nodiscard]] static std::unique_ptr<ObstaclePage> made_page(const atlas::PatchGrid& patches,
                                                               const atlas::TileAddress& tile,
                                                               const std::function<radar::Obstacle(Vec2d)>& obstacle) {
    auto page = std::make_unique<ObstaclePage>();
    page->key = tile;
    const radar::GroundGrid texels = atlas::texels_of(patches, tile);
    for (std::size_t row = 0; row < texels.rows; ++row) {
      for (std::size_t column = 0; column < texels.columns; ++column) {
        page->of.push_back(PackedObstacle::packed(obstacle(texels.centre_of(column, row))));
      }
    }
    return page;
  }

 private:
  std::vector<std::unique_ptr<ObstaclePage>> pages_;
  ObstacleMosaic mosaic_;
};

}  // namespace sigmascape::live
