#include "sigmascape/bake/plan.h"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "sigmascape/atlas/building_textures.h"
#include "sigmascape/atlas/error_texture.h"
#include "sigmascape/atlas/half_texture.h"
#include "sigmascape/atlas/pyramid.h"
#include "sigmascape/atlas/pyramid_tiles.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/bake/bake.h"
#include "sigmascape/bake/job.h"
#include "sigmascape/bake/job_share.h"
#include "sigmascape/bake/look_baker.h"
#include "sigmascape/bake/part_progress.h"
#include "sigmascape/bake/patch_room.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/base/parallel.h"

namespace sigmascape::bake {
namespace {

/// Of one frequency, compressed, a texel: of all levels of patches σ0, of the finest its standard errors, and σ0 above
/// patches, where nothing is left out for its noise.
struct TexelBytes {
  double sigma0 = 0.0, errors = 0.0, above = 0.0;

  TexelBytes& operator+=(const TexelBytes& other) {
    sigma0 += other.sigma0;
    errors += other.errors;
    above += other.above;
    return *this;
  }
};

/// What a trial at one elevation gave.
struct Trial {
  double seconds_per_cell = 0.0;  // of all frequencies together
  TexelBytes bytes;
};

/// The trials of a plan: bakes pieces of the scene into memory.
class Trials {
 public:
  Trials(const scene::Scene& scene, const BakeSettings& settings)
      : scene_(scene),
        settings_(settings),
        piece_(piece_of(settings)),
        description_(description_of(scene, piece_)),
        baker_(scene, piece_) {}

  [[nodiscard]] std::vector<Trial> at_all_elevations(ProgressListener& progress) const {
    const std::size_t count = settings_.aspects.elevations_rad.size();
    const auto tell = [&](std::size_t done) {
      progress.advanced("plan", static_cast<double>(done), static_cast<double>(count), "looks");
    };
    tell(0);
    std::vector<Trial> trials;
    for (std::size_t i = 0; i < count; ++i) {
      PartProgress part(progress, "plan", i, 1, count);
      trials.push_back(at_elevation(i, part));
      tell(i + 1);
    }
    return trials;
  }
  /// Launch cells of these jobs together.
  [[nodiscard]] double cells_of(const JobList& jobs, const std::vector<std::size_t>& numbers) const {
    std::vector<double> cells(numbers.size());
    parallel_for(numbers.size(), thread_count(settings_.threads), [&](std::size_t i, unsigned) {
      const Job job = jobs[numbers[i]];
      cells[i] = baker_.area_of(settings_.patches.texels_of(job.patch), job.aspect).whole_cells();
    });
    return std::accumulate(cells.begin(), cells.end(), 0.0);
  }

 private:
  static BakeSettings piece_of(BakeSettings settings) {
    settings.patches.texels_per_side = atlas::tile_side;
    return settings;
  }

  [[nodiscard]] Trial at_elevation(std::size_t elevation, ProgressListener& progress) const {
    const auto& azimuths = settings_.aspects.azimuths_rad;
    const radar::Aspect aspect{azimuths[3 * elevation % azimuths.size()], settings_.aspects.elevations_rad[elevation]};
    const atlas::PatchIndex patch = piece_.patches.patch_at(scene_.extent.centre());
    // All looks of a patch share it: it is not a look's time.
    (void)baker_.geometry_about(piece_.patches.texels_of(patch));
    const auto begin = std::chrono::steady_clock::now();
    const BakedLook look = baker_.bake(patch, aspect, progress).front();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    const auto texels = piece_.patches.texels_of(patch);
    const double cells = baker_.area_of(texels, aspect).whole_cells();
    Trial trial{.seconds_per_cell = taken.count() / std::max(cells, 1.0), .bytes = bytes_of(look, texels)};
    if (settings_.buildings == Buildings::Both) trial.bytes += bytes_of(*look.buildings, texels);
    return trial;
  }

  [[nodiscard]] TexelBytes bytes_of(const BakedTexels& baked, const radar::GroundGrid& texels) const {
    const auto a_texel = [&](const std::string& file) {
      return static_cast<double>(file.size()) / static_cast<double>(baked.sigma0.size());
    };
    const auto texture = [&](const atlas::HalfTexture& halves) {
      return atlas::texture_bytes(halves, atlas::sigma0_bands, texels, description_);
    };
    const atlas::MipChain chain{baked.sigma0};
    const atlas::HalfTexture above = atlas::encoded(chain, atlas::fitting_scale(baked.sigma0), atlas::pyramid_bits);
    return {.sigma0 = a_texel(texture(atlas::encoded_as(description_, chain, baked.relative_errors))),
            .errors = a_texel(
                atlas::error_texture_bytes(baked.relative_errors, baked.sigma0, texels, description_, scene_.name)),
            .above = a_texel(texture(above))};
  }

  const scene::Scene& scene_;
  const BakeSettings& settings_;
  BakeSettings piece_;
  atlas::AtlasDescription description_;  // of the piece
  LookBaker baker_;
};

/// Texels of one patch: of its finest level, and of all levels that its textures hold.
struct PatchTexels {
  double finest = 0.0, all_levels = 0.0;

  explicit PatchTexels(const atlas::PatchGrid& patches) {
    const auto side = static_cast<double>(patches.texels_per_side);
    finest = side * side;
    for (std::size_t level = 0; level < patches.stored_levels(); ++level) {
      all_levels += finest / static_cast<double>(std::size_t{1} << (2 * level));
    }
  }
};

/// Texels of the levels above all patches.
double texels_above(const atlas::AtlasDescription& description) {
  const atlas::PyramidTiles above(description.patches, description.extent);
  double tiles = 0.0;
  for (std::size_t level = 1; level <= above.levels(); ++level) tiles += static_cast<double>(above.tiles(level).size());
  return tiles * static_cast<double>(atlas::tile_side * atlas::tile_side);
}

/// Of one elevation's open jobs the cells of so many are counted. Each needs a look at all that stands in the scene,
/// and the mean of that many is surer than the time that the trial tells.
constexpr std::size_t most_counted = 64;

/// One, by lot, of each of equal stretches of a row of jobs: in step with neither rows of patches nor azimuths.
std::vector<std::size_t> some_of(const std::vector<std::size_t>& numbers) {
  const std::size_t count = std::min(numbers.size(), most_counted);
  const auto stretch = static_cast<double>(numbers.size()) / static_cast<double>(std::max<std::size_t>(count, 1));
  std::vector<std::size_t> some;
  for (std::size_t i = 0; i < count; ++i) {
    const double place = (static_cast<double>(i) + static_cast<double>(unit_float(hashed(i)))) * stretch;
    some.push_back(numbers[static_cast<std::size_t>(place)]);
  }
  return some;
}

std::size_t looks_there(const std::optional<atlas::LookStores>& stores, const Job& job) {
  if (!stores) return 0;
  return static_cast<std::size_t>(
      std::ranges::count_if(job.looks, [&](atlas::LookIndex look) { return stores->is_done(job.patch, look); }));
}

}  // namespace

BakePlan plan(const scene::Scene& scene, const BakeSettings& settings, const std::filesystem::path& folder,
              ProgressListener& progress, const Shard& shard) {
  check(settings);
  check(shard);
  check_room(scene, settings);
  const atlas::AtlasDescription description = description_of(scene, settings);
  const auto store = atlas::Store::find(folder, description);
  const auto stores = store ? std::optional<atlas::LookStores>(*store) : std::nullopt;
  const auto begin = std::chrono::steady_clock::now();
  const Trials trials(scene, settings);
  const std::vector<Trial> found = trials.at_all_elevations(progress);
  BakePlan plan;
  plan.probe_looks = found.size();
  plan.probe_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const JobList jobs(description);
  const std::size_t azimuths = settings.aspects.azimuths_rad.size();
  const JobShare share(jobs, shard);
  plan.jobs = jobs.size();
  plan.patches = plan.jobs / (azimuths * found.size());
  const PatchTexels texels(settings.patches);
  const double above = texels_above(description) / static_cast<double>(plan.patches);
  std::vector<std::vector<std::size_t>> open(found.size());  // numbers of jobs, by elevation
  std::size_t last_patch = plan.patches;                     // of the share, none as yet
  for (std::size_t number = 0; number < jobs.size(); ++number) {
    const std::size_t elevation = number / azimuths % found.size();
    const Trial& trial = found[elevation];
    const double bytes =
        (trial.bytes.sigma0 * texels.all_levels + trial.bytes.above * above + trial.bytes.errors * texels.finest) *
        static_cast<double>(jobs.looks_per_job());
    plan.bytes += bytes;
    if (!share.has(number)) continue;
    ++plan.jobs_of_share;
    if (number / jobs.aspects() != last_patch) ++plan.patches_of_share;
    last_patch = number / jobs.aspects();
    plan.bytes_of_share += bytes;
    const Job job = jobs[number];
    const std::size_t there = looks_there(stores, job);
    plan.looks += job.looks.size();
    plan.already += there;
    if (there < job.looks.size()) open[elevation].push_back(number);
  }
  plan.has_whole_patches = plan.jobs_of_share == plan.patches_of_share * jobs.aspects();
  for (std::size_t elevation = 0; elevation < found.size(); ++elevation) {
    const std::vector<std::size_t> counted = some_of(open[elevation]);
    if (counted.empty()) continue;
    const double standing_for = static_cast<double>(open[elevation].size()) / static_cast<double>(counted.size());
    const double cells = standing_for * trials.cells_of(jobs, counted);
    plan.jobs_counted += counted.size();
    plan.cells += cells;
    plan.seconds += found[elevation].seconds_per_cell * cells;
  }
  return plan;
}

}  // namespace sigmascape::bake
