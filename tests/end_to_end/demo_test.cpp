#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bytes_of.h"
#include "validation/validation_record.h"

namespace sigmascape::end_to_end {
namespace {

namespace fs = std::filesystem;

/// Runs the program and returns its exit code; what it prints goes to `output`.
int run_program(const std::string& arguments, const fs::path& output) {
  const int status =
      std::system(fmt::format("'{}' {} > '{}' 2>&1", SIGMASCAPE_CLI, arguments, output.string()).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// The demo on a small scene, run once.
class Demo : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("sigmascape_demo_test_{}", getpid());
    fs::create_directories(folder_);
    // A quarter of the demo's area and only the looks around the two views.
    code_ = run_program(
        fmt::format("demo --out '{}' --scale 0.15 --azimuths 8 --elevations-deg 5,13 --samples 16 --traced-samples 96",
                    (folder_ / "demo").string()),
        folder_ / "printed.txt");
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
  int code_ = -1;
};

TEST_F(Demo, MapsBothWaysAndSaysHowCloseTheyCome) {
  ASSERT_EQ(code_, 0) << bytes_of(folder_ / "printed.txt");
  for (const char* name : {"paper_view_traced.png", "paper_view_baked.png", "baked_view_traced.tif",
                           "baked_view_baked.tif", "index.html", "comparison.json", "atlas/collection.json"}) {
    EXPECT_TRUE(fs::exists(folder_ / "demo" / name)) << name;
  }
  EXPECT_NE(bytes_of(folder_ / "printed.txt").find("index.html"), std::string::npos) << "the page is not named";

  const auto json = nlohmann::json::parse(bytes_of(folder_ / "demo/comparison.json"));
  const auto& view = json.at("views").at(1);
  ASSERT_EQ(view.at("view"), "baked_view");
  const auto row_at = [&](const char* list, double cell_m) {
    for (const auto& row : view.at(list)) {
      if (row.at("cell_m") == cell_m) return row;
    }
    throw std::runtime_error("no such cell size");
  };
  const auto row = row_at("cells", 8.0), floor = row_at("noise_floor", 8.0);
  for (const char* key : {"cell_m", "correlation_db", "rms_db", "bias_db", "l1", "shadow_iou"})
    EXPECT_TRUE(row.contains(key)) << key;
  fmt::print("  8 m cells: correlation {:.3f}, noise floor {:.3f}\n", row.at("correlation_db").get<double>(),
             floor.at("correlation_db").get<double>());
  EXPECT_GE(row.at("correlation_db").get<double>(), 0.9);
  EXPECT_GT(floor.at("correlation_db").get<double>(), row.at("correlation_db").get<double>());
  EXPECT_LE(std::abs(row.at("bias_db").get<double>()), 0.5);
}

TEST(Program, ExitCodesTellWrongUseFromFailure) {
  const fs::path printed = fs::temp_directory_path() / fmt::format("sigmascape_exit_codes_{}.txt", getpid());
  EXPECT_EQ(run_program("--help", printed), 0);
  EXPECT_EQ(run_program("bake --no-such-option", printed), 2);
  EXPECT_EQ(run_program("", printed), 2);
  EXPECT_EQ(run_program("scene info /no/such/scene.toml", printed), 1);
  EXPECT_NE(bytes_of(printed).find("/no/such/scene.toml"), std::string::npos) << bytes_of(printed);
  fs::remove(printed);
}

TEST(Program, EverySubcommandHasHelpWithExamples) {
  const fs::path printed = fs::temp_directory_path() / fmt::format("sigmascape_help_{}.txt", getpid());
  for (const char* command : {"scene info", "bake", "render", "compare", "demo"}) {
    EXPECT_EQ(run_program(fmt::format("{} --help", command), printed), 0);
    EXPECT_NE(bytes_of(printed).find("Example"), std::string::npos) << command;
  }
  fs::remove(printed);
}

}  // namespace
}  // namespace sigmascape::end_to_end
