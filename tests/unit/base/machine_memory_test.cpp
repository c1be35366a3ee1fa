#include "sigmascape/base/machine_memory.h"

#include <gtest/gtest.h>

#include "scratch_folder.h"

namespace sigmascape {
namespace {

TEST(MachineMemory, IsWhatTheNarrowestControlGroupAllows) {
  const ScratchFolder folder;
  const std::filesystem::path root = folder.path("cgroup");
  std::filesystem::create_directories(root / "batch" / "job_7" / "task");
  const auto limit = [&](const std::string& group, const std::string& bytes) {
    folder.write("cgroup/" + group + "memory.max", bytes + "\n");
  };
  EXPECT_FALSE(control_group_memory_bytes(root, "0::/batch/job_7/task\n"));
  limit("batch/job_7/task/", "max");
  EXPECT_FALSE(control_group_memory_bytes(root, "0::/batch/job_7/task\n"));
  limit("batch/job_7/", "4294967296");
  limit("batch/", "8589934592");
  EXPECT_EQ(control_group_memory_bytes(root, "0::/batch/job_7/task\n"), 4294967296.0);
  EXPECT_EQ(control_group_memory_bytes(root, "4:memory:/elsewhere\n0::/batch\n"), 8589934592.0);
  // In a container the group looks like the root, which holds its limit.
  limit("", "2147483648");
  EXPECT_EQ(control_group_memory_bytes(root, "0::/\n"), 2147483648.0);
  EXPECT_FALSE(control_group_memory_bytes(root, "4:memory:/batch\n"));
  EXPECT_LE(machine_memory_bytes(), 1e15);
  EXPECT_GT(machine_memory_bytes(), 1e8);
}

}  // namespace
}  // namespace sigmascape
