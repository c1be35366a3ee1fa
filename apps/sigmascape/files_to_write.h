#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace sigmascape::cli {

/// A file to write, and the option that names it; no file when the option was not given.
struct NamedFile {
  const char* option;
  const std::string& file;
};

/// What can be told of files, and of those that are written beside them, before the work that fills them. Throws Error
/// for one that cannot be written where it is to lie, that is or lies in one of `read`, the files and folders that the
/// work is made from, or that another option names as well, of which the second would take the place of the first.
void check_files_to_write(std::span<const NamedFile> files, const std::vector<std::filesystem::path>& read);

/// The same of files that are added to where they are: whether they can be written is seen when they are opened.
void check_files_apart(std::span<const NamedFile> files, const std::vector<std::filesystem::path>& read);

/// Whether a file lies in a folder or below it, by links too; neither need be there yet.
[[nodiscard]] bool lies_in(const std::filesystem::path& file, const std::filesystem::path& named);

}  // namespace sigmascape::cli
