#include "sigmascape/bake/look_baker.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <utility>

#include "sigmascape/bake/echo_landing.h"
#include "sigmascape/bake/noise_sharing.h"
#include "sigmascape/bake/terrain_horizon.h"
#include "sigmascape/bake/tile_sampler.h"
#include "sigmascape/base/error.h"
#include "sigmascape/base/parallel.h"
#include "sigmascape/base/units.h"
#include "sigmascape/radar/rectangle_parts.h"
#include "sigmascape/scene/obstacle_raster.h"
#include "sigmascape/terrain/obstacle_sweep.h"
#include "sigmascape/trace/late_by.h"
#include "sigmascape/trace/tile_progress.h"

namespace sigmascape::bake {
namespace {

/// What a texel is multiplied by of which terrain leaves that part to be seen. Of little seen the shadow is not taken
/// out whole: what few paths bring of the rest would be multiplied with all its noise.
double gain_of(double part_seen) {
  constexpr double least = 0.2;
  return part_seen > 0.0 ? 1.0 / std::max(part_seen, least) : 1.0;
}

/// Ground without relief is the level plane, which rays meet in closed form.
trace::Footing footing_of(const scene::Scene& scene, const BakeSettings& settings) {
  const bool is_level = scene.terrain.lowest_m() == scene.terrain.highest_m();
  return is_level ? trace::Footing::LevelPlane : footing_of(settings);
}

/// 1 for texels that anything comes back from, at any frequency, 0 for others.
Array2D<std::uint8_t> answering_texels(const radar::GroundGrid& texels, const std::vector<PatchSums>& sums) {
  Array2D<std::uint8_t> answering(texels.columns, texels.rows);
  const auto note = [&](const receiver::GroundAccumulator& some) {
    const Array2D<radar::Channels> power = some.sigma0();
    for (std::size_t i = 0; i < power.size(); ++i) {
      if (power.values()[i] != radar::Channels{}) answering.values()[i] = 1;
    }
  };
  for (const PatchSums& of_frequency : sums) {
    note(of_frequency.all);
    if (of_frequency.buildings) note(*of_frequency.buildings);
  }
  return answering;
}

/// With the terrain's shadow taken out.
NoisyTexels texels_of(const receiver::GroundAccumulator& sums, const Array2D<float>& gains) {
  NoisyTexels texels{sums.sigma0(), sums.sigma0_variances()};
  for (std::size_t i = 0; i < gains.size(); ++i) {
    const float gain = gains.values()[i];
    texels.power.values()[i] = texels.power.values()[i] * gain;
    texels.variance.values()[i] *= static_cast<double>(gain) * static_cast<double>(gain);
  }
  return texels;
}

/// Of all power, that of several surfaces as its texels share it.
void put_shared(const NoisyTexels& several, unsigned threads, NoisyTexels& all) {
  const NoisyTexels shared = with_noise_shared(several, threads);
  for (std::size_t i = 0; i < all.power.size(); ++i) {
    const radar::Channels& before = several.power.values()[i];
    const radar::Channels& after = shared.power.values()[i];
    if (after == before) continue;
    all.power.values()[i] += after + before * -1.0F;
    double& variance = all.variance.values()[i];
    const double shared_variance = shared.variance.values()[i];
    // What first surfaces add to it, which where they vary against it might be less than nothing.
    variance = shared_variance + std::max(variance - several.variance.values()[i], 0.0);
  }
}

/// With errors as parts of the power.
BakedTexels baked(NoisyTexels texels) {
  Array2D<float> errors(texels.power.columns(), texels.power.rows());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double power = static_cast<double>(texels.power.values()[i].power(radar::Polarization::Sum));
    if (power > 0.0) errors.values()[i] = static_cast<float>(std::sqrt(texels.variance.values()[i]) / power);
  }
  return {std::move(texels.power), std::move(errors)};
}

bool is_too_bright(const PatchSums& sums) {
  return sums.all.bins().overflows() > 0 || (sums.buildings && sums.buildings->bins().overflows() > 0);
}

}  // namespace

LookBaker::LookBaker(const scene::Scene& scene, const BakeSettings& settings)
    : scene_(scene),
      settings_(settings),
      footing_(footing_of(scene, settings)),
      heights_(trace::heights_of(scene, footing_)),
      lowest_ground_m_(static_cast<double>(scene.terrain.lowest_m())),
      occupied_(scene::occupied_extent(scene)),
      tallest_m_(scene::tallest_object_m(scene)),
      surfaces_(trace::surface_models(scene, settings.aspects.frequencies_hz)) {
  if (footing_ == trace::Footing::Terrain) highest_ground_.emplace(scene.terrain);
}

trace::SceneGeometry& LookBaker::geometry_about(const radar::GroundGrid& texels) const {
  trace::Surroundings around = surroundings_of(texels);
  // Of what lies close together all patches need everything.
  if (common_part(occupied_, radar::widened(around.place, around.near_m)) == occupied_)
    around = trace::Surroundings::everything();
  if (!local_ || local_->around != around) {
    local_.reset();  // before the next takes memory
    local_.emplace(Local{around, trace::SceneGeometry(scene_, footing_, around, heights_)});
    geometry_bytes_ = std::max(geometry_bytes_, local_->geometry.memory_bytes());
  }
  return local_->geometry;
}

trace::Surroundings LookBaker::surroundings_of(const radar::GroundGrid& texels) const {
  const auto [lowest_rad, highest_rad] = std::ranges::minmax(settings_.aspects.elevations_rad);
  const radar::Rectangle target = radar::common_part(texels.extent(), scene_.extent);
  double late_m = 0.0;
  for (const double elevation_rad : {lowest_rad, highest_rad})
    late_m = std::max(late_m, trace::late_by_m(tallest_m_, trace::Viewpoint::distant({0.0, elevation_rad}), target));
  // Paths begin at what lies over to where they may begin, and cells are launched by whole tiles.
  const double layover_m = (heights_.highest_m - heights_.lowest_m) * std::tan(highest_rad);
  const double tile_m = settings_.patches.texel_m * trace::tile_side_cells;
  const double about_m = trace::farthest_beginning_m(late_m) + layover_m + 2.0 * std::max(tile_m, 32.0);
  return {.place = radar::widened(target, about_m),
          .near_m = trace::farthest_bounce_m,
          .least_slope = std::tan(lowest_rad),
          .lowest_m = heights_.lowest_m};
}

Array2D<float> LookBaker::terrain_gains(const radar::GroundGrid& texels, const std::vector<PatchSums>& sums,
                                        const radar::Aspect& aspect) const {
  const TerrainHorizon horizon(aspect, scene_.terrain, *highest_ground_,
                               std::min(texels.cell_m, scene_.terrain.spacing_m));
  if (!tops_ || tops_->grid != texels) tops_ = tops_of(texels);
  const Array2D<std::uint8_t> answering = answering_texels(texels, sums);
  Array2D<float> gains(texels.columns, texels.rows, 1.0F);
  parallel_for(texels.rows, thread_count(settings_.threads), [&](std::size_t row, unsigned) {
    for (std::size_t column = 0; column < texels.columns; ++column) {
      if (answering(column, row) == 0) continue;
      const Vec2d place = texels.centre_of(column, row);
      const auto top_m = static_cast<double>(tops_->top_m(column, row));
      gains(column, row) = static_cast<float>(gain_of(terrain::part_above(horizon.hidden_m(place, top_m), top_m)));
    }
  });
  return gains;
}

radar::AnsweringTops LookBaker::tops_of(const radar::GroundGrid& texels) const {
  const std::size_t margin = radar::layover_squares(tallest_m_, texels.cell_m);
  const double margin_m = static_cast<double>(margin) * texels.cell_m;
  const radar::GroundGrid about{texels.west_m - margin_m, texels.north_m + margin_m, texels.cell_m,
                                texels.columns + 2 * margin, texels.rows + 2 * margin};
  const radar::AnsweringTops all = radar::answering_tops(scene::obstacles_of(scene_, about), radar::FromAfar::Unhidden);
  radar::AnsweringTops within{texels, Array2D<float>(texels.columns, texels.rows)};
  for (std::size_t row = 0; row < texels.rows; ++row)
    std::ranges::copy(all.top_m.row(row + margin).subspan(margin, texels.columns), within.top_m.row(row).begin());
  return within;
}

trace::LaunchArea LookBaker::area_of(const radar::GroundGrid& texels, const radar::Aspect& aspect) const {
  // The scene ends where its extent does; beyond a rim about it texels stay black.
  const auto viewpoint = trace::Viewpoint::distant(aspect);
  const radar::Rectangle target = radar::common_part(texels.extent(), scene_.extent);
  auto area =
      trace::launch_area(viewpoint, target, settings_.patches.texel_m, heights_.lowest_m, heights_.highest_m + 1.0,
                         trace::multibounce_reach(tallest_m_, occupied_, viewpoint, target), trace::tile_side_cells);
  trace::spare_rays(area, scene_, footing_);
  return area;
}

std::vector<BakedLook> LookBaker::bake(atlas::PatchIndex patch, const radar::Aspect& aspect,
                                       ProgressListener& progress) const {
  const radar::GroundGrid texels = settings_.patches.texels_of(patch);
  return bake(texels, area_of(texels, aspect), aspect, progress);
}

std::vector<BakedLook> LookBaker::bake(const radar::GroundGrid& texels, const trace::LaunchArea& area,
                                       const radar::Aspect& aspect, ProgressListener& progress) const {
  const auto viewpoint = trace::Viewpoint::distant(aspect);
  const trace::PathTracer tracer(geometry_about(texels), surfaces_, viewpoint, {.max_bounces = settings_.max_bounces},
                                 settings_.seed);

  std::vector<PatchSums> sums;
  for (std::size_t f = 0; f < surfaces_.size(); ++f) {
    PatchSums& of_frequency = sums.emplace_back(PatchSums{receiver::GroundAccumulator(texels)});
    if (settings_.noise == Noise::Shared) of_frequency.several.emplace(texels);
    if (settings_.buildings != Buildings::Baked) of_frequency.buildings.emplace(texels);
  }
  const unsigned workers = thread_count(settings_.threads);
  const bool has_relief = footing_ == trace::Footing::Terrain;
  const EchoLanding landing = has_relief
                                  ? EchoLanding(aspect, scene_.terrain, lowest_ground_m_, highest_ground_->highest_m())
                                  : EchoLanding(aspect);
  std::vector<TileSampler> samplers(workers, TileSampler(settings_, landing, sums));
  trace::TileProgress tiles(progress, "bake", "look", 0.0, 1.0, 1.0, area.tiles());
  const auto counts = tracer.trace_tiles(area, workers, [&](trace::TilePaths& tile, unsigned worker) {
    samplers[worker].sample(tile, texels.cell_area_m2());
    tiles.tile_done(worker);
  });

  double samples = 0.0;
  for (const TileSampler& sampler : samplers) samples += sampler.samples_of_whole_cells();
  std::vector<BakedLook> looks;
  const Array2D<float> gains = has_relief ? terrain_gains(texels, sums, aspect) : Array2D<float>();
  for (const PatchSums& of_frequency : sums) {
    if (is_too_bright(of_frequency)) {
      throw Error(fmt::format("bake of the patch at ({:.0f}, {:.0f}) m, azimuth {:.1f}°, elevation {:.1f}°",
                              texels.extent().west_m, texels.extent().south_m, deg_from_radians(aspect.azimuth_rad),
                              deg_from_radians(aspect.elevation_rad)),
                  "a texel is brighter than the sums can hold", "use a smaller texel or a rougher material");
    }
    NoisyTexels all = texels_of(of_frequency.all, gains);
    if (of_frequency.several) put_shared(texels_of(*of_frequency.several, gains), settings_.threads, all);
    BakedLook& look = looks.emplace_back(BakedLook{baked(std::move(all))});
    if (of_frequency.buildings) look.buildings = baked(texels_of(*of_frequency.buildings, gains));
    look.samples_per_texel = area.cells.empty() ? 0.0 : samples / area.whole_cells();
  }
  looks.front().counts = counts;
  return looks;
}

}  // namespace sigmascape::bake
