#include "sigmascape/atlas/mip_chain.h"

#include <cassert>
#include <utility>

namespace sigmascape::atlas {
namespace {

float mean(float a, float b, float c, float d) {
  return static_cast<float>((static_cast<double>(a) + b + (static_cast<double>(c) + d)) / 4.0);
}

bool goes_on(std::size_t side, std::size_t smallest_side) {
  return side > smallest_side && side % 2 == 0;
}

}  // namespace

Array2D<radar::Channels> area_mean(const Array2D<radar::Channels>& finer) {
  assert(finer.columns() % 2 == 0 && finer.rows() % 2 == 0);
  Array2D<radar::Channels> coarser(finer.columns() / 2, finer.rows() / 2);
  for (std::size_t row = 0; row < coarser.rows(); ++row) {
    const auto north = finer.row(2 * row);
    const auto south = finer.row(2 * row + 1);
    for (std::size_t column = 0; column < coarser.columns(); ++column) {
      const radar::Channels& a = north[2 * column];
      const radar::Channels& b = north[2 * column + 1];
      const radar::Channels& c = south[2 * column];
      const radar::Channels& d = south[2 * column + 1];
      coarser(column, row) = {mean(a.vv, b.vv, c.vv, d.vv), mean(a.hh, b.hh, c.hh, d.hh), mean(a.hv, b.hv, c.hv, d.hv),
                              mean(a.re_vvhh, b.re_vvhh, c.re_vvhh, d.re_vvhh)};
    }
  }
  return coarser;
}

MipChain mip_chain(Array2D<radar::Channels> level_0, std::size_t smallest_side) {
  MipChain chain;
  chain.push_back(std::move(level_0));
  while (goes_on(chain.back().columns(), smallest_side)) chain.push_back(area_mean(chain.back()));
  return chain;
}

ObstacleChain mip_chain(radar::ObstacleMap level, std::size_t smallest_side) {
  ObstacleChain chain;
  while (goes_on(level.obstacles.columns(), smallest_side)) {
    radar::ObstacleMap coarser = radar::halved(level);
    chain.push_back(std::move(level.obstacles));
    level = std::move(coarser);
  }
  chain.push_back(std::move(level.obstacles));
  return chain;
}

}  // namespace sigmascape::atlas
