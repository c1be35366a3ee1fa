#include "sigmascape/dataset/sample_maker.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/dataset/bounce_labels.h"
#include "sigmascape/dataset/dataset_atlases.h"
#include "sigmascape/dataset/sample_radar.h"
#include "sigmascape/dataset/speckle.h"
#include "sigmascape/dataset/target_box.h"
#include "sigmascape/product/ground_projection.h"
#include "sigmascape/receiver/target_echoes.h"
#include "sigmascape/scene/obstacle_raster.h"
#include "sigmascape/scene/scene_file.h"
#include "sigmascape/simulate/part_seen.h"
#include "sigmascape/simulate/placement.h"
#include "sigmascape/simulate/simulate.h"
#include "sigmascape/trace/path_tracer.h"

namespace sigmascape::dataset {
namespace {

std::shared_ptr<const radar::ObstacleMap> obstacles_for(const atlas::Atlas& atlas, const scene::Scene& scene,
                                                        double cell_m) {
  if (atlas.ground_layers() != nullptr) {
    return std::make_shared<const radar::ObstacleMap>(atlas.ground_layers()->obstacles);
  }
  return std::make_shared<const radar::ObstacleMap>(scene::obstacles_of(scene, cell_m));
}

radar::Target target_of(const PlannedTarget& planned, const TargetClass& kind, const terrain::HeightField& terrain) {
  return {.name = kind.name,
          .track = radar::Track::straight(
              {planned.position.x, planned.position.y, terrain.height_at(planned.position) + kind.height_m},
              {planned.velocity_mps.x, planned.velocity_mps.y, 0.0}),
          .rcs_m2 = target_channels(planned.rcs_m2)};
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

/// σ0 of the noise that the plan wants under a map.
double noise_under(const radar::GroundMap& map, const SamplePlan& plan) {
  if (plan.noise_sigma0_db) return linear_from_db(*plan.noise_sigma0_db);
  if (plan.snr_db) return mean_vv(map) / linear_from_db(*plan.snr_db);
  return 0.0;
}

/// Whether a place lies on the map where the radar looks.
bool is_looked_at(Vec2d place, const radar::GroundMap& map) {
  if (!map.grid.extent().contains(place)) return false;
  const Vec2d cell = map.grid.cells_from(place);
  const std::size_t column = std::min(static_cast<std::size_t>(cell.x), map.grid.columns - 1);
  const std::size_t row = std::min(static_cast<std::size_t>(cell.y), map.grid.rows - 1);
  return !std::isnan(map.sigma0(column, row).vv);
}

/// Whether the gate is open when the echo of a place comes back, of the same pulse.
bool is_within_gate(Vec3d place, const radar::Radar& radar) {
  const double range_m = length(place - radar.position);
  return range_m >= radar.receiver.first_range_m.value_or(0.0) &&
         range_m <= radar.receiver.last_range_m.value_or(std::numeric_limits<double>::infinity());
}

}  // namespace

radar::Channels target_channels(double rcs_m2) {
  const auto rcs = static_cast<float>(rcs_m2);
  return {rcs, rcs, 0.0F, rcs};
}

SampleMaker::SampleMaker(const DatasetSpec& spec)
    : spec_(spec),
      scene_(scene::read_scene(spec.scene)),
      scene_hash_(scene::scene_hash(scene_)),
      targets_hash_(scene::targets_hash(scene_)),
      reflectors_(simulate::targets_of(scene_)),
      centres_(centres_of(spec, scene_.extent)) {
  scene_.point_targets.clear();  // speckle is of the ground alone
  if (spec_.level_of_detail == 0) {
    geometry_.emplace(scene_, trace::Footing::Terrain);
  } else {
    DatasetAtlases opened = opened_atlases(spec_, scene_hash_);
    atlas_ = std::move(opened.all);
    bounce_atlases_ = std::move(opened.of_bounces);
    atlas_hashes_ = std::move(opened.hashes);
    obstacles_ = obstacles_for(*atlas_, scene_, spec_.cell_m);
    for (const radar::Obstacle& obstacle : obstacles_->obstacles.values())
      tallest_m_ = std::max(tallest_m_, static_cast<double>(obstacle.top_m()));
    highest_m_ = simulate::highest_m_of(scene_.terrain, obstacles_.get());
  }
  check_radars();
  check_views();
  check_gate();
  check_flights();
  check_classes();
}

radar::RangeAzimuthImage SampleMaker::ground_image(const radar::Radar& radar, const SamplePlan& plan,
                                                   std::vector<radar::Layer>& bounces) const {
  if (atlas_) {
    render::RenderCounts counts;
    const auto image_from = [&](const atlas::Atlas& atlas) {
      return simulate::baked_image(atlas, scene_.terrain, radar, plan.grid.extent(),
                                   {.level_of_detail = spec_.level_of_detail, .threads = 1}, counts);
    };
    auto image = image_from(*atlas_);
    std::vector<radar::RangeAzimuthImage> up_to;
    for (const atlas::Atlas& fewer : bounce_atlases_) up_to.push_back(image_from(fewer));
    bounces =
        baked_bounce_layers(spec_.bounce_layers, image, up_to, scene_.terrain, plan.grid, spec_.polarizations.front());
    return image;
  }
  simulate::TraceSettings settings{
      .cell_m = spec_.cell_m, .samples_per_cell = spec_.samples_per_cell, .seed = plan.seed, .threads = 1};
  if (!spec_.bounce_layers.empty()) {
    for (const std::string& name : spec_.bounce_layers)
      settings.max_bounces = std::max(settings.max_bounces, static_cast<int>(bounce_order(name)));
    radar::Radar shown = radar;
    shown.polarization = spec_.polarizations.front();
    radar::RangeAzimuthImage image;
    bounces =
        traced_bounce_layers(spec_.bounce_layers, scene_, *geometry_, shown, plan.grid, settings, nullptr, &image);
    return image;
  }
  trace::TraceCounts counts;
  return simulate::traced_image(scene_, *geometry_, radar, plan.grid.extent(), settings, counts);
}

radar::LayerStack SampleMaker::labels(const radar::Radar& radar, const radar::GroundGrid& grid) const {
  const std::vector<simulate::LayerKind>& kinds = spec_.layers;
  if (kinds.empty()) return {grid, {}, {}, {}};
  if (geometry_) return simulate::traced_layers(scene_, *geometry_, radar, grid, kinds, 1);
  return simulate::swept_layers(
      {&scene_.terrain, obstacles_.get(), &scene_.ground, scene_.materials.size(), tallest_m_}, radar, grid, kinds, 1);
}

std::vector<SampleTarget> SampleMaker::targets_of(const SamplePlan& plan, const radar::Radar& radar,
                                                  const radar::GroundMap& map, const PartSeen& part_seen) const {
  std::vector<SampleTarget> targets;
  for (const PlannedTarget& planned : plan.targets) {
    const TargetClass& kind = spec_.targets[planned.target_class];
    const radar::Target point = target_of(planned, kind, scene_.terrain);
    const Vec3d place = point.track.position_at(0.0);
    SampleTarget target{.planned = planned, .box = target_box(place, kind.size_m, radar, scene_.terrain, plan.grid)};
    target.box.category = planned.target_class;
    target.box.track = planned.track;
    target.part_seen = part_seen(place);
    target.is_seen = target.part_seen >= least_part_seen && is_looked_at(planned.position, map) &&
                     is_within_gate(place, radar) && target.box.width > 0.0;
    targets.push_back(target);
  }
  return targets;
}

SampleMaker::PartSeen SampleMaker::part_seen_from(const radar::Radar& radar) const {
  if (!geometry_) {
    return [this, from = radar.position](Vec3d point) {
      return simulate::part_seen({.terrain = scene_.terrain, .obstacles = obstacles_.get(), .highest_m = highest_m_},
                                 from, point);
    };
  }
  return [this, from = radar.position, surfaces = trace::surface_models(scene_, radar.frequency_hz)](Vec3d point) {
    return simulate::part_seen(*geometry_, surfaces, from, point);
  };
}

Array2D<radar::Channels> SampleMaker::steady_sigma0(const std::vector<SampleTarget>& targets, const PartSeen& part_seen,
                                                    const radar::Radar& radar, const radar::RangeAzimuthGrid& bins,
                                                    const radar::GroundGrid& grid) const {
  std::vector<radar::Target> seen = simulate::seen_targets(reflectors_, 0.0, part_seen);
  for (const SampleTarget& target : targets) {
    if (!(target.part_seen > 0.0)) continue;
    const TargetClass& kind = spec_.targets[target.planned.target_class];
    seen.push_back(radar::weakened(target_of(target.planned, kind, scene_.terrain), target.part_seen));
  }
  if (seen.empty()) return {};
  radar::RangeAzimuthImage image{bins, radar.position, Array2D<radar::Channels>(bins.azimuths, bins.ranges)};
  receiver::add_echoes(image, radar, receiver::target_echoes(seen, radar, {}));
  return product::ground_map(image, scene_.terrain, grid).sigma0;
}

Sample SampleMaker::make(std::size_t index) const {
  Sample sample;
  sample.plan = plan_of(spec_, centres_, index);
  const SamplePlan& plan = sample.plan;
  const radar::Radar radar = radar_of(spec_, plan, scene_.terrain);
  sample.scene_hash = scene_hash_;
  sample.radar_position = radar.position;
  const Vec3d to_radar = radar.position - middle_of(plan, scene_.terrain);
  sample.slant_range_m = length(to_radar);
  sample.aspect = {wrapped_azimuth(azimuth_of(to_radar)), std::asin(to_radar.z / sample.slant_range_m)};

  std::vector<radar::Layer> bounces;
  const auto image = ground_image(radar, plan, bounces);
  sample.map = product::ground_map(image, scene_.terrain, plan.grid);
  sample.labels = labels(radar, plan.grid);
  sample.map.crs = sample.labels.crs = scene_.frame.proj();

  const PartSeen part_seen = part_seen_from(radar);
  sample.targets = targets_of(plan, radar, sample.map, part_seen);
  sample.noise_sigma0 = noise_under(sample.map, plan);
  draw_speckle(sample.map, steady_sigma0(sample.targets, part_seen, radar, image.grid, plan.grid),
               {.looks = spec_.looks, .noise = static_cast<float>(sample.noise_sigma0), .seed = plan.seed});

  std::ranges::move(bounces, std::back_inserter(sample.labels.layers));
  return sample;
}

}  // namespace sigmascape::dataset
