#include "sigmascape/bake/claims.h"

#include <csignal>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

#include "scratch_folder.h"

#include "sigmascape/base/interruption.h"

namespace sigmascape::bake {
namespace {

TEST(Claims, AJobIsClaimedOnceUntilGivenBack) {
  const ScratchFolder folder;
  const Claims one(folder.path("")), two(folder.path(""));
  {
    const auto claim = one.take_if_free(5);
    ASSERT_TRUE(claim);
    EXPECT_FALSE(two.take_if_free(5));
    EXPECT_TRUE(two.take_if_free(6));
  }
  EXPECT_TRUE(two.take_if_free(5));
  EXPECT_EQ(std::filesystem::file_size(folder.path(".claims")), 0U);
}

TEST(Claims, EndWithAKilledProcess) {
  const ScratchFolder folder;
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const Claims claims(folder.path(""));
    const auto claim = claims.take_if_free(0);
    static_cast<void>(::write(ready[1], "x", 1) == 1);
    while (true) ::pause();
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  const Claims claims(folder.path(""));
  EXPECT_FALSE(claims.take_if_free(0));
  bool is_killed = false;
  const Claims::Claim claim = claims.take(0, [&] {
    if (!std::exchange(is_killed, true)) ::kill(child, SIGKILL);
  });
  EXPECT_TRUE(is_killed) << "who waits is told of it";
  ::waitpid(child, nullptr, 0);
  ::close(ready[0]);
  ::close(ready[1]);
}

/// As whoever knows does that the machine is gone whose locks a server still keeps.
TEST(Claims, WhoWaitsNoticesThatTheirFileWasDeleted) {
  const ScratchFolder folder;
  const Claims gone(folder.path("")), waits(folder.path(""));
  const auto held = gone.take_if_free(5);
  const Claims::Claim claim = waits.take(5, [&] { std::filesystem::remove(folder.path(".claims")); });
  EXPECT_TRUE(std::filesystem::exists(folder.path(".claims")));
  EXPECT_FALSE(Claims(folder.path("")).take_if_free(5)) << "it holds the claim in the file that others find";
}

TEST(Claims, WhoWaitsCanBeToldToStop) {
  const ScratchFolder folder;
  const Claims one(folder.path("")), two(folder.path(""));
  const auto claim = one.take_if_free(5);
  const Interruption interruption([] { return true; });
  EXPECT_THROW(static_cast<void>(two.take(5)), Interrupted);
}

// A folder that cannot be written to stands for a file system that cannot lock.
TEST(Claims, WhereThereAreNoLocksWorkGoesOn) {
  const Claims claims("/nowhere");
  EXPECT_TRUE(claims.take_if_free(0));
}

}  // namespace
}  // namespace sigmascape::bake
