#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <unistd.h>

#include "equal_noise.h"
#include "figures.h"
#include "paper_look.h"

#include "sigmascape/atlas/store.h"
#include "sigmascape/bake/bake.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scene/paper_scene.h"

namespace {

using namespace sigmascape;
using bench::Figures;

constexpr std::uint32_t paper_samples = 100;
constexpr double texels_of_the_paper = 1024.0 * 1024.0;

/// Time and noise of a look, mean over elevations.
void measure_equal_noise(const bench::PaperLooks& looks, bool whole, Figures& figures) {
  const auto& elevations = looks.settings().aspects.elevations_rad;
  const std::size_t count = whole ? elevations.size() : 1;
  double plain = 0.0, median = 0.0, l1 = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double elevation_rad = elevations[whole ? i : elevations.size() / 2];
    const auto noise = bench::equal_noise(looks, {radians_from_deg(45.0), elevation_rad}, paper_samples);
    bench::prove(std::abs(noise.mean_ratio - 1.0) < 4.0 * noise.mean_ratio_error + 1e-3,
                 fmt::format("our map holds the power of the plain one: ratio {:.4f} ± {:.4f}", noise.mean_ratio,
                             noise.mean_ratio_error));
    const std::string note = fmt::format(
        "elevation {:.0f}°; plain: L1 {:.3f}, median {:.3f} over the {:.0f} % of texels that are noisy",
        deg_from_radians(elevation_rad), noise.plain.l1, noise.plain.median_relative, 100.0 * noise.noisy_share);
    figures.add("bake.equal_noise_gain.median", noise.plain_seconds / noise.median_seconds, "1", note);
    figures.add("bake.equal_noise_gain.l1", noise.plain_seconds / noise.l1_seconds, "1", note);
    plain += noise.plain_seconds / static_cast<double>(count);
    median += noise.median_seconds / static_cast<double>(count);
    l1 += noise.l1_seconds / static_cast<double>(count);
  }
  const double slower = std::max(median, l1);
  const std::string place = whole ? "the whole scene, mean over the five elevations"
                                  : "a crop of 256 x 256 texels with houses and trees, 21°, scaled by area";
  const double texels = whole ? texels_of_the_paper : 256.0 * 256.0;
  figures.add("bake.equal_noise_gain", plain / slower, "1", place + "; the lesser of median and L1");
  figures.add("bake.seconds_per_look", 0.5 * slower * texels_of_the_paper / texels, "s",
              place + "; processor time over two cores, at the noise of 100 plain rays and 8 bounces");
}

/// Bytes of a look, and whether many looks take as long as single ones.
void measure_looks(const scene::Scene& scene, const bench::PaperLooks& looks, bool quick, Figures& figures) {
  const auto folder = std::filesystem::temp_directory_path() / fmt::format("sigmascape_bench_bake_{}", getpid());
  bake::BakeSettings settings = looks.settings();
  settings.sampling = {.target_db = 1.0, .most_samples = 32};
  settings.mantissa_bits = 6;
  const std::size_t azimuths = quick ? 2 : settings.aspects.azimuths_rad.size();
  settings.aspects.azimuths_rad.resize(azimuths);

  const bake::LookBaker baker(scene, settings);
  SilentProgress silent;
  double single = 0.0;
  const atlas::Store store = atlas::Store::create(folder, bake::description_of(scene, settings));
  double bytes = 0.0;
  const double start = bench::processor_seconds();
  for (atlas::LookIndex look = 0; look < settings.aspects.look_count(); ++look) {
    const double before = bench::processor_seconds();
    for (const atlas::PatchIndex patch : looks.patches()) {
      const auto baked = baker.bake(patch, settings.aspects.look(look).aspect, silent).front();
      store.write(patch, look, baked.sigma0, {}, baked.relative_errors);
    }
    if (look % azimuths == 0) single += bench::processor_seconds() - before;
  }
  const double all = bench::processor_seconds() - start;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".tif") bytes += static_cast<double>(entry.file_size());
  }
  std::filesystem::remove_all(folder);
  const auto count = static_cast<double>(settings.aspects.look_count());
  figures.add("bake.looks_linearity", all / (count * single / (count / static_cast<double>(azimuths))), "1",
              fmt::format("{} looks over as many times the mean of one at each elevation", count));
  const double side = static_cast<double>(settings.patches.texels_per_side);
  const double texels = static_cast<double>(looks.patches().size()) * side * side;
  figures.add("bake.bytes_per_look", bytes / count * texels_of_the_paper / texels / 1e6, "MB",
              "four channels and the standard errors, 6 mantissa bits (0.03 dB)");
}

void measure_threads(const scene::Scene& scene, Figures& figures) {
  const bench::PaperLooks one(scene, false, 1), two(scene, false, 2);
  const radar::Aspect aspect{radians_from_deg(45.0), radians_from_deg(21.0)};
  const bake::Sampling sampling{.samples_per_texel = 32};
  const auto single = one.ours(aspect, sampling, 1), both = two.ours(aspect, sampling, 1);
  bench::prove(single.power == both.power, "two threads bake what one does");
  figures.add("bake.thread_efficiency", single.wall_seconds / (2.0 * both.wall_seconds), "1", "needs two idle cores");
}

}  // namespace

int main(int count, char** words) {
  const auto arguments = bench::Arguments::parsed(count, words);
  Figures figures(arguments.out);
  const double start = bench::wall_seconds();
  const scene::Scene scene = scene::paper_scene();
  const bench::PaperLooks looks(scene, !arguments.quick, 2);
  figures.add("bake.scene_load_seconds", bench::wall_seconds() - start, "s",
              "the paper's scene made up and ready for rays");
  measure_equal_noise(looks, !arguments.quick, figures);
  measure_looks(scene, looks, arguments.quick, figures);
  measure_threads(scene, figures);
  figures.add("bake.peak_memory_mib", bench::peak_memory_mib(), "MiB", "of this program, the paper's whole scene");
  return 0;
}
