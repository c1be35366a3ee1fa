#include "sigmascape/scene/footprint.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "sigmascape/base/interruption.h"
#include "sigmascape/radar/rectangle_parts.h"
#include "sigmascape/scene/disjoint_groups.h"

namespace sigmascape::scene {
namespace {

/// Footprints whose common ground is smaller than this only touch.
constexpr double touching_m2 = 0.01;
constexpr double equal_height_m = 0.01;
constexpr double merging_share = 0.1;
constexpr double least_piece_m2 = 1.0;
constexpr double least_piece_width_m = 0.2;

radar::Rectangle bounds_of(const geo::Polygon& polygon) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  radar::Rectangle box{inf, inf, -inf, -inf};
  for (const Vec2d& corner : polygon.outer) box = radar::with_point(box, corner);
  return box;
}

/// One polygon of a footprint.
struct Part {
  std::size_t footprint, polygon;
  radar::Rectangle box;
};

/// From west to east.
std::vector<Part> parts_from_the_west(const std::vector<Footprint>& footprints) {
  std::vector<Part> parts;
  for (std::size_t i = 0; i < footprints.size(); ++i) {
    for (std::size_t k = 0; k < footprints[i].shape.size(); ++k)
      parts.push_back({i, k, bounds_of(footprints[i].shape[k])});
  }
  std::ranges::stable_sort(parts, {}, [](const Part& part) { return part.box.west_m; });
  return parts;
}

/// Calls `visit` for all pairs of parts of different footprints whose boxes share ground, found by a sweep from west to
/// east. The parts of one feature may be a whole town, so that its own box says nothing.
template <typename Visit>
void for_each_neighbours(const std::vector<Footprint>& footprints, const Visit& visit) {
  const std::vector<Part> parts = parts_from_the_west(footprints);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    Interruption::heed();
    const Part& one = parts[k];
    for (std::size_t l = k + 1; l < parts.size() && parts[l].box.west_m < one.box.east_m; ++l) {
      const Part& other = parts[l];
      if (other.footprint == one.footprint || other.box.south_m >= one.box.north_m ||
          other.box.north_m <= one.box.south_m) {
        continue;
      }
      visit(one, other);
    }
  }
}

/// The place of each footprint among all from west to east.
std::vector<std::size_t> places_from_west(const std::vector<Footprint>& footprints) {
  std::vector<double> west_m;
  for (const Footprint& footprint : footprints) {
    west_m.push_back(std::numeric_limits<double>::infinity());
    for (const geo::Polygon& polygon : footprint.shape)
      west_m.back() = std::min(west_m.back(), bounds_of(polygon).west_m);
  }
  std::vector<std::size_t> order(footprints.size()), places(footprints.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return west_m[i]; });
  for (std::size_t place = 0; place < order.size(); ++place) places[order[place]] = place;
  return places;
}

struct Overlap {
  std::size_t one, other;
  double area_m2;
};

/// All pairs that share ground, from west to east.
std::vector<Overlap> overlaps_among(const std::vector<Footprint>& footprints) {
  const std::vector<std::size_t> places = places_from_west(footprints);
  std::map<std::pair<std::size_t, std::size_t>, Overlap> by_place;
  for_each_neighbours(footprints, [&](const Part& a, const Part& b) {
    Interruption::heed();
    const bool in_order = places[a.footprint] < places[b.footprint];
    const Part &one = in_order ? a : b, &other = in_order ? b : a;
    const double area_m2 = geo::area_m2(geo::intersected({footprints[one.footprint].shape[one.polygon]},
                                                         {footprints[other.footprint].shape[other.polygon]}));
    if (area_m2 == 0.0) return;
    const auto place = std::pair(places[one.footprint], places[other.footprint]);
    by_place.try_emplace(place, Overlap{one.footprint, other.footprint, 0.0}).first->second.area_m2 += area_m2;
  });
  std::vector<Overlap> overlaps;
  for (const auto& [place, overlap] : by_place) {
    if (overlap.area_m2 > touching_m2) overlaps.push_back(overlap);
  }
  return overlaps;
}

std::vector<double> areas_m2(const std::vector<Footprint>& footprints) {
  std::vector<double> areas;
  for (const Footprint& footprint : footprints) areas.push_back(geo::area_m2(footprint.shape));
  return areas;
}

bool belong_together(const Footprint& one, const Footprint& other, double common_share) {
  return std::abs(one.height_m - other.height_m) < equal_height_m && one.wall == other.wall && one.roof == other.roof &&
         common_share >= merging_share;
}

bool is_sliver(const geo::Polygon& polygon) {
  const double area_m2 = geo::area_m2(polygon);
  return area_m2 < least_piece_m2 || 2.0 * area_m2 / geo::perimeter_m(polygon) < least_piece_width_m;
}

/// The union of some shapes, of many by halves: one after the other each would have to go over all before it.
geo::Polygons united(std::span<const geo::Polygons> shapes) {
  constexpr std::size_t few = 8;
  if (shapes.size() > few)
    return geo::united(united(shapes.first(shapes.size() / 2)), united(shapes.subspan(shapes.size() / 2)));
  geo::Polygons whole = shapes.front();
  for (const geo::Polygons& shape : shapes.subspan(1)) {
    Interruption::heed();
    whole = geo::united(whole, shape);
  }
  return whole;
}

/// Makes one of each group, the first of it, and leaves nothing of the others, which it marks.
void merge(std::vector<Footprint>& footprints, DisjointGroups& groups, std::vector<bool>& changed) {
  std::map<std::size_t, std::vector<geo::Polygons>> shapes;
  for (std::size_t i = 0; i < footprints.size(); ++i) {
    const std::size_t first = groups.first_of(i);
    if (first == i) continue;
    auto& of_group = shapes[first];
    if (of_group.empty()) of_group.push_back(footprints[first].shape);
    of_group.push_back(std::exchange(footprints[i].shape, {}));
    changed[i] = true;
  }
  for (auto& [first, of_group] : shapes) footprints[first].shape = united(of_group);
}

/// One footprint that cuts another.
struct Cut {
  std::size_t winner, loser;
  friend auto operator<=>(const Cut&, const Cut&) = default;
};

/// Which cut which, each once, in the order of their overlaps: the taller the lower, the larger the smaller, the
/// earlier the later.
std::vector<Cut> cuts_among(const std::vector<Footprint>& footprints, const std::vector<Overlap>& overlaps,
                            DisjointGroups& groups) {
  const std::vector<double> area_m2 = areas_m2(footprints);
  const auto rank = [&](std::size_t i) { return std::tuple(-footprints[i].height_m, -area_m2[i], i); };
  std::vector<Cut> cuts;
  std::set<Cut> known;
  for (const Overlap& overlap : overlaps) {
    const std::size_t a = groups.first_of(overlap.one), b = groups.first_of(overlap.other);
    if (a == b) continue;
    const Cut cut = rank(a) < rank(b) ? Cut{a, b} : Cut{b, a};
    if (known.insert(cut).second) cuts.push_back(cut);
  }
  return cuts;
}

/// For each cut, which polygons of the loser may be met by which of the winner's.
using PolygonPairs = std::vector<std::pair<std::size_t, std::size_t>>;
std::map<Cut, PolygonPairs> meetings(const std::vector<Footprint>& footprints, const std::vector<Cut>& cuts) {
  std::map<Cut, PolygonPairs> met;
  for (const Cut& cut : cuts) met[cut];
  for_each_neighbours(footprints, [&](const Part& one, const Part& other) {
    for (const auto& [winner, loser] : {std::pair(one, other), std::pair(other, one)}) {
      const auto found = met.find({winner.footprint, loser.footprint});
      if (found != met.end()) found->second.emplace_back(loser.polygon, winner.polygon);
    }
  });
  for (auto& [cut, pairs] : met) std::ranges::sort(pairs);
  return met;
}

/// What is left of a footprint, by the number of the polygon that it is left of.
using Pieces = std::vector<geo::Polygons>;

void subtract(Pieces& pieces, const geo::Polygons& cutter, const PolygonPairs& pairs) {
  for (std::size_t k = 0; k < pairs.size();) {
    Interruption::heed();
    const std::size_t polygon = pairs[k].first;
    geo::Polygons cutting;
    for (; k < pairs.size() && pairs[k].first == polygon; ++k) cutting.push_back(cutter[pairs[k].second]);
    pieces[polygon] = geo::subtracted(pieces[polygon], cutting);
  }
}

/// What the cuts leave of each loser.
std::map<std::size_t, Pieces> pieces_left(const std::vector<Footprint>& footprints, const std::vector<Cut>& cuts) {
  const auto met = meetings(footprints, cuts);
  std::map<std::size_t, Pieces> left;
  for (const Cut& cut : cuts) {
    Pieces& pieces = left[cut.loser];
    if (pieces.empty()) {
      for (const geo::Polygon& polygon : footprints[cut.loser].shape) pieces.push_back({polygon});
    }
    subtract(pieces, footprints[cut.winner].shape, met.at(cut));
  }
  return left;
}

void replace_by(Pieces pieces, Footprint& footprint) {
  footprint.uncut = std::exchange(footprint.shape, {});
  for (std::size_t whole = 0; whole < pieces.size(); ++whole) {
    for (geo::Polygon& piece : pieces[whole]) {
      if (is_sliver(piece)) continue;
      footprint.shape.push_back(std::move(piece));
      footprint.cut_of.push_back(whole);
    }
  }
}

}  // namespace

std::vector<Footprint> without_overlaps(std::vector<Footprint> footprints, std::span<FlawTally> tallies) {
  const auto overlaps = overlaps_among(footprints);
  std::vector<bool> changed(footprints.size(), false);
  DisjointGroups groups(footprints.size());
  const std::vector<double> before_m2 = areas_m2(footprints);
  for (const auto& [one, other, area_m2] : overlaps) {
    const double share = area_m2 / std::min(before_m2[one], before_m2[other]);
    if (belong_together(footprints[one], footprints[other], share)) groups.join(one, other);
  }
  merge(footprints, groups, changed);
  for (auto& [loser, pieces] : pieces_left(footprints, cuts_among(footprints, overlaps, groups))) {
    replace_by(std::move(pieces), footprints[loser]);
    changed[loser] = true;
  }
  for (std::size_t i = 0; i < footprints.size(); ++i) {
    if (changed[i]) tallies[footprints[i].source].flaw("overlapping footprints, merged or cut", footprints[i].id);
  }
  std::erase_if(footprints, [](const Footprint& footprint) { return footprint.shape.empty(); });
  return footprints;
}

const geo::Polygon& whole_of(std::size_t piece, const Footprint& footprint) {
  return footprint.uncut.empty() ? footprint.shape[piece] : footprint.uncut[footprint.cut_of[piece]];
}

}  // namespace sigmascape::scene
