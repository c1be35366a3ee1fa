#include "sigmascape/scene/footprint.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "sigmascape/base/interruption.h"
#include "sigmascape/radar/rectangle_parts.h"

namespace sigmascape::scene {
namespace {

/// Footprints whose common ground is smaller than this only touch.
constexpr double touching_m2 = 0.01;
constexpr double equal_height_m = 0.01;
constexpr double merging_share = 0.1;
constexpr double least_piece_m2 = 1.0;
constexpr double least_piece_width_m = 0.2;

radar::Rectangle bounds_of(const geo::Polygons& shape) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  radar::Rectangle box{inf, inf, -inf, -inf};
  for (const geo::Polygon& polygon : shape) {
    for (const Vec2d& corner : polygon.outer) box = radar::with_point(box, corner);
  }
  return box;
}

struct Overlap {
  std::size_t one, other;
  double area_m2;
};

/// All pairs that share ground, found by a sweep from west to east.
std::vector<Overlap> overlaps_among(const std::vector<Footprint>& footprints) {
  std::vector<radar::Rectangle> box;
  for (const Footprint& footprint : footprints) box.push_back(bounds_of(footprint.shape));
  std::vector<std::size_t> order(footprints.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&box](std::size_t i) { return box[i].west_m; });

  std::vector<Overlap> overlaps;
  for (std::size_t k = 0; k < order.size(); ++k) {
    Interruption::heed();
    const std::size_t one = order[k];
    for (std::size_t l = k + 1; l < order.size() && box[order[l]].west_m < box[one].east_m; ++l) {
      const std::size_t other = order[l];
      if (box[other].south_m >= box[one].north_m || box[other].north_m <= box[one].south_m) continue;
      const double area_m2 = geo::area_m2(geo::intersected(footprints[one].shape, footprints[other].shape));
      if (area_m2 > touching_m2) overlaps.push_back({one, other, area_m2});
    }
  }
  return overlaps;
}

bool belong_together(const Footprint& one, const Footprint& other, double common_m2) {
  const double smaller_m2 = std::min(geo::area_m2(one.shape), geo::area_m2(other.shape));
  return std::abs(one.height_m - other.height_m) < equal_height_m && one.wall == other.wall && one.roof == other.roof &&
         common_m2 >= merging_share * smaller_m2;
}

/// For each footprint, the one that it has become part of: itself, or the first of its group.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }
  [[nodiscard]] std::size_t first_of(std::size_t i) const { return parent_[i] == i ? i : first_of(parent_[i]); }
  void join(std::size_t a, std::size_t b) {
    const auto [first, second] = std::minmax({first_of(a), first_of(b)});
    parent_[second] = first;
  }

 private:
  std::vector<std::size_t> parent_;
};

bool is_sliver(const geo::Polygon& polygon) {
  const double area_m2 = geo::area_m2(polygon);
  return area_m2 < least_piece_m2 || 2.0 * area_m2 / geo::perimeter_m(polygon) < least_piece_width_m;
}

/// Taller before lower, larger before smaller, earlier before later.
bool goes_first(const std::vector<Footprint>& footprints, std::size_t a, std::size_t b) {
  const double a_m2 = geo::area_m2(footprints[a].shape), b_m2 = geo::area_m2(footprints[b].shape);
  return std::tuple(-footprints[a].height_m, -a_m2, a) < std::tuple(-footprints[b].height_m, -b_m2, b);
}

}  // namespace

std::vector<Footprint> without_overlaps(std::vector<Footprint> footprints, std::span<FlawTally> tallies) {
  const auto overlaps = overlaps_among(footprints);
  std::vector<bool> changed(footprints.size(), false);
  Groups groups(footprints.size());
  for (const auto& [one, other, area_m2] : overlaps) {
    if (belong_together(footprints[one], footprints[other], area_m2)) groups.join(one, other);
  }
  for (std::size_t i = 0; i < footprints.size(); ++i) {
    const std::size_t first = groups.first_of(i);
    if (first == i) continue;
    footprints[first].shape = geo::united(footprints[first].shape, footprints[i].shape);
    footprints[i].shape.clear();
    changed[i] = true;
  }

  std::vector<Footprint> cut = footprints;
  for (const auto& [one, other, area_m2] : overlaps) {
    Interruption::heed();
    const std::size_t a = groups.first_of(one), b = groups.first_of(other);
    if (a == b) continue;
    const auto [winner, loser] = goes_first(footprints, a, b) ? std::pair(a, b) : std::pair(b, a);
    cut[loser].uncut = footprints[loser].shape;
    cut[loser].shape = geo::subtracted(cut[loser].shape, footprints[winner].shape);
    changed[loser] = true;
  }
  for (std::size_t i = 0; i < cut.size(); ++i) {
    if (!changed[i]) continue;
    std::erase_if(cut[i].shape, is_sliver);
    tallies[cut[i].source].flaw("overlapping footprints, merged or cut", cut[i].id);
  }
  std::erase_if(cut, [](const Footprint& footprint) { return footprint.shape.empty(); });
  return cut;
}

const geo::Polygon& whole_of(const geo::Polygon& piece, const Footprint& footprint) {
  if (footprint.uncut.empty()) return piece;
  return *std::ranges::max_element(
      footprint.uncut, {}, [&](const geo::Polygon& whole) { return geo::area_m2(geo::intersected({whole}, {piece})); });
}

}  // namespace sigmascape::scene
