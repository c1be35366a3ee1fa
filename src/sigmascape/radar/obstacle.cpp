#include "sigmascape/radar/obstacle.h"

#include <cassert>

namespace sigmascape::radar {

Obstacle merged(const Obstacle& north_west, const Obstacle& north_east, const Obstacle& south_west,
                const Obstacle& south_east) {
  const auto greater = [](const Obstacle& a, const Obstacle& b) { return std::max(a.solid_top_m, b.solid_top_m); };
  Obstacle all;
  all.solid_top_m = 0.25F * (greater(north_west, north_east) + greater(south_west, south_east) +
                             greater(north_west, south_west) + greater(north_east, south_east));
  float extinction = 0.0F;
  for (const Obstacle* part : {&north_west, &north_east, &south_west, &south_east}) {
    extinction += part->crown_extinction_per_m;
    all.crown_base_m += part->crown_extinction_per_m * part->crown_base_m;
    all.crown_top_m += part->crown_extinction_per_m * part->crown_top_m;
  }
  if (extinction > 0.0F) {
    all.crown_base_m /= extinction;
    all.crown_top_m /= extinction;
  }
  all.crown_extinction_per_m = extinction / 4.0F;
  return all;
}

Array2D<Obstacle> halved(const Array2D<Obstacle>& finer) {
  assert(finer.columns() % 2 == 0 && finer.rows() % 2 == 0);
  Array2D<Obstacle> coarser(finer.columns() / 2, finer.rows() / 2);
  for (std::size_t row = 0; row < coarser.rows(); ++row) {
    for (std::size_t column = 0; column < coarser.columns(); ++column) {
      coarser(column, row) = merged(finer(2 * column, 2 * row), finer(2 * column + 1, 2 * row),
                                    finer(2 * column, 2 * row + 1), finer(2 * column + 1, 2 * row + 1));
    }
  }
  return coarser;
}

}  // namespace sigmascape::radar
