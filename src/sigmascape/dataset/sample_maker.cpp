#include "sigmascape/dataset/sample_maker.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/dataset/speckle.h"
#include "sigmascape/product/ground_projection.h"
#include "sigmascape/receiver/range_azimuth_receiver.h"
#include "sigmascape/receiver/target_echoes.h"
#include "sigmascape/scene/obstacle_raster.h"
#include "sigmascape/scene/scene_file.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::dataset {
namespace {

/// How far above the highest thing the radar must stand.
constexpr double clearance_m = 2.0;

atlas::Atlas loaded_atlas(const DatasetSpec& spec, const std::string& scene_hash) {
  const auto store = atlas::Store::open(*spec.atlas);
  if (store.description().scene_hash != scene_hash) {
    throw Error(fmt::format("{}: dataset.atlas", spec.file.string()), "was baked from another scene",
                "bake this scene, or name the scene that the atlas was made from");
  }
  return atlas::load_atlas(store);
}

std::shared_ptr<const radar::ObstacleMap> obstacles_for(const atlas::Atlas& atlas, const scene::Scene& scene,
                                                        double cell_m) {
  if (atlas.ground_layers() != nullptr) {
    return std::make_shared<const radar::ObstacleMap>(atlas.ground_layers()->obstacles);
  }
  const radar::Rectangle all = scene.extent;
  return std::make_shared<const radar::ObstacleMap>(
      scene::obstacles_of(scene, {all.west_m, all.north_m, cell_m, static_cast<std::size_t>(all.width_m() / cell_m),
                                  static_cast<std::size_t>(all.height_m() / cell_m)}));
}

radar::Target target_of(const PlannedTarget& planned, const TargetClass& kind, const terrain::HeightField& terrain) {
  const auto rcs = static_cast<float>(planned.rcs_m2);
  return {.name = kind.name,
          .track = radar::Track::straight(
              {planned.position.x, planned.position.y, terrain.height_at(planned.position) + kind.height_m}),
          .rcs_m2 = radar::Channels{rcs, rcs, 0.0F, rcs}};
}

/// Where the map shows a point: on the ground at the point's own range and azimuth.
Vec2d shown_at(Vec3d point, Vec3d radar, const terrain::HeightField& terrain) {
  const double range_m = length(point - radar);
  const Vec2d here{radar.x, radar.y};
  const Vec2d away = Vec2d{point.x, point.y} - here;
  const Vec2d outwards = away * (1.0 / length(away));
  Vec2d shown{point.x, point.y};
  for (int round = 0; round < 8; ++round) {
    const double drop_m = radar.z - terrain.height_at(shown);
    shown = here + outwards * std::sqrt(std::max(0.0, range_m * range_m - drop_m * drop_m));
  }
  return shown;
}

/// The box, sides along the map's, about size and response of a target.
product::TargetBox box_about(Vec2d shown, const radar::Radar& radar, const TargetClass& kind, std::size_t category,
                             const radar::GroundGrid& grid) {
  const Vec2d away{shown.x - radar.position.x, shown.y - radar.position.y};
  const double distance_m = length(away), range_m = std::hypot(distance_m, radar.position.z);
  const double along_m = radar.range_resolution_m * range_m / distance_m;
  // Sent and received over the same beam: its two-way half-power width.
  const double across_m = radar.beam_width_rad * distance_m / std::sqrt(2.0);
  const double sine = std::abs(away.x) / distance_m, cosine = std::abs(away.y) / distance_m;
  const double width = (along_m * sine + across_m * cosine + kind.size_m) / grid.cell_m + 1.0;
  const double height = (along_m * cosine + across_m * sine + kind.size_m) / grid.cell_m + 1.0;
  const Vec2d cell = grid.cells_from(shown);
  const auto columns = static_cast<double>(grid.columns), rows = static_cast<double>(grid.rows);
  const double left = std::clamp(cell.x - width / 2.0, 0.0, columns),
               right = std::clamp(cell.x + width / 2.0, 0.0, columns);
  const double top = std::clamp(cell.y - height / 2.0, 0.0, rows),
               bottom = std::clamp(cell.y + height / 2.0, 0.0, rows);
  return {category, left, top, right - left, bottom - top};
}

double mean_vv(const radar::GroundMap& map) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const radar::Channels& cell : map.sigma0.values()) {
    if (std::isnan(cell.vv)) continue;
    sum += static_cast<double>(cell.vv);
    ++count;
  }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

}  // namespace

SampleMaker::SampleMaker(const DatasetSpec& spec)
    : spec_(spec),
      scene_(scene::read_scene(spec.scene)),
      scene_hash_(scene::scene_hash(scene_)),
      centres_(centres_of(spec, scene_.extent)) {
  if (spec_.level_of_detail == 0) {
    geometry_.emplace(scene_, trace::Footing::Terrain);
  } else {
    atlas_ = loaded_atlas(spec_, scene_hash_);
    obstacles_ = obstacles_for(*atlas_, scene_, spec_.cell_m);
  }
  check_views();
}

void SampleMaker::check_views() const {
  const std::string file = spec_.file.string();
  if (atlas_) {
    atlas_->check_frequency(spec_.radar.radar.frequency_hz);
    const auto& baked = atlas_->aspects().elevations_rad;
    constexpr double slack_rad = 1e-9;
    if (spec_.elevation_rad.lowest < baked.front() - slack_rad ||
        spec_.elevation_rad.highest > baked.back() + slack_rad) {
      throw Error(file + ": view.elevation_deg",
                  fmt::format("leads outside the atlas, which was baked from {:.1f} to {:.1f} degrees",
                              deg_from_radians(baked.front()), deg_from_radians(baked.back())),
                  "stay within these, or bake more elevations");
    }
  }
  const double highest_m = scene_.terrain.highest_m() + static_cast<float>(scene::tallest_object_m(scene_));
  const double least_altitude_m =
      scene_.terrain.lowest_m() + spec_.slant_range_m.lowest * std::sin(spec_.elevation_rad.lowest);
  if (least_altitude_m < highest_m + clearance_m) {
    throw Error(file + ": view.slant_range_km",
                fmt::format("lets the radar stand at {:.0f} m, and the scene reaches up to {:.0f} m", least_altitude_m,
                            highest_m),
                "begin the range further out, or the elevation higher");
  }
  const double half_diagonal_m = static_cast<double>(spec_.cells) * spec_.cell_m / std::sqrt(2.0);
  if (spec_.slant_range_m.lowest * std::cos(spec_.elevation_rad.highest) < half_diagonal_m) {
    throw Error(file + ": view.slant_range_km", "lets the radar stand over the map", "begin the range further out");
  }
}

radar::RangeAzimuthImage SampleMaker::ground_image(const radar::Radar& radar, const SamplePlan& plan) const {
  if (atlas_) {
    render::RenderCounts counts;
    return simulate::baked_image(*atlas_, scene_.terrain, radar, plan.grid.extent(),
                                 {.level_of_detail = spec_.level_of_detail, .threads = 1}, counts);
  }
  trace::TraceCounts counts;
  return simulate::traced_image(
      scene_, *geometry_, radar, plan.grid.extent(),
      {.cell_m = spec_.cell_m, .samples_per_cell = spec_.samples_per_cell, .seed = plan.seed, .threads = 1}, counts);
}

radar::LayerStack SampleMaker::labels(const radar::Radar& radar, const radar::GroundGrid& grid) const {
  std::vector<simulate::LayerKind> kinds = spec_.layers;
  // Which targets are seen is told by the shadows.
  if (std::ranges::find(kinds, simulate::LayerKind::Shadow) == kinds.end()) {
    kinds.push_back(simulate::LayerKind::Shadow);
  }
  if (geometry_) return simulate::traced_layers(scene_, *geometry_, radar, grid, kinds, 1);
  return simulate::swept_layers({&scene_.terrain, obstacles_.get(), &scene_.ground, scene_.materials.size()}, radar,
                                grid, kinds, 1);
}

Sample SampleMaker::make(std::size_t index) const {
  Sample sample;
  sample.plan = plan_of(spec_, centres_, index);
  const SamplePlan& plan = sample.plan;
  radar::Radar radar = spec_.radar.radar;
  radar.position = radar::position_seeing({plan.centre.x, plan.centre.y, scene_.terrain.height_at(plan.centre)},
                                          plan.azimuth_rad, plan.elevation_rad, plan.slant_range_m);
  sample.radar_position = radar.position;
  const auto image = ground_image(radar, plan);
  sample.map = product::ground_map(image, scene_.terrain, plan.grid);
  sample.map.crs = scene_.frame.proj();
  sample.labels = labels(radar, plan.grid);
  sample.labels.crs = sample.map.crs;

  const auto shadow = std::ranges::find(sample.labels.layers, "shadow", &radar::Layer::name);
  std::vector<radar::Target> seen;
  for (const PlannedTarget& planned : plan.targets) {
    const TargetClass& kind = spec_.targets[planned.target_class];
    const Vec2d cell = plan.grid.cells_from(planned.position);
    const radar::Target target = target_of(planned, kind, scene_.terrain);
    const auto column = std::min(static_cast<std::size_t>(cell.x), spec_.cells - 1);
    const auto row = std::min(static_cast<std::size_t>(cell.y), spec_.cells - 1);
    SampleTarget out{.planned = planned, .is_seen = shadow->values(column, row) == 0.0F, .box = {}};
    out.box = box_about(shown_at(target.track.position_at(0.0), radar.position, scene_.terrain), radar, kind,
                        planned.target_class, plan.grid);
    out.is_seen = out.is_seen && out.box.width > 0.0 && out.box.height > 0.0;
    if (out.is_seen) seen.push_back(target);
    sample.targets.push_back(out);
  }
  Array2D<radar::Channels> steady;
  if (!seen.empty()) {
    receiver::RangeAzimuthReceiver receiver(radar, image.grid);
    receiver.add(receiver::target_echoes(seen, radar, {}));
    steady = product::ground_map(receiver.image(), scene_.terrain, plan.grid).sigma0;
  }
  if (plan.snr_db) sample.noise_sigma0 = mean_vv(sample.map) / linear_from_db(*plan.snr_db);
  draw_speckle(sample.map, steady,
               {.looks = spec_.looks, .noise = static_cast<float>(sample.noise_sigma0), .seed = plan.seed});
  if (std::ranges::find(spec_.layers, simulate::LayerKind::Shadow) == spec_.layers.end()) {
    sample.labels.layers.erase(shadow);
  }
  return sample;
}

}  // namespace sigmascape::dataset
