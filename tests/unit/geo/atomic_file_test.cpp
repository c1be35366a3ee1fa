#include "sigmascape/geo/atomic_file.h"

#include <barrier>
#include <chrono>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mutex>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include "bytes_of.h"
#include "full_disk.h"

#include "sigmascape/base/error.h"

namespace sigmascape::geo {
namespace {

/// A folder of its own for each test.
class AtomicFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("sigmascape_atomic_") + test->name() + "_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::size_t files() const {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_)) ++count;
    return count;
  }

  std::filesystem::path folder_;
};

TEST_F(AtomicFile, HoldsWhatWasWrittenAndNothingElseIsLeft) {
  const std::string content("one\0two\n", 8);
  write_atomically(folder_ / "a.txt", content);
  EXPECT_EQ(bytes_of(folder_ / "a.txt"), content);
  EXPECT_EQ(files(), 1U);
}

TEST_F(AtomicFile, GrowsUnderAnotherNameUntilItIsWhole) {
  write_atomically(folder_ / "a.txt", "before");
  {
    GrowingFile broken_off(folder_ / "a.txt");
    broken_off.append("half of it");
    EXPECT_EQ(bytes_of(folder_ / "a.txt"), "before");
    EXPECT_EQ(files(), 2U);
  }
  EXPECT_EQ(bytes_of(folder_ / "a.txt"), "before");
  EXPECT_EQ(files(), 1U);
  GrowingFile whole(folder_ / "deep" / "a.txt");
  for (const char* piece : {"one", " and ", "two"}) whole.append(piece);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "deep" / "a.txt"));
  whole.put_in_place();
  EXPECT_EQ(bytes_of(folder_ / "deep" / "a.txt"), "one and two");
}

TEST_F(AtomicFile, ThatGrowsTellsOfAFullDisk) {
  const FullDisk full(1000);
  GrowingFile file(folder_ / "a.txt");
  file.append(std::string(900, 'x'));
  EXPECT_THROW(file.append(std::string(900, 'x')), Error);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.txt"));
}

TEST_F(AtomicFile, MakesTheFoldersOnItsWay) {
  write_atomically(folder_ / "deep" / "er" / "a.txt", "x");
  EXPECT_EQ(bytes_of(folder_ / "deep" / "er" / "a.txt"), "x");
}

TEST_F(AtomicFile, OfManyThatWriteWhatIsAbsentOneIsFirst) {
  for (int attempt = 0; attempt < 20; ++attempt) {
    const auto path = folder_ / std::to_string(attempt);
    std::vector<std::string> first;
    std::mutex guard;
    std::barrier together(4);
    {
      std::vector<std::jthread> writers;
      for (const char* content : {"one", "two", "three", "four"}) {
        writers.emplace_back([&, content] {
          together.arrive_and_wait();
          if (!write_if_absent(path, content)) return;
          const std::lock_guard lock(guard);
          first.emplace_back(content);
        });
      }
    }
    ASSERT_EQ(first.size(), 1U);
    EXPECT_EQ(bytes_of(path), first.front());
    EXPECT_FALSE(write_if_absent(path, "five"));
    EXPECT_EQ(bytes_of(path), first.front());
  }
  EXPECT_EQ(files(), 20U) << "nothing is left beside them";
}

TEST_F(AtomicFile, AFailingWriterLeavesTheOldFileAndNoOther) {
  write_atomically(folder_ / "a.txt", "old");
  const auto half_way = [](const std::filesystem::path& temporary) {
    std::ofstream(temporary) << "ne";
    throw std::runtime_error("interrupted");
  };
  EXPECT_THROW(write_atomically(folder_ / "a.txt", half_way), std::runtime_error);
  EXPECT_EQ(bytes_of(folder_ / "a.txt"), "old");
  EXPECT_EQ(files(), 1U);
}

TEST_F(AtomicFile, TheFinalNameIsNotThereWhileTheWriterWorks) {
  bool seen_early = true;
  write_atomically(folder_ / "a.txt", [&](const std::filesystem::path& temporary) {
    EXPECT_EQ(temporary.parent_path(), folder_) << "another folder may be another disk, where rename fails";
    seen_early = std::filesystem::exists(folder_ / "a.txt");
  });
  EXPECT_FALSE(seen_early);
}

TEST_F(AtomicFile, AFullDiskGivesOneSentenceAndLeavesNothing) {
  std::string message;
  {
    const FullDisk full(1000);
    try {
      write_atomically(folder_ / "a.txt", std::string(5000, 'x'));
    } catch (const Error& error) {
      message = error.what();
    }
  }
  EXPECT_THAT(message, testing::HasSubstr("a.txt"));
  EXPECT_THAT(message, testing::HasSubstr("(File too large); let files grow larger (ulimit -f)"));
  EXPECT_EQ(files(), 0U);
}

TEST_F(AtomicFile, OfFilesThatBelongTogetherAFullDiskLeavesNone) {
  write_together({{folder_ / "a.json", "{}"}, {folder_ / "deep" / "a.npy", "numbers"}});
  EXPECT_EQ(bytes_of(folder_ / "a.json"), "{}");
  EXPECT_EQ(bytes_of(folder_ / "deep" / "a.npy"), "numbers");
  std::filesystem::remove_all(folder_);
  std::filesystem::create_directories(folder_);

  const std::string large(5000, 'x');
  {
    const FullDisk full(1000);
    EXPECT_THROW(write_together({{folder_ / "a.json", "{}"}, {folder_ / "a.npy", large}}), Error);
    EXPECT_THROW(write_together({{folder_ / "a.npy", large}, {folder_ / "a.json", "{}"}}), Error);
  }
  EXPECT_EQ(files(), 0U);
}

// The second name cannot be taken, which shows only when the first has been.
TEST_F(AtomicFile, OfFilesThatBelongTogetherTheFormerOnesStandAgain) {
  write_atomically(folder_ / "a.json", "old");
  std::filesystem::create_directories(folder_ / "a.npy" / "occupied");
  EXPECT_THROW(write_together({{folder_ / "new.json", "{}"}, {folder_ / "a.json", "{}"}, {folder_ / "a.npy", "x"}}),
               Error);
  EXPECT_EQ(bytes_of(folder_ / "a.json"), "old");
  EXPECT_EQ(files(), 2U) << "neither a new name nor a temporary one";
}

// As with a shell's `>`: a picture that is published under a link is the new one wherever it is looked at.
TEST_F(AtomicFile, LinksStayAndWhatTheyLeadToIsWritten) {
  const auto there = folder_ / "there", link = folder_ / "link", first = folder_ / "first";
  std::filesystem::create_directories(there);
  write_atomically(there / "a.txt", "old");
  std::filesystem::create_symlink("there/a.txt", link);
  std::filesystem::create_symlink(link, first);
  const auto expect_written = [&](const char* content) {
    EXPECT_TRUE(std::filesystem::is_symlink(first) && std::filesystem::is_symlink(link));
    EXPECT_FALSE(std::filesystem::is_symlink(there / "a.txt"));
    EXPECT_EQ(bytes_of(there / "a.txt"), content);
    EXPECT_EQ(bytes_of(first), content);
    EXPECT_EQ(files(), 3U) << "nothing is left beside them";
  };
  write_atomically(first, "one");
  expect_written("one");
  write_atomically(first, [&](const std::filesystem::path& temporary) {
    EXPECT_TRUE(std::filesystem::equivalent(temporary.parent_path(), there)) << "another folder may be another disk";
    std::ofstream(temporary) << "two";
  });
  expect_written("two");
  write_together({{first, "three"}, {there / "b.txt", "x"}});
  expect_written("three");
  EXPECT_FALSE(write_if_absent(first, "four"));
  expect_written("three");
  // What stood there stands there again when the other cannot be written.
  std::filesystem::create_directories(there / "occupied" / "folder");
  EXPECT_THROW(write_together({{first, "five"}, {there / "occupied", "x"}}), Error);
  expect_written("three");
}

TEST_F(AtomicFile, LinksThatLeadToNothingYetAreWrittenToWhereTheyLead) {
  const auto link = folder_ / "link", target = folder_ / "there" / "a.txt";
  std::filesystem::create_symlink("there/a.txt", link);
  EXPECT_NO_THROW(check_place_for(link));
  EXPECT_TRUE(write_if_absent(link, "one"));
  EXPECT_EQ(bytes_of(target), "one");
  std::filesystem::remove(target);
  write_atomically(link, "two");
  EXPECT_EQ(bytes_of(target), "two");
  EXPECT_TRUE(std::filesystem::is_symlink(link));
}

TEST_F(AtomicFile, WhatLiesBesideAFileLiesBesideWhatItsLinkLeadsTo) {
  EXPECT_EQ(companion_of(folder_ / "map.npy", ".json"), folder_ / "map.json");
  std::filesystem::create_symlink("there/today.npy", folder_ / "latest.npy");
  EXPECT_EQ(companion_of(folder_ / "latest.npy", ".json"), folder_ / "there" / "today.json");
  // There the one would take the place of the other.
  std::filesystem::create_symlink("there/map.json", folder_ / "astray.npy");
  EXPECT_THROW(static_cast<void>(companion_of(folder_ / "astray.npy", ".json")), Error);
}

TEST_F(AtomicFile, PlacesAreThoseThatLinksLeadTo) {
  write_atomically(folder_ / "file", "x");
  std::filesystem::create_symlink("file/a.txt", folder_ / "below_a_file");
  std::filesystem::create_symlink(".", folder_ / "to_a_folder");
  std::filesystem::create_symlink("round", folder_ / "round");
  for (const char* name : {"below_a_file", "to_a_folder", "round"}) {
    EXPECT_THROW(check_place_for(folder_ / name), Error) << name;
    EXPECT_THROW(write_atomically(folder_ / name, "x"), Error) << name;
    EXPECT_TRUE(std::filesystem::is_symlink(folder_ / name)) << name;
  }
}

TEST_F(AtomicFile, AFolderThatCannotBeMadeIsNamed) {
  write_atomically(folder_ / "file", "x");
  try {
    write_atomically(folder_ / "file" / "a.txt", "x");
    FAIL() << "a file was taken for a folder";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("file/a.txt"));
  }
}

TEST_F(AtomicFile, PlacesWhereNothingCanLieAreToldBeforeTheWork) {
  write_atomically(folder_ / "file", "x");
  // Whoever may execute it could enter it, were it a folder.
  std::filesystem::permissions(folder_ / "file", std::filesystem::perms::owner_all);
  EXPECT_THROW(check_place_for(folder_ / "file" / "a.txt"), Error);
  EXPECT_THROW(check_place_for(folder_ / "file" / "deeper" / "a.txt"), Error);
  EXPECT_THROW(check_place_for(folder_), Error);
  EXPECT_NO_THROW(check_place_for(folder_ / "file"));
  EXPECT_NO_THROW(check_place_for(folder_ / "new" / "deeper" / "a.txt"));
  EXPECT_NO_THROW(check_place_for("a.txt"));
  EXPECT_NO_THROW(check_place_for(folder_ / std::string(150, 'a')));
  EXPECT_THROW(check_place_for(folder_ / std::string(250, 'a')), Error) << "another name is longer meanwhile";
  EXPECT_EQ(files(), 1U) << "the check writes nothing";
}

TEST_F(AtomicFile, FoldersThatMayNotBeWrittenToAreToldBeforeTheWork) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  std::filesystem::create_directories(folder_ / "locked");
  std::filesystem::permissions(folder_ / "locked", std::filesystem::perms::owner_read);
  EXPECT_THROW(check_place_for(folder_ / "locked" / "a.txt"), Error);
  EXPECT_THROW(check_place_for(folder_ / "locked" / "new" / "a.txt"), Error);
}

TEST_F(AtomicFile, ManyWritersOfOneNameNeverMix) {
  const auto path = folder_ / "a.txt";
  std::vector<std::thread> writers;
  for (char letter : {'a', 'b', 'c', 'd'}) {
    writers.emplace_back([&path, letter] {
      for (int i = 0; i < 20; ++i) write_atomically(path, std::string(20000, letter));
    });
  }
  for (std::thread& writer : writers) writer.join();
  const std::string content = bytes_of(path);
  ASSERT_EQ(content.size(), 20000U);
  EXPECT_EQ(content, std::string(20000, content.front()));
  EXPECT_EQ(files(), 1U);
}

TEST_F(AtomicFile, WhatAnEndedProcessLeftIsRemoved) {
  const pid_t child = ::fork();
  if (child == 0) write_atomically(folder_ / "a.txt", [](const std::filesystem::path&) { ::_exit(0); });
  ::waitpid(child, nullptr, 0);
  ASSERT_EQ(files(), 1U);
  remove_leftovers(folder_, "b");
  EXPECT_EQ(files(), 1U) << "it is of another file";
  remove_leftovers(folder_, "a");
  EXPECT_EQ(files(), 0U);
}

TEST_F(AtomicFile, WhatIsBeingWrittenIsNoLeftover) {
  write_atomically(folder_ / "a.txt", [&](const std::filesystem::path& temporary) {
    std::ofstream(temporary) << "half";
    remove_leftovers(folder_, "a");
    EXPECT_TRUE(std::filesystem::exists(temporary));
  });
  EXPECT_EQ(bytes_of(folder_ / "a.txt"), "half");
}

TEST_F(AtomicFile, WhatOthersNamedAlikeStays) {
  for (const char* name : {".notes.tmp", ".a.0-.tmp", ".a.-1.tmp", ".99-0.tmp", ".a.0123-99-0.tmp", ".a.99-0.tmp~"}) {
    std::ofstream(folder_ / name) << "of others";
    std::filesystem::last_write_time(folder_ / name,
                                     std::filesystem::file_time_type::clock::now() - std::chrono::hours(30));
    remove_leftovers(folder_, "");
    EXPECT_TRUE(std::filesystem::exists(folder_ / name)) << name;
  }
}

// The process of that number may be alive on a host whose locks do not reach here.
TEST_F(AtomicFile, WhatIsOfAnotherHostIsRemovedWhenItIsOld) {
  for (const char* name : {".a.txt.0123456789abcdef-99999999-0.tmp", ".a.txt.99-0.tmp"}) {
    std::ofstream(folder_ / name) << "half";
    remove_leftovers(folder_, "a");
    EXPECT_TRUE(std::filesystem::exists(folder_ / name)) << name;
    const auto now = std::filesystem::file_time_type::clock::now();
    std::filesystem::last_write_time(folder_ / name, now - std::chrono::hours(12));
    remove_leftovers(folder_, "a");
    EXPECT_TRUE(std::filesystem::exists(folder_ / name)) << name;
    std::filesystem::last_write_time(folder_ / name, now - std::chrono::hours(30));
    remove_leftovers(folder_, "a");
    EXPECT_FALSE(std::filesystem::exists(folder_ / name)) << name;
  }
}

}  // namespace
}  // namespace sigmascape::geo
