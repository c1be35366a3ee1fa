#pragma once

#include <string>
#include <vector>

class GDALDataset;

namespace sigmascape::geo {

/// SHA-256 of each file that a raster is read from, in order of their names, and of files beside it that say more of
/// it. A mosaic (VRT) is read from what it is put together from, and each part of that as if it were read alone; files
/// within archives count as those on disk. Of files on other machines name, size and time stand for what is in them,
/// and what is no file, as one raster of several in one, adds the digest of what it is called. Equal lists mean equal
/// rasters. Throws Error when one of them cannot be read.
[[nodiscard]] std::vector<std::string> digests_of_content(GDALDataset& raster);

}  // namespace sigmascape::geo
