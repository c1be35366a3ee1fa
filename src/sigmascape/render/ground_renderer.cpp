#include "sigmascape/render/ground_renderer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
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

/// A bin that is larger than so many samples, in range or across, holds no more along that side.
constexpr double most_samples_a_side = 32.0;
/// Outwards, where samples step evenly over the ground and bins over slant range, two show no beat between them: they
/// are shared linearly between bins.
constexpr double fewest_samples_outwards = 2.0;

/// Samples along the side of the finest texel that is read. What a texel shows is as wide as itself, with edges of half
/// its width: samples that lie 1/n of a texel apart, n whole, sum it without error along its axes.
constexpr double samples_a_texel = 2.0;
/// Of those that lie across a strip in every step; it is wider where bins hold many texels.
constexpr double most_places_across = 8.0;

/// Of the distance to the farthest ground of a map, that to the nearest whose bins' widths are asked for: under a radar
/// that stands over its map they narrow to nothing.
constexpr double nearest_part = 0.25;

/// How samples lie along a strip of ground.
struct StripSpacing {
  double step_m;  ///< outwards
  double places;  ///< in every step, across
};

/// A strip of ground, one azimuth's worth: which of it is seen, and what comes back.
///
/// What hides is asked in its middle; reflectivity is looked up at places across it. From step to step these move on by
/// the golden section of what lies between them, so that they make no rows outwards that a wall could slip through.
class AzimuthStrip {
 public:
  AzimuthStrip(const ReflectingGround& ground, const radar::TargetShadows& shadows, Vec3d radar_position,
               const radar::Rectangle& area)
      : ground_(ground), shadows_(shadows), radar_position_(radar_position), area_(area) {}

  void sweep(double azimuth_rad, double width_rad, double near_m, double far_m, const StripSpacing& spacing,
             std::vector<radar::Echo>& echoes, RenderCounts& counts) const {
    const radar::GroundStretch wanted =
        radar::stretch_within(area_, {radar_position_.x, radar_position_.y}, radar::horizontal_direction(azimuth_rad));
    if (wanted.empty()) return;
    ReflectingGround::Looks looks;
    const double to_radar_rad = wrapped_azimuth(azimuth_rad + pi);
    const Vec2d right = radar::horizontal_direction(azimuth_rad + 0.5 * pi);
    // What lies beyond the area hides nothing of it.
    ground_.walk(azimuth_rad, near_m, std::min(far_m, wanted.end_m + spacing.step_m), spacing.step_m,
                 [&](std::size_t step, double distance_m, Vec3d middle, const terrain::Sight& sight) {
                   const double width_m = distance_m * width_rad, apart_m = width_m / spacing.places;
                   const double golden = std::numbers::phi * static_cast<double>(step);
                   radar::Channels sigma0;
                   std::size_t within = 0, seen = 0;
                   for (double place = golden - std::floor(golden); place < spacing.places; ++place) {
                     const double aside_m = place * apart_m - 0.5 * width_m;
                     const Vec3d point{middle.x + aside_m * right.x, middle.y + aside_m * right.y, middle.z};
                     if (!area_.contains({point.x, point.y})) continue;
                     ++within;
                     if (!ground_.answers(point, sight)) continue;
                     if (shadows_.hide(point)) continue;
                     ++seen;
                     sigma0 += ground_.sigma0(point, to_radar_rad, sight, looks);
                   }
                   counts.ground_samples += within;
                   counts.visible += seen;
                   if (seen == 0) return;
                   const Vec3d away = radar_position_ - middle;
                   const double range_m = length(away);
                   echoes.push_back({.range_m = range_m,
                                     .cross = azimuth_rad,
                                     .rcs_m2 = sigma0 * static_cast<float>(apart_m * spacing.step_m),
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

/// A whole part of the finest texel that is read, and of a bin no more than lets beats be seen.
double outward_step_m(double range_step_m, double finest_m) {
  const double parts = std::ceil(finest_m / (range_step_m / fewest_samples_outwards));
  return std::max(finest_m / std::max(parts, samples_a_texel), range_step_m / most_samples_a_side);
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
  const double level = std::min(std::max(settings.level_of_detail - 1.0, atlas_->level_for(cell_m / 2.0)),
                                static_cast<double>(atlas_->coarsest_level()));
  atlas_->prepare(area, level);

  receiver::RangeAzimuthReceiver receiver(radar, grid);
  const auto buildings = building_layer(
      *atlas_, *terrain_,
      {radar::Vantage(radar.position), frequency_hz, area, level, radar::CurvedEarth::flat(), settings.threads});
  const ReflectingGround ground =
      ReflectingGround(*atlas_, *terrain_, radar.position, frequency_hz, level, settings.slope)
          .with_buildings(buildings.get());
  const radar::TargetShadows shadows(settings.targets, 0.0, radar.position);
  const AzimuthStrip strip(ground, shadows, radar.position, area);
  const radar::AzimuthSpan azimuths = azimuths_to_sweep(area, foot);
  const double texel_m = atlas_->patches().texel_m;
  const double apart_m = texel_m * std::exp2(level), finest_m = texel_m * std::exp2(std::floor(level));
  const double step_m = outward_step_m(grid.range_step_m, finest_m);
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
    const StripSpacing spacing{
        step_m, std::clamp(std::ceil(samples_a_texel * width_rad * far_of_map_m / finest_m), 1.0, most_places_across)};
    for (double number = 0.5; number < strips && width_rad > 0.0; ++number) {
      const double azimuth_rad = span.middle_rad + span.left_rad + number * width_rad;
      echoes[worker].clear();
      strip.sweep(azimuth_rad, width_rad, near_m, far_m, spacing, echoes[worker], strip_counts[worker]);
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
