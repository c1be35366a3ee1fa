#include "sigmascape/atlas/mip_chain.h"

#include <cassert>
#include <utility>

namespace sigmascape::atlas {
namespace {

float mean(float a, float b, float c, float d) {
  return static_cast<float>((static_cast<double>(a) + b + (static_cast<double>(c) + d)) / 4.0);
}

/// Level 0 and those that `halve` makes one from the other.
template <typename Texel>
std::vector<Array2D<Texel>> chain_of(Array2D<Texel> level_0, std::size_t smallest_side,
                                     Array2D<Texel> (*halve)(const Array2D<Texel>&)) {
  std::vector<Array2D<Texel>> chain;
  chain.push_back(std::move(level_0));
  while (chain.back().columns() > smallest_side && chain.back().columns() % 2 == 0)
    chain.push_back(halve(chain.back()));
  return chain;
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
  return chain_of(std::move(level_0), smallest_side, area_mean);
}

ObstacleChain mip_chain(Array2D<radar::Obstacle> level_0, std::size_t smallest_side) {
  return chain_of(std::move(level_0), smallest_side, radar::halved);
}

}  // namespace sigmascape::atlas
