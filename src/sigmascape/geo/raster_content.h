#pragma once

#include <string>
#include <vector>

class GDALDataset;

namespace sigmascape::geo {

/// SHA-256 of each file that a raster is read from, in order of their names, and of files beside it that say more of
/// it. A mosaic (VRT) is read from what it is put together from, which may be mosaics again; files within archives count
/// as those on disk. What has no such name, as one raster of several in a file, adds the digest of what it is called.
/// Equal lists mean equal rasters. Throws Error when one of them cannot be read.
[[nodiscard]] std::vector<std::string> digests_of_content(GDALDataset& raster);

}  // namespace sigmascape::geo
