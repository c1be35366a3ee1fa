#include "sigmascape/live/row_widths.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/units.h"
#include "sigmascape/base/vector_targets.h"
#include "sigmascape/live/lesser_greater.h"
#include "sigmascape/live/small_arc.h"

namespace sigmascape::live {
namespace {

/// Half the angle that a square takes in, whose middle lies there. From above it, where no angle tells, a quarter turn.
[[gnu::always_inline]] inline float half_width_of(float half_side_m, float east_m, float north_m) {
  const float distance_m = std::sqrt(east_m * east_m + north_m * north_m);
  // Seen along a diagonal it is wider than along a side.
  const float across = greater((std::abs(east_m) + std::abs(north_m)) / greater(distance_m, 1e-6F * half_side_m), 1.0F);
  const float half_m = half_side_m * across;
  return small_arc(half_m / greater(distance_m, half_m));
}

/// The angle from (1, 0) to (ahead, across), up to half a turn either way.
[[gnu::always_inline]] inline float arc(float across, float ahead) {
  const float a = std::abs(across), b = std::abs(ahead);
  const float small = small_arc(lesser(a, b) / greater(greater(a, b), 1e-30F));
  const float first_quarter = a > b ? static_cast<float>(0.5 * pi) - small : small;
  const float turned = ahead < 0.0F ? static_cast<float>(pi) - first_quarter : first_quarter;
  return across < 0.0F ? -turned : turned;
}

/// Surely where one is: a texel has the same width whatever else is in its row.
bool may_span_beams(const LatticeRow& row, const RowGeometry& geometry) {
  constexpr double diagonal = 1.4143, spare = 1.01;
  const double last_m = row.first_middle_east_m + static_cast<double>(row.count - 1) * geometry.cell_m;
  const double nearest_m = std::hypot(std::clamp(0.0, row.first_middle_east_m, last_m), row.middle_north_m);
  return nearest_m < spare * diagonal * geometry.cell_m * geometry.beams_per_rad;
}

SIGMASCAPE_VECTOR_TARGETS
void find_each(LatticeRow& row, const RowGeometry& geometry) {
  const double* const east = row.east_m.data();
  const double* const north = row.north_m.data();
  const float* const beam = row.beam.data();
  float* const beams_wide = row.beams_wide.data();
  float* const middle_beam = row.middle_beam.data();
  const double first_east = row.first_middle_east_m, middle_north = row.middle_north_m, cell = geometry.cell_m;
  const auto half_cell = static_cast<float>(0.5 * cell), beams_per_rad = static_cast<float>(geometry.beams_per_rad);
  const std::size_t count = row.whole_vectors();
  SIGMASCAPE_INDEPENDENT_TURNS
  for (std::size_t i = 0; i < count; ++i) {
    const double middle_east = first_east + static_cast<double>(static_cast<std::int32_t>(i)) * cell;
    const float half_width =
        half_width_of(half_cell, static_cast<float>(middle_east), static_cast<float>(middle_north));
    const float whole = greater(2.0F * half_width * beams_per_rad, 1.0F);
    const float wide = lesser(whole, most_beams_wide);
    // From the scatterer's own place to its texel's middle, or as far as so many beams reach.
    const float part = (1.0F - 1.0F / wide) * (wide / whole);
    const auto x = static_cast<float>(east[i]), y = static_cast<float>(north[i]);
    const float east_by = part * static_cast<float>(middle_east - east[i]);
    const float north_by = part * static_cast<float>(middle_north - north[i]);
    const float across = east_by * y - north_by * x, ahead = x * (x + east_by) + y * (y + north_by);
    beams_wide[i] = wide;
    middle_beam[i] = beam[i] + lesser(greater(arc(across, ahead) * beams_per_rad, -0.5F * wide), 0.5F * wide);
  }
}

}  // namespace

double width_from(double distance_m, double side_m) {
  return 2.0 * std::atan(0.5 * side_m / std::max(distance_m, 0.5 * side_m));
}

std::size_t beams_beside(double nearest_m, double cell_m, double beams_per_rad) {
  constexpr double diagonal = 1.4143, margin = 0.75;
  const double wide = width_from(nearest_m - margin * cell_m, diagonal * cell_m) * beams_per_rad;
  return static_cast<std::size_t>(std::ceil(std::clamp(wide, 1.0, static_cast<double>(most_beams_wide))));
}

void find_widths(LatticeRow& row, const RowGeometry& geometry) {
  row.may_span_beams = may_span_beams(row, geometry);
  if (row.may_span_beams) find_each(row, geometry);
}

}  // namespace sigmascape::live
