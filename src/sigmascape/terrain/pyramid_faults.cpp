#include "sigmascape/terrain/pyramid_faults.h"

#include <cstdint>
#include <fmt/format.h>
#include <system_error>
#include <utility>

#include "sigmascape/base/error.h"
#include "sigmascape/geo/is_absent.h"
#include "sigmascape/terrain/height_tile.h"
#include "sigmascape/terrain/pyramid_files.h"

namespace sigmascape::terrain {
namespace {

/// What is wrong with one of the files of a folder, if anything; `read` throws Error when it is not as it was written.
template <typename Read>
std::optional<PyramidFault> fault_of(const std::filesystem::path& folder, const std::filesystem::path& file,
                                     const Read& read) {
  std::error_code error;
  const bool is_there = std::filesystem::exists(file, error);
  const std::filesystem::path name = file.lexically_relative(folder);
  if (error) return PyramidFault{name, fmt::format("cannot be read ({})", error.message())};
  if (!is_there) return PyramidFault{name, "is missing"};
  try {
    read();
    return std::nullopt;
  } catch (const Error&) {
    return PyramidFault{name, "is truncated or was altered"};
  }
}

/// Calls `on_file(file, read)` for every file that the heading speaks of; `read(crs)` reads it whole.
template <typename OnFile>
void for_each_file(const std::filesystem::path& folder, const OnFile& on_file) {
  const PyramidHeading heading = read_heading(folder / heading_name);
  for (int level = 0; level < heading.layout.levels(); ++level) {
    on_file(index_path(folder, level),
            [&](const std::string&) { static_cast<void>(read_index(folder, heading, level)); });
    for (std::uint32_t row = 0; row < heading.layout.down(level); ++row) {
      for (std::uint32_t column = 0; column < heading.layout.across(level); ++column) {
        const TileKey key{level, column, row};
        on_file(tile_path(folder, key),
                [&](const std::string& crs) { static_cast<void>(read_whole_tile(folder, heading.layout, crs, key)); });
      }
    }
  }
}

}  // namespace

bool holds_pyramid(const std::filesystem::path& folder) {
  return !geo::is_absent(folder / heading_name);
}

bool holds_pyramid_of_a_field(const std::filesystem::path& folder) {
  return !heading_fault(folder) && read_heading(folder / heading_name).is_of_field;
}

bool is_called_unfinished(const std::filesystem::path& folder) {
  return holds_pyramid(folder) && !geo::is_absent(folder / unfinished_heading_name);
}

void call_finished(const std::filesystem::path& folder) {
  if (is_called_unfinished(folder)) std::filesystem::remove(folder / unfinished_heading_name);
}

std::optional<PyramidFault> heading_fault(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / heading_name;
  return fault_of(folder, file, [&] { static_cast<void>(read_heading(file)); });
}

std::vector<PyramidFault> verify_pyramid(const std::filesystem::path& folder, const geo::LocalFrame& frame) {
  if (const auto fault = heading_fault(folder)) return {*fault};
  std::vector<PyramidFault> faults;
  const std::string crs = frame.proj();
  for_each_file(folder, [&](const std::filesystem::path& file, const auto& read) {
    if (auto fault = fault_of(folder, file, [&] { read(crs); })) faults.push_back(std::move(*fault));
  });
  return faults;
}

std::vector<PyramidFault> missing_files(const std::filesystem::path& folder) {
  if (const auto fault = heading_fault(folder)) return {*fault};
  std::vector<PyramidFault> faults;
  for_each_file(folder, [&](const std::filesystem::path& file, const auto&) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) faults.push_back({file.lexically_relative(folder), "is missing"});
  });
  return faults;
}

}  // namespace sigmascape::terrain
