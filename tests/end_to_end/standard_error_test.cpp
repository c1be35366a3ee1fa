#include <array>
#include <csignal>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <pty.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

#include "end_to_end/made_scene.h"
#include "end_to_end/process.h"
#include "scratch_folder.h"

namespace sigmascape::end_to_end {
namespace {

using ::testing::HasSubstr;

/// The program where what it says beside its work cannot be written.
class StandardError : public ::testing::Test {
 protected:
  /// What the shell does first is a line of its own.
  [[nodiscard]] Ended run(const std::string& arguments, const std::string& first = "") const {
    return Process(fmt::format("cd '{}' || exit; {}exec '{}' {}", folder_.path(".").string(), first, SIGMASCAPE_CLI,
                               arguments),
                   folder_.path("printed"))
        .ended();
  }
  /// A radar, and a scene of which there is something to warn of.
  void write_warned_of() const {
    std::ofstream(scene_, std::ios::app) << "[[buildings]]\nfile = \"houses.csv\"\ncrs = \"EPSG:25830\"\n"
                                            "height_attribute = \"height\"\nwhere = \"height = 'unheard of'\"\n";
    folder_.write("radar.toml",
                  "[radar]\nfrequency_ghz = 10\nrange_resolution_m = 4\nbeam_width_deg = 0.1\n"
                  "[position]\nazimuth_deg = 180\nelevation_deg = 20\nslant_range_km = 5\n");
  }
  [[nodiscard]] static std::string render_to(const std::string& file) {
    return "render radar.toml --scene scene/scene.toml --samples 1 --out " + file;
  }
  [[nodiscard]] std::string content_of(const std::string& name) const {
    std::ifstream file(folder_.path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  const ScratchFolder folder_;
  const std::filesystem::path scene_ = write_made_scene(folder_.path("scene"), 240.0, 120.0);
};

// A closed one leaves its number to the files that are opened: the warning must not get into one of them.
TEST_F(StandardError, WarningsThatCannotBeWrittenAreLostAndTheMapIsNot) {
  write_warned_of();
  const Ended heard = run(render_to("heard.npy"));
  ASSERT_EQ(heard.code, 0) << heard.said;
  ASSERT_THAT(heard.said, HasSubstr("warning: scene: files without a feature"));
  EXPECT_EQ(run(render_to("full.npy 2> /dev/full")).code, 0);
  EXPECT_EQ(run(render_to("closed.npy 2>&-")).code, 0);
  EXPECT_EQ(run(render_to("all_closed.npy --json <&- 2>&-")).code, 0);
  const std::string map = content_of("heard.npy");
  ASSERT_GT(map.size(), 1000U);
  EXPECT_EQ(content_of("full.npy"), map);
  EXPECT_EQ(content_of("closed.npy"), map);
  EXPECT_EQ(content_of("all_closed.npy"), map);
}

/// Opens a stream, by its sign in the shell, into a pipe whose reader has gone by then.
std::string into_a_pipe_without_reader(const std::string& sign) {
  return fmt::format("rm -f pipe; mkfifo pipe; : < pipe & exec {} pipe; wait; ", sign);
}

TEST_F(StandardError, AReaderThatHasGoneDoesNotEndTheWork) {
  write_warned_of();
  ASSERT_EQ(run(render_to("heard.npy")).code, 0);
  EXPECT_EQ(run(render_to("unheard.npy"), into_a_pipe_without_reader("2>")).code, 0);
  EXPECT_EQ(content_of("unheard.npy"), content_of("heard.npy"));
  // What went wrong is told by the code at least.
  EXPECT_EQ(run("scene info none.toml", into_a_pipe_without_reader("2>")).code, 1);
  EXPECT_EQ(run("scene info --unheard-of", into_a_pipe_without_reader("2>")).code, 2);
}

// As before a `head` that has seen enough.
TEST_F(StandardError, OfStandardOutputAReaderThatHasGoneEndsTheProgram) {
  constexpr int killed = -1;
  EXPECT_EQ(run("scene info scene/scene.toml", into_a_pipe_without_reader(">")).code, killed);
}

TEST_F(StandardError, OfAClosedStandardOutputItIsStillSaid) {
  const Ended ended = run("scene info scene/scene.toml >&-");
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(ended.said, HasSubstr("sigmascape: standard output: cannot be written"));
}

/// Runs a line on a terminal that goes away, as one does when its connection is lost, after the first thing shown. A
/// hang-up is not heeded, as with nohup. Returns what waitpid() tells.
int status_of_line_whose_terminal_goes(const std::string& line) {
  int terminal = -1;
  const pid_t pid = ::forkpty(&terminal, nullptr, nullptr, nullptr);
  if (pid == 0) {
    static_cast<void>(std::signal(SIGHUP, SIG_IGN));
    ::execl("/bin/bash", "bash", "-c", line.c_str(), nullptr);
    ::_exit(127);
  }
  std::array<char, 4096> part{};
  const ssize_t shown = ::read(terminal, part.data(), part.size());
  EXPECT_GT(shown, 0) << "it ended before it showed anything";
  ::close(terminal);
  int status = 0;
  ::waitpid(pid, &status, 0);
  return status;
}

TEST_F(StandardError, ABakeGoesOnWhenItsTerminalIsGone) {
  const std::string line = fmt::format(
      "exec '{}' bake '{}' --out '{}' --texel-m 0.5 --patch-texels 256 --azimuths 2 --elevations-deg 30 --samples 64 "
      "--threads 1 > '{}'",
      SIGMASCAPE_CLI, scene_.string(), folder_.path("atlas").string(), folder_.path("told").string());
  const int status = status_of_line_whose_terminal_goes(line);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  EXPECT_THAT(content_of("told"), HasSubstr("8 looks in "));
  EXPECT_EQ(run("atlas verify atlas").code, 0);
}

}  // namespace
}  // namespace sigmascape::end_to_end
