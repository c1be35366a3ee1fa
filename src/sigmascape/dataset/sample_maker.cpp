#include "sigmascape/dataset/sample_maker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/atlas/stac_description.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/interruption.h"
#include "sigmascape/base/sha256.h"
#include "sigmascape/base/units.h"
#include "sigmascape/dataset/bounce_labels.h"
#include "sigmascape/dataset/sample_radar.h"
#include "sigmascape/dataset/speckle.h"
#include "sigmascape/dataset/target_box.h"
#include "sigmascape/product/ground_projection.h"
#include "sigmascape/radar/range_ambiguity.h"
#include "sigmascape/receiver/target_echoes.h"
#include "sigmascape/scene/obstacle_raster.h"
#include "sigmascape/scene/scene_file.h"
#include "sigmascape/simulate/part_seen.h"
#include "sigmascape/simulate/placement.h"
#include "sigmascape/simulate/simulate.h"
#include "sigmascape/trace/path_tracer.h"

namespace sigmascape::dataset {
namespace {

/// How far above the highest thing the radar must stand.
constexpr double clearance_m = 2.0;
/// By how much the rounding of degrees may lead out of an atlas.
constexpr double slack_rad = 1e-9;

atlas::Store opened_store(const DatasetSpec& spec, const std::filesystem::path& folder, const std::string& key,
                          const std::string& scene_hash) {
  auto store = atlas::Store::open(folder);
  if (store.description().scene_hash != scene_hash) {
    throw Error(fmt::format("{}: dataset.{}", spec.file.string(), key), "was baked from another scene",
                "bake this scene, or name the scene that the atlas was made from");
  }
  return store;
}

/// Throws Error for a store that differs from the atlas in more than the surfaces that a path may meet: what the one
/// holds less the other would be the difference of two bakes then, not of bounces.
void check_same_bake(const atlas::AtlasDescription& fewer, const atlas::AtlasDescription& all,
                     const std::string& where) {
  if (fewer.aspects != all.aspects)
    throw Error(where, "has other looks than the atlas", "bake it with the same azimuths, elevations and frequencies");
  const std::string remedy = "bake it with all options of the atlas but --bounces";
  if (fewer.patches != all.patches)
    throw Error(where,
                fmt::format("has texels of {:g} m, and the atlas of {:g} m, or other patches", fewer.patches.texel_m,
                            all.patches.texel_m),
                remedy);
  const auto word = [](const atlas::AtlasDescription& description, const std::string& key) {
    const auto found = description.settings.find(key);
    return found == description.settings.end() ? std::string("none") : found->second;
  };
  for (const auto& settings : {fewer.settings, all.settings}) {
    for (const auto& [key, value] : settings) {
      if (key == "max_bounces" || word(fewer, key) == word(all, key)) continue;
      throw Error(where,
                  fmt::format("was baked with {} {}, and the atlas with {}", key, word(fewer, key), word(all, key)),
                  remedy);
    }
  }
}

/// The store of echoes over at most so many surfaces.
atlas::Store opened_bounces(const DatasetSpec& spec, std::size_t most, const std::string& scene_hash,
                            const atlas::AtlasDescription& all) {
  auto store = opened_store(spec, spec.bounce_atlases[most - 1], spec.bounce_atlases_key, scene_hash);
  const auto& settings = store.description().settings;
  const auto bounces = settings.find("max_bounces");
  const std::string where =
      fmt::format("{}: {}", spec.file.string(), spec.bounce_atlases[most - 1].filename().string());
  if (bounces == settings.end() || bounces->second != std::to_string(most))
    throw Error(where,
                fmt::format("does not hold the echoes over {} surface{} and no more", most, most == 1 ? "" : "s"),
                fmt::format("bake it with --bounces {}", most));
  check_same_bake(store.description(), all, where);
  return store;
}

/// Throws Error for orders of bounces that bakes with shared noise do not tell. Up to two surfaces they do, for echoes
/// of one are not shared. Of two bakes that share, each by the doubt in its own texels, one less the other is less than
/// nothing in places.
void check_tells_orders(const DatasetSpec& spec, std::size_t bounces, const atlas::AtlasDescription& all) {
  const auto noise = all.settings.find("noise");
  if (bounces <= 2 || noise == all.settings.end() || noise->second != "shared") return;
  throw Error(
      spec.file.string() + ": dataset.layers",
      fmt::format("asks for bounce{}, which bakes with --noise shared do not tell, for each shares its own noise",
                  bounces),
      "bake atlas and bounce_atlases without it, or ask for bounce1, bounce2 and multibounce alone");
}

/// What a store is told apart by: of equal descriptions all texels are equal.
std::string description_hash(const atlas::Store& store) {
  return sha256_of(atlas::described(store.description()).dump());
}

/// Whole, and read as samples come to it.
atlas::Atlas opened_atlas(const atlas::Store& store) {
  atlas::Atlas atlas = atlas::load_atlas(store, {.reading = atlas::Reading::AsAsked});
  atlas.check_whole();
  return atlas;
}

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

double half_diagonal_m(const DatasetSpec& spec) {
  return static_cast<double>(spec.cells) * spec.cell_m / std::sqrt(2.0);
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
    const auto store = opened_store(spec_, *spec_.atlas, "atlas", scene_hash_);
    atlas_ = opened_atlas(store);
    atlas_hashes_.push_back(description_hash(store));
    const std::size_t bounces = spec_.bounce_atlases.size();
    check_tells_orders(spec_, bounces, store.description());
    for (std::size_t most = 1; most <= bounces; ++most) {
      const auto fewer = opened_bounces(spec_, most, scene_hash_, store.description());
      bounce_atlases_.push_back(opened_atlas(fewer));
      atlas_hashes_.push_back(description_hash(fewer));
    }
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

/// Labels of classes are bytes.
void SampleMaker::check_classes() const {
  const std::size_t classes = simulate::class_names(scene_).size();
  if (classes <= 256 || std::ranges::find(spec_.layers, simulate::LayerKind::Class) == spec_.layers.end()) return;
  throw Error(spec_.file.string() + ": dataset.layers",
              fmt::format("asks for class, and the scene has {} classes, where files hold 256", classes),
              "leave it out, or give the scene fewer materials");
}

void SampleMaker::check_radars() const {
  const auto& drawn = spec_.radar_ranges.frequency_hz;
  if (!atlas_) {
    if (drawn) check_materials(*drawn);
    return;
  }
  if (!drawn) return atlas_->check_frequency(spec_.radar.radar.frequency_hz);
  const auto& baked = atlas_->aspects().frequencies_hz;
  constexpr double slack = 1.01;
  if (drawn->lowest * slack < baked.front() || drawn->highest > baked.back() * slack) {
    throw Error(spec_.file.string() + ": radar.frequency_ghz",
                fmt::format("leads outside the atlas, which was baked from {:g} to {:g} GHz", baked.front() / 1e9,
                            baked.back() / 1e9),
                "stay within these, or bake more frequencies");
  }
}

/// What a material is not known for is said at once, not by the first sample that comes to it.
void SampleMaker::check_materials(const Range& frequencies_hz) const {
  try {
    static_cast<void>(trace::surface_models(scene_, std::array{frequencies_hz.lowest, frequencies_hz.highest}));
  } catch (const Error& unknown) {
    throw Error(spec_.file.string() + ": radar.frequency_ghz", "leads to where the scene is not known", unknown.what());
  }
}

void SampleMaker::check_views() const {
  const std::string file = spec_.file.string();
  if (atlas_) {
    const auto& baked = atlas_->aspects().elevations_rad;
    if (spec_.elevation_rad.lowest < baked.front() - slack_rad ||
        spec_.elevation_rad.highest > baked.back() + slack_rad) {
      throw Error(file + ": view.elevation_deg",
                  fmt::format("leads outside the atlas, which was baked from {:.6g} to {:.6g} degrees",
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
  if (spec_.slant_range_m.lowest * std::cos(spec_.elevation_rad.highest) < half_diagonal_m(spec_)) {
    throw Error(file + ": view.slant_range_km", "lets the radar stand over the map", "begin the range further out");
  }
}

/// A gate that is open to some of the maps is warned of where it is shut (dataset_warnings.h).
void SampleMaker::check_gate() const {
  const auto &first_m = spec_.radar.radar.receiver.first_range_m, &last_m = spec_.radar.radar.receiver.last_range_m;
  constexpr double never = std::numeric_limits<double>::infinity();
  const double unambiguous_m = radar::unambiguous_range_m(spec_.radar.radar.waveform.pulse_repetition_hz);
  const double opens_m = first_m.value_or(0.0);
  const double closes_m = std::min(last_m.value_or(never), first_m ? opens_m + unambiguous_m : never);
  const double flown_m =
      spec_.sequence.speed_mps.highest * spec_.sequence.interval_s * static_cast<double>(spec_.sequence.frames - 1);
  const double relief_m = scene_.terrain.highest_m() - scene_.terrain.lowest_m();
  const double about_m = flown_m + std::hypot(half_diagonal_m(spec_), relief_m);
  const double nearest_m = std::max(0.0, spec_.slant_range_m.lowest - about_m);
  const double farthest_m = spec_.slant_range_m.highest + about_m;
  if (opens_m <= farthest_m && closes_m >= nearest_m) return;
  throw Error(spec_.file.string() + ": view.slant_range_km",
              fmt::format("leads to maps from {:.5g} to {:.5g} km away, and the radar file's range gate is open from "
                          "{:.5g} to {:.5g} km",
                          nearest_m / 1e3, farthest_m / 1e3, opens_m / 1e3, closes_m / 1e3),
              "stay where the gate is open, or move it by receiver.first_range_km and last_range_km");
}

void SampleMaker::check_flights() const {
  const std::size_t frames = spec_.sequence.frames;
  if (!flies(spec_.sequence)) return;
  for (std::size_t first = 0; first < spec_.count; first += frames) {
    Interruption::heed();
    const SamplePlan begin = plan_of(spec_, centres_, first);
    // Level flight: the middle of the map is seen steepest from the frame that is nearest to it, flattest from an end.
    check_frame(plan_of(spec_, centres_, first + nearest_frame(spec_, begin, scene_.terrain)));
    check_frame(plan_of(spec_, centres_, first + frames - 1));
  }
}

void SampleMaker::check_frame(const SamplePlan& plan) const {
  const Vec3d to_radar = radar_of(spec_, plan, scene_.terrain).position - middle_of(plan, scene_.terrain);
  const double distance_m = length(Vec2d{to_radar.x, to_radar.y});
  const std::string where = spec_.file.string() + ": sequence.speed_mps";
  if (distance_m < half_diagonal_m(spec_)) {
    throw Error(where,
                fmt::format("takes the radar over the map, in frame {} of sequence {}", plan.frame, plan.sequence),
                "fly less far by fewer frames, a shorter interval or less speed, or begin further out");
  }
  if (!atlas_) return;
  const double elevation_rad = std::atan2(to_radar.z, distance_m);
  const auto& baked = atlas_->aspects().elevations_rad;
  if (elevation_rad >= baked.front() - slack_rad && elevation_rad <= baked.back() + slack_rad) return;
  throw Error(
      where,
      fmt::format("leads outside the atlas, which was baked from {:.2f} to {:.2f} degrees: frame {} of sequence {} "
                  "is seen under {:.2f}",
                  deg_from_radians(baked.front()), deg_from_radians(baked.back()), plan.frame, plan.sequence,
                  deg_from_radians(elevation_rad)),
      "fly less far, keep view.elevation_deg from the ends of the atlas, or bake more elevations");
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
  sample.aspect = {wrapped_azimuth(std::atan2(to_radar.x, to_radar.y)), std::asin(to_radar.z / sample.slant_range_m)};

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
