#include "sigmascape/bake/ground_baker.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <span>
#include <utility>
#include <vector>

#include "sigmascape/atlas/catalogs.h"
#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/atlas/obstacle_file.h"
#include "sigmascape/atlas/pyramid.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/atlas/texture_name.h"
#include "sigmascape/bake/claims.h"
#include "sigmascape/bake/ground_elevations.h"
#include "sigmascape/bake/job.h"
#include "sigmascape/bake/job_share.h"
#include "sigmascape/base/units.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/scatter/surface_sigma0.h"
#include "sigmascape/scene/obstacle_raster.h"

namespace sigmascape::bake {
namespace {

/// σ0 of each of the materials, lying level.
std::vector<radar::Channels> sigma0_of(const scene::Scene& scene, const std::vector<scene::MaterialIndex>& materials,
                                       const radar::Look& look) {
  std::vector<radar::Channels> sigma0;
  for (const scene::MaterialIndex material : materials) {
    const scatter::SurfaceModel surface(scene.materials[material], look.frequency_hz);
    sigma0.push_back(scatter::surface_sigma0(surface, look.aspect.elevation_rad));
  }
  return sigma0;
}

/// What part of each texel is made of each of the materials that lie on the ground: [texel, material].
std::vector<float> shares_of(const scene::MaterialMap& ground, const std::vector<scene::MaterialIndex>& materials,
                             const radar::GroundGrid& texels) {
  std::vector<std::size_t> place(std::size_t{materials.back()} + 1);  // of a material among them
  for (std::size_t i = 0; i < materials.size(); ++i) place[materials[i]] = i;
  // A point a material cell, but no more than tell a share to a few percent.
  const auto points = static_cast<std::size_t>(std::clamp(std::ceil(texels.cell_m / ground.grid.cell_m), 1.0, 8.0));
  const double spacing_m = texels.cell_m / static_cast<double>(points);
  const float share = 1.0F / static_cast<float>(points * points);
  std::vector<float> shares(texels.columns * texels.rows * materials.size(), 0.0F);
  for (std::size_t j = 0; j < texels.rows * points; ++j) {
    for (std::size_t i = 0; i < texels.columns * points; ++i) {
      const Vec2d point{texels.west_m + (static_cast<double>(i) + 0.5) * spacing_m,
                        texels.north_m - (static_cast<double>(j) + 0.5) * spacing_m};
      shares[(j / points * texels.columns + i / points) * materials.size() + place[ground.at(point)]] += share;
    }
  }
  return shares;
}

Array2D<radar::Channels> mixed(std::span<const float> shares, const std::vector<radar::Channels>& sigma0,
                               const radar::GroundGrid& texels) {
  Array2D<radar::Channels> mixture(texels.columns, texels.rows);
  for (std::size_t texel = 0; texel < mixture.size(); ++texel) {
    for (std::size_t material = 0; material < sigma0.size(); ++material) {
      const float share = shares[texel * sigma0.size() + material];
      if (share > 0.0F) mixture.values()[texel] += sigma0[material] * share;
    }
  }
  return mixture;
}

/// What killed processes left of a patch's ground and obstacles.
void remove_leftovers(const atlas::Store& store, const atlas::Store& ground, const atlas::PatchIndex& patch) {
  const std::string name = atlas::patch_name(patch);
  geo::remove_leftovers(store.folder() / name, "obstacles");
  geo::remove_leftovers(ground.folder() / name, "az");
}

/// One process's way through the patches of its share.
class GroundRun {
 public:
  GroundRun(const scene::Scene& scene, const atlas::Store& store, const Shard& shard, atlas::Scrutiny scrutiny,
            ProgressListener& progress)
      : scene_(scene),
        store_(store),
        shard_(shard),
        scrutiny_(scrutiny),
        progress_(progress),
        materials_(scene.ground.materials_laid()),
        ground_(atlas::create_ground_store(store, ground_elevations_rad(scene, store.description().aspects), &mended_)),
        looks_(static_cast<atlas::LookIndex>(ground_.description().aspects.look_count())),
        sigma0_(looks_) {}

  std::vector<atlas::StoreFault> mended() {
    mend_catalogs();
    bake_patches();
    make_levels_above();
    mend_catalogs();
    return std::move(mended_);
  }

 private:
  void bake_patches() {
    const Claims claims(store_.folder());
    const JobList jobs(store_.description());
    const std::size_t first_claim = jobs.size();
    const atlas::PatchBlock& patches = jobs.patches();
    const JobShare share(jobs, shard_);
    std::vector<std::size_t> numbers;
    for (std::size_t number = 0; number < patches.size(); ++number) {
      if (share.has_patch(number)) numbers.push_back(number);
    }
    const auto tell = [&] {
      progress_.advanced("ground", static_cast<double>(patches_.size()), static_cast<double>(numbers.size()),
                         "patches");
    };
    tell();
    const auto bake_number = [&](std::size_t number) {
      remove_leftovers(store_, ground_, patches[number]);
      bake_patch(patches[number]);
      patches_.push_back(patches[number]);
      tell();
    };
    // Several processes that are not told apart by shards go on side by side; what another is at comes last.
    std::vector<std::size_t> held_by_others;
    for (const std::size_t number : numbers) {
      const auto claim = claims.take_if_free(first_claim + number);
      if (claim) bake_number(number);
      if (!claim) held_by_others.push_back(number);
    }
    for (const std::size_t number : held_by_others) {
      const Claims::Claim claim = claims.take(first_claim + number, [&] {
        progress_.waiting(
            "ground", fmt::format("another process that is at the ground of {}", atlas::patch_name(patches[number])));
      });
      bake_number(number);
    }
  }

  void bake_patch(const atlas::PatchIndex& patch) {
    const atlas::AtlasDescription& description = ground_.description();
    const radar::GroundGrid texels = description.patches.texels_of(patch);
    if (auto fault = atlas::obstacles_fault(store_, patch, scrutiny_)) {
      atlas::write_obstacles(store_, patch, scene::obstacles_of(scene_, texels));
      note(std::move(*fault), "");
    }
    std::vector<float> shares;
    for (atlas::LookIndex index = 0; index < looks_; ++index) {
      auto fault = atlas::texture_fault(ground_, ground_.texture_path(patch, index), scrutiny_);
      if (!fault) continue;
      if (sigma0_[index].empty()) sigma0_[index] = sigma0_of(scene_, materials_, description.aspects.look(index));
      if (shares.empty()) shares = shares_of(scene_.ground, materials_, texels);
      ground_.write(patch, index, mixed(shares, sigma0_[index], texels),
                    {.seed = 0, .samples_per_texel = 0, .simd = "none", .counts = {}});
      note(std::move(*fault), folder());
    }
  }

  void make_levels_above() {
    const atlas::Pyramid pyramid(ground_);
    if (pyramid.levels() == 0) return;
    const auto tell = [&](std::size_t done) {
      progress_.advanced("pyramid", static_cast<double>(done), static_cast<double>(looks_) + 1.0, "layers");
    };
    tell(0);
    atlas::MakingNotes of_ground, of_obstacles;
    for (atlas::LookIndex index = 0; index < looks_; ++index) {
      pyramid.make_above(patches_, index, scrutiny_, &of_ground);
      tell(index + std::size_t{1});
    }
    atlas::obstacle_pyramid(store_).make_above(patches_, scrutiny_, &of_obstacles);
    for (atlas::StoreFault& fault : of_ground.mended) note(std::move(fault), folder());
    for (atlas::StoreFault& fault : of_obstacles.mended) note(std::move(fault), "");
    tell(looks_ + std::size_t{1});
  }

  void mend_catalogs() {
    for (atlas::StoreFault& fault :
         atlas::mend_catalogs(ground_, scrutiny_, [this](std::size_t number) { return shard_.has(number); })) {
      note(std::move(fault), folder());
    }
  }

  [[nodiscard]] std::filesystem::path folder() const { return ground_.folder().filename(); }

  void note(atlas::StoreFault fault, const std::filesystem::path& folder) {
    if (fault.is_absent) return;
    fault.file = folder / fault.file;
    mended_.push_back(std::move(fault));
  }

  const scene::Scene& scene_;
  const atlas::Store& store_;
  const Shard& shard_;
  atlas::Scrutiny scrutiny_;
  ProgressListener& progress_;
  std::vector<atlas::StoreFault> mended_;
  std::vector<scene::MaterialIndex> materials_;  // that lie on the ground
  atlas::Store ground_;
  atlas::LookIndex looks_;
  std::vector<std::vector<radar::Channels>> sigma0_;  // [look][material], of looks that something lacks
  std::vector<atlas::PatchIndex> patches_;            // of the share, done
};

}  // namespace

std::vector<atlas::StoreFault> bake_ground(const scene::Scene& scene, const atlas::Store& store, const Shard& shard,
                                           atlas::Scrutiny scrutiny, ProgressListener* progress) {
  SilentProgress silent;
  return GroundRun(scene, store, shard, scrutiny, progress != nullptr ? *progress : silent).mended();
}

}  // namespace sigmascape::bake
