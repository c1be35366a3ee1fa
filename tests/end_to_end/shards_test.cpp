#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/mount.h>
#include <thread>
#include <unistd.h>

#include "end_to_end/made_scene.h"
#include "end_to_end/process.h"
#include "scratch_folder.h"

namespace sigmascape::end_to_end {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

/// Sixteen looks of eight patches, baked once by one process; other tests must come to the same bytes.
class Shards : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fs::temp_directory_path() / fmt::format("sigmascape_shards_test_{}", getpid());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    scene_ = write_made_scene(folder_ / "scene", 700.0, 200.0);
    const Ended whole = baked("whole", "--threads 2");
    ASSERT_EQ(whole.code, 0) << whole.printed;
    whole_ = files_of(folder_ / "whole");
    // 16 looks of three files and 8 textures above them of two; the ground's own store, obstacles and terrain besides.
    ASSERT_GT(whole_.size(), 3U * 16U + 2U * 8U);
    ASSERT_TRUE(whole_.contains(obstacles_above));
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }

  /// `exec` makes the process that is killed the program itself.
  static std::string bake_line(const std::string& atlas, const std::string& options) {
    return fmt::format(
        "exec '{}' bake '{}' --out '{}' --texel-m 1 --patch-texels 256 --azimuths 2 --elevations-deg 30 --samples 4 "
        "--bounces 2 --json {}",
        SIGMASCAPE_CLI, scene_.string(), (folder_ / atlas).string(), options);
  }
  static Process start(const std::string& line) {
    static int serial = 0;
    return {line, folder_ / fmt::format("printed_{}.txt", ++serial)};
  }
  static Ended run(const std::string& line) { return start(line).ended(); }
  static Ended run_cli(const std::string& arguments) { return run(fmt::format("'{}' {}", SIGMASCAPE_CLI, arguments)); }
  static Ended baked(const std::string& atlas, const std::string& options = "") {
    return run(bake_line(atlas, options));
  }
  static std::string path_of(const std::string& atlas) { return (folder_ / atlas).string(); }

  static constexpr const char* obstacles = "patch_-001_+000/obstacles.tif";
  static constexpr const char* obstacles_above = "pyramid_1/patch_+000_+000/obstacles.tif";
  static inline fs::path folder_, scene_;
  static inline std::map<std::string, std::string> whole_;
};

/// Looks of patches that are vouched for by an item.
std::size_t looks_in(const fs::path& atlas) {
  std::size_t looks = 0;
  if (!fs::exists(atlas)) return looks;
  for (const auto& folder : fs::directory_iterator(atlas)) {
    if (!folder.path().filename().string().starts_with("patch")) continue;
    for (const auto& file : fs::directory_iterator(folder)) {
      const std::string name = file.path().filename().string();
      looks += name.starts_with("az") && name.ends_with(".json") ? 1U : 0U;
    }
  }
  return looks;
}

/// What a bake says that it has mended, each fault up to its colon.
std::vector<std::string> mended_by(const Ended& bake) {
  std::vector<std::string> mended;
  const nlohmann::json summary = bake.json();
  for (const nlohmann::json& one : summary.at("mended")) {
    const std::string fault = one.at("fault");
    mended.push_back(one.at("file").get<std::string>() + " " + fault.substr(0, fault.find(':')));
  }
  return mended;
}

constexpr const char* a_texture = "patch_-001_+000/az180.0_el30.0_f10.000GHz.tif";

TEST_F(Shards, ThreeProcessesWithDifferentThreadsMakeTheBytesOfOne) {
  std::vector<Process> shards;
  for (int i = 0; i < 3; ++i) {
    shards.push_back(start(bake_line("three", fmt::format("--shard {}/3 --threads {}", i, i + 1))));
  }
  std::size_t looks = 0, pyramid = 0;
  for (const Process& shard : shards) {
    const Ended ended = shard.ended();
    ASSERT_EQ(ended.code, 0) << ended.printed;
    looks += ended.json().at("looks").get<std::size_t>();
    pyramid += ended.json().at("pyramid").get<std::size_t>();
  }
  EXPECT_EQ(looks, 16U);
  EXPECT_GE(pyramid, 8U) << "two shards that end at once may both write a texture";
  EXPECT_EQ(difference_of(files_of(folder_ / "three"), whole_), "");
}

TEST_F(Shards, KilledAtAnyMomentItGoesOnToTheSameBytes) {
  std::size_t killed = 0;
  const auto kill_after = [&killed](std::size_t looks, int milliseconds) {
    const Process process = start(bake_line("killed", "--threads 1"));
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (looks_in(folder_ / "killed") < std::min<std::size_t>(looks, 16) &&
           std::chrono::steady_clock::now() < give_up) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    process.kill();
    killed += process.ended().code == -1 ? 1U : 0U;
  };
  for (const int milliseconds : {40, 90, 130, 250, 350}) kill_after(0, milliseconds);
  for (const int milliseconds : {0, 7, 19, 41, 83}) kill_after(looks_in(folder_ / "killed") + 1, milliseconds);
  EXPECT_GE(killed, 5U);
  const std::size_t finished = looks_in(folder_ / "killed");
  EXPECT_GE(finished, 5U);
  const Ended last = baked("killed");
  ASSERT_EQ(last.code, 0) << last.printed;
  EXPECT_EQ(last.json().at("already"), finished) << "what was finished before a kill is baked once";
  // A temporary file of the collection, a catalog or the pyramid may stay, since another process might be writing it.
  auto found = files_of(folder_ / "killed");
  std::erase_if(found, [](const auto& file) {
    const bool is_others = !file.first.starts_with("patch") || file.first.find("/.catalog.json") != std::string::npos;
    return file.first.ends_with(".tmp") && is_others;
  });
  EXPECT_EQ(difference_of(found, whole_), "");
}

TEST_F(Shards, TwoProcessesInOneFolderShareTheWork) {
  const Process one = start(bake_line("two", "--threads 1")), other = start(bake_line("two", "--threads 1"));
  const nlohmann::json first = one.ended().json(), second = other.ended().json();
  const auto baked_by = [](const nlohmann::json& report) {
    return report.at("looks").get<int>() - report.at("already").get<int>() - report.at("elsewhere").get<int>();
  };
  EXPECT_EQ(baked_by(first) + baked_by(second), 16) << "no look is baked twice";
  EXPECT_EQ(difference_of(files_of(folder_ / "two"), whole_), "");
}

TEST_F(Shards, DamageIsFoundNamedAndMended) {
  fs::copy(folder_ / "whole", folder_ / "damaged", fs::copy_options::recursive);
  ASSERT_EQ(run_cli(fmt::format("atlas verify '{}'", path_of("damaged"))).code, 0);
  const std::string truncated = "patch_+000_+000/az000.0_el30.0_f10.000GHz.tif";
  const std::string above = "pyramid_1/patch_+000_+000/az000.0_el30.0_f10.000GHz.tif";
  fs::resize_file(folder_ / "damaged" / truncated, 1000);
  fs::remove(folder_ / "damaged" / above);
  fs::resize_file(folder_ / "damaged" / obstacles, 1000);
  fs::remove(folder_ / "damaged" / obstacles_above);
  const std::string catalog = "patch_-001_+000/catalog.json", catalog_above = "pyramid_1/patch_+000_+000/catalog.json";
  std::fstream(folder_ / "damaged" / catalog, std::ios::binary | std::ios::in | std::ios::out).put('[');
  fs::remove(folder_ / "damaged" / catalog_above);
  fs::remove(folder_ / "damaged/ground" / catalog);
  {
    std::fstream file(folder_ / "damaged" / a_texture, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(-1, std::ios::end);
    file.put('?');
  }
  const std::string altered_item = "patch_-002_+000/az000.0_el30.0_f10.000GHz.json";
  const std::string removed_item = "patch_-002_-001/az000.0_el30.0_f10.000GHz.json";
  const std::string of_ground = "ground/patch_+000_+000/az000.0_el00.2_f10.000GHz.tif";
  {
    std::string item = whole_.at(altered_item);
    const std::string scale = "\"sigmascape:scale\": ";
    std::ofstream(folder_ / "damaged" / altered_item, std::ios::binary)
        << item.insert(item.find(scale) + scale.size(), "1024");
  }
  fs::remove(folder_ / "damaged" / removed_item);
  // One that was written this minute might be on its way.
  fs::last_write_time((folder_ / "damaged" / removed_item).replace_extension(".tif"),
                      fs::file_time_type::clock::now() - std::chrono::hours(1));
  fs::resize_file(folder_ / "damaged" / of_ground, 1000);
  fs::resize_file(folder_ / "damaged/terrain.tif", 100);
  const Ended verified = run_cli(fmt::format("atlas verify '{}'", path_of("damaged")));
  EXPECT_EQ(verified.code, 1);
  EXPECT_THAT(verified.printed, HasSubstr(altered_item + " was altered: its own SHA-256 is not the recorded one"));
  EXPECT_THAT(verified.printed,
              HasSubstr(removed_item + " is missing, so the file that it vouches for does not count"));
  EXPECT_THAT(verified.printed, HasSubstr(of_ground + " is truncated: 1000 of"));
  EXPECT_THAT(verified.printed, HasSubstr("terrain.tif is truncated: 100 of"));
  EXPECT_THAT(verified.printed, HasSubstr(truncated + " is truncated: 1000 of"));
  EXPECT_THAT(verified.printed, HasSubstr(a_texture + std::string(" was altered")));
  EXPECT_THAT(verified.printed, HasSubstr(above + " is missing"));
  EXPECT_THAT(verified.printed, HasSubstr(obstacles + std::string(" is truncated: 1000 of")));
  EXPECT_THAT(verified.printed, HasSubstr(obstacles_above + std::string(" is missing")));
  EXPECT_THAT(verified.printed, HasSubstr(catalog + " does not link what the atlas is planned to hold"));
  EXPECT_THAT(verified.printed, HasSubstr(catalog_above + " is missing"));
  EXPECT_THAT(verified.printed, HasSubstr("ground/" + catalog + " is missing"));
  const Ended as_json = run_cli(fmt::format("atlas verify --json '{}'", path_of("damaged")));
  EXPECT_EQ(as_json.code, 1);
  EXPECT_EQ(as_json.json().at("faults").size(), 12U);

  const Ended by_size = baked("damaged");
  EXPECT_EQ(by_size.json().at("already"), 13) << "a file of the right size is only found with --verify";
  const std::string without_file = " is missing, though its item is there";
  EXPECT_THAT(mended_by(by_size),
              UnorderedElementsAre(truncated + " is truncated", altered_item + " was altered",
                                   removed_item + " is missing, so the file that it vouches for does not count",
                                   obstacles + std::string(" is truncated"), obstacles_above + without_file,
                                   above + without_file, of_ground + " is truncated", "terrain.tif is truncated",
                                   catalog_above + " is missing", "ground/" + catalog + " is missing"));
  const std::string tile = "terrain/level_0/0_0.tif";
  fs::resize_file(folder_ / "damaged" / tile, 1000);
  const Ended by_content = baked("damaged", "--verify");
  EXPECT_EQ(by_content.json().at("already"), 15);
  EXPECT_THAT(mended_by(by_content),
              UnorderedElementsAre(a_texture + std::string(" was altered"), tile + " is truncated or was altered",
                                   catalog + " does not link what the atlas is planned to hold"));
  EXPECT_EQ(run_cli(fmt::format("atlas verify '{}'", path_of("damaged"))).code, 0);
  EXPECT_EQ(difference_of(files_of(folder_ / "damaged"), whole_), "");
}

// Each file is as it was written, in a place that is not its own.
TEST_F(Shards, WhatStandsInThePlaceOfAnotherIsFoundNamedAndMended) {
  fs::copy(folder_ / "whole", folder_ / "swapped", fs::copy_options::recursive);
  const fs::path patch = folder_ / "swapped/patch_+000_+000";
  for (const char* ending : {".tif", ".json", "_error.tif"}) {
    fs::copy_file(patch / fmt::format("az000.0_el30.0_f10.000GHz{}", ending),
                  patch / fmt::format("az180.0_el30.0_f10.000GHz{}", ending), fs::copy_options::overwrite_existing);
  }
  fs::rename(folder_ / "swapped/patch_-001_+000", folder_ / "swapped/kept");
  fs::rename(folder_ / "swapped/patch_-002_+000", folder_ / "swapped/patch_-001_+000");
  fs::rename(folder_ / "swapped/kept", folder_ / "swapped/patch_-002_+000");
  const Ended verified = run_cli(fmt::format("atlas verify '{}'", path_of("swapped")));
  EXPECT_EQ(verified.code, 1);
  EXPECT_THAT(
      verified.printed,
      HasSubstr("patch_+000_+000/az180.0_el30.0_f10.000GHz.json is of patch_+000_+000_az000.0_el30.0_f10.000GHz "
                "and stands in the place of patch_+000_+000_az180.0_el30.0_f10.000GHz"));
  EXPECT_THAT(verified.printed, HasSubstr("patch_-002_+000/obstacles.json is of patch_-001_+000_obstacles"));
  EXPECT_EQ(baked("swapped", "--verify").json().at("already"), 16 - 5);
  EXPECT_EQ(difference_of(files_of(folder_ / "swapped"), whole_), "");
}

TEST_F(Shards, TerrainThatIsMissingIsNamed) {
  fs::copy(folder_ / "whole", folder_ / "level", fs::copy_options::recursive);
  fs::remove_all(folder_ / "level/terrain");
  const std::string verify = fmt::format("atlas verify '{}'", path_of("level"));
  const Ended missing = run_cli(verify);
  EXPECT_EQ(missing.code, 1);
  EXPECT_THAT(missing.printed, HasSubstr("terrain/ is missing\n1 fault in "));
  EXPECT_EQ(baked("level").code, 0);
  EXPECT_EQ(run_cli(verify).code, 0);
  fs::resize_file(folder_ / "level/terrain/pyramid.toml", 40);
  EXPECT_THAT(run_cli(verify).printed, HasSubstr("terrain/pyramid.toml is truncated or was altered\n1 fault in "));
  EXPECT_THAT(mended_by(baked("level", "--verify")),
              UnorderedElementsAre("terrain/pyramid.toml is truncated or was altered"));
  EXPECT_EQ(difference_of(files_of(folder_ / "level"), whole_), "");
}

TEST_F(Shards, OfNoLookNoErrorIsTold) {
  fs::create_directories(folder_ / "begun");
  fs::copy_file(folder_ / "whole/collection.json", folder_ / "begun/collection.json");
  const Ended json = run_cli(fmt::format("atlas info --json '{}'", path_of("begun")));
  EXPECT_EQ(json.json().at("looks_done"), 0);
  EXPECT_TRUE(json.json().at("relative_standard_error").at("mean").is_null());
  EXPECT_THAT(run_cli(fmt::format("atlas info '{}'", path_of("begun"))).printed,
              ::testing::ContainsRegex("error +none yet"));
}

// The looks say what the atlas is of, so that nothing is lost with it.
TEST_F(Shards, ADamagedCollectionIsToldAndMended) {
  fs::copy(folder_ / "whole", folder_ / "torn", fs::copy_options::recursive);
  const std::string collection = path_of("torn/collection.json");
  fs::resize_file(collection, 300);
  const std::string verify = fmt::format("atlas verify '{}'", path_of("torn"));
  for (const Ended& ended :
       {baked("torn"), run_cli(fmt::format("atlas info '{}'", path_of("torn"))), run_cli(verify)}) {
    EXPECT_EQ(ended.code, 1);
    EXPECT_THAT(ended.printed, HasSubstr(collection + ": is truncated or was altered"));
    EXPECT_THAT(ended.printed, HasSubstr("remove this one file and bake again with the same settings"));
    EXPECT_THAT(ended.printed, Not(HasSubstr("json.exception")));
  }
  fs::remove(collection);
  EXPECT_EQ(baked("torn").json().at("already"), 16);
  EXPECT_EQ(difference_of(files_of(folder_ / "torn"), whole_), "");

  fs::copy_file(collection, folder_ / "torn/ground/collection.json", fs::copy_options::overwrite_existing);
  const Ended verified = run_cli(verify);
  EXPECT_EQ(verified.code, 1);
  EXPECT_THAT(verified.printed, HasSubstr("ground/collection.json was altered"));
  EXPECT_THAT(mended_by(baked("torn", "--verify")), UnorderedElementsAre("ground/collection.json was altered"));
  EXPECT_EQ(difference_of(files_of(folder_ / "torn"), whole_), "");
}

// Two that begin at once in one folder: one is refused, and the other's atlas is its own.
TEST_F(Shards, TwoWithDifferentSettingsDoNotMix) {
  const Process one = start(bake_line("mixed", "--threads 1")),
                other = start(bake_line("mixed", "--threads 1 --seed 2"));
  const Ended first = one.ended(), second = other.ended();
  ASSERT_NE(first.code == 0, second.code == 0) << first.printed << second.printed;
  EXPECT_THAT((first.code == 0 ? second : first).printed, HasSubstr("holds another atlas: settings.seed is"));
  const Ended rest = baked("mixed", first.code == 0 ? "" : "--seed 2");
  EXPECT_EQ(rest.json().at("already"), 16) << "the looks are all of one bake";
  EXPECT_EQ(run_cli(fmt::format("atlas verify '{}'", path_of("mixed"))).code, 0);
}

TEST_F(Shards, ThePyramidIsMadeAnewByItself) {
  fs::copy(folder_ / "whole", folder_ / "bare", fs::copy_options::recursive);
  fs::remove_all(folder_ / "bare/pyramid_1");
  fs::remove_all(folder_ / "bare/ground/pyramid_1");
  const Ended made = run_cli(fmt::format("atlas pyramid --json '{}'", path_of("bare")));
  ASSERT_EQ(made.code, 0) << made.printed;
  EXPECT_EQ(made.json().at("written"), 8 + 4 + 8) << "four places: two looks, obstacles, two of the ground";
  EXPECT_EQ(made.json().at("left_out"), 0);
  EXPECT_EQ(difference_of(files_of(folder_ / "bare"), whole_), "");

  fs::remove(folder_ / "bare" / obstacles);
  fs::remove((folder_ / "bare" / obstacles).replace_extension(".json"));
  const Ended lacking = run_cli(fmt::format("atlas pyramid '{}'", path_of("bare")));
  EXPECT_EQ(lacking.code, 1);
  EXPECT_THAT(lacking.printed,
              HasSubstr("0 files above the patches written; 1 left out for want of 1 file of patches (" +
                        std::string(obstacles) + " is missing); start the bake again"));
}

TEST_F(Shards, InfoTellsWhatIsThereAndWhatIsNot) {
  const Ended info = run_cli(fmt::format("atlas info --json '{}'", path_of("whole")));
  ASSERT_EQ(info.code, 0) << info.printed;
  const nlohmann::json json = info.json();
  std::size_t bytes = 0;
  for (const auto& [name, content] : whole_) bytes += content.size();
  EXPECT_EQ(json.at("bytes"), bytes);
  EXPECT_EQ(json.at("patches"), 8);
  EXPECT_EQ(json.at("looks"), 16);
  EXPECT_EQ(json.at("looks_done"), 16);
  EXPECT_EQ(json.at("pyramid").at("textures"), 8) << "four places: two looks";
  EXPECT_EQ(json.at("pyramid").at("textures_done"), 8);
  EXPECT_EQ(json.at("obstacles").at("files"), 8 + 4);
  EXPECT_EQ(json.at("obstacles").at("files_done"), 8 + 4);
  EXPECT_EQ(json.at("ground").at("files_done"), json.at("ground").at("files"));
  EXPECT_GT(json.at("ground").at("files"), 8 + 4);
  EXPECT_TRUE(json.at("ground").at("faults").empty());
  EXPECT_TRUE(json.at("terrain").at("faults").empty());
  EXPECT_EQ(json.at("azimuths_deg").size(), 2U);
  EXPECT_GT(json.at("relative_standard_error").at("smallest").get<double>(), 0.0);
  EXPECT_LE(json.at("relative_standard_error").at("smallest"), json.at("relative_standard_error").at("mean"));
  EXPECT_LE(json.at("relative_standard_error").at("mean"), json.at("relative_standard_error").at("largest"));
  EXPECT_EQ(json.at("settings").at("max_bounces"), "2");
  const Ended text = run_cli(fmt::format("atlas info '{}'", path_of("whole")));
  EXPECT_THAT(text.printed, HasSubstr("16 of 16"));
  EXPECT_EQ(run_cli(fmt::format("atlas info '{}'", path_of("nothing"))).code, 1);
}

TEST_F(Shards, AFullDiskLeavesNothingHalfWritten) {
  // Files may grow to so many blocks of 1024 bytes: enough for the collection, too few for the largest texture.
  std::size_t largest = 0;
  for (const auto& [name, content] : whole_) largest = std::max(largest, content.size());
  const std::size_t blocks = (largest - 1) / 1024;
  ASSERT_GT(blocks * 1024, whole_.at("collection.json").size());
  const Ended full = run(fmt::format("ulimit -f {}; {}", blocks, bake_line("full", "--threads 1")));
  EXPECT_EQ(full.code, 1);
  EXPECT_THAT(full.printed, HasSubstr("cannot be written (File too large); let files grow larger (ulimit -f)"));
  const auto left = files_of(folder_ / "full");
  EXPECT_LT(left.size(), whole_.size());
  for (const auto& [name, content] : left) EXPECT_EQ(content, whole_[name]) << name;
  EXPECT_EQ(baked("full").code, 0);
  EXPECT_EQ(difference_of(files_of(folder_ / "full"), whole_), "");
}

TEST_F(Shards, ADiskThatFillsUpMidwayKeepsWhatWasWhole) {
  const fs::path disk = folder_ / "disk";
  fs::create_directories(disk);
  std::size_t pages = 0;
  for (const auto& [name, content] : whole_) pages += content.size() / 4096 + 1;
  // The ground comes first: so much of the room that some looks follow it.
  const std::string most = fmt::format("size={}k", 4 * pages * 7 / 10);
  if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, most.c_str()) != 0) {
    GTEST_SKIP() << "a small disk of its own cannot be mounted here: a disk that fills up was NOT tried";
  }
  const Ended full = run(bake_line("disk/atlas", "--threads 1"));
  fs::copy(disk / "atlas", folder_ / "rescued", fs::copy_options::recursive);
  ::umount(disk.c_str());
  EXPECT_EQ(full.code, 1);
  EXPECT_THAT(full.printed, HasSubstr("No space left on device"));
  EXPECT_THAT(full.printed, HasSubstr("free some space"));
  const Ended rest = baked("rescued");
  EXPECT_GT(rest.json().at("already"), 0);
  EXPECT_LT(rest.json().at("already"), 16);
  EXPECT_EQ(difference_of(files_of(folder_ / "rescued"), whole_), "");
}

// The piece that is tried is of the scene itself, so that counts are exact and sizes of the right order.
TEST_F(Shards, APlanWritesNothingAndCountsRight) {
  const Ended planned = baked("planned", "--plan");
  ASSERT_EQ(planned.code, 0) << planned.printed;
  const nlohmann::json plan = planned.json();
  EXPECT_FALSE(fs::exists(folder_ / "planned"));
  EXPECT_EQ(plan.at("patches"), 8);
  EXPECT_EQ(plan.at("jobs"), 16);
  EXPECT_EQ(plan.at("looks"), 16);
  EXPECT_EQ(plan.at("already"), 0);
  EXPECT_GT(plan.at("seconds").get<double>(), 0.0);
  double bytes = 0.0;
  for (const auto& [name, content] : whole_) {
    const bool is_of_a_look = !name.starts_with("ground") && name.find("/az") != std::string::npos;
    if (is_of_a_look && name.ends_with(".tif")) bytes += static_cast<double>(content.size());
  }
  // Patches at the scene's edge hold less of it than the piece in the middle that is tried.
  EXPECT_GT(plan.at("bytes").get<double>(), 0.95 * bytes);
  EXPECT_LT(plan.at("bytes").get<double>(), 1.5 * bytes);
  EXPECT_EQ(baked("whole", "--plan").json().at("already"), 16);
  const nlohmann::json share = baked("planned", "--plan --shard 0/4").json();
  EXPECT_EQ(share.at("looks"), 4);
  EXPECT_EQ(share.at("jobs"), 16);
  EXPECT_EQ(share.at("jobs_of_share"), 4);
  EXPECT_EQ(share.at("patches_of_share"), 4);
  EXPECT_EQ(share.at("has_whole_patches"), false);
  EXPECT_NEAR(share.at("bytes_of_share").get<double>(), share.at("bytes").get<double>() / 4.0, 1.0);
  const Ended other = baked("whole", "--plan --seed 2");
  EXPECT_EQ(other.code, 1);
  EXPECT_THAT(other.printed, HasSubstr("seed is \"1\" there and \"2\" here"));
}

TEST_F(Shards, TheLogTellsOfEveryLook) {
  const Ended ended = baked("logged", fmt::format("--json-log '{}'", path_of("log.jsonl")));
  ASSERT_EQ(ended.code, 0) << ended.printed;
  std::ifstream log(folder_ / "log.jsonl");
  std::string line;
  double done = -1.0;
  std::size_t lines = 0;
  nlohmann::json json;
  std::vector<std::string> stages;
  std::map<std::string, nlohmann::json> last;
  while (std::getline(log, line)) {
    const nlohmann::json any = nlohmann::json::parse(line);
    const std::string task = any.at("task");
    if (stages.empty() || stages.back() != task) stages.push_back(task);
    EXPECT_EQ(any.at("looks_total"), 16) << "in every stage";
    EXPECT_GE(any.at("looks_done").get<double>(), done);
    last[task] = any;
    if (task != "bake") continue;
    json = any;
    EXPECT_EQ(json.at("done"), json.at("looks_done"));
    lines += json.at("looks_done").get<double>() > done ? 1 : 0;
    done = json.at("looks_done");
  }
  EXPECT_THAT(stages, testing::ElementsAre("bake", "ground", "pyramid", "bake", "pyramid"));
  EXPECT_EQ(last["ground"].at("done"), 8);
  EXPECT_EQ(last["ground"].at("total"), 8);
  EXPECT_EQ(last["ground"].at("unit"), "patches");
  EXPECT_EQ(last["pyramid"].at("done"), 2);
  EXPECT_EQ(last["pyramid"].at("unit"), "layers");
  EXPECT_GE(lines, 17U) << "at the start and after each look";
  EXPECT_EQ(done, 16.0);
  EXPECT_GT(json.at("rays_per_second").get<double>(), 0.0);
  EXPECT_GT(json.at("relative_standard_error").get<double>(), 0.0);
  EXPECT_EQ(json.at("seconds_left"), 0.0);
}

TEST_F(Shards, ALogThatCannotBeWrittenIsAnError) {
  const Ended from_the_start = baked("unlogged", "--json-log /dev/full");
  EXPECT_EQ(from_the_start.code, 1);
  EXPECT_THAT(from_the_start.printed, HasSubstr("/dev/full: cannot be written (No space left on device)"));
  EXPECT_FALSE(fs::exists(folder_ / "unlogged/patch_+000_+000"));

  // A disk that fills up meanwhile: what was to be baked is baked all the same.
  const fs::path disk = folder_ / "log_disk";
  fs::create_directories(disk);
  if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=4k") != 0) {
    GTEST_SKIP() << "a small disk of its own cannot be mounted here: a disk that fills up was NOT tried";
  }
  const Ended midway = baked("unlogged", fmt::format("--json-log '{}'", (disk / "log.jsonl").string()));
  const auto size = fs::file_size(disk / "log.jsonl");
  ::umount(disk.c_str());
  EXPECT_EQ(midway.code, 1);
  EXPECT_EQ(size, 4096U);
  EXPECT_THAT(midway.printed,
              HasSubstr("log.jsonl: could not be written to its end; all that was to be baked is there"));
  EXPECT_EQ(difference_of(files_of(folder_ / "unlogged"), whole_), "");
}

TEST_F(Shards, TheLogOfAShareThatStartsAgainGoesOn) {
  const fs::path file = folder_ / "continued.jsonl";
  std::ofstream(file) << "{\"task\": \"bake\"}\n{\"task\": \"ba";
  ASSERT_EQ(baked("continued", fmt::format("--json-log '{}'", file.string())).code, 0);
  std::ifstream log(file);
  std::string first, broken, next;
  std::getline(log, first);
  std::getline(log, broken);
  std::getline(log, next);
  EXPECT_EQ(first, "{\"task\": \"bake\"}");
  EXPECT_EQ(broken, "{\"task\": \"ba");
  EXPECT_EQ(nlohmann::json::parse(next).at("looks_done"), 0);
}

TEST_F(Shards, NonsenseIsRefusedBeforeAnythingIsWritten) {
  const auto refused = [](const std::string& options) {
    const Ended ended = baked("refused", options);
    EXPECT_NE(ended.code, 0) << options;
    return ended.printed;
  };
  EXPECT_THAT(refused("--shard 5/3"),
              HasSubstr("--shard: shard 5/3: is not one of them; shards are counted from 0: give "
                        "0/3 to 2/3\n"));
  EXPECT_THAT(refused("--shard 0/0"), HasSubstr("there are no shards"));
  EXPECT_THAT(refused("--shard a/b"), HasSubstr("is not two whole numbers; write it as 0/8, 1/8, up to 7/8\n"));
  // What an indexed job of Kubernetes takes for a command line that no pod understands.
  for (const char* command : {"bake scene.toml", "dataset spec.toml"}) {
    for (const char* shard : {"3/3", "a/b", "1", "0/0", "-1/2", ""})
      EXPECT_EQ(run_cli(fmt::format("{} --out refused --shard '{}'", command, shard)).code, 2) << command << shard;
  }
  for (const char* threads : {"-1", "all", "1025"}) {
    EXPECT_THAT(refused(std::string("--threads ") + threads),
                HasSubstr(fmt::format("--threads: is {}; give a whole number from 0 to 1024", threads)));
  }
  for (const char* samples : {"1", "1048577", "4294967297"}) {
    EXPECT_THAT(refused(std::string("--samples ") + samples),
                HasSubstr(fmt::format("is {}; give a whole number from 2 to 1048576", samples)));
  }
  EXPECT_THAT(refused("--elevations-deg 0,30"), HasSubstr("--elevations-deg: is 0; give a number from 0.5 to 89"));
  EXPECT_THAT(refused("--elevations-deg 90"), HasSubstr("--elevations-deg: is 90; give a number from 0.5 to 89"));
  EXPECT_THAT(refused("--elevations-deg 30,20,30"), HasSubstr("--elevations-deg: 30° is given twice"));
  EXPECT_THAT(refused("--frequencies-ghz 10,10"), HasSubstr("--frequencies-ghz: 10 GHz is given twice"));
  EXPECT_THAT(refused("--patch-texels 300"), HasSubstr("--patch-texels: is 300; give 256 times a power of two"));
  for (const char* seed : {"-1", "18446744073709551616", "x"}) {
    EXPECT_THAT(refused(std::string("--seed ") + seed),
                HasSubstr(fmt::format("--seed: is {}; give a whole number from 0 to 18446744073709551615", seed)));
  }
  EXPECT_THAT(refused("--json-log /nowhere/log"), HasSubstr("/nowhere/log"));
  EXPECT_FALSE(fs::exists(folder_ / "refused"));
  const Ended other = baked("whole", "--seed 2");
  EXPECT_EQ(other.code, 1);
  EXPECT_THAT(other.printed, HasSubstr("seed is \"1\" there and \"2\" here"));
}

// Four patches, or thirty-two: only the one being baked is in memory.
TEST_F(Shards, MemoryDoesNotGrowWithTheNumberOfPatches) {
  const auto peak_kib = [](double width_m, double height_m) {
    const fs::path scene = write_made_scene(folder_ / fmt::format("scene_{}", width_m), width_m, height_m);
    const Ended ended =
        run(fmt::format("exec '{}' bake '{}' --out '{}' --texel-m 0.5 --patch-texels 256 --azimuths 1 --elevations-deg "
                        "45 --samples 2 --bounces 1 --threads 2",
                        SIGMASCAPE_CLI, scene.string(), path_of(fmt::format("atlas_{}", width_m))));
    EXPECT_EQ(ended.code, 0) << ended.printed;
    return static_cast<double>(ended.peak_memory_kib);
  };
  const double few = peak_kib(200.0, 200.0), many = peak_kib(1000.0, 500.0);
  EXPECT_LT(many, 1.15 * few);
}

}  // namespace
}  // namespace sigmascape::end_to_end
