#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "bytes_of.h"

namespace sigmascape::end_to_end {
namespace {

namespace fs = std::filesystem;

/// A measurement of the smallest scene with hardly any rays, made twice into the same folder, the second time with all
/// but one of the first one's views taken over.
class Results : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    fs::create_directories(folder_);
    ASSERT_EQ(run("first.md"), 0) << bytes_of(folder_ / "printed.txt");
    first_ = nlohmann::json::parse(bytes_of(folder_ / "out/results.json"));
    for (const auto& file : fs::recursive_directory_iterator(folder_ / "out")) {
      if (file.path().extension() == ".tif") written_[file.path()] = file.last_write_time();
    }
    keep_all_but_the_last_view();
    ASSERT_EQ(run("second.md", fmt::format("--measured '{}'", (folder_ / "some.json").string())), 0)
        << bytes_of(folder_ / "printed.txt");
    second_ = nlohmann::json::parse(bytes_of(folder_ / "out/results.json"));
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }

  [[nodiscard]] static int run(const char* page, const std::string& more = "") {
    const std::string line = fmt::format(
        "'{}' results --small --scale 0.1 --samples 2 --traced-samples 4 --held-out 2 --on-grid 1 --out '{}' --page "
        "'{}' {} > '{}' 2>&1",
        SIGMASCAPE_CLI, (folder_ / "out").string(), (folder_ / page).string(), more,
        (folder_ / "printed.txt").string());
    const int status = std::system(line.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  /// As if a run elsewhere had been broken off.
  static void keep_all_but_the_last_view() {
    nlohmann::json measured = nlohmann::json::parse(bytes_of(folder_ / "measured.json"));
    measured.at("views").erase(measured.at("views").size() - 1);
    std::ofstream(folder_ / "some.json") << measured;
    fs::remove(folder_ / "out/measured.json");
  }

  static inline const fs::path folder_ =
      fs::temp_directory_path() / fmt::format("sigmascape_results_test_{}", getpid());
  static inline nlohmann::json first_, second_;
  static inline std::map<fs::path, fs::file_time_type> written_;
};

std::string place_of(const nlohmann::json& view) {
  return fmt::format("{} {:.6f} {:.6f}", view.at("scene").get<std::string>(), view.at("azimuth_deg").get<double>(),
                     view.at("elevation_deg").get<double>());
}

/// By scene and view, in the order of the maps.
std::map<std::string, std::vector<double>> times_of_frames(const nlohmann::json& results) {
  std::map<std::string, std::vector<double>> times;
  for (const auto& map : results.at("views")) times[place_of(map)].push_back(map.at("render_ms"));
  return times;
}

TEST_F(Results, AreNumbersPageAndPictures) {
  for (const char* name : {"results.json", "index.html"}) EXPECT_TRUE(fs::exists(folder_ / "out" / name)) << name;
  const std::string page = bytes_of(folder_ / "first.md");
  EXPECT_EQ(page.find(folder_.string()), std::string::npos) << "the page names a folder";
  for (const char* part :
       {"```\nsigmascape results --small --scale 0.1 --held-out 2 --on-grid 1 --repeated 3 --samples 2 "
        "--traced-samples 4 ",
        "as many elevations, spaced evenly, 8 × 5 in cot ψ", "### Without noise", "## Where the error is", "## Why",
        "### At views that were baked", "### At views that were not baked", "The largest by RMS is", "## Cheap wins",
        "## What limits the best of them", "dB a megabyte", "texels half as wide",
        "rays where the noise is | to 0.4 dB, at most 128", "texel size", "Figure 1", "Figure 7", "Figure 8"})
    EXPECT_NE(page.find(part), std::string::npos) << part;

  std::size_t pictures = 0;
  for (std::size_t at = page.find("!["); at != std::string::npos; at = page.find("![", at + 1)) {
    const std::size_t file = page.find("](", at) + 2;
    const std::string name = page.substr(file, page.find(')', file) - file);
    EXPECT_TRUE(fs::is_regular_file(folder_ / name)) << name;
    ++pictures;
  }
  EXPECT_EQ(pictures, 3U + 4 + 2 + 4 + 7 + 7) << "plots, Figures 1, 5 and 6, 7, 8, and the worst view";
}

TEST_F(Results, CountThePapersTexturesAsThePaperCounts) {
  // 200 m in texels of 2 km / 1024, four floats each. At full size and 32 looks it is the paper's 537 MB.
  const double texels = std::pow(200.0 / (2000.0 / 1024.0), 2.0);
  std::map<std::string, double> bytes;
  for (const auto& row : first_.at("rows")) {
    if (row.at("method") == "paper")
      bytes[row.at("grid").get<std::string>() + row.at("change").get<std::string>()] = row.at("bytes");
  }
  EXPECT_NEAR(bytes.at("8 × 4"), 32 * texels * 16.0, 1.0);
  EXPECT_NEAR(bytes.at("8 × 5"), 40 * texels * 16.0, 1.0);
  EXPECT_NEAR(bytes.at("8 × 5half floats"), 40 * texels * 8.0, 1.0);
}

TEST_F(Results, HaveEveryMethodInEveryKindOfView) {
  std::map<std::string, std::set<std::string>> kinds;
  for (const auto& row : first_.at("rows")) {
    if (row.at("grid") == "8 × 5" && row.at("scene") == "hills") kinds[row.at("method")].insert(row.at("view_kind"));
  }
  const std::set<std::string> all{"on grid", "held out", "Figure 8 view"};
  for (const char* method : {"paper", "ours, shadows baked", "ours, on level ground", "ours, on its own ground"})
    EXPECT_EQ(kinds[method], all) << method;
}

TEST_F(Results, HaveMoreLooksAndBytesOfFinerGrids) {
  std::map<std::string, std::pair<int, std::uintmax_t>> cost;
  for (const auto& row : first_.at("rows")) {
    if (row.at("method") == "ours, on its own ground") cost[row.at("grid")] = {row.at("looks"), row.at("bytes")};
  }
  EXPECT_EQ(cost.at("8 × 4").first, 32);
  EXPECT_EQ(cost.at("8 × 5").first, 40);
  EXPECT_EQ(cost.at("16 × 6").first, 96);
  EXPECT_EQ(cost.at("8 × 5 in cot ψ").first, 40);
  EXPECT_EQ(cost.at("own look").first, 1);
  EXPECT_LT(cost.at("8 × 4").second, cost.at("8 × 5").second);
  EXPECT_LT(cost.at("8 × 5").second, cost.at("16 × 5").second);
  EXPECT_LT(cost.at("16 × 5").second, cost.at("16 × 6").second);
}

/// The first row of these with that cell size that says so.
nlohmann::json row_of(const nlohmann::json& results, const nlohmann::json& wanted, double cell_m) {
  for (const auto& row : results.at("rows")) {
    bool is_wanted = row.at("cell_m") == cell_m;
    for (const auto& [key, value] : wanted.items()) is_wanted = is_wanted && row.at(key) == value;
    if (is_wanted) return row;
  }
  ADD_FAILURE() << "no row says " << wanted;
  return {};
}

TEST_F(Results, GiveTilesThePowerOfAFinerGrid) {
  const nlohmann::json own{{"method", "ours, on its own ground"}, {"scene", "hills"}, {"view_kind", "held out"}};
  auto by_tiles = own, finer = own;
  by_tiles.update({{"grid", "8 × 5"}, {"change", "power by tiles"}});
  finer.update({{"grid", "16 × 6"}, {"change", ""}});
  for (const char* metric : {"correlation_db", "rms_db", "bias_db", "l1"}) {
    EXPECT_NEAR(row_of(first_, by_tiles, 32.0).at("median").at(metric).get<double>(),
                row_of(first_, finer, 32.0).at("median").at(metric).get<double>(), 1e-4)
        << metric;
  }
  EXPECT_GT(std::abs(row_of(first_, by_tiles, 8.0).at("median").at("rms_db").get<double>() -
                     row_of(first_, finer, 8.0).at("median").at("rms_db").get<double>()),
            0.01);
}

TEST_F(Results, HaveErrorsByLevelThatMakeUpTheRms) {
  std::size_t compared = 0;
  for (const auto& row : first_.at("rows")) {
    if (row.at("cell_m") != 8.0 || row.at("views") != 1) continue;
    for (const auto& [errors, metrics] : {std::pair("by_level", "median"), {"noise_by_level", "noise_floor_median"}}) {
      double cells = 0.0, squares = 0.0;
      for (const auto& range : row.at(errors)) {
        cells += range.at("cells").get<double>();
        squares += range.at("squared_error_db2").get<double>();
      }
      EXPECT_NEAR(std::sqrt(squares / cells), row.at(metrics).at("rms_db").get<double>(), 1e-9);
      ++compared;
    }
  }
  EXPECT_GT(compared, 20U);
}

TEST_F(Results, TellOfBakedViewsWithoutNoise) {
  std::set<std::string> cases;
  for (const auto& row : first_.at("rows")) {
    EXPECT_EQ(row.contains("without_noise"), row.at("cell_m") == 8.0 && row.at("view_kind") == "on grid" &&
                                                 row.at("grid") == "own look" && row.at("change") == "");
    if (!row.contains("without_noise")) continue;
    cases.insert(fmt::format("{} {} {}", row.at("scene").get<std::string>(), row.at("method").get<std::string>(),
                             row.at("baked_samples").get<int>()));
    const auto& free = row.at("without_noise");
    EXPECT_EQ(free.at("views"), 1);
    EXPECT_EQ(free.at("measured"), row.at("median"));
    EXPECT_EQ(free.at("noise_floor"), row.at("noise_floor_median"));
    EXPECT_LT(free.at("rms_db"), row.at("median").at("rms_db"));
    EXPECT_GT(free.at("correlation_db"), row.at("median").at("correlation_db"));
  }
  const std::set<std::string> all{
      "hills paper 2", "hills paper 4", "hills ours, on its own ground 2", "hills ours, on its own ground 4",
      "level paper 2", "level paper 4", "level ours, on level ground 2",   "level ours, on level ground 4"};
  EXPECT_EQ(cases, all);
}

TEST_F(Results, TellWhatABakeDoesByItselfAtViewsThatWereBaked) {
  std::set<std::string> cases;
  for (const auto& row : first_.at("rows")) {
    if (row.at("change") != "rays where the noise is") continue;
    EXPECT_EQ(row.at("view_kind"), "on grid");
    EXPECT_EQ(row.at("baked_samples"), 0);
    cases.insert(fmt::format("{} {} {}", row.at("scene").get<std::string>(), row.at("method").get<std::string>(),
                             row.at("grid").get<std::string>()));
  }
  const std::set<std::string> all{"hills ours, on its own ground own look", "level ours, on level ground own look"};
  EXPECT_EQ(cases, all);
}

TEST_F(Results, HaveAWorstNoBetterThanTheMedian) {
  std::size_t compared = 0;
  for (const auto& row : first_.at("rows")) {
    for (const auto& [median, worst] : {std::pair("median", "worst"), {"noise_floor_median", "noise_floor_worst"}}) {
      if (row.at(median).at("correlation_db").is_null()) continue;
      EXPECT_LE(row.at(worst).at("correlation_db"), row.at(median).at("correlation_db"));
      EXPECT_GE(row.at(worst).at("rms_db"), row.at(median).at("rms_db"));
      EXPECT_GE(std::abs(row.at(worst).at("bias_db").get<double>()) + 1e-12,
                std::abs(row.at(median).at("bias_db").get<double>()));
      EXPECT_LE(row.at(worst).at("shadow_iou"), row.at(median).at("shadow_iou"));
      ++compared;
    }
  }
  EXPECT_GT(compared, 100U);
}

TEST_F(Results, SayTheSameASecondTimeFromWhatIsThere) {
  // View by view: times of frames are those of the first run where it was taken over.
  const auto first = times_of_frames(first_), second = times_of_frames(second_);
  const auto some = nlohmann::json::parse(bytes_of(folder_ / "some.json")).at("views");
  ASSERT_EQ(some.size(), 4U) << "of two held-out views, one baked one on hills and on level ground, and the paper's";
  for (const auto& view : some) {
    const auto place = place_of(view);
    EXPECT_EQ(second.at(place), first.at(place)) << place;
  }
  EXPECT_NE(second, first) << "the last one was rendered again";
  ASSERT_GT(written_.size(), 100U);
  for (const auto& [path, when] : written_) EXPECT_EQ(fs::last_write_time(path), when) << path << " was made again";
  ASSERT_EQ(second_.at("rows").size(), first_.at("rows").size());
  for (std::size_t i = 0; i < first_.at("rows").size(); ++i) {
    for (const char* same : {"median", "worst", "noise_floor_median", "bytes", "bake_s", "trace_s"})
      EXPECT_EQ(second_.at("rows").at(i).at(same), first_.at("rows").at(i).at(same)) << i << " " << same;
  }
}

}  // namespace
}  // namespace sigmascape::end_to_end
