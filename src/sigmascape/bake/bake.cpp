#include "sigmascape/bake/bake.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/bake/ground_baker.h"
#include "sigmascape/bake/look_baker.h"
#include "sigmascape/trace/simd_setting.h"

namespace sigmascape::bake {
namespace {

atlas::AtlasDescription description_of(const scene::Scene& scene, const BakeSettings& settings) {
  return {.name = scene.name,
          .frame = scene.frame,
          .extent = scene.extent,
          .patches = settings.patches,
          .aspects = settings.aspects,
          .scene_hash = scene::scene_hash(scene),
          .settings = {{"samples_per_texel", std::to_string(settings.samples_per_texel)},
                       {"max_bounces", std::to_string(settings.max_bounces)},
                       {"seed", std::to_string(settings.seed)},
                       {atlas::shadows_setting,
                        settings.shadows == Shadows::RunTime ? atlas::shadows_at_run_time : "baked"},
                       {"simd", trace::simd_setting()}},
          .mantissa_bits = settings.mantissa_bits,
          .attribution = scene.attribution};
}

/// All looks of an atlas that one set of paths serves: one patch from one aspect, at every frequency.
struct Job {
  atlas::PatchIndex patch;
  radar::Aspect aspect;
  std::vector<atlas::LookIndex> looks;  // in the order of frequencies
};

std::vector<Job> jobs_of(const atlas::AtlasDescription& atlas) {
  const atlas::AspectGrid& axes = atlas.aspects;
  std::vector<Job> jobs;
  for (const atlas::PatchIndex& patch : atlas.patches.covering(atlas.extent)) {
    for (std::size_t elevation = 0; elevation < axes.elevations_rad.size(); ++elevation) {
      for (std::size_t azimuth = 0; azimuth < axes.azimuths_rad.size(); ++azimuth) {
        Job& job = jobs.emplace_back(Job{patch, axes.look(axes.index_of(azimuth, elevation, 0)).aspect, {}});
        for (std::size_t frequency = 0; frequency < axes.frequencies_hz.size(); ++frequency) {
          job.looks.push_back(axes.index_of(azimuth, elevation, frequency));
        }
      }
    }
  }
  return jobs;
}

/// Tells of the part of one job as part of all.
class JobProgress final : public ProgressListener {
 public:
  JobProgress(ProgressListener& whole, std::size_t before, std::size_t looks, std::size_t total)
      : whole_(whole), before_(before), looks_(looks), total_(total) {}

  void advanced(std::string_view task, double done, double of, std::string_view) override {
    whole_.advanced(task, static_cast<double>(before_) + done / of * static_cast<double>(looks_),
                    static_cast<double>(total_), "looks");
  }

 private:
  ProgressListener& whole_;
  std::size_t before_, looks_, total_;
};

}  // namespace

BakeReport bake(const scene::Scene& scene, const BakeSettings& settings, const std::filesystem::path& folder,
                ProgressListener& progress) {
  check(settings);
  const atlas::Store store = atlas::Store::create(folder, description_of(scene, settings));
  if (settings.shadows == Shadows::RunTime) bake_ground(scene, store);
  const LookBaker baker(scene, settings);

  BakeReport report;
  report.looks = store.units().size();
  report.geometry_bytes = baker.geometry_bytes();
  std::size_t done = 0, baked = 0;
  double squared_errors = 0.0;
  for (const Job& job : jobs_of(store.description())) {
    const auto is_done = [&](atlas::LookIndex look) { return store.is_done(job.patch, look); };
    const auto there = static_cast<std::size_t>(std::ranges::count_if(job.looks, is_done));
    report.already += there;
    if (there < job.looks.size()) {
      JobProgress part(progress, done, job.looks.size(), report.looks);
      const std::vector<BakedLook> looks = baker.bake(job.patch, job.aspect, part);
      for (std::size_t i = 0; i < looks.size(); ++i) {
        report.counts += looks[i].counts;
        if (is_done(job.looks[i])) continue;
        const double error = looks[i].relative_standard_error;
        store.write(job.patch, job.looks[i], looks[i].sigma0,
                    {.seed = settings.seed,
                     .samples_per_texel = settings.samples_per_texel,
                     .relative_standard_error = error,
                     .simd = trace::simd_setting(),
                     .counts = {}});
        squared_errors += error * error;
        ++baked;
      }
    }
    done += job.looks.size();
    progress.advanced("bake", static_cast<double>(done), static_cast<double>(report.looks), "looks");
  }
  report.relative_standard_error = baked > 0 ? std::sqrt(squared_errors / static_cast<double>(baked)) : 0.0;
  return report;
}

}  // namespace sigmascape::bake
