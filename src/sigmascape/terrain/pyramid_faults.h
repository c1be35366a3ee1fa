#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sigmascape/geo/local_frame.h"

namespace sigmascape::terrain {

/// Whether a folder holds the heading of a finished pyramid, whatever that is like.
[[nodiscard]] bool holds_pyramid(const std::filesystem::path& folder);
/// Whether it says that it was made from a field in memory, as bakes make it, rather than from a raster. Those of a
/// former kind do not say.
[[nodiscard]] bool holds_pyramid_of_a_field(const std::filesystem::path& folder);

/// Whether beside the heading of a finished pyramid lies what says that it is unfinished, as of a build that was killed
/// between its last two steps.
[[nodiscard]] bool is_called_unfinished(const std::filesystem::path& folder);
/// Removes that. For whoever has the right to build there.
void call_finished(const std::filesystem::path& folder);

struct PyramidFault {
  std::filesystem::path file;  ///< relative to the folder
  std::string what;            ///< "is missing", "is truncated or was altered", "cannot be read (…)"
};

/// What is wrong with the heading of a finished pyramid, if anything: without one that can be understood the rest
/// counts for nothing.
[[nodiscard]] std::optional<PyramidFault> heading_fault(const std::filesystem::path& folder);

/// Reads every file of a pyramid on disk and returns those that are not as they were written: tiles that say that they
/// lie elsewhere in `frame`, in which the pyramid was built, among them.
[[nodiscard]] std::vector<PyramidFault> verify_pyramid(const std::filesystem::path& folder,
                                                       const geo::LocalFrame& frame);

/// Those that are not there at all, its heading among them; reads nothing else.
[[nodiscard]] std::vector<PyramidFault> missing_files(const std::filesystem::path& folder);

}  // namespace sigmascape::terrain
