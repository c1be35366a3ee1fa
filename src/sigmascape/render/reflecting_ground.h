#pragma once

#include <algorithm>
#include <cstddef>

#include "sigmascape/atlas/atlas.h"
#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/look.h"
#include "sigmascape/radar/sea_horizon.h"
#include "sigmascape/render/building_layer.h"
#include "sigmascape/terrain/ground_profile.h"
#include "sigmascape/terrain/height_field.h"
#include "sigmascape/terrain/obstacle_sweep.h"

namespace sigmascape::render {

/// Which grazing angle and which area the reflectivity of a slope is looked up and weighted with.
enum class SlopeModel {
  Upright,  ///< that above the horizontal, over map area: right for walls and trees, which do not lean with their hill
  Tilted,   ///< that above the local slope, over true area: right for bare ground
};

/// Terrain and atlas as a radar at one place meets them: what of a place is seen, and what of that comes back.
/// docs/decisions/0006-ground-apart.md.
class ReflectingGround {
 public:
  /// The looks that answer for a stretch of ground; looked up anew when the aspect has changed.
  class Looks {
   private:
    friend class ReflectingGround;
    struct Cursor {
      double azimuth_rad = 0.0;
      double sin_grazing = 2.0;  // none yet
      atlas::AspectWeights weights = {};
      void turn_to(const atlas::Atlas& atlas, double new_azimuth_rad, double new_sin_grazing, double frequency_hz);
    };
    Cursor textures_, ground_;
  };

  /// `slope` is that of the textures; ground that is kept apart is Tilted always. Both must outlive this.
  ReflectingGround(const atlas::Atlas& atlas, const terrain::HeightField& terrain, Vec3d radar_position,
                   double frequency_hz, double level, SlopeModel slope = SlopeModel::Upright,
                   const radar::CurvedEarth& earth = radar::CurvedEarth::flat())
      : atlas_(&atlas),
        ground_(atlas.ground_layers()),
        terrain_(&terrain),
        radar_position_(radar_position),
        frequency_hz_(frequency_hz),
        level_(level),
        slope_(slope),
        earth_(earth),
        lowest_ground_m_(earth.curvature_per_m() > 0.0 ? static_cast<double>(terrain.lowest_m()) : 0.0) {}

  /// The same ground with what its buildings return directly, laid over it for this radar: where the atlas keeps them
  /// apart. The layer must outlive it.
  [[nodiscard]] ReflectingGround with_buildings(const BuildingLayer* layer) const {
    ReflectingGround other = *this;
    other.buildings_ = layer;
    return other;
  }

  /// The same ground as a radar at another place meets it.
  [[nodiscard]] ReflectingGround seen_from(Vec3d radar_position) const {
    ReflectingGround other = *this;
    other.radar_position_ = radar_position;
    return other;
  }

  /// Side of the squares in which is told what hides and what answers.
  [[nodiscard]] double told_cell_m() const {
    return ground_ != nullptr ? ground_->obstacles.grid.cell_m : atlas_->patches().texel_m;
  }

  /// Walks outwards along an azimuth, from one distance over the ground to another, and calls `visit(step, distance_m,
  /// point, sight)` in the middle of every step that lies on the terrain, or up to `beyond_m` outside it, where it goes
  /// on as high as its edges and hides nothing.
  template <typename Visit>
  void walk(double azimuth_rad, double near_m, double far_m, double step_m, const Visit& visit,
            double beyond_m = 0.0) const {
    terrain::ObstacleSweep line_of_sight(radar_position_.z);
    const radar::SeaHorizon sea(radar_position_.z, lowest_ground_m_, earth_.curvature_per_m());
    // What hides is looked at in strides that no obstacle and no crest is narrower than; every so many a place is
    // visited.
    const std::size_t strides = strides_in(step_m);
    const double stride_m = step_m / static_cast<double>(strides);
    terrain::GroundProfile profile(*terrain_, ground_ != nullptr ? &ground_->obstacles : nullptr, beyond_m);
    const radar::Rectangle extent = terrain_->extent();
    profile.walk({.origin = {radar_position_.x, radar_position_.y},
                  .direction = radar::horizontal_direction(azimuth_rad),
                  .near_m = near_m,
                  .step_m = stride_m,
                  .count = static_cast<std::size_t>(std::max(0.0, (far_m - near_m) / step_m)) * strides},
                 [&](std::size_t k, double distance_m, Vec3d point, const radar::Obstacle& obstacle) {
                   line_of_sight.rise_to(sea.slope_before(distance_m));
                   const double height_m = point.z - earth_.drop_m(distance_m);
                   const bool hides = beyond_m == 0.0 || extent.contains({point.x, point.y});
                   const terrain::Sight sight =
                       hides ? line_of_sight.advance(distance_m, height_m, obstacle, stride_m)
                             : terrain::ObstacleSweep(line_of_sight).advance(distance_m, height_m, obstacle, stride_m);
                   if (k % strides == strides / 2) visit(k / strides, distance_m, point, sight);
                 });
  }

  /// Of what answers from there but the bare ground, the part that is seen, from 0 to 1.
  [[nodiscard]] double part_seen(Vec3d point, const terrain::Sight& sight) const;

  /// Whether anything is seen of a point of which so much is seen.
  [[nodiscard]] bool answers(Vec3d point, const terrain::Sight& sight) const {
    return sight.ground > 0.0 || part_seen(point, sight) > 0.0 ||
           (buildings_ != nullptr && buildings_->sigma0_at({point.x, point.y}) != radar::Channels{});
  }

  /// σ0 over map area of a point on the terrain of which so much is seen: textures for what stands there, scaled by
  /// what of them is seen, buildings that are kept apart, and the bare ground where it is kept apart, with its grazing
  /// angle above the local slope and its true area. `to_radar_rad`: azimuth from the point to the radar.
  [[nodiscard]] radar::Channels sigma0(Vec3d point, double to_radar_rad, const terrain::Sight& sight,
                                       Looks& looks) const;

 private:
  /// An odd number, so that one of them is the middle.
  [[nodiscard]] std::size_t strides_in(double step_m) const {
    const double narrowest_m =
        ground_ != nullptr ? std::min(ground_->obstacles.grid.cell_m, terrain_->spacing_m) : terrain_->spacing_m;
    return 2 * static_cast<std::size_t>(step_m / narrowest_m) + 1;
  }
  /// Unit vector to the radar from a point, above the horizontal that the point has on the curved Earth.
  [[nodiscard]] Vec3d towards_radar(Vec3d point) const;
  /// Sine of the elevation at which what stands upright is looked up: that above the horizontal. Below the lowest baked
  /// one, where γ is held, it is what gives that look as much less as the slope has less of the beam: a hillside goes
  /// on to answer where level ground is grazed, and to a radar that stands lower than itself.
  /// docs/decisions/0150-below-the-lowest-look.md
  [[nodiscard]] double upright_sine(Vec2d place, Vec3d towards) const;
  [[nodiscard]] radar::Channels of_textures(Vec2d place, Vec3d towards, double to_radar_rad,
                                            Looks::Cursor& cursor) const;
  [[nodiscard]] radar::Channels of_bare_ground(Vec2d place, Vec3d towards, Looks::Cursor& cursor) const;

  const atlas::Atlas* atlas_;
  const atlas::GroundLayers* ground_;
  const terrain::HeightField* terrain_;
  Vec3d radar_position_;
  double frequency_hz_, level_;
  SlopeModel slope_;
  radar::CurvedEarth earth_;
  double lowest_ground_m_;  // looked for over a round Earth alone: a flat one hides nothing by it
  const BuildingLayer* buildings_ = nullptr;
};

}  // namespace sigmascape::render
