#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <span>
#include <string>
#include <unistd.h>
#include <vector>

#include "bias.h"
#include "equal_noise.h"
#include "figures.h"
#include "memory_of_bake.h"
#include "paper_look.h"
#include "sharing.h"

#include "sigmascape/atlas/store.h"
#include "sigmascape/bake/bake.h"
#include "sigmascape/bake/plan.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scene/paper_scene.h"

namespace {

using namespace sigmascape;
using bench::Figures;

constexpr std::uint32_t paper_samples = 100;
constexpr double texels_of_the_paper = 1024.0 * 1024.0;

/// From coarse to fine; the first that is as good as plain sampling decides.
std::vector<bake::Sampling> ladder() {
  std::vector<bake::Sampling> samplings;
  for (const std::uint32_t samples : {32U, 64U, 128U, 256U}) samplings.push_back({.samples_per_texel = samples});
  return samplings;
}

/// Time and noise of a look, mean over elevations.
void measure_equal_noise(bench::PaperLooks& looks, std::span<const double> elevations_rad, const std::string& place,
                         Figures& figures) {
  const auto samplings = ladder();
  const auto count = static_cast<double>(elevations_rad.size());
  double plain = 0.0, slower = 0.0;
  for (const double elevation_rad : elevations_rad) {
    const radar::Aspect aspect{radians_from_deg(45.0), elevation_rad};
    const auto noise = bench::equal_noise(looks, aspect, paper_samples, samplings);
    bench::prove(std::abs(noise.mean_ratio - 1.0) < 4.0 * noise.mean_ratio_error + 1e-3,
                 fmt::format("our map holds the power of the plain one: ratio {:.4f} ± {:.4f}", noise.mean_ratio,
                             noise.mean_ratio_error));
    const std::string note = fmt::format(
        "elevation {:.0f}°; plain: {:.0f} s, L1 {:.3f}, median {:.3f} over the {:.0f} % of lit texels that are noisy; "
        "power of ours over plain {:.3f} ± {:.3f}",
        deg_from_radians(elevation_rad), noise.plain_seconds / looks.part_of(aspect), noise.plain.l1,
        noise.plain.median_relative, 100.0 * noise.noisy_share, noise.mean_ratio, noise.mean_ratio_error);
    figures.add("bake.equal_noise_gain.median", noise.plain_seconds / noise.median_seconds, "1", note);
    figures.add("bake.equal_noise_gain.l1", noise.plain_seconds / noise.l1_seconds, "1", note);
    figures.add("bake.error_predicted_over_actual", noise.honesty.predicted_over_actual, "1", note);
    figures.add("bake.interval_coverage", noise.honesty.covered, "1",
                "differences of two maps within their 95 % intervals, all noisy texels");
    plain += noise.plain_seconds / looks.part_of(aspect) / count;
    slower += std::max(noise.median_seconds, noise.l1_seconds) / looks.part_of(aspect) / count;
  }
  figures.add("bake.equal_noise_gain", plain / slower, "1", place + "; the lesser of median and L1");
  figures.add("bake.seconds_per_look", 0.5 * slower, "s",
              place + "; processor time over two cores, at the noise of 100 plain rays and 8 bounces");
}

/// Whether our maps hold the power that long plain ones do, where paths are long and none is left out.
void measure_bias(const scene::Scene& scene, bool quick, Figures& figures) {
  const radar::Aspect aspect{radians_from_deg(45.0), radians_from_deg(21.0)};
  const std::uint32_t plain_samples = quick ? 160 : 3200;
  const bake::Sampling sampling{.samples_per_texel = quick ? 100U : 1600U};
  const bench::Bias bias = bench::bias_in_town_and_forest(scene, aspect, sampling, plain_samples);
  const std::string what = fmt::format(
      "town and forest within {:.0f} to {:.0f} m east and {:.0f} to {:.0f} m north, 21°: our power over that of plain "
      "sampling {:.4f} ± {:.4f}",
      bias.piece.west_m, bias.piece.east_m, bias.piece.south_m, bias.piece.north_m, bias.ratio, bias.standard_error);
  bench::prove(std::abs(bias.ratio - 1.0) < 3.0 * bias.standard_error + 1e-3, what);
  figures.add("bake.bias", bias.ratio - 1.0, "1", what);
}

/// How much closer to long runs looks come whose texels share their noise, with the rays of the paper's setting.
void measure_sharing(const scene::Scene& scene, bool quick, Figures& figures) {
  for (const double elevation_deg : {5.0, 21.0, 37.0}) {
    const radar::Aspect aspect{radians_from_deg(45.0), radians_from_deg(elevation_deg)};
    const bench::Sharing sharing = bench::what_sharing_gives(scene, aspect, paper_samples, quick ? 400 : 1600);
    bench::prove(std::abs(sharing.power_ratio - 1.0) < 1e-5,
                 fmt::format("sharing keeps the power: ratio {:.7f}", sharing.power_ratio));
    const bench::MapError &own = sharing.own, &shared = sharing.shared;
    const std::string where =
        fmt::format("500 m in the middle of the scene, elevation {:.0f}°, errors from long runs: ", elevation_deg);
    figures.add("bake.sharing.l1", shared.l1 / own.l1, "1", where + fmt::format("{:.3f} of {:.3f}", shared.l1, own.l1));
    figures.add("bake.sharing.rms_db", shared.rms_db / own.rms_db, "1",
                where + fmt::format("cells of 8 m, {:.2f} of {:.2f} dB", shared.rms_db, own.rms_db));
    figures.add("bake.sharing.median", shared.median_relative / own.median_relative, "1",
                where + fmt::format("{:.3f} of {:.3f}", shared.median_relative, own.median_relative));
  }
}

/// What part of a look's time its rays take when nothing is done but trace them.
void measure_embree_share(const scene::Scene& scene, Figures& figures) {
  // A log belongs to one thread.
  bench::PaperLooks looks(scene, 10, 1);
  const radar::Aspect aspect{radians_from_deg(45.0), radians_from_deg(21.0)};
  const bake::Sampling sampling{.samples_per_texel = 64};
  trace::SceneGeometry& geometry = looks.geometry();
  trace::RayLog log;
  log.reserve(looks.ours(aspect, sampling, 1).counts.rays);
  geometry.log_to(&log);
  const bench::TimedLook logged = looks.ours(aspect, sampling, 1);
  geometry.log_to(nullptr);
  const auto asked_again = static_cast<std::size_t>(std::ranges::count_if(log, &trace::LoggedRay::asks_again));
  bench::prove(log.size() - asked_again == logged.counts.rays, "every ray is in the log");
  double whole = 0.0, bare = 0.0;
  std::size_t met = 0;
  // In turn, so that what else the machine does falls on both.
  for (int turn = 0; turn < 5; ++turn) {
    const bench::TimedLook look = looks.ours(aspect, sampling, 1);
    bench::prove(look.counts.rays == logged.counts.rays, "a look has the rays that it had before");
    whole += look.processor_seconds;
    const double start = bench::processor_seconds();
    met = geometry.replay(log);
    bare += bench::processor_seconds() - start;
  }
  figures.add(
      "bake.embree_share", bare / whole, "1",
      fmt::format("{} rays of one tile in a hundred of the whole scene, 21°, 64 rays a cell, {} of them asked for "
                  "again from near by, {:.0f} % of all of which meet something, traced again in the same packets",
                  logged.counts.rays, asked_again, 100.0 * static_cast<double>(met) / static_cast<double>(log.size())));
}

double bytes_of_textures(const atlas::Store& store) {
  double bytes = 0.0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(store.folder())) {
    if (entry.path().extension() == ".tif") bytes += static_cast<double>(entry.file_size());
  }
  return bytes;
}

/// Bytes of a look, and whether many looks take as long as single ones.
void measure_looks(const scene::Scene& scene, bool quick, Figures& figures) {
  const auto folder = std::filesystem::temp_directory_path() / fmt::format("sigmascape_bench_bake_{}", getpid());
  bake::BakeSettings settings;
  settings.patches.texels_per_side = quick ? 256 : 512;
  settings.threads = 2;
  settings.sampling = {.samples_per_texel = quick ? 8U : 50U};
  settings.shadows = bake::Shadows::Baked;
  const std::size_t azimuths = quick ? 2 : settings.aspects.azimuths_rad.size();
  settings.aspects.azimuths_rad.resize(azimuths);

  const bake::LookBaker baker(scene, settings);
  SilentProgress silent;
  // In the middle of the scene; of a quick run a quarter of it.
  const atlas::PatchIndex patch = settings.patches.patch_at(scene.extent.centre());
  (void)baker.geometry_about(settings.patches.texels_of(patch));
  const atlas::AtlasDescription to_noise = bake::description_of(scene, settings);
  atlas::AtlasDescription whole_halves = to_noise;
  whole_halves.digits = atlas::Digits::All;
  const atlas::Store alone = atlas::Store::create(folder / "alone", to_noise);
  const atlas::Store together = atlas::Store::create(folder / "together", to_noise);
  const atlas::Store exact = atlas::Store::create(folder / "exact", whole_halves);
  const auto bake = [&](const atlas::Store& store, atlas::LookIndex look) {
    auto baked = baker.bake(patch, settings.aspects.look(look).aspect, silent).front();
    store.write(patch, look, baked.sigma0, {}, baked.relative_errors);
    return baked;
  };
  const auto looks = static_cast<atlas::LookIndex>(settings.aspects.look_count());
  double singles = 0.0;
  for (atlas::LookIndex look = 0; look < looks; ++look) {
    // Never one after the one that follows it.
    const double before = bench::processor_seconds();
    const bake::BakedLook baked = bake(alone, looks - 1 - look);
    singles += bench::processor_seconds() - before;
    exact.write(patch, looks - 1 - look, baked.sigma0, {}, baked.relative_errors);
  }
  const double start = bench::processor_seconds();
  for (atlas::LookIndex look = 0; look < looks; ++look) bake(together, look);
  const double all = bench::processor_seconds() - start;
  const auto count = static_cast<double>(looks);
  const auto side = static_cast<double>(settings.patches.texels_per_side);
  const double textures_of_the_paper = count * side * side / texels_of_the_paper;
  const double bytes = bytes_of_textures(together) / textures_of_the_paper;
  const double exact_bytes = bytes_of_textures(exact) / textures_of_the_paper;
  std::filesystem::remove_all(folder);
  figures.add("bake.looks_linearity", all / singles, "1",
              fmt::format("{} looks of a patch over those of each by itself, in another order", count));
  const std::string of_what = "a patch in the middle, scaled by area; four channels and the standard errors, ";
  figures.add("bake.bytes_per_look", bytes / 1e6, "MB",
              of_what + "digits that noise does not drown, as bakes have if not told otherwise");
  figures.add("bake.bytes_per_look.whole_halves", exact_bytes / 1e6, "MB",
              of_what + fmt::format("{} mantissa bits", whole_halves.mantissa_bits));
}

/// Whether a bake takes the time that its plan tells before it is begun.
void measure_plan(const scene::Scene& scene, bool quick, Figures& figures) {
  const auto folder = std::filesystem::temp_directory_path() / fmt::format("sigmascape_bench_plan_{}", getpid());
  bake::BakeSettings settings;
  // Four patches, each of a sixteenth of the paper's texels.
  settings.patches = {.texel_m = 2.0 * settings.patches.texel_m, .texels_per_side = 256};
  settings.threads = 2;
  settings.sampling = {.samples_per_texel = quick ? 8U : 50U};
  settings.shadows = bake::Shadows::Baked;
  settings.aspects.azimuths_rad.resize(quick ? 1 : 2);

  SilentProgress silent;
  const bake::BakePlan plan = bake::plan(scene, settings, folder, silent);
  const double start = bench::wall_seconds();
  const bake::BakeReport report = bake::bake(scene, settings, folder, silent);
  const double taken = bench::wall_seconds() - start;
  std::filesystem::remove_all(folder);
  bench::prove(report.looks == plan.looks && report.already == 0, "the looks that were planned are baked, all of them");
  figures.add(
      "bake.plan_over_actual", plan.seconds / taken, "1",
      fmt::format("{} looks of four patches of 256 x 256 texels: {:.1f} s planned, {:.1f} s taken, on the wall; "
                  "needs two idle cores",
                  plan.looks, plan.seconds, taken));
}

void measure_threads(const scene::Scene& scene, bool quick, Figures& figures) {
  bench::PaperLooks one(scene, quick ? 12 : 4, 1), two(scene, quick ? 12 : 4, 2);
  const radar::Aspect aspect{radians_from_deg(45.0), radians_from_deg(21.0)};
  const bake::Sampling sampling{.samples_per_texel = 100};
  const auto single = one.ours(aspect, sampling, 1), both = two.ours(aspect, sampling, 1);
  bench::prove(single.power == both.power, "two threads bake what one does");
  figures.add("bake.thread_efficiency", single.wall_seconds / (2.0 * both.wall_seconds), "1", "needs two idle cores");
}

/// Whether a bake takes more memory the more patches it has. To be asked before this program has any itself, of which
/// processes that it begins would have a part.
void measure_memory_of_patches(Figures& figures) {
  for (const std::size_t along_a_side : {2U, 4U}) {
    figures.add(
        fmt::format("bake.peak_memory_patches_mib.{}", along_a_side * along_a_side),
        bench::memory_of_bake_mib(along_a_side), "MiB",
        "of a process that bakes the paper's whole scene in so many patches of 256 x 256 texels, two looks each");
  }
}

}  // namespace

int main(int count, char** words) {
  const auto arguments = bench::Arguments::parsed(count, words);
  const bool quick = arguments.quick;
  Figures figures(arguments.out);
  if (!quick) measure_memory_of_patches(figures);
  const double start = bench::wall_seconds();
  const scene::Scene scene = scene::paper_scene();
  const int thinning = quick ? 10 : 1;
  bench::PaperLooks looks(scene, thinning, 2);
  figures.add("bake.scene_load_seconds", bench::wall_seconds() - start, "s",
              "the paper's scene made up and ready for rays");
  const auto& elevations = looks.settings().aspects.elevations_rad;
  measure_equal_noise(
      looks, elevations,
      quick ? "one tile in a hundred of the whole scene, scaled by the number of cells, mean over the five "
              "elevations"
            : "the whole scene, mean over the five elevations",
      figures);
  // Before a second scene and the log of rays, which are none of a bake's memory.
  figures.add("bake.peak_memory_mib", bench::peak_memory_mib(), "MiB", "of this program, the paper's whole scene");
  measure_bias(scene, quick, figures);
  measure_sharing(scene, quick, figures);
  measure_looks(scene, quick, figures);
  measure_plan(scene, quick, figures);
  measure_threads(scene, quick, figures);
  measure_embree_share(scene, figures);
  return 0;
}
