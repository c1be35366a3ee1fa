#pragma once

#include <atomic>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <string>
#include <unistd.h>

#include "sigmascape/base/error.h"

namespace sigmascape {

/// A new folder, for one test or for a whole suite when made while that is set up; removed afterwards.
class ScratchFolder {
 public:
  ScratchFolder() : folder_(std::filesystem::temp_directory_path() / name()) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~ScratchFolder() { std::filesystem::remove_all(folder_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] std::filesystem::path path(const std::string& file) const { return folder_ / file; }
  std::filesystem::path write(const std::string& file, const std::string& text) const {
    std::ofstream(path(file), std::ios::binary) << text;
    return path(file);
  }

 private:
  static std::string name() {
    static std::atomic<int> made{0};
    const auto* unit = ::testing::UnitTest::GetInstance();
    const auto* test = unit->current_test_info();
    std::string words = std::string("sigmascape_") + unit->current_test_suite()->name() + "_" +
                        (test != nullptr ? test->name() : "suite") + "_" + std::to_string(getpid()) + "_" +
                        std::to_string(++made);
    for (char& c : words) c = c == '/' ? '_' : c;
    return words;
  }
  std::filesystem::path folder_;
};

/// Every file of a folder and those below with its bytes.
[[nodiscard]] inline std::map<std::string, std::string> files_of(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream file(entry.path(), std::ios::binary);
    files[std::filesystem::relative(entry.path(), folder).string()] = {std::istreambuf_iterator<char>(file), {}};
  }
  return files;
}

/// Names the files in which two folders differ, or that only one has; empty when they are equal byte for byte.
[[nodiscard]] inline std::string difference_of(const std::map<std::string, std::string>& found,
                                               const std::map<std::string, std::string>& expected) {
  std::string words;
  for (const auto& [name, content] : expected) {
    const auto other = found.find(name);
    if (other == found.end()) {
      words += name + " is missing; ";
    } else if (other->second != content) {
      words += name + " differs; ";
    }
  }
  for (const auto& [name, content] : found) words += expected.contains(name) ? "" : name + " is too many; ";
  return words;
}

/// The message of the Error that an action throws; empty when it throws none.
template <typename Action>
[[nodiscard]] std::string message_of_error(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace sigmascape
