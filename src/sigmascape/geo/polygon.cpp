#include "sigmascape/geo/polygon.h"

#include <algorithm>
#include <cmath>

namespace sigmascape::geo {
namespace {

double ring_length_m(const Ring& ring) {
  double sum = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) sum += length(ring[(i + 1) % ring.size()] - ring[i]);
  return sum;
}

}  // namespace

double signed_area_m2(const Ring& ring) {
  double twice = 0.0;
  // Measured from the first corner: far from the origin the products of coordinates would lose the small difference.
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) twice += cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
  return twice / 2.0;
}

double area_m2(const Polygon& polygon) {
  double area = std::abs(signed_area_m2(polygon.outer));
  for (const Ring& hole : polygon.holes) area -= std::abs(signed_area_m2(hole));
  return area;
}

double area_m2(const std::vector<Polygon>& polygons) {
  double sum = 0.0;
  for (const Polygon& polygon : polygons) sum += area_m2(polygon);
  return sum;
}

double perimeter_m(const Polygon& polygon) {
  double sum = ring_length_m(polygon.outer);
  for (const Ring& hole : polygon.holes) sum += ring_length_m(hole);
  return sum;
}

Ring tidy_ring(Ring ring, bool counter_clockwise) {
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  if ((signed_area_m2(ring) > 0.0) != counter_clockwise) std::ranges::reverse(ring);
  return ring;
}

}  // namespace sigmascape::geo
