// How many labelled samples of 256 × 256 cells does a machine make in a second from an atlas that is there, and does
// its memory grow with their number?

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <string>
#include <unistd.h>

#include "figures.h"

#include "sigmascape/bake/bake.h"
#include "sigmascape/base/units.h"
#include "sigmascape/dataset/dataset_run.h"
#include "sigmascape/scene/scene_file.h"

namespace {

using namespace sigmascape;         // NOLINT: a program of its own
using namespace sigmascape::bench;  // NOLINT
namespace fs = std::filesystem;

/// A folder that goes with the program.
class Scratch {
 public:
  Scratch() : folder_(fs::temp_directory_path() / fmt::format("sigmascape_dataset_bench_{}", getpid())) {
    fs::create_directories(folder_);
  }
  ~Scratch() { fs::remove_all(folder_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  [[nodiscard]] fs::path path(const char* name) const { return folder_ / name; }
  void write(const char* name, const std::string& text) const { std::ofstream(path(name)) << text; }

 private:
  fs::path folder_;
};

double resident_mib() {
  std::ifstream file("/proc/self/statm");
  double pages = 0.0, resident = 0.0;
  file >> pages >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1048576.0;
}

/// Hears how far the run has come and looks at the memory then.
class MemoryWatch final : public ProgressListener {
 public:
  void advanced(std::string_view, double done, double total, std::string_view) override {
    const double now = resident_mib();
    // The first lot counts as early however few there are.
    if (early_ == 0.0 || done <= 0.3 * total) early_ = std::max(early_, now);
    late_ = std::max(late_, now);
  }
  /// Of the most that the run held over the most that it held in its first third.
  [[nodiscard]] double growth() const { return late_ / early_; }

 private:
  double early_ = 0.0, late_ = 0.0;
};

/// The paper's landscape at a quarter of its size, 500 × 500 m, in 256 × 256 cells of 1 m with all labels that an atlas
/// gives.
dataset::DatasetSpec made_spec(const Scratch& scratch, std::size_t count) {
  scratch.write("scene.toml", "[paper]\nscale = 0.25\n");
  scratch.write("radar.toml",
                "[radar]\nfrequency_ghz = 10\nrange_resolution_m = 1\nbeam_width_deg = 0.006\n"
                "[position]\nazimuth_deg = 0\nelevation_deg = 13\nslant_range_km = 15\n");
  scratch.write("spec.toml",
                fmt::format("[dataset]\nscene = \"scene.toml\"\nradar = \"radar.toml\"\natlas = \"atlas\"\ncount = {}\n"
                            "cells = 256\ncell_m = 1.0\nfiles = \"webdataset\"\nsamples_per_shard = 10\n"
                            "layers = [\"shadow\", \"layover\", \"incidence\", \"range\", \"class\", \"height\"]\n"
                            "[view]\nazimuth_deg = [0, 360]\nelevation_deg = [8, 21]\nslant_range_km = [15, 20]\n"
                            "[speckle]\nlooks = 1\n[noise]\nsnr_db = [10, 30]\n"
                            "[[targets]]\nname = \"vehicle\"\nnumber = [0, 5]\nrcs_dbsm = [15, 35]\nsize_m = 5.0\n",
                            count));
  bake::BakeSettings settings;
  settings.aspects.azimuths_rad = {0.0, 0.5 * pi, pi, 1.5 * pi};
  settings.aspects.elevations_rad = {radians_from_deg(8.0), radians_from_deg(21.0)};
  settings.patches = {.texel_m = 1.0, .texels_per_side = 512};
  settings.sampling.samples_per_texel = 2;
  SilentProgress silent;
  bake::bake(scene::read_scene(scratch.path("scene.toml")), settings, scratch.path("atlas"), silent);
  return dataset::read_dataset_spec(scratch.path("spec.toml"));
}

void measure(const Arguments& arguments) {
  Figures figures(arguments.out);
  const Scratch scratch;
  const std::size_t count = arguments.quick ? 20 : 100;
  const dataset::SampleMaker maker(made_spec(scratch, count));
  MemoryWatch watch;
  const double wall = wall_seconds(), processor = processor_seconds();
  const auto report = dataset::make_dataset(maker, scratch.path("samples"), {}, watch);
  const double wall_s = wall_seconds() - wall, processor_s = processor_seconds() - processor;
  prove(report.is_complete && report.samples == count, "all samples are there");
  const auto samples = static_cast<double>(count);
  figures.add("dataset.samples_per_second", samples / wall_s, "1/s", "256 x 256 cells with six labels, atlas loaded");
  figures.add("dataset.sample_processor_ms", 1e3 * processor_s / samples, "ms", "all threads together");
  figures.add("dataset.memory_mib", resident_mib(), "MiB", "resident at the end");
  figures.add("dataset.memory_growth", watch.growth(), "", "most of the run over most of its first third");
}

}  // namespace

int main(int argc, char** argv) {
  measure(Arguments::parsed(argc, argv));
  return 0;
}
