#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <pty.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

#include "end_to_end/made_scene.h"
#include "end_to_end/process.h"
#include "scratch_folder.h"

namespace sigmascape::end_to_end {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

/// Bakes of a few houses, of as few looks as will do.
class BakeCommand : public ::testing::Test {
 protected:
  [[nodiscard]] std::string line(const std::string& subcommand, const std::string& options) const {
    return fmt::format("exec '{}' {} {}", SIGMASCAPE_CLI, subcommand, options);
  }
  [[nodiscard]] std::string bake_line(const std::string& atlas, const std::string& options) const {
    return line("bake", fmt::format("'{}' --out '{}' {}", scene_.string(), folder_.path(atlas).string(), options));
  }
  [[nodiscard]] Ended run(const std::string& line) const { return Process(line, folder_.path("printed.txt")).ended(); }
  [[nodiscard]] nlohmann::json baked(const std::string& atlas, const std::string& options) const {
    const Ended ended = run(bake_line(atlas, options + " --json"));
    EXPECT_EQ(ended.code, 0) << ended.printed;
    return ended.code == 0 ? ended.json() : nlohmann::json();
  }
  [[nodiscard]] nlohmann::json info_of(const std::string& atlas) const {
    return run(line("atlas info --json", folder_.path(atlas).string())).json();
  }

  const ScratchFolder folder_;
  const std::filesystem::path scene_ = write_made_scene(folder_.path("scene"), 240.0, 120.0);
};

constexpr const char* one_coarse_look = "--texel-m 4 --patch-texels 256 --azimuths 1 --elevations-deg 45";

TEST_F(BakeCommand, ThePresetOfThePaperIsAHundredRaysAndEightBounces) {
  const std::string options = std::string(one_coarse_look) + " --preset paper";
  ASSERT_EQ(baked("paper", options).at("looks"), 4);
  const nlohmann::json settings = info_of("paper").at("settings");
  EXPECT_EQ(settings.at("samples_per_texel"), "100");
  EXPECT_EQ(settings.at("max_bounces"), "8");
  EXPECT_FALSE(settings.contains("target_db"));
  for (const char* other : {"--samples 10", "--bounces 2", "--target-db 1", "--most-samples 64"}) {
    const Ended refused = run(bake_line("refused", options + " " + other));
    EXPECT_NE(refused.code, 0) << other;
    EXPECT_THAT(refused.printed, HasSubstr("excludes")) << other;
  }
}

TEST_F(BakeCommand, TargetsThatAreNoneAreRefusedByTheirOption) {
  for (const char* target : {"0", "-1", "nan", "11", "x"}) {
    const Ended refused = run(bake_line("refused", std::string("--target-db ") + target));
    EXPECT_EQ(refused.code, 2) << target;
    EXPECT_THAT(refused.printed, HasSubstr(fmt::format("--target-db: is {}; give a number from 0.01 to 10\n", target)));
  }
}

TEST_F(BakeCommand, WhatPartOfThePowerMissesTheTargetIsTold) {
  const auto part_above = [&](const std::string& atlas, const std::string& options) {
    const nlohmann::json summary = baked(atlas, std::string(one_coarse_look) + " --bounces 2 " + options);
    const nlohmann::json info = info_of(atlas);
    EXPECT_EQ(summary.at("above_target"), info.at("above_target"));
    EXPECT_EQ(summary.at("part_of_all"), info.at("part_of_all"));
    EXPECT_EQ(summary.at("relative_standard_error"), info.at("relative_standard_error").at("mean"));
    return summary.at("above_target");
  };
  const double few_rays = part_above("few", "--target-db 0.4 --most-samples 8");
  const double many_rays = part_above("many", "--target-db 0.4 --most-samples 512");
  EXPECT_GT(few_rays, 0.1);
  EXPECT_LT(many_rays, 0.8 * few_rays);
  EXPECT_TRUE(part_above("none", "--samples 8").is_null()) << "there is no target";
  const Ended text = run(line("atlas info", folder_.path("few").string()));
  EXPECT_THAT(text.printed,
              ContainsRegex("error +[0-9.]+ % of the power, [0-9.]+ % of what returns with the bare ground, "
                            "which has no noise\n +above target +[0-9]+ % of the power"));
  const std::string few_again = std::string(one_coarse_look) + " --bounces 2 --target-db 0.4 --most-samples 8";
  EXPECT_THAT(run(bake_line("fresh", few_again)).printed,
              ContainsRegex("error of what was baked now: [0-9.]+ % of the power, .*, [0-9]+ % of the power in texels "
                            "above the target"));
  EXPECT_THAT(run(bake_line("few", few_again)).printed,
              AllOf(HasSubstr("(4 already there"), Not(HasSubstr("above the target"))));
}

TEST_F(BakeCommand, WhereNothingStandsNoErrorIsTold) {
  const std::filesystem::path bare = folder_.path("bare.toml");
  std::string scene;
  std::getline(std::ifstream(scene_), scene, '\0');
  std::ofstream(bare) << scene.erase(scene.find("[[buildings]]")).replace(scene.find("heights"), 0, "scene/");
  const std::string options = std::string(one_coarse_look) + " --most-samples 8 --bounces 2";
  const std::string bake =
      line("bake", fmt::format("'{}' --out '{}' {}", bare.string(), folder_.path("bare").string(), options));
  EXPECT_THAT(run(bake).printed, HasSubstr("error of what was baked now: none, for no texel returns anything"));
  const nlohmann::json info = info_of("bare");
  EXPECT_TRUE(info.at("relative_standard_error").at("mean").is_null());
  EXPECT_TRUE(info.at("above_target").is_null());
  EXPECT_EQ(info.at("part_of_all"), 0.0);
  EXPECT_THAT(run(line("atlas info", folder_.path("bare").string())).printed,
              ContainsRegex("error +none, for no texel returns anything\n"));
  EXPECT_THAT(run(line("atlas info", folder_.path("bare/ground").string())).printed,
              ContainsRegex("error +not told by what is there\n"));
}

TEST_F(BakeCommand, OfNothingThatWasBakedNoErrorIsTold) {
  const std::string options = std::string(one_coarse_look) + " --samples 8 --bounces 2";
  EXPECT_GT(baked("again", options).at("relative_standard_error").get<double>(), 0.0);
  EXPECT_TRUE(baked("again", options).at("relative_standard_error").is_null());
  EXPECT_THAT(run(bake_line("again", options)).printed,
              AllOf(HasSubstr("(4 already there)"), Not(HasSubstr("error")), Not(HasSubstr("rays"))));
}

// The scene's own elevation raster is called as that of an atlas is.
TEST_F(BakeCommand, IntoTheFolderOfTheSceneNothingIsWrittenOver) {
  const std::filesystem::path folder = scene_.parent_path();
  std::filesystem::rename(folder / "heights.asc", folder / "terrain.tif");
  std::string scene;
  std::getline(std::ifstream(scene_), scene, '\0');
  std::ofstream(scene_) << scene.replace(scene.find("heights.asc"), 11, "terrain.tif");
  const auto before = files_of(folder);
  for (const char* plan : {"", " --plan"}) {
    const Ended refused =
        run(line("bake", fmt::format("'{}' --out '{}' {}{}", scene_.string(), folder.string(), one_coarse_look, plan)));
    EXPECT_EQ(refused.code, 1) << refused.printed;
    EXPECT_THAT(refused.printed, HasSubstr("holds terrain.tif, which is of no atlas, and a bake would write over it"));
  }
  EXPECT_EQ(difference_of(files_of(folder), before), "");
}

TEST_F(BakeCommand, ALogIsAddedToNoFileButALog) {
  const std::string options = std::string(one_coarse_look) + " --samples 2 --bounces 1";
  ASSERT_EQ(run(bake_line("a", options)).code, 0);
  folder_.write("scene/notes.txt", "of others\n");
  const auto atlas_before = files_of(folder_.path("a")), scene_before = files_of(folder_.path("scene"));
  const auto said_to_log = [&](const std::string& atlas, const std::string& file) {
    const Ended refused =
        run(bake_line(atlas, fmt::format("{} --json-log '{}'", options, folder_.path(file).string())));
    EXPECT_EQ(refused.code, 1) << file << refused.printed;
    return refused.printed;
  };
  const std::string is_read = ", of what this is made from; give it a file of its own";
  EXPECT_THAT(said_to_log("a", "scene/scene.toml"), AllOf(HasSubstr("--json-log: names "), HasSubstr(is_read)));
  EXPECT_THAT(said_to_log("a", "scene/houses.csv"), HasSubstr(is_read));
  const std::string of_atlas = ", in the folder of --out and by a name as an atlas may have; end it in .jsonl";
  EXPECT_THAT(said_to_log("a", "a/collection.json"), HasSubstr("a/collection.json" + of_atlas));
  EXPECT_THAT(said_to_log("b", "b/terrain.tif"), HasSubstr("b/terrain.tif" + of_atlas));
  EXPECT_THAT(said_to_log("b/", "b/terrain.tif"), HasSubstr("b/terrain.tif" + of_atlas));
  EXPECT_THAT(said_to_log("a", "a/ground/../buildings.json"), HasSubstr("buildings.json" + of_atlas));
  EXPECT_THAT(said_to_log("a", "a/patch_+000_+000/catalog.json"), HasSubstr("catalog.json" + of_atlas));
  EXPECT_THAT(said_to_log("a", "scene/notes.txt"), HasSubstr("notes.txt: holds something else"));
  EXPECT_EQ(difference_of(files_of(folder_.path("a")), atlas_before), "");
  EXPECT_EQ(difference_of(files_of(folder_.path("scene")), scene_before), "");
}

TEST_F(BakeCommand, BuildingsThatAreKeptApartAreToldVerifiedAndMended) {
  const std::string options = std::string(one_coarse_look) + " --samples 2 --bounces 2 --buildings apart";
  ASSERT_EQ(baked("apart", options).at("looks"), 4);
  EXPECT_EQ(info_of("apart").at("settings").at("buildings"), "apart");
  EXPECT_EQ(info_of("apart").at("buildings").at("faults").size(), 0U);
  const std::string verify = line("atlas verify", folder_.path("apart").string());
  EXPECT_EQ(run(verify).code, 0);
  const std::filesystem::path file = folder_.path("apart") / "buildings.glb";
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 1);
  EXPECT_THAT(run(verify).printed, HasSubstr("buildings.glb is truncated"));
  EXPECT_EQ(info_of("apart").at("buildings").at("faults").size(), 1U);
  EXPECT_THAT(run(bake_line("apart", options)).printed, HasSubstr("buildings.glb"));
  EXPECT_EQ(run(verify).code, 0);
  EXPECT_TRUE(info_of("apart").at("buildings").at("textures").is_null());
  const Ended refused = run(bake_line("level", options + " --footing level"));
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.printed, HasSubstr("let objects stand on their own terrain"));
}

TEST_F(BakeCommand, BuildingsThatAreKeptApartAndBakedAreToldAndVerified) {
  const std::string options = std::string(one_coarse_look) + " --samples 2 --bounces 2 --buildings both";
  ASSERT_EQ(baked("both", options).at("looks"), 4);
  const nlohmann::json told = info_of("both").at("buildings");
  EXPECT_EQ(told.at("faults").size(), 0U);
  EXPECT_EQ(told.at("textures").at("files_done"), told.at("textures").at("files"));
  const std::string verify = line("atlas verify", folder_.path("both").string());
  EXPECT_EQ(run(verify).code, 0);
  std::filesystem::remove(folder_.path("both") / "buildings" / "collection.json");
  EXPECT_THAT(run(verify).printed, HasSubstr("buildings/collection.json is missing"));
  EXPECT_TRUE(info_of("both").at("buildings").at("textures").at("files").is_null());
  EXPECT_THAT(run(bake_line("both", options)).printed, Not(HasSubstr("rays")));
  EXPECT_EQ(run(verify).code, 0);
}

TEST_F(BakeCommand, TheGroundOfAnAtlasLacksNoTerrainOfItsOwn) {
  ASSERT_EQ(baked("a", std::string(one_coarse_look) + " --samples 2 --bounces 1").at("looks"), 4);
  EXPECT_EQ(info_of("a/ground").at("terrain").at("faults").size(), 0U);
  const Ended verified = run(line("atlas verify", folder_.path("a/ground").string()));
  EXPECT_EQ(verified.code, 0) << verified.printed;
}

TEST_F(BakeCommand, ALogGoesOnBehindPartOfALineAndIntoTheOutputOfAJob) {
  const std::string options = std::string(one_coarse_look) + " --samples 2 --bounces 1";
  folder_.write("log.jsonl", R"({"ta)");
  for (int start = 0; start < 2; ++start)
    EXPECT_EQ(run(bake_line("a", options + fmt::format(" --json-log '{}'", folder_.path("log.jsonl").string()))).code,
              0);
  folder_.write("job.txt", "the job starts\n");
  const std::string into_job = fmt::format(" --json-log /dev/stdout >> '{}'", folder_.path("job.txt").string());
  EXPECT_EQ(run(bake_line("a", options + into_job)).code, 0);
  std::ifstream job(folder_.path("job.txt"));
  const std::string written{std::istreambuf_iterator<char>(job), {}};
  EXPECT_THAT(written, AllOf(HasSubstr("the job starts\n"), HasSubstr(R"({"task":)")));
}

TEST_F(BakeCommand, ALogIntoItsOwnOutputIsWrittenOverByNothing) {
  const std::string options = std::string(one_coarse_look) + " --samples 2 --bounces 1";
  const std::string job = folder_.path("job.txt").string();
  EXPECT_EQ(run(bake_line("a", options + fmt::format(" --json-log /dev/stdout > '{}'", job))).code, 0);
  std::ifstream lines(job);
  std::size_t logged = 0;
  std::string line;
  while (std::getline(lines, line) && line.starts_with('{')) {
    EXPECT_TRUE(nlohmann::json::accept(line)) << line;
    ++logged;
  }
  EXPECT_GT(logged, 3U);
  EXPECT_THAT(line, HasSubstr("4 looks in "));
}

TEST_F(BakeCommand, ALogWhoseReaderHasGoneIsToldAndNotWaitedFor) {
  const std::string pipe = folder_.path("pipe").string();
  const Ended ended = run(fmt::format(
      "mkfifo '{0}'; : < '{0}' & {1}", pipe,
      bake_line("a", std::string(one_coarse_look) + fmt::format(" --samples 2 --bounces 1 --json-log '{}'", pipe))));
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(ended.said, HasSubstr("pipe: cannot be written (Broken pipe)"));
}

// On standard error, so that a summary in JSON stays what it is; what lies outside by rights is for `scene info` alone.
TEST_F(BakeCommand, WhatIsLikelyAMistakeInTheSceneIsSaidOnceWhereverItIsWorkedOn) {
  std::ofstream(scene_, std::ios::app) << "[[buildings]]\nfile = \"houses.csv\"\ncrs = \"EPSG:25830\"\n"
                                          "height_attribute = \"height\"\nwhere = \"height = 'unheard of'\"\n";
  folder_.write("radar.toml",
                "[radar]\nfrequency_ghz = 10\nrange_resolution_m = 4\nbeam_width_deg = 0.1\n"
                "[position]\nazimuth_deg = 180\nelevation_deg = 20\nslant_range_km = 5\n");
  const std::string few = std::string(one_coarse_look) + " --samples 2 --bounces 1 --json";
  const std::string traced =
      fmt::format("'{}' --scene '{}' --samples 1 --out '{}' --json", folder_.path("radar.toml").string(),
                  scene_.string(), folder_.path("map.tif").string());
  for (const std::string& command :
       {bake_line("said", few), bake_line("planned", few + " --plan"), line("render", traced)}) {
    const Ended ended = run(command);
    ASSERT_EQ(ended.code, 0) << ended.printed;
    EXPECT_TRUE(ended.json().is_object());
    const std::string warning =
        "warning: scene: files without a feature that is asked for, of which nothing is used: 1";
    const std::size_t found = ended.said.find(warning);
    ASSERT_NE(found, std::string::npos) << ended.said;
    EXPECT_THAT(ended.said.substr(found), ContainsRegex("first .*houses.csv: none meets where .*\n"));
    EXPECT_EQ(ended.said.find("warning: scene", found + 1), std::string::npos) << ended.said;
  }
}

// Of runs that take long, at once: these end for another reason when they have read the scene.
TEST_F(BakeCommand, WhatIsLikelyAMistakeInTheSceneIsSaidBeforeItIsMeasured) {
  std::ofstream(scene_, std::ios::app) << "[[buildings]]\nfile = \"houses.csv\"\ncrs = \"EPSG:25830\"\n"
                                          "height_attribute = \"height\"\nwhere = \"height = 'unheard of'\"\n";
  for (const std::string& command : {line("demo", fmt::format("--scene '{0}' --out '{0}/demo'", scene_.string())),
                                     line("results", fmt::format("--scene '{}' --scale 100 --out '{}'", scene_.string(),
                                                                 folder_.path("results").string()))}) {
    const Ended ended = run(command);
    EXPECT_EQ(ended.code, 1) << ended.printed;
    EXPECT_THAT(ended.said, HasSubstr("warning: scene: files without a feature that is asked for")) << command;
  }
}

/// What a command line prints on a terminal.
std::string printed_on_a_terminal(const std::string& line) {
  int terminal = -1;
  const pid_t pid = ::forkpty(&terminal, nullptr, nullptr, nullptr);
  if (pid == 0) {
    ::execl("/bin/bash", "bash", "-c", line.c_str(), nullptr);
    ::_exit(127);
  }
  std::string printed;
  std::array<char, 4096> part{};
  // Ends with an error when the last process has left the terminal.
  for (ssize_t length = 1; length > 0;) {
    length = ::read(terminal, part.data(), part.size());
    if (length > 0) printed.append(part.data(), static_cast<std::size_t>(length));
  }
  int status = 0;
  ::waitpid(pid, &status, 0);
  EXPECT_EQ(status, 0) << printed;
  ::close(terminal);
  return printed;
}

TEST_F(BakeCommand, ATerminalShowsHowFarAPlanIs) {
  EXPECT_THAT(printed_on_a_terminal(bake_line("planned",
                                              "--texel-m 0.5 --patch-texels 256 --azimuths 2 --elevations-deg 30 "
                                              "--samples 512 --threads 1 --plan")),
              ContainsRegex("plan: 0\\.[0-9] of 1 looks, "));
}

TEST_F(BakeCommand, ATerminalShowsLooksRaysErrorAndTimeLeft) {
  const std::string shown = printed_on_a_terminal(bake_line(
      "watched", "--texel-m 0.5 --patch-texels 256 --azimuths 2 --elevations-deg 30 --samples 64 --threads 1"));
  EXPECT_THAT(shown, ContainsRegex("bake: [0-9]+\\.[0-9] of [0-9]+ looks, [0-9.]+ million rays a second, "
                                   "error [0-9.]+ %, [0-9.]+ [a-z]+ left"));
  EXPECT_THAT(shown.substr(shown.rfind("looks in ")), AllOf(HasSubstr(" s, "), HasSubstr("million rays")));
}

}  // namespace
}  // namespace sigmascape::end_to_end
