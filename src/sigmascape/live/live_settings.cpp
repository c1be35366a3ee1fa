#include "sigmascape/live/live_settings.h"

#include <cmath>
#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"

namespace sigmascape::live {
namespace {

constexpr double furthest_range_m = 1e7;
/// Beams wider than that are no beams: what lies beside them would come from behind the radar.
constexpr double widest_beam_rad = pi / 4.0;
/// A turn that was divided by a number of beams comes back as one but for rounding.
constexpr double hairs_breadth_rad = 1e-6;
/// Sides of a picture of the terrain: a tile of it, and 4 GiB.
constexpr std::size_t least_picture_px = TerrainRaster::tile_side, most_picture_px = 1U << 15U;

}  // namespace

void check(const LiveSettings& settings, const std::string& where) {
  constexpr std::size_t most_bins = 1U << 26U;
  if (settings.beams == 0 || settings.ranges == 0 || settings.ranges > most_bins / settings.beams) {
    throw Error(where, fmt::format("has {} beams of {} ranges", settings.beams, settings.ranges),
                fmt::format("give at least one of each and no more than {} bins", most_bins));
  }
  const double turn_rad = static_cast<double>(settings.beams) * settings.beam_step_rad;
  if (!(settings.beam_step_rad > 0.0 && turn_rad < 2.0 * pi + hairs_breadth_rad)) {
    throw Error(where, fmt::format("has beams {} rad apart", settings.beam_step_rad),
                "give a positive step; all beams together go round once at most");
  }
  if (!(settings.beam_step_rad <= widest_beam_rad + hairs_breadth_rad)) {
    throw Error(where, fmt::format("has beams {} rad apart", settings.beam_step_rad),
                fmt::format("give at most {:.4f}, an eighth of a turn", widest_beam_rad));
  }
  if (!(settings.range_step_m > 0.0 && settings.range_step_m <= furthest_range_m)) {
    throw Error(
        where, fmt::format("has ranges {} m apart", settings.range_step_m),
        fmt::format("give a step above 0, of which all ranges together take no more than {:g} m", furthest_range_m));
  }
  if (const double length_m = static_cast<double>(settings.ranges) * settings.range_step_m;
      length_m > furthest_range_m) {
    throw Error(where, fmt::format("has ranges over {:g} m together", length_m),
                fmt::format("give no more than {:g} m of them", furthest_range_m));
  }
  if (!(settings.cells_per_bin >= 0.25 && settings.cells_per_bin <= 64.0)) {
    throw Error(where, fmt::format("has {} lattice cells a bin", settings.cells_per_bin), "give 0.25 to 64");
  }
  const RasterSettings& raster = settings.visibility.raster;
  if (!(raster.pixels_per_triangle > 0.0 && std::isfinite(raster.pixels_per_triangle))) {
    throw Error(where, fmt::format("is to draw {} pixels a triangle", raster.pixels_per_triangle),
                "give a positive number; the paper has 16");
  }
  if (raster.longest_side < least_picture_px || raster.longest_side > most_picture_px) {
    throw Error(where, fmt::format("is to draw {} pixels a side", raster.longest_side),
                fmt::format("give {} to {}", least_picture_px, most_picture_px));
  }
  if (!(settings.refraction >= 0.1)) {
    throw Error(where, fmt::format("has a refraction of {}", settings.refraction),
                "give 4/3, less down to 0.1, or more for a flatter Earth");
  }
}

}  // namespace sigmascape::live
