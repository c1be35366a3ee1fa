#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <sys/wait.h>

#include "end_to_end/made_scene.h"
#include "scratch_folder.h"

namespace sigmascape::end_to_end {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// How words of a command line are understood.
class CommandLine : public ::testing::Test {
 protected:
  /// What it says; empty when it took the line.
  [[nodiscard]] std::string said_to(const std::string& arguments) const {
    const int status = std::system(
        fmt::format("cd '{}' && ('{}' {}) > said 2>&1", folder_.path(".").string(), SIGMASCAPE_CLI, arguments).c_str());
    EXPECT_TRUE(WIFEXITED(status)) << arguments << " was killed";
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return "";
    std::ifstream stream(folder_.path("said"));
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  void write_radar() const {
    folder_.write("radar.toml",
                  "[radar]\nfrequency_ghz = 10\nrange_resolution_m = 4\nbeam_width_deg = 0.1\n"
                  "[position]\nazimuth_deg = 180\nelevation_deg = 20\nslant_range_km = 5\n");
  }

  const ScratchFolder folder_;
};

TEST_F(CommandLine, AListIsOneWordAndLeavesThoseThatFollow) {
  write_radar();
  write_made_scene(folder_.path("town"), 200.0, 200.0);
  EXPECT_THAT(said_to("bake --out atlas --texel-m 4 --patch-texels 256 --samples 2 --azimuths 1 --frequencies-ghz 10 "
                      "--elevations-deg 20,30 town/scene.toml"),
              IsEmpty());
  EXPECT_THAT(said_to("render --layers-out layers.tif --layers shadow,class radar.toml --scene town/scene.toml "
                      "--samples 1 --out map.tif"),
              IsEmpty());
  EXPECT_THAT(said_to("compare --cells-m=8,16 map.tif map.tif --json"), IsEmpty());
  EXPECT_THAT(said_to("plot aspects --at 10,20 atlas --out plot.svg"), IsEmpty());
  // One word after the other, each for itself.
  EXPECT_THAT(said_to("compare --cells-m 8 --cells-m 16 map.tif map.tif"), IsEmpty());
  EXPECT_THAT(said_to("bake town/scene.toml --out atlas --elevations-deg 20 30"), HasSubstr("30"));
}

TEST_F(CommandLine, ACoordinateSystemOfNoCellsIsRefused) {
  const std::string render = "render radar.toml --scene none.toml --crs EPSG:25830 ";
  for (const char* file : {"", "--ppi scope.png", "--b-scope scope.png", "--snr snr.npy", "--video video.npy",
                           "--atlas atlas --iq pulses.npy"}) {
    EXPECT_THAT(said_to(render + file), HasSubstr("--crs: is of --out, --power, --png or --layers-out, which is not"));
  }
  for (const char* file : {"--out map.tif", "--power map.tif", "--png map.png", "--layers class --layers-out map.tif"})
    EXPECT_THAT(said_to(render + file), AllOf(HasSubstr("radar.toml"), Not(HasSubstr("--crs"))));
}

TEST_F(CommandLine, ExtrapolationWithoutAnAtlasIsRefused) {
  const std::string render = "render radar.toml --scene none.toml --extrapolate --out map.tif ";
  for (const char* traced : {"", "--lod 0", "--lod 0 --atlas atlas"}) {
    EXPECT_THAT(said_to(render + traced),
                StartsWith("sigmascape: --extrapolate: is of --lod 1 and up and of --iq, which is not asked for"));
  }
  for (const char* baked : {"--atlas atlas", "--lod 2 --atlas atlas", "--lod 0 --atlas atlas --iq pulses.npy"})
    EXPECT_THAT(said_to(render + baked), AllOf(HasSubstr("radar.toml"), Not(HasSubstr("--extrapolate"))));
}

TEST_F(CommandLine, ALinkNamesTheFileThatItLeadsTo) {
  write_radar();
  write_made_scene(folder_.path("town"), 200.0, 200.0);
  std::filesystem::create_directory(folder_.path("maps"));
  std::filesystem::create_symlink("maps/today.tif", folder_.path("latest.tif"));
  const std::string render = "render radar.toml --scene town/scene.toml --samples 1 ";
  ASSERT_THAT(said_to(render + "--out latest.tif"), IsEmpty());
  EXPECT_TRUE(std::filesystem::is_symlink(folder_.path("latest.tif")));
  EXPECT_THAT(said_to("compare maps/today.tif latest.tif"), IsEmpty());
  EXPECT_THAT(said_to(render + "--out maps/today.tif --power latest.tif"),
              HasSubstr("--power: names latest.tif, as --out does"));
  // What lies beside a file lies beside the one that a link leads to.
  std::filesystem::create_symlink("maps/today.npy", folder_.path("latest.npy"));
  std::filesystem::create_symlink("maps/today.power", folder_.path("power.npy"));
  EXPECT_THAT(said_to(render + "--out latest.npy --power power.npy"),
              HasSubstr("--power: names power.npy, which has maps/today.json beside it, as --out does"));
  ASSERT_THAT(said_to(render + "--out latest.npy"), IsEmpty());
  EXPECT_TRUE(std::filesystem::exists(folder_.path("maps/today.json")));
  // What a map is made from is not written over by another name either.
  std::filesystem::create_symlink("town/heights.asc", folder_.path("heights.tif"));
  EXPECT_THAT(said_to(render + "--out heights.tif"), HasSubstr("--out: names heights.tif, of what this is made from"));
}

}  // namespace
}  // namespace sigmascape::end_to_end
