#include "sigmascape/bake/ground_baker.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sigmascape/atlas/catalogs.h"
#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/atlas/obstacle_file.h"
#include "sigmascape/atlas/pyramid.h"
#include "sigmascape/atlas/texture_name.h"
#include "sigmascape/bake/claims.h"
#include "sigmascape/bake/job.h"
#include "sigmascape/base/units.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/scatter/surface_sigma0.h"
#include "sigmascape/scene/obstacle_raster.h"
#include "sigmascape/trace/path_tracer.h"

namespace sigmascape::bake {
namespace {

/// Elevations of the ground's σ0. Between them γ is blended, of which that of natural ground hardly changes; what is
/// smooth and answers at steep incidence alone is met on slopes.
std::vector<double> ground_elevations_rad() {
  std::vector<double> elevations;
  for (const double degrees : {2.0, 5.0, 10.0, 20.0, 30.0, 45.0, 60.0, 75.0, 88.0}) {
    elevations.push_back(radians_from_deg(degrees));
  }
  return elevations;
}

/// σ0 of every material, lying level.
std::vector<radar::Channels> sigma0_of(const scene::Scene& scene, const atlas::AtlasDescription& description,
                                       atlas::LookIndex index) {
  const radar::Look look = description.aspects.look(index);
  std::vector<radar::Channels> sigma0;
  for (const scatter::SurfaceModel& surface : trace::surface_models(scene, look.frequency_hz))
    sigma0.push_back(scatter::surface_sigma0(surface, look.aspect.elevation_rad));
  return sigma0;
}

/// What part of each texel is made of each material: [texel][material].
std::vector<std::vector<float>> shares_of(const scene::MaterialMap& ground, std::size_t materials,
                                          const radar::GroundGrid& texels) {
  // A point a material cell, but no more than tell a share to a few percent.
  const auto points = static_cast<std::size_t>(std::clamp(std::ceil(texels.cell_m / ground.grid.cell_m), 1.0, 8.0));
  const double spacing_m = texels.cell_m / static_cast<double>(points);
  const float share = 1.0F / static_cast<float>(points * points);
  std::vector<std::vector<float>> shares(texels.columns * texels.rows, std::vector<float>(materials, 0.0F));
  for (std::size_t j = 0; j < texels.rows * points; ++j) {
    for (std::size_t i = 0; i < texels.columns * points; ++i) {
      const Vec2d point{texels.west_m + (static_cast<double>(i) + 0.5) * spacing_m,
                        texels.north_m - (static_cast<double>(j) + 0.5) * spacing_m};
      shares[j / points * texels.columns + i / points][ground.at(point)] += share;
    }
  }
  return shares;
}

Array2D<radar::Channels> mixed(const std::vector<std::vector<float>>& shares,
                               const std::vector<radar::Channels>& sigma0, const radar::GroundGrid& texels) {
  Array2D<radar::Channels> mixture(texels.columns, texels.rows);
  for (std::size_t texel = 0; texel < mixture.size(); ++texel) {
    for (std::size_t material = 0; material < sigma0.size(); ++material) {
      if (shares[texel][material] > 0.0F) mixture.values()[texel] += sigma0[material] * shares[texel][material];
    }
  }
  return mixture;
}

/// What killed processes left of a patch's ground and obstacles. Another may be writing a catalog there.
void remove_leftovers(const atlas::Store& store, const atlas::Store& ground, const atlas::PatchIndex& patch) {
  const std::string name = atlas::patch_name(patch);
  geo::remove_leftovers(store.folder() / name, "obstacles");
  geo::remove_leftovers(ground.folder() / name, "az");
}

}  // namespace

void bake_ground(const scene::Scene& scene, const atlas::Store& store, const Shard& shard, atlas::Scrutiny scrutiny) {
  const atlas::Store ground = atlas::create_ground_store(store, ground_elevations_rad());
  const atlas::AtlasDescription& description = ground.description();
  const auto looks = static_cast<atlas::LookIndex>(description.aspects.look_count());
  std::vector<std::vector<radar::Channels>> sigma0(looks);  // [look][material], of looks that something lacks

  const Claims claims(store.folder());
  const std::size_t first_claim = JobList(store.description()).size();
  std::vector<atlas::PatchIndex> patches_of_share;
  const atlas::PatchBlock patches = description.patches.block_over(description.extent);
  for (std::size_t number = 0; number < patches.size(); ++number) {
    if (!shard.has(number)) continue;
    const atlas::PatchIndex patch = patches[number];
    patches_of_share.push_back(patch);
    const auto claim = claims.take(first_claim + number, Claims::Wait::UntilFree);
    if (claim && claim->is_exclusive()) remove_leftovers(store, ground, patch);
    const radar::GroundGrid texels = description.patches.texels_of(patch);
    if (atlas::obstacles_fault(store, patch, scrutiny)) {
      atlas::write_obstacles(store, patch, scene::obstacles_of(scene, texels));
    }
    std::vector<std::vector<float>> shares;
    for (atlas::LookIndex index = 0; index < looks; ++index) {
      if (ground.is_done(patch, index, scrutiny)) continue;
      if (sigma0[index].empty()) sigma0[index] = sigma0_of(scene, description, index);
      if (shares.empty()) shares = shares_of(scene.ground, scene.materials.size(), texels);
      ground.write(patch, index, mixed(shares, sigma0[index], texels),
                   {.seed = 0, .samples_per_texel = 0, .relative_standard_error = 0.0, .simd = "none", .counts = {}});
    }
  }
  const atlas::Pyramid pyramid(ground);
  for (atlas::LookIndex index = 0; index < looks; ++index) pyramid.make_above(patches_of_share, index, scrutiny);
  atlas::obstacle_pyramid(store).make_above(patches_of_share, scrutiny);
  atlas::mend_catalogs(ground, scrutiny, [&shard](std::size_t number) { return shard.has(number); });
}

}  // namespace sigmascape::bake
