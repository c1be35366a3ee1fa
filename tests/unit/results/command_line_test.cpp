#include "results/command_line.h"

#include <filesystem>
#include <gtest/gtest.h>

namespace sigmascape::cli {
namespace {

std::string line_of(const ResultsOptions& options) {
  return command_line(options, results_plan(options));
}

TEST(ResultsCommandLine, SpellsOutWhatFollowedFromSmall) {
  ResultsOptions options;
  options.small = true;
  options.traced_samples = 32;
  EXPECT_EQ(
      line_of(options),
      "sigmascape results --small --scale 0.2 --held-out 4 --on-grid 3 --repeated 3 --samples 64 --traced-samples 32 "
      "--finer-samples 64 --out out/results");
}

TEST(ResultsCommandLine, HasWhatWasSaidOtherwise) {
  ResultsOptions options;
  options.itu_materials = true;
  options.held_out = 2;
  options.seed = 7;
  options.bounces = 3;
  options.page = "docs/page.md";
  options.most_traced_samples = 6144;
  options.without_finest_grid = true;
  EXPECT_EQ(line_of(options),
            "sigmascape results --no-finest-grid --itu-materials --scale 0.5 --held-out 2 --on-grid 8 --repeated 3 "
            "--samples 100 "
            "--traced-samples 1024 --most-traced-samples 6144 --finer-samples 4096 --bounces 3 --seed 7 --out "
            "out/results --page docs/page.md");
}

TEST(ResultsCommandLine, NamesNoFolderOfTheMachine) {
  ResultsOptions options;
  options.small = true;
  options.scene_file = "/home/somebody/places/harbour.toml";
  options.around_m = {350.0, -400.0};
  options.folder = "/home/somebody/out";
  options.page = "../page.md";
  EXPECT_EQ(line_of(options),
            "sigmascape results --small --scene harbour.toml --around 350 -400 --scale 0.2 --held-out 4 --on-grid 3 "
            "--repeated 3 --samples 64 --traced-samples 256 --finer-samples 256");
  options.scene_file = (std::filesystem::current_path() / "examples/harbour.toml").string();
  EXPECT_NE(line_of(options).find("--scene examples/harbour.toml "), std::string::npos);
}

}  // namespace
}  // namespace sigmascape::cli
