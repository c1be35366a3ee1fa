#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "end_to_end/real_data.h"
#include "scratch_folder.h"

#include "sigmascape/bake/bake.h"
#include "sigmascape/base/units.h"
#include "sigmascape/dataset/dataset_run.h"
#include "sigmascape/scene/scene_file.h"

namespace sigmascape::end_to_end {
namespace {

namespace fs = std::filesystem;

double resident_mib() {
  std::ifstream file("/proc/self/statm");
  double pages = 0.0, resident = 0.0;
  file >> pages >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1048576.0;
}

/// The resident memory after every lot, by samples done.
class MemoryWatch final : public ProgressListener {
 public:
  void advanced(std::string_view, double done, double, std::string_view) override {
    seen.emplace_back(done, resident_mib());
  }
  [[nodiscard]] double most_between(double first, double last) const {
    double most = 0.0;
    for (const auto& [done, mib] : seen) {
      if (done > first && done <= last) most = std::max(most, mib);
    }
    return most;
  }
  std::vector<std::pair<double, double>> seen;
};

/// A thousand samples of 128 × 128 cells of the example's San Francisco, from an atlas that the environment variable
/// SIGMASCAPE_SAN_FRANCISCO_ATLAS names, or one that is baked for the test.
TEST(SanFranciscoDataset, AThousandSamplesInFlatMemory) {
  if (!fs::exists(data_folder() / "san_francisco"))
    GTEST_SKIP() << "the folder san_francisco is not in " << data_folder() << "; set SIGMASCAPE_DATA";
  const ScratchFolder folder;
  const fs::path examples = fs::path(SIGMASCAPE_SOURCE_DIR) / "examples";
  const fs::path scene = examples / "san_francisco/san_francisco.toml";
  const char* named = std::getenv("SIGMASCAPE_SAN_FRANCISCO_ATLAS");
  const fs::path atlas = named != nullptr && *named != '\0' ? fs::path(named) : folder.path("atlas");
  if (!fs::exists(atlas)) {
    bake::BakeSettings settings;
    settings.aspects.azimuths_rad = {0.0, 0.5 * pi, pi, 1.5 * pi};
    settings.aspects.elevations_rad = {radians_from_deg(13.0), radians_from_deg(29.0)};
    settings.patches = {.texel_m = 8.0, .texels_per_side = 256};
    settings.sampling.samples_per_texel = 2;
    SilentProgress silent;
    bake::bake(scene::read_scene(scene), settings, atlas, silent);
  }
  const auto spec = folder.write(
      "spec.toml",
      fmt::format("[dataset]\nscene = \"{}\"\natlas = \"{}\"\nradar = \"{}\"\ncount = 1000\nseed = 1\n"
                  "cells = 128\ncell_m = 8.0\nfiles = \"webdataset\"\n"
                  "layers = [\"shadow\", \"layover\", \"incidence\", \"range\", \"class\", \"height\"]\n"
                  "[view]\nazimuth_deg = [0, 360]\nelevation_deg = [13, 29]\nslant_range_km = [15, 20]\n"
                  "[radar]\nrange_resolution_m = [4, 8]\n[speckle]\nlooks = 1\n[noise]\nsnr_db = [10, 30]\n"
                  "[[targets]]\nname = \"vehicle\"\nnumber = [0, 5]\nrcs_dbsm = [25, 45]\nsize_m = 5.0\n",
                  scene.string(), atlas.string(), (examples / "san_francisco/radar.toml").string()));
  const dataset::SampleMaker maker(dataset::read_dataset_spec(spec));
  MemoryWatch watch;
  const auto begin = std::chrono::steady_clock::now();
  const auto report = dataset::make_dataset(maker, folder.path("samples"), {}, watch);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  fmt::print("  1,000 samples of 128 x 128 in {:.1f} s: {:.2f} a second; {:.0f} MiB after 200, {:.0f} MiB at most\n",
             seconds, 1000.0 / seconds, watch.most_between(0.0, 200.0), watch.most_between(0.0, 1000.0));
  EXPECT_TRUE(report.is_complete);
  EXPECT_EQ(report.samples, 1000U);
  // Lots come and go; what they leave does not add up.
  EXPECT_LT(watch.most_between(200.0, 1000.0), 1.05 * watch.most_between(0.0, 200.0) + 8.0);

  std::ifstream stream(folder.path("samples/manifest.json"));
  const auto manifest = nlohmann::json::parse(stream);
  EXPECT_EQ(manifest.at("samples").size(), 1000U);
  EXPECT_EQ(manifest.at("tars").size(), 20U);
  // Of some 2,500 targets; between and under the houses of downtown hardly a tenth is seen.
  EXPECT_GT(manifest.at("boxes").get<int>(), 100);
}

}  // namespace
}  // namespace sigmascape::end_to_end
