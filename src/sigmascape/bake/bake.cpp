#include "sigmascape/bake/bake.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sigmascape/atlas/building_file.h"
#include "sigmascape/atlas/building_textures.h"
#include "sigmascape/atlas/catalogs.h"
#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/atlas/power_error.h"
#include "sigmascape/atlas/pyramid.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/atlas/texture_name.h"
#include "sigmascape/bake/claims.h"
#include "sigmascape/bake/ground_baker.h"
#include "sigmascape/bake/job.h"
#include "sigmascape/bake/job_share.h"
#include "sigmascape/bake/look_baker.h"
#include "sigmascape/bake/mean_ground.h"
#include "sigmascape/bake/part_progress.h"
#include "sigmascape/bake/patch_room.h"
#include "sigmascape/bake/shape_files.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/trace/simd_setting.h"

namespace sigmascape::bake {
namespace {

std::map<std::string, std::string> settings_in_words(const BakeSettings& settings) {
  const Sampling& sampling = settings.sampling;
  std::map<std::string, std::string> words = {
      {"max_bounces", std::to_string(settings.max_bounces)},
      {"seed", std::to_string(settings.seed)},
      {atlas::shadows_setting, settings.shadows == Shadows::RunTime ? atlas::shadows_at_run_time : "baked"},
      {atlas::footing_setting,
       footing_of(settings) == trace::Footing::LevelPlane ? "level" : atlas::footing_on_terrain},
      {"simd", trace::simd_setting()}};
  // An atlas that tells none is of the first.
  if (physics_revision > 1) words[atlas::physics_revision_setting] = std::to_string(physics_revision);
  if (settings.noise == Noise::Shared) words["noise"] = "shared";
  if (settings.buildings != Buildings::Baked) words[atlas::buildings_setting] = atlas::buildings_apart;
  if (settings.buildings == Buildings::Both) words[atlas::building_textures_setting] = atlas::building_textures_kept;
  if (sampling.is_adaptive()) {
    words["samples_per_texel"] = fmt::format("{} to {}", pilot_samples, sampling.most_samples);
    words["target_db"] = fmt::format("{}", sampling.target_db);
    words["floor_db"] = fmt::format("{}", sampling.floor_db);
    // Of all that a cell returns, though what buildings do is not in the textures.
    if (settings.buildings != Buildings::Baked) words["target_of"] = "all";
  } else {
    words["samples_per_texel"] = std::to_string(sampling.samples_per_texel);
  }
  return words;
}

/// What a look returns with what buildings that are kept apart do, which maps make anew from the buildings: that has no
/// noise.
BakedTexels with_buildings(const BakedLook& look) {
  BakedTexels all = look;
  for (std::size_t i = 0; i < all.sigma0.size(); ++i) {
    radar::Channels& texel = all.sigma0.values()[i];
    const float own = texel.power(radar::Polarization::Sum);
    texel += look.buildings->sigma0.values()[i];
    if (own > 0.0F) all.relative_errors.values()[i] *= own / texel.power(radar::Polarization::Sum);
  }
  return all;
}

/// One process's way through its share.
class BakeRun {
 public:
  BakeRun(const LookBaker& baker, const BakeSettings& settings, const atlas::Store& store, const BakeShare& share,
          ProgressListener& progress)
      : baker_(baker),
        settings_(settings),
        store_(store),
        share_(share),
        progress_(progress),
        jobs_(store.description()),
        share_of_jobs_(jobs_, share.shard),
        claims_(store.folder()) {}

  BakeReport report(const scene::Scene& scene) {
    if (settings_.shadows == Shadows::RunTime)
      ground_.emplace(scene, store_.description().aspects, store_.description().patches);
    if (settings_.buildings == Buildings::Both)
      static_cast<void>(atlas::create_building_textures(store_, &report_.mended));
    stores_.emplace(store_);
    // Before anything is written, which would make the catalogs above it without a word.
    mend_catalogs();
    const std::vector<OpenJob> open = open_jobs();
    tell_progress();
    const bool keeps_buildings = settings_.buildings != Buildings::Baked;
    for (atlas::StoreFault& fault :
         write_shape_files(scene, store_, keeps_buildings, claims_, share_.scrutiny, progress_))
      note(std::move(fault));
    if (settings_.shadows == Shadows::RunTime) {
      for (atlas::StoreFault& fault : bake_ground(scene, store_, share_.shard, share_.scrutiny, &progress_))
        note(std::move(fault));
      tell_progress();
    }
    std::vector<OpenJob> held_by_others;
    for (const OpenJob& job : open) {
      const auto claim = claims_.take_if_free(job.number);
      if (!claim) {
        held_by_others.push_back(job);
        continue;
      }
      bake_job(job);
    }
    for (const OpenJob& job : held_by_others) {
      const Claims::Claim claim =
          claims_.take(job.number, [&] { progress_.waiting("bake", at_work_on(jobs_[job.number])); });
      bake_job(job);
    }
    make_levels_above();
    mend_catalogs();
    report_.geometry_bytes = baker_.geometry_bytes();
    return report_;
  }

 private:
  struct OpenJob {
    std::size_t number = 0;
    std::size_t missing = 0;  // of its looks
  };

  [[nodiscard]] bool is_done(const Job& job, atlas::LookIndex look) const {
    return stores_->is_done(job.patch, look, share_.scrutiny);
  }

  /// Jobs of the share of which some look is not there. Counts the looks that are.
  [[nodiscard]] std::vector<OpenJob> open_jobs() {
    for (std::size_t number = 0; number < jobs_.size(); ++number)
      report_.looks += share_of_jobs_.has(number) ? jobs_.looks_per_job() : 0;
    std::vector<OpenJob> open;
    std::size_t looked_at = 0;
    for (std::size_t number = 0; number < jobs_.size(); ++number) {
      if (!share_of_jobs_.has(number)) continue;
      const std::size_t missing = missing_looks(jobs_[number]);
      report_.already += jobs_.looks_per_job() - missing;
      if (missing > 0) open.push_back({number, missing});
      looked_at += jobs_.looks_per_job();
      tell_verified(looked_at);
    }
    done_ = report_.already;
    return open;
  }

  /// Sizes are looked up in no time; to read all that is there takes some.
  void tell_verified(std::size_t textures) {
    if (share_.scrutiny != atlas::Scrutiny::Content) return;
    progress_.advanced("verify", static_cast<double>(textures), static_cast<double>(report_.looks), "textures");
  }

  [[nodiscard]] std::size_t missing_looks(const Job& job) const {
    return static_cast<std::size_t>(
        std::ranges::count_if(job.looks, [&](atlas::LookIndex look) { return !is_done(job, look); }));
  }

  /// With its claim in hand. Looks that another process has baked since are there already.
  void bake_job(const OpenJob& open) {
    const Job job = jobs_[open.number];
    const std::size_t missing = missing_looks(job);
    if (missing > 0) {
      remove_leftovers(job);
      bake_and_write(job, open.missing);
    }
    report_.elsewhere += open.missing - std::min(missing, open.missing);
    done_ += open.missing;
    tell_progress();
  }

  [[nodiscard]] std::string at_work_on(const Job& job) const {
    const radar::Look look = store_.description().aspects.look(job.looks.front());
    return fmt::format("another process that is at {} of {}", atlas::look_name(look), atlas::patch_name(job.patch));
  }

  void bake_and_write(const Job& job, std::size_t counting_for) {
    PartProgress part(progress_, "bake", done_, counting_for, report_.looks);
    const std::vector<BakedLook> looks = baker_.bake(job.patch, job.aspect, part);
    for (std::size_t i = 0; i < looks.size(); ++i) {
      report_.counts += looks[i].counts;
      if (!is_done(job, job.looks[i])) write(job.patch, job.looks[i], looks[i]);
    }
  }

  void write(atlas::PatchIndex patch, atlas::LookIndex number, const BakedLook& look) {
    atlas::PowerError error = look.buildings ? error_of(with_buildings(look)) : error_of(look);
    if (ground_) error.ground_power = ground_->power_of(patch, number);
    if (settings_.buildings == Buildings::Both)
      write(stores_->all().back(), patch, number, *look.buildings, look.samples_per_texel, {});
    write(store_, patch, number, look, look.samples_per_texel, error);
    report_.errors.add(number, error);
    ++baked_;
  }

  [[nodiscard]] atlas::PowerError error_of(const BakedTexels& texels) const {
    return atlas::power_error(texels.sigma0, texels.relative_errors, relative_target());
  }

  void write(const atlas::Store& store, atlas::PatchIndex patch, atlas::LookIndex look, const BakedTexels& texels,
             double samples_per_texel, const std::optional<atlas::PowerError>& error) {
    if (auto fault = atlas::texture_fault(store, store.texture_path(patch, look), share_.scrutiny))
      note(*std::move(fault), store);
    store.write(patch, look, texels.sigma0,
                {.seed = settings_.seed,
                 .samples_per_texel = samples_per_texel,
                 .simd = trace::simd_setting(),
                 .counts = {},
                 .error = error},
                texels.relative_errors);
  }

  void note(atlas::StoreFault fault) {
    if (!fault.is_absent) report_.mended.push_back(std::move(fault));
  }
  /// Of the atlas or of its layer of buildings.
  void note(atlas::StoreFault fault, const atlas::Store& store) {
    fault.file = store.folder().lexically_relative(store_.folder()) / fault.file;
    note({.file = fault.file.lexically_normal(), .what = std::move(fault.what), .is_absent = fault.is_absent});
  }

  void mend_catalogs() {
    for (const atlas::Store& store : stores_->all()) {
      for (atlas::StoreFault& fault : atlas::mend_catalogs(
               store, share_.scrutiny, [this](std::size_t number) { return share_.shard.has(number); })) {
        note(std::move(fault), store);
      }
    }
  }

  void remove_leftovers(const Job& job) const {
    for (const atlas::Store& store : stores_->all()) {
      for (const atlas::LookIndex look : job.looks) {
        const std::filesystem::path texture = store.folder() / store.texture_path(job.patch, look);
        geo::remove_leftovers(texture.parent_path(), texture.stem().string());
      }
    }
  }

  void tell_progress() {
    if (baked_ > 0) {
      progress_.measured("bake", "rays", static_cast<double>(report_.counts.rays));
      if (const auto error = report_.errors.relative()) progress_.measured("bake", "relative_standard_error", *error);
    }
    progress_.advanced("bake", static_cast<double>(done_), static_cast<double>(report_.looks), "looks");
  }

  /// Those that the share bakes from an aspect.
  [[nodiscard]] std::vector<atlas::PatchIndex> patches_from(std::size_t aspect) const {
    std::vector<atlas::PatchIndex> patches;
    for (std::size_t number = aspect; number < jobs_.size(); number += jobs_.aspects()) {
      if (share_of_jobs_.has(number)) patches.push_back(jobs_[number].patch);
    }
    return patches;
  }

  void make_levels_above() {
    if (atlas::Pyramid(store_).levels() == 0) return;
    std::size_t layers = 0;
    const auto tell = [&] {
      progress_.advanced("pyramid", static_cast<double>(layers),
                         static_cast<double>(stores_->all().size() * jobs_.aspects() * jobs_.looks_per_job()),
                         "layers");
    };
    tell();
    for (const atlas::Store& store : stores_->all()) {
      const atlas::Pyramid pyramid(store);
      atlas::MakingNotes notes;
      for (std::size_t aspect = 0; aspect < jobs_.aspects(); ++aspect) {
        const std::vector<atlas::PatchIndex> patches = patches_from(aspect);
        for (const atlas::LookIndex look : jobs_[aspect].looks) {
          report_.pyramid += pyramid.make_above(patches, look, share_.scrutiny, &notes);
          ++layers;
          tell();
        }
      }
      for (atlas::StoreFault& fault : notes.mended) note(std::move(fault), store);
    }
  }

  /// A target is one for what the rays of a cell return (docs/decisions/0015-adaptive-sampling.md), so that texels may
  /// miss it.
  [[nodiscard]] std::optional<double> relative_target() const {
    const Sampling& sampling = settings_.sampling;
    return sampling.is_adaptive() ? std::optional(sampling.relative_target()) : std::nullopt;
  }

  const LookBaker& baker_;
  const BakeSettings& settings_;
  const atlas::Store& store_;
  const BakeShare& share_;
  ProgressListener& progress_;
  JobList jobs_;
  JobShare share_of_jobs_;
  Claims claims_;
  std::optional<MeanGround> ground_;         // where it is kept apart
  std::optional<atlas::LookStores> stores_;  // of the looks, as soon as all are there
  BakeReport report_;
  std::size_t done_ = 0, baked_ = 0;
};

}  // namespace

atlas::AtlasDescription description_of(const scene::Scene& scene, const BakeSettings& settings) {
  return {.name = scene.name,
          .frame = scene.frame,
          .extent = scene.extent,
          .patches = settings.patches,
          .aspects = settings.aspects,
          .scene_hash = scene::scene_hash(scene),
          .settings = settings_in_words(settings),
          .mantissa_bits = settings.mantissa_bits,
          .digits = settings.digits,
          .attribution = scene.attribution,
          .format_version =
              settings.buildings == Buildings::Baked ? atlas::usual_format_version : atlas::newest_format_version};
}

BakeReport bake(const scene::Scene& scene, const BakeSettings& settings, const std::filesystem::path& folder,
                ProgressListener& progress, const BakeShare& share) {
  check(settings);
  check(share.shard);
  check_room(scene, settings);
  // Materials that do not know a frequency are told of before there is a folder.
  static_cast<void>(trace::surface_models(scene, settings.aspects.frequencies_hz));
  const atlas::Store store = atlas::Store::create(folder, description_of(scene, settings));
  const LookBaker baker(scene, settings);
  return BakeRun(baker, settings, store, share, progress).report(scene);
}

}  // namespace sigmascape::bake
