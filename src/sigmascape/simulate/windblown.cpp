#include "sigmascape/simulate/windblown.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "sigmascape/radar/value_at.h"
#include "sigmascape/scene/obstacle_raster.h"

namespace sigmascape::simulate {
namespace {

/// Crowns are told no finer than this.
constexpr double crown_cell_m = 2.0;
/// Crowns are found for so many cells square at a time.
constexpr std::size_t cells_a_side = 1024;

/// Where the scene's crowns stand. They are found square by square as somebody asks: what an image needs reaches beyond
/// its map, along a strip as far as its ghosts come from.
class Crowns {
 public:
  explicit Crowns(const scene::Scene& scene)
      : scene_(scene),
        extent_(scene::occupied_extent(scene)),
        squares_(squares_over(extent_)),
        found_(squares_.columns * squares_.rows) {}

  /// From several threads at once.
  [[nodiscard]] bool over(Vec2d point) const {
    if (!extent_.contains(point)) return false;
    const Vec2d square = squares_.cells_from(point);
    const std::size_t column = std::min(static_cast<std::size_t>(square.x), squares_.columns - 1),
                      row = std::min(static_cast<std::size_t>(square.y), squares_.rows - 1);
    Square& found = found_[row * squares_.columns + column];
    std::call_once(found.is_found, [&] { found.fill(scene_, extent_, squares_, column, row); });
    return radar::value_at(found.cells, found.is_crown, point) != 0;
  }

 private:
  struct Square {
    std::once_flag is_found;
    radar::GroundGrid cells;
    Array2D<std::uint8_t> is_crown;

    void fill(const scene::Scene& scene, const radar::Rectangle& extent, const radar::GroundGrid& squares,
              std::size_t column, std::size_t row) {
      cells = {squares.west_m + static_cast<double>(column) * squares.cell_m,
               squares.north_m - static_cast<double>(row) * squares.cell_m, crown_cell_m, 0, 0};
      cells.columns = cells_over(std::min(squares.cell_m, extent.east_m - cells.west_m));
      cells.rows = cells_over(std::min(squares.cell_m, cells.north_m - extent.south_m));
      const radar::ObstacleMap standing = scene::obstacles_of(scene, cells);
      is_crown = Array2D<std::uint8_t>(cells.columns, cells.rows);
      std::ranges::transform(standing.obstacles.values(), is_crown.values().begin(),
                             [](const radar::Obstacle& obstacle) {
                               return static_cast<std::uint8_t>(obstacle.crown_top_m > 0.0F ? 1 : 0);
                             });
    }
  };

  static std::size_t cells_over(double length_m) {
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(length_m / crown_cell_m)));
  }

  static radar::GroundGrid squares_over(const radar::Rectangle& extent) {
    const double side_m = crown_cell_m * static_cast<double>(cells_a_side);
    const auto count = [&](double length_m) {
      return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(length_m / side_m)));
    };
    return {extent.west_m, extent.north_m, side_m, count(extent.width_m()), count(extent.height_m())};
  }

  const scene::Scene& scene_;
  radar::Rectangle extent_;
  radar::GroundGrid squares_;
  mutable std::vector<Square> found_;
};

}  // namespace

Windblown windblown_of(const scene::Scene& scene) {
  std::vector<bool> plants;
  for (const auto& material : scene.materials) plants.push_back(material.plants);
  return [&scene, plants, crowns = std::make_shared<const Crowns>(scene)](Vec2d point) {
    return plants[scene.ground.at(point)] || crowns->over(point);
  };
}

}  // namespace sigmascape::simulate
