#include "sigmascape/render/ground_renderer.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sigmascape/base/parallel.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/azimuth_span.h"
#include "sigmascape/radar/echo.h"
#include "sigmascape/radar/rectangle_distances.h"
#include "sigmascape/radar/target_shadows.h"
#include "sigmascape/receiver/range_azimuth_receiver.h"

namespace sigmascape::render {
namespace {

/// Samples stand about a texel apart. A bin that is larger than that, in range or across, holds up to so many along
/// that side.
constexpr double most_samples_a_side = 32.0;
/// Outwards, where samples step evenly over the ground and bins over slant range, two show no beat between them: they
/// are shared linearly between bins.
constexpr double fewest_samples_outwards = 2.0;

/// Of the distance to the farthest ground of a map, that to the nearest whose bins' widths are asked for: under a radar
/// that stands over its map they narrow to nothing.
constexpr double nearest_part = 0.25;

/// A strip of ground, one azimuth's worth: which of it is seen, and what comes back.
class AzimuthStrip {
 public:
  AzimuthStrip(const ReflectingGround& ground, const radar::TargetShadows& shadows, Vec3d radar_position,
               const radar::Rectangle& area)
      : ground_(ground), shadows_(shadows), radar_position_(radar_position), area_(area) {}

  void sweep(double azimuth_rad, double width_rad, double near_m, double far_m, double step_m,
             std::vector<radar::Echo>& echoes, RenderCounts& counts) const {
    const radar::GroundStretch wanted =
        radar::stretch_within(area_, {radar_position_.x, radar_position_.y}, radar::horizontal_direction(azimuth_rad));
    if (wanted.empty()) return;
    ReflectingGround::Looks looks;
    const double to_radar_rad = wrapped_azimuth(azimuth_rad + pi);
    // What lies beyond the area hides nothing of it.
    ground_.walk(azimuth_rad, near_m, std::min(far_m, wanted.end_m + step_m), step_m,
                 [&](std::size_t, double distance_m, Vec3d point, const terrain::Sight& sight) {
                   if (!area_.contains({point.x, point.y})) return;
                   ++counts.ground_samples;
                   if (sight.ground == 0.0 && ground_.part_seen(point, sight) == 0.0) return;
                   if (shadows_.hide(point)) return;
                   ++counts.visible;
                   const Vec3d away = radar_position_ - point;
                   const double range_m = length(away);
                   const double map_area_m2 = distance_m * width_rad * step_m;
                   echoes.push_back(
                       {.range_m = range_m,
                        .cross = azimuth_rad,
                        .rcs_m2 = ground_.sigma0(point, to_radar_rad, sight, looks) * static_cast<float>(map_area_m2),
                        .bounces = 1,
                        .sin_depression = static_cast<float>(away.z / range_m)});
                 });
  }

 private:
  const ReflectingGround& ground_;
  const radar::TargetShadows& shadows_;
  Vec3d radar_position_;
  const radar::Rectangle& area_;
};

/// Under which an area is seen. From above it these are all, and no bin is cut where they close.
radar::AzimuthSpan azimuths_to_sweep(const radar::Rectangle& area, Vec2d foot) {
  if (area.contains(foot)) return {.middle_rad = 0.0, .left_rad = -2.0 * pi, .right_rad = 2.0 * pi};
  return radar::azimuths_of(area, foot);
}

/// What azimuths have in common with a bin, about the same middle.
radar::AzimuthSpan within_bin(const radar::AzimuthSpan& azimuths, double first_rad, double width_rad) {
  const double left_rad = turned_by_least(first_rad + 0.5 * width_rad - azimuths.middle_rad) - 0.5 * width_rad;
  return {azimuths.middle_rad, std::max(left_rad, azimuths.left_rad),
          std::min(left_rad + width_rad, azimuths.right_rad)};
}

}  // namespace

radar::RangeAzimuthImage GroundRenderer::render(const radar::Radar& radar, const radar::Rectangle& area,
                                                const radar::RangeAzimuthGrid& grid, const RenderSettings& settings,
                                                RenderCounts& counts) const {
  const double frequency_hz = settings.texture_frequency_hz.value_or(radar.frequency_hz);
  atlas_->check_frequency(frequency_hz);
  const Vec2d foot{radar.position.x, radar.position.y};
  const double far_of_map_m = radar::farthest_m(area, foot);
  const double near_of_map_m = std::max(radar::nearest_m(area, foot), far_of_map_m * nearest_part);
  const double cell_m = std::min(radar.range_resolution_m, radar.beam_width_rad * near_of_map_m);
  // Two texels a resolution cell: what is finer the receiver would only average away.
  const double level = std::max(settings.level_of_detail - 1.0, atlas_->level_for(cell_m / 2.0));
  atlas_->prepare(area, level);

  receiver::RangeAzimuthReceiver receiver(radar, grid);
  const ReflectingGround ground(*atlas_, *terrain_, radar.position, frequency_hz, level, settings.slope);
  const radar::TargetShadows shadows(settings.targets, 0.0, radar.position);
  const AzimuthStrip strip(ground, shadows, radar.position, area);
  const radar::AzimuthSpan azimuths = azimuths_to_sweep(area, foot);
  const double apart_m = atlas_->patches().texel_m * std::exp2(level);
  const double step_m = grid.range_step_m / std::clamp(std::round(grid.range_step_m / apart_m), fewest_samples_outwards,
                                                       most_samples_a_side);
  // Terrain nearer than the area may hide it.
  const double near_m = radar::nearest_m(terrain_->extent(), foot), far_m = radar::farthest_m(terrain_->extent(), foot);
  const unsigned workers = thread_count(settings.threads);
  std::vector<std::vector<radar::Echo>> echoes(workers);
  std::vector<RenderCounts> strip_counts(workers);
  parallel_for(grid.azimuths, workers, [&](std::size_t index, unsigned worker) {
    const double first_rad = grid.first_azimuth_rad + static_cast<double>(index) * grid.azimuth_step_rad;
    const radar::AzimuthSpan span = within_bin(azimuths, first_rad, grid.azimuth_step_rad);
    const double seen_rad = std::max(span.right_rad - span.left_rad, 0.0);
    const double strips = std::clamp(std::round(seen_rad * far_of_map_m / apart_m), 1.0, most_samples_a_side);
    const double width_rad = seen_rad / strips;
    for (double number = 0.5; number < strips && width_rad > 0.0; ++number) {
      const double azimuth_rad = span.middle_rad + span.left_rad + number * width_rad;
      echoes[worker].clear();
      strip.sweep(azimuth_rad, width_rad, near_m, far_m, step_m, echoes[worker], strip_counts[worker]);
      receiver.add_at_azimuth(azimuth_rad, echoes[worker]);
    }
  });
  for (const RenderCounts& part : strip_counts) {
    counts.ground_samples += part.ground_samples;
    counts.visible += part.visible;
  }
  return receiver.image();
}

}  // namespace sigmascape::render
