#include "touched.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/atlas/half.h"
#include "sigmascape/base/units.h"

namespace sigmascape::bench {
namespace {

/// Nodes of a lattice that lie in the sector between the radar and the end of the last range.
std::size_t nodes_in_view(Vec2d north_west, double spacing_m, std::size_t columns, std::size_t rows,
                          const live::Frame& frame, const live::Pose& pose) {
  const radar::RangeAzimuthGrid& grid = frame.grid;
  const double far_m = grid.first_range_m + static_cast<double>(grid.ranges) * grid.range_step_m;
  const double width = static_cast<double>(grid.azimuths) * grid.azimuth_step_rad;
  std::size_t count = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    const double north = north_west.y - static_cast<double>(row) * spacing_m - pose.position.y;
    for (std::size_t column = 0; column < columns; ++column) {
      const double east = north_west.x + static_cast<double>(column) * spacing_m - pose.position.x;
      const bool near = east * east + north * north <= far_m * far_m;
      count += near && wrapped_azimuth(std::atan2(east, north) - grid.first_azimuth_rad) <= width ? 1U : 0U;
    }
  }
  return count;
}

}  // namespace

Touched touched_by(const live::Frame& frame, const live::LiveSettings& settings, const live::Pose& pose,
                   const live::LiveGround& ground) {
  Touched touched;
  const live::LiveTerrain& terrain = ground.terrain();
  const terrain::PyramidLayout& layout = terrain.pyramid().layout();
  const int level = terrain.level_for(atlas::texel_side_m(ground.description().patches, frame.report.level));
  const auto side = static_cast<std::size_t>(terrain::HeightTile::cells);
  touched.terrain_nodes = nodes_in_view({layout.west_m, layout.north_m}, layout.spacing_at(level),
                                        side * layout.across(level) + 1, side * layout.down(level) + 1, frame, pose);
  const live::LiveObstacles* const obstacles = ground.obstacles();
  const bool apart = obstacles != nullptr;
  if (apart) {
    const atlas::TileBlock block = obstacles->tiles_of(obstacles->level_for(settings.range_step_m / 2.0));
    const radar::GroundGrid first = atlas::texels_of(ground.description().patches, block.at(0, 0));
    touched.obstacle_cells = nodes_in_view({first.west_m, first.north_m}, first.cell_m, block.across * first.columns,
                                           block.down * first.rows, frame, pose);
  }
  const auto cells = static_cast<double>(frame.report.cells - std::min(frame.report.dark, frame.report.cells));
  constexpr double look_bytes = live::GroundPage::channels * sizeof(atlas::Half);
  const double textures = ground.aspects().frequency_part(1) > 0.0F ? 8.0 : 4.0;
  // Of bare ground two elevations, the slope and the height of what stands there.
  const double bare_ground = apart ? textures / 2.0 * look_bytes + 8.0 : 0.0;
  const double texel_bytes = textures * look_bytes + sizeof(float) + bare_ground;
  const double horizon_bytes = static_cast<double>((settings.beams + 1) * 2 * settings.ranges) * (apart ? 12.0 : 4.0);
  touched.bytes = static_cast<double>(touched.terrain_nodes) * sizeof(float) +
                  static_cast<double>(touched.obstacle_cells) * sizeof(live::PackedObstacle) + cells * texel_bytes +
                  horizon_bytes + static_cast<double>(frame.amplitudes_m.size_bytes() + frame.powers_m2.size_bytes());
  return touched;
}

}  // namespace sigmascape::bench
