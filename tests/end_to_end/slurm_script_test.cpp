#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "end_to_end/process.h"
#include "scratch_folder.h"

namespace sigmascape::end_to_end {
namespace {

using ::testing::HasSubstr;

/// What the job file for Slurm does as a task of an array: it prints the line that it would bake with.
class SlurmScript : public ::testing::Test {
 protected:
  [[nodiscard]] Ended task(const std::string& variables) const {
    return Process(fmt::format("env {} SIGMASCAPE=echo SLURM_ARRAY_JOB_ID=7 '{}/examples/clusters/slurm.sh' town.toml",
                               variables, SIGMASCAPE_SOURCE_DIR),
                   folder_.path("printed.txt"))
        .ended();
  }
  [[nodiscard]] static std::string array(int id, int lowest, int highest, int count) {
    return fmt::format(
        "SLURM_ARRAY_TASK_ID={} SLURM_ARRAY_TASK_MIN={} SLURM_ARRAY_TASK_MAX={} SLURM_ARRAY_TASK_COUNT={}", id, lowest,
        highest, count);
  }
  const ScratchFolder folder_;
};

TEST_F(SlurmScript, BakesTheShareOfItsTask) {
  const Ended third = task(array(2, 0, 7, 8));
  EXPECT_EQ(third.code, 0) << third.printed;
  EXPECT_THAT(third.printed, HasSubstr("bake town.toml --shard 2/8"));
  EXPECT_THAT(task("SHARES=8 " + array(5, 2, 5, 2)).printed, HasSubstr("--shard 5/8"));
}

TEST_F(SlurmScript, EveryTaskOfAnArrayThatIsNumberedOtherwiseRefuses) {
  for (const int id : {1, 4, 8}) {
    const Ended refused = task(array(id, 1, 8, 8));
    EXPECT_EQ(refused.code, 2);
    EXPECT_THAT(refused.printed, HasSubstr("the tasks 1 to 8 are not the shares 0 to 7; submit --array=0-7"));
  }
  EXPECT_EQ(task(array(0, 0, 6, 4)).code, 2) << "every second number";
  const Ended too_many = task("SHARES=8 " + array(3, 3, 8, 2));
  EXPECT_EQ(too_many.code, 2);
  EXPECT_THAT(too_many.printed, HasSubstr("there is no share 8 of 8"));
}

TEST_F(SlurmScript, SharesThatAreNoNumberAreRefused) {
  for (const char* shares : {"0", "-8", "eight", "08", "2/8"}) {
    const Ended refused = task(fmt::format("SHARES={} ", shares) + array(2, 2, 5, 2));
    EXPECT_EQ(refused.code, 2) << shares;
    EXPECT_THAT(refused.printed,
                HasSubstr(fmt::format("SHARES is '{}', which is no number of shares; say how many there are", shares)));
  }
}

TEST_F(SlurmScript, OutsideAnArrayItSaysSo) {
  const Ended refused = task("--unset=SLURM_ARRAY_TASK_ID");
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.printed, HasSubstr("this is no task of a job array; submit it with 'sbatch --array=0-7'"));
}

}  // namespace
}  // namespace sigmascape::end_to_end
