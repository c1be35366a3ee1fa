#include "files_to_write.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <system_error>
#include <utility>

#include "sigmascape/base/error.h"
#include "sigmascape/base/file_ending.h"
#include "sigmascape/geo/atomic_file.h"

namespace sigmascape::cli {
namespace {

/// The file and what lies beside it: product/map_file.h, png_file.h, iq_sigmf.h.
std::vector<std::filesystem::path> with_companion(const std::filesystem::path& file) {
  constexpr std::array<std::pair<const char*, const char*>, 3> companions{
      {{".npy", ".json"}, {".png", ".pgw"}, {".sigmf-meta", ".sigmf-data"}}};
  std::vector<std::filesystem::path> files{file};
  for (const auto& [ending, companion] : companions) {
    if (file_ending(file) == ending) files.push_back(geo::companion_of(file, companion));
  }
  return files;
}

/// One path for all that name the same file, by links too.
std::filesystem::path known_path(const std::filesystem::path& file) {
  std::error_code fault;
  const std::filesystem::path absolute = std::filesystem::absolute(geo::end_of_links(file));
  const std::filesystem::path folder = std::filesystem::weakly_canonical(absolute.parent_path(), fault);
  return fault ? absolute.lexically_normal() : folder / absolute.filename();
}

/// Whether it is that file, or lies in that folder.
bool is_of(const std::filesystem::path& file, const std::filesystem::path& other) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(other, ignored)) return std::filesystem::equivalent(file, other, ignored);
  return lies_in(file, other);
}

}  // namespace

bool lies_in(const std::filesystem::path& file, const std::filesystem::path& named) {
  std::error_code ignored;
  std::filesystem::path folder = std::filesystem::weakly_canonical(std::filesystem::absolute(named), ignored);
  if (!folder.has_filename()) folder = folder.parent_path();  // one named with a slash at its end, not yet there
  const std::filesystem::path known = known_path(file);
  return std::ranges::mismatch(folder, known).in1 == folder.end();
}

void check_files_to_write(std::span<const NamedFile> files, const std::vector<std::filesystem::path>& read) {
  for (const auto& [option, file] : files) {
    if (file.empty()) continue;
    for (const std::filesystem::path& written : with_companion(file)) geo::check_place_for(written);
  }
  check_files_apart(files, read);
}

void check_files_apart(std::span<const NamedFile> files, const std::vector<std::filesystem::path>& read) {
  std::map<std::filesystem::path, const char*> taken;
  for (const auto& [option, file] : files) {
    if (file.empty()) continue;
    for (const std::filesystem::path& written : with_companion(file)) {
      const std::string names = written == file
                                    ? fmt::format("names {}", file)
                                    : fmt::format("names {}, which has {} beside it", file, written.string());
      if (std::ranges::any_of(read, [&](const auto& other) { return is_of(written, other); }))
        throw Error(option, names + ", of what this is made from", "give it a file of its own");
      const auto [other, is_new] = taken.emplace(known_path(written), option);
      if (!is_new)
        throw Error(option, fmt::format("{}, as {} does", names, other->second), "give each of them a file of its own");
    }
  }
}

}  // namespace sigmascape::cli
