#include "sigmascape/live/visible_ground.h"

#include <algorithm>

#include "sigmascape/radar/look.h"

namespace sigmascape::live {
namespace {

/// By how much the horizon stands above ground that the picture hides, where no nearer ground along the azimuth does.
constexpr float just_hidden = 1e-4F;

/// The horizon along one azimuth from what a picture shows: up to every node, the steepest ground that is seen, first
/// of all the given one. Slopes are those of the bilinear surface, on which everything else stands.
void trace_horizon(const TerrainRaster& raster, Vec3d radar, const terrain::TerrainView& ground,
                   const HorizonGrid& grid, std::size_t azimuth, float steepest, float* slopes) {
  const Vec2d outwards =
      radar::horizontal_direction(grid.first_azimuth_rad + static_cast<double>(azimuth) * grid.azimuth_step_rad);
  const radar::Rectangle extent = ground.extent();
  for (std::size_t k = 0; k < grid.distances; ++k) {
    const double distance_m = grid.near_m + static_cast<double>(k) * grid.step_m;
    const Vec2d point = Vec2d{radar.x, radar.y} + outwards * distance_m;
    slopes[k] = steepest;
    if (!extent.contains(point)) continue;
    const auto slope = static_cast<float>((terrain::height_at(ground, point) - radar.z) / distance_m -
                                          grid.drop_per_square_m * distance_m);
    const bool is_seen = raster.sees(point);
    slopes[k] = is_seen ? slope : std::max(steepest, slope + just_hidden);
    if (is_seen) steepest = std::max(steepest, slope);
  }
}

}  // namespace

VisibleGround::VisibleGround(const VisibleGroundSettings& settings, unsigned workers)
    : settings_(settings), horizon_(HorizonGrid{}, workers) {}

void VisibleGround::find(std::size_t first_azimuth, std::size_t count, Vec3d radar, const Occluders& occluders,
                         WorkerTeam& team) {
  if (settings_.method == VisibilityMethod::HorizonSweep) {
    team.run(count, [&](std::size_t index, unsigned worker) {
      horizon_.sweep(first_azimuth + index, radar, occluders, worker);
    });
    return;
  }
  const Vec3d above{radar.x, radar.y, radar.z + static_cast<double>(occluders.lowered_m)};
  const HorizonGrid& grid = horizon_.grid();
  triangles_left_out_ = raster_.draw(above, grid, occluders.terrain, settings_.raster, team);
  team.run(count, [&](std::size_t index, unsigned worker) {
    const std::size_t azimuth = first_azimuth + index;
    // A picture tells that nearer ground hides the first nodes, but not how high that reaches: it is walked over.
    horizon_.sweep(azimuth, radar, occluders, worker);
    float* const slopes = horizon_.slopes(azimuth);
    trace_horizon(raster_, above, occluders.terrain, grid, azimuth, slopes[0], slopes);
    horizon_.rise_to_sea(azimuth, radar, occluders);
  });
}

}  // namespace sigmascape::live
