#include "sigmascape/render/ground_renderer.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/base/parallel.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/echo.h"
#include "sigmascape/receiver/range_azimuth_receiver.h"
#include "sigmascape/terrain/obstacle_sweep.h"

namespace sigmascape::render {
namespace {

/// Ground samples a bin outwards, where samples step evenly over the ground and bins over slant range: with two, their
/// linear sharing between bins shows no beat. Across, one sample stands on the centre of every bin.
constexpr double samples_per_range_bin = 2.0;

/// By what part the sine of the grazing angle may change before the looks are weighted anew.
constexpr double aspect_step = 5e-4;

/// One azimuth's worth of ground: which of it is seen, and what comes back.
class AzimuthStrip {
 public:
  AzimuthStrip(const atlas::Atlas& atlas, const terrain::HeightField& terrain, const radar::Radar& radar,
               const radar::Rectangle& area, const RenderSettings& settings, double level)
      : atlas_(atlas),
        ground_(atlas.ground_layers()),
        terrain_(terrain),
        radar_(radar),
        area_(area),
        settings_(settings),
        level_(level) {}

  void sweep(double azimuth_rad, double azimuth_step_rad, double near_m, double far_m, double step_m,
             std::vector<radar::Echo>& echoes, RenderCounts& counts) const {
    const Vec2d direction = radar::horizontal_direction(azimuth_rad);
    const Vec2d origin{radar_.position.x, radar_.position.y};
    terrain::ObstacleSweep line_of_sight(radar_.position.z);
    AspectCursor cursor{wrapped_azimuth(azimuth_rad + pi)}, ground_cursor{0.0};
    // What hides is looked at in strides that no obstacle is narrower than; every so many an echo is taken.
    const std::size_t strides = strides_in(step_m);
    const double stride_m = step_m / static_cast<double>(strides);
    const auto count = static_cast<std::size_t>((far_m - near_m) / step_m) * strides;
    for (std::size_t k = 0; k < count; ++k) {
      const double distance_m = near_m + (static_cast<double>(k) + 0.5) * stride_m;
      const Vec2d point = origin + direction * distance_m;
      if (!terrain_.extent().contains(point)) continue;
      const double height_m = terrain_.height_at(point);
      const terrain::Sight sight = line_of_sight.advance(distance_m, height_m, obstacle_at(point), stride_m);
      if (k % strides != strides / 2 || !area_.contains(point)) continue;
      ++counts.ground_samples;
      if (sight.ground == 0.0 && sight.objects == 0.0) continue;
      ++counts.visible;
      const double map_area_m2 = distance_m * azimuth_step_rad * step_m;
      const Vec3d place{point.x, point.y, height_m};
      radar::Echo echo = echo_from(place, azimuth_rad, map_area_m2, cursor);
      if (ground_ != nullptr) {
        echo.rcs_m2 = echo.rcs_m2 * static_cast<float>(sight.objects);
        if (sight.ground > 0.0) echo.rcs_m2 += ground_rcs_m2(place, map_area_m2 * sight.ground, ground_cursor);
      }
      echoes.push_back(echo);
    }
  }

 private:
  /// The looks that answer for the current stretch of the strip; looked up anew when the grazing angle has changed.
  struct AspectCursor {
    double azimuth_rad;
    double sin_grazing = 2.0;  // none yet
    atlas::AspectWeights weights = {};

    void turn_to(const atlas::Atlas& atlas, double new_sin_grazing, double frequency_hz) {
      if (std::abs(new_sin_grazing - sin_grazing) <= aspect_step * std::abs(new_sin_grazing)) return;
      sin_grazing = new_sin_grazing;
      weights = atlas.weights_for({azimuth_rad, std::asin(std::clamp(sin_grazing, -1.0, 1.0))}, frequency_hz);
    }
  };

  /// An odd number, so that one of them is the middle.
  [[nodiscard]] std::size_t strides_in(double step_m) const {
    if (ground_ == nullptr) return 1;
    return 2 * static_cast<std::size_t>(step_m / ground_->obstacles.grid.cell_m) + 1;
  }

  [[nodiscard]] radar::Obstacle obstacle_at(Vec2d point) const {
    return ground_ != nullptr ? ground_->obstacles.at(point) : radar::Obstacle{};
  }

  /// The bare ground's own echo: its angle is that to its slope, its area the true one.
  [[nodiscard]] radar::Channels ground_rcs_m2(Vec3d point, double map_area_m2, AspectCursor& cursor) const {
    const Vec2d place{point.x, point.y};
    const Vec3d normal = terrain_.normal_at(place);
    const double sin_grazing = dot(normal, normalized(radar_.position - point));
    if (sin_grazing <= 0.0) return {};
    cursor.turn_to(ground_->sigma0, sin_grazing, radar_.frequency_hz);
    return ground_->sigma0.sigma0_at(place, cursor.weights, level_) * static_cast<float>(map_area_m2 / normal.z);
  }

  [[nodiscard]] radar::Echo echo_from(Vec3d point, double azimuth_rad, double map_area_m2, AspectCursor& cursor) const {
    const Vec3d away = radar_.position - point;
    const double range_m = length(away);
    double sin_grazing = away.z / range_m;
    double area_m2 = map_area_m2;
    if (settings_.slope == SlopeModel::Tilted) {
      const Vec3d normal = terrain_.normal_at({point.x, point.y});
      sin_grazing = dot(normal, away) / range_m;
      area_m2 /= normal.z;
    }
    cursor.turn_to(atlas_, sin_grazing, radar_.frequency_hz);
    const radar::Channels sigma0 = atlas_.sigma0_at({point.x, point.y}, cursor.weights, level_);
    return {.range_m = range_m,
            .cross = azimuth_rad,
            .rcs_m2 = sigma0 * static_cast<float>(area_m2),
            .bounces = 1,
            .sin_depression = static_cast<float>(away.z / range_m)};
  }

  const atlas::Atlas& atlas_;
  const atlas::GroundLayers* ground_;  // nullptr where the textures hold ground and shadows
  const terrain::HeightField& terrain_;
  const radar::Radar& radar_;
  const radar::Rectangle& area_;
  const RenderSettings& settings_;
  double level_;
};

struct Reach {
  double near_m, far_m;
};

/// Nearest and farthest horizontal distance from the radar to ground that matters: terrain nearer than the area may
/// hide it.
Reach distances_to(const radar::Radar& radar, const radar::Rectangle& ground) {
  const Vec2d p{radar.position.x, radar.position.y};
  const Vec2d nearest{std::clamp(p.x, ground.west_m, ground.east_m), std::clamp(p.y, ground.south_m, ground.north_m)};
  double farthest = 0.0;
  for (const Vec2d corner : {Vec2d{ground.west_m, ground.south_m},
                             {ground.east_m, ground.south_m},
                             {ground.west_m, ground.north_m},
                             {ground.east_m, ground.north_m}}) {
    farthest = std::max(farthest, length(corner - p));
  }
  return {length(nearest - p), farthest};
}

}  // namespace

radar::RangeAzimuthImage GroundRenderer::render(const radar::Radar& radar, const radar::Rectangle& area,
                                                const radar::RangeAzimuthGrid& grid, const RenderSettings& settings,
                                                RenderCounts& counts) const {
  atlas_->check_frequency(radar.frequency_hz);
  const Reach reach = distances_to(radar, terrain_->extent());
  const double step_m = grid.range_step_m / samples_per_range_bin;
  const double cell_m = std::min(radar.range_resolution_m, radar.beam_width_rad * reach.near_m);
  // Two texels a resolution cell: what is finer the receiver would only average away.
  const double level = std::max(settings.level_of_detail - 1.0, atlas_->level_for(cell_m / 2.0));

  receiver::RangeAzimuthReceiver receiver(radar, grid);
  const AzimuthStrip strip(*atlas_, *terrain_, radar, area, settings, level);
  const unsigned workers = thread_count(settings.threads);
  std::vector<std::vector<radar::Echo>> echoes(workers);
  std::vector<RenderCounts> strip_counts(workers);
  parallel_for(grid.azimuths, workers, [&](std::size_t index, unsigned worker) {
    echoes[worker].clear();
    const double azimuth = grid.first_azimuth_rad + (static_cast<double>(index) + 0.5) * grid.azimuth_step_rad;
    strip.sweep(azimuth, grid.azimuth_step_rad, reach.near_m, reach.far_m, step_m, echoes[worker],
                strip_counts[worker]);
    receiver.add(echoes[worker]);
  });
  for (const RenderCounts& part : strip_counts) {
    counts.ground_samples += part.ground_samples;
    counts.visible += part.visible;
  }
  counts.overflows += receiver.bins().overflows();
  return receiver.image();
}

}  // namespace sigmascape::render
