#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "scratch_folder.h"

#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/atlas/obstacle_file.h"
#include "sigmascape/atlas/pyramid.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/base/units.h"
#include "sigmascape/live/live_renderer.h"
#include "sigmascape/radar/look.h"

namespace sigmascape::live {

/// A baked square of so many patches a side, north-east of the origin or about it; each texel is what `sigma0` says of
/// its look, the height of the ground what `height_m` says of the way from the middle.
struct ExampleGround {
  double texel_m = 4.0;
  int patches_a_side = 2;
  std::size_t texels_a_patch = atlas::tile_side;  ///< a side
  /// Of the scene, where it ends before its patches do; what `sigma0` says goes on to their edges.
  std::optional<radar::Rectangle> extent = {};
  bool about_origin = false;  ///< where four tiles of any level meet
  int azimuths = 4;
  std::vector<double> elevations_deg = {5.0, 13.0, 37.0};
  std::function<radar::Channels(const radar::Look&)> sigma0;
  /// Factor of a texel by its look and the way from the middle to its centre.
  std::function<float(const radar::Look&, Vec2d)> pattern = [](const radar::Look&, Vec2d) { return 1.0F; };
  std::vector<double> frequencies_hz = {10e9};  ///< that are baked
  std::function<double(Vec2d)> height_m = [](Vec2d) { return 0.0; };
  double terrain_spacing_m = 8.0;
  CacheOptions cache = {};
  std::string scene_hash = "none";  ///< of which the atlas says that it was made
  /// Set: the atlas keeps the ground apart; its textures hold objects alone, `bare_sigma0` is the ground's own σ0 and
  /// what stands on it is what `obstacle` says of the way from the middle.
  std::function<radar::Channels(const radar::Look&)> bare_sigma0 = nullptr;
  std::vector<double> ground_elevations_deg = {2.0, 5.0, 10.0, 20.0, 45.0, 88.0};
  std::function<radar::Obstacle(Vec2d)> obstacle = [](Vec2d) { return radar::Obstacle{}; };

  [[nodiscard]] double side_m() const { return static_cast<double>(texels_a_patch) * texel_m * patches_a_side; }
  [[nodiscard]] Vec2d south_west() const { return about_origin ? Vec2d{-side_m() / 2.0, -side_m() / 2.0} : Vec2d{}; }
  [[nodiscard]] Vec2d middle() const { return south_west() + Vec2d{side_m() / 2.0, side_m() / 2.0}; }

  [[nodiscard]] atlas::Store store(const std::filesystem::path& folder) const {
    atlas::AtlasDescription description;
    description.name = "example";
    const Vec2d corner = south_west();
    description.extent =
        extent.value_or(radar::Rectangle{corner.x, corner.y, corner.x + side_m(), corner.y + side_m()});
    description.patches = {texel_m, texels_a_patch};
    description.scene_hash = scene_hash;
    for (int azimuth = 0; azimuth < azimuths; ++azimuth) {
      description.aspects.azimuths_rad.push_back(radians_from_deg(azimuth * 360.0 / azimuths));
    }
    for (const double elevation : elevations_deg) {
      description.aspects.elevations_rad.push_back(radians_from_deg(elevation));
    }
    description.aspects.frequencies_hz = frequencies_hz;
    if (bare_sigma0) description.settings[atlas::shadows_setting] = atlas::shadows_at_run_time;
    atlas::Store store = atlas::Store::create(folder, description);
    write_patterned(store);
    if (bare_sigma0) write_ground(store);
    return store;
  }

  void write_patterned(const atlas::Store& store) const {
    for (const atlas::Unit& unit : store.units()) {
      const radar::GroundGrid grid = store.description().patches.texels_of(unit.patch);
      const radar::Look look = store.description().aspects.look(unit.look);
      const radar::Channels even = sigma0(look);
      Array2D<radar::Channels> texels(grid.columns, grid.rows);
      for (std::size_t row = 0; row < grid.rows; ++row) {
        for (std::size_t column = 0; column < grid.columns; ++column) {
          texels(column, row) = even * pattern(look, grid.centre_of(column, row) - middle());
        }
      }
      store.write(unit.patch, unit.look, texels, {});
    }
  }

  static void write(const atlas::Store& store, const std::function<radar::Channels(const radar::Look&)>& sigma0) {
    for (const atlas::Unit& unit : store.units()) {
      const radar::GroundGrid grid = store.description().patches.texels_of(unit.patch);
      Array2D<radar::Channels> texels(grid.columns, grid.rows);
      std::ranges::fill(texels.values(), sigma0(store.description().aspects.look(unit.look)));
      store.write(unit.patch, unit.look, texels, {});
    }
  }

  void write_ground(const atlas::Store& store) const {
    std::vector<double> elevations;
    for (const double degrees : ground_elevations_deg) elevations.push_back(radians_from_deg(degrees));
    const atlas::Store ground = atlas::create_ground_store(store, elevations);
    write(ground, bare_sigma0);
    atlas::Pyramid(ground).make_above(ground.units());
    write_obstacles(store);
  }

  /// At all levels.
  void write_obstacles(const atlas::Store& store) const {
    const auto patches = store.description().patches.covering(store.description().extent);
    for (const atlas::PatchIndex& patch : patches) {
      radar::ObstacleMap map{store.description().patches.texels_of(patch), {}};
      map.obstacles = Array2D<radar::Obstacle>(map.grid.columns, map.grid.rows);
      for (std::size_t row = 0; row < map.grid.rows; ++row) {
        for (std::size_t column = 0; column < map.grid.columns; ++column) {
          map.obstacles(column, row) = obstacle(map.grid.centre_of(column, row) - middle());
        }
      }
      atlas::write_obstacles(store, patch, map);
    }
    atlas::obstacle_pyramid(store).make_above(patches);
  }

  [[nodiscard]] terrain::HeightField terrain() const {
    constexpr double margin_m = 100.0;
    terrain::HeightField field;
    field.west_m = south_west().x - margin_m;
    field.north_m = south_west().y + side_m() + margin_m;
    field.spacing_m = terrain_spacing_m;
    const auto nodes = static_cast<std::size_t>((side_m() + 2.0 * margin_m) / terrain_spacing_m) + 1;
    field.height_m = Array2D<float>(nodes, nodes);
    for (std::size_t row = 0; row < nodes; ++row) {
      for (std::size_t column = 0; column < nodes; ++column) {
        const Vec2d node{field.west_m + static_cast<double>(column) * terrain_spacing_m,
                         field.north_m - static_cast<double>(row) * terrain_spacing_m};
        field.height_m(column, row) = static_cast<float>(height_m(node - middle()));
      }
    }
    return field;
  }

  [[nodiscard]] std::shared_ptr<LiveGround> over(const atlas::Store& store, double frequency_hz = 10e9) const {
    return std::make_shared<LiveGround>(store, terrain(), frequency_hz, cache);
  }
};

/// A frame after all pages that it wants are there.
inline const Frame& settled_frame(LiveRenderer& renderer, LiveGround& ground, const Pose& pose) {
  renderer.render(pose);
  ground.wait_until_loaded();
  renderer.render(pose);
  ground.wait_until_loaded();
  return renderer.render(pose);
}

/// VV of all bins of a range together, but of so many beams at either side.
inline double vv_of_range(const Frame& frame, std::size_t range, std::size_t left_out = 2) {
  double sum = 0.0;
  for (std::size_t beam = left_out; beam + left_out < frame.grid.azimuths; ++beam)
    sum += static_cast<double>(frame.powers_m2[(beam * frame.grid.ranges + range) * 4]);
  return sum;
}

/// γ sin ψ in VV, a half of it in HH, a tenth in HV, VV and HH correlated by 0.6.
inline radar::Channels constant_gamma(double gamma, const radar::Look& look) {
  const auto vv = static_cast<float>(gamma * std::sin(look.aspect.elevation_rad));
  return {vv, 0.5F * vv, 0.1F * vv, 0.6F * std::sqrt(0.5F) * vv};
}

/// Where it matters only that ground returns something.
inline constexpr double example_gamma = 0.1;

/// Level and of example_gamma everywhere.
inline ExampleGround even_example() {
  ExampleGround ground;
  ground.sigma0 = [](const radar::Look& look) { return constant_gamma(example_gamma, look); };
  return ground;
}

/// A radar that sees a place from an azimuth and elevation, its bins about it.
struct ExampleView {
  Vec2d target = ExampleGround{}.middle();
  double azimuth_deg = 30.0, elevation_deg = 13.0, slant_range_m = 4000.0;
  std::size_t beams = 48, ranges = 64;
  double bin_m = 12.0;  ///< along and, at the origin, across

  [[nodiscard]] LiveSettings settings(FrameContent content, unsigned threads = 2) const {
    LiveSettings settings;
    settings.content = content;
    settings.beams = beams;
    settings.ranges = ranges;
    settings.range_step_m = bin_m * std::cos(radians_from_deg(elevation_deg));
    settings.beam_step_rad = bin_m / (slant_range_m * std::cos(radians_from_deg(elevation_deg)));
    settings.threads = threads;
    settings.refraction = 1e9;
    return settings;
  }
  [[nodiscard]] Pose pose() const {
    const LiveSettings bins = settings(FrameContent::Powers);
    const double azimuth = radians_from_deg(azimuth_deg), elevation = radians_from_deg(elevation_deg);
    const radar::Aspect aspect{azimuth, elevation};
    Pose pose;
    pose.position = Vec3d{target.x, target.y, 0.0} + radar::direction_to_radar(aspect) * slant_range_m;
    pose.first_azimuth_rad = azimuth + pi - bins.beam_step_rad * static_cast<double>(beams) / 2.0;
    pose.first_range_m = slant_range_m - bins.range_step_m * static_cast<double>(ranges) / 2.0;
    return pose;
  }
};

}  // namespace sigmascape::live
