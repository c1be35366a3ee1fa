#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "sigmascape/base/error.h"
#include "sigmascape/base/file_ending.h"
#include "sigmascape/geo/atomic_file.h"

namespace sigmascape::cli {

/// A file to write, and the option that names it; no file when the option was not given.
struct NamedFile {
  const char* option;
  const std::string& file;
};

/// The file, under the name that all have which share their companions with it: "map.NPY" and "map.npy" both have
/// map.json beside them.
[[nodiscard]] inline std::filesystem::path name_for_all_cases(const std::filesystem::path& file) {
  return std::filesystem::absolute(file).lexically_normal().replace_extension(file_ending(file));
}

/// What can be told of files before the work that fills them. Throws Error for one that cannot be written where it is
/// to lie, and when two options name one file, of which the second would take the place of the first.
inline void check_files_to_write(std::span<const NamedFile> files) {
  std::map<std::filesystem::path, const char*> taken;
  for (const NamedFile& named : files) {
    if (named.file.empty()) continue;
    geo::check_place_for(named.file);
    const auto [other, is_new] = taken.emplace(name_for_all_cases(named.file), named.option);
    if (!is_new) {
      throw Error(named.option, "names " + named.file + ", as " + other->second + " does",
                  "give each of them a file of its own");
    }
  }
}

}  // namespace sigmascape::cli
