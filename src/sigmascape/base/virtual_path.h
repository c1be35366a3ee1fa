#pragma once

#include <filesystem>

namespace sigmascape {

/// Whether a path is of the kind /vsizip//data/heights.zip/heights.tif, by which GDAL reads what lies within an archive
/// or comes from elsewhere: the file system knows nothing of such a file, and GDAL alone tells whether it is there.
[[nodiscard]] inline bool is_virtual(const std::filesystem::path& path) {
  return path.string().starts_with("/vsi");
}

}  // namespace sigmascape
