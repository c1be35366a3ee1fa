#include "sigmascape/atlas/patch_table.h"

#include <chrono>
#include <filesystem>
#include <gtest/gtest.h>
#include <latch>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "example_texels.h"

#include "sigmascape/base/interruption.h"

namespace sigmascape::atlas {
namespace {

using namespace std::chrono_literals;

constexpr PatchBlock western{.south_west = {-1, 0}, .north_east = {-1, 0}};
constexpr PatchBlock eastern{.south_west = {0, 0}, .north_east = {0, 0}};

class PatchTableTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("sigmascape_patch_table_") + test->name() + "_" + std::to_string(::getpid()));
    std::filesystem::remove_all(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// Two patches of one look.
  [[nodiscard]] Store store() const {
    AtlasDescription description = example_description();
    description.extent = {-256.0, 0.0, 256.0, 256.0};
    description.patches = {1.0, 256};
    description.aspects = {{0.0}, {radians_from_deg(5.0)}, {10e9}};
    Store store = Store::create(folder_, description);
    for (const Unit& unit : store.units())
      store.write(unit.patch, unit.look, example_texels(256, static_cast<std::uint64_t>(unit.patch.x + 7)), {});
    return store;
  }

  std::filesystem::path folder_;
};

/// A thread that reads patches and stands still in the midst of it, until it is let go on.
class StandingReader {
 public:
  StandingReader(PatchTable& table, const PatchBlock& wanted)
      : thread_([this, &table, wanted] {
          const Interruption interruption([this] {
            if (stands_.try_wait()) return false;
            stands_.count_down();
            goes_on_.wait();
            return false;
          });
          table.read(wanted, 0);
        }) {
    stands_.wait();
  }
  ~StandingReader() { end(); }
  StandingReader(const StandingReader&) = delete;
  StandingReader& operator=(const StandingReader&) = delete;

  void end() {
    if (!thread_.joinable()) return;
    goes_on_.count_down();
    thread_.join();
  }

 private:
  std::latch stands_{1}, goes_on_{1};
  std::thread thread_;
};

TEST_F(PatchTableTest, WhoWaitsForAnotherCanBeToldToStop) {
  PatchTable table(store(), {0}, 0, 1);
  StandingReader reader(table, western);
  int asked = 0;
  {
    const Interruption interruption([&] { return ++asked > 3; });
    EXPECT_THROW(table.read(eastern, 0), Interrupted);
  }
  reader.end();
  EXPECT_FALSE(table.patches()[0].levels[0].empty());
  EXPECT_TRUE(table.patches()[1].levels[0].empty());
  table.read(eastern, 0);
  EXPECT_FALSE(table.patches()[1].levels[0].empty());
}

TEST_F(PatchTableTest, WhatIsThereIsNotWaitedFor) {
  PatchTable table(store(), {0}, 0, 1);
  table.read(eastern, 0);
  const StandingReader reader(table, western);
  const auto begun = std::chrono::steady_clock::now();
  const Interruption interruption([&] { return std::chrono::steady_clock::now() - begun > 10s; });
  EXPECT_NO_THROW(table.read(eastern, 0));
}

/// Whoever was at it when the child was made is not there to end it.
TEST_F(PatchTableTest, AForkedChildReadsForItself) {
  const Store of_both = store();
  PatchTable expected(of_both, {0}, 0, 1), table(of_both, {0}, 0, 1);
  expected.read(expected.block(), 0);
  table.read(eastern, 0);
  StandingReader reader(table, western);
  const pid_t child = ::fork();
  if (child == 0) {
    ::alarm(60);  // a hang ends here
    table.read(table.block(), 0);
    bool are_alike = true;
    for (std::size_t i = 0; i < 2; ++i) are_alike &= table.patches()[i].levels == expected.patches()[i].levels;
    ::_exit(are_alike ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  EXPECT_TRUE(table.patches()[0].levels[0].empty()) << "the child's are not the parent's";
  reader.end();
  EXPECT_EQ(table.patches()[0].levels, expected.patches()[0].levels);
}

}  // namespace
}  // namespace sigmascape::atlas
