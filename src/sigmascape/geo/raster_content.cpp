#include "sigmascape/geo/raster_content.h"

#include <array>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gdal_priv.h>
#include <memory>
#include <set>

#include "sigmascape/base/error.h"
#include "sigmascape/base/interruption.h"
#include "sigmascape/base/sha256.h"
#include "sigmascape/geo/quiet_gdal.h"

namespace sigmascape::geo {
namespace {

bool is_file(const std::string& name) {
  VSIStatBufL status;
  return VSIStatL(name.c_str(), &status) == 0 && VSI_ISREG(status.st_mode) != 0;
}

struct Closing {
  void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};

std::string digest_of_file(const std::string& name) {
  const std::unique_ptr<VSILFILE, Closing> file(VSIFOpenL(name.c_str(), "rb"));
  if (!file) throw Error(name, "cannot be read", "check that the file exists and may be read");
  Sha256 digest;
  std::array<std::byte, 1 << 16> buffer{};
  while (const std::size_t read = VSIFReadL(buffer.data(), 1, buffer.size(), file.get())) {
    Interruption::heed();
    digest.add(std::span(buffer).first(read));
  }
  if (VSIFEofL(file.get()) == 0) throw Error(name, "cannot be read to its end", "check that it is a whole file");
  return digest.hex_digest();
}

/// Adds the files that a raster lists, and those that the mosaics among them list, which GDAL leaves to whoever asks.
void add_files(GDALDataset& raster, std::set<std::string>& files) {
  const CPLStringList listed(raster.GetFileList());
  for (int i = 0; i < listed.size(); ++i) {
    const std::string name = listed[i];
    if (!is_file(name) || !files.insert(name).second) continue;
    static constexpr std::array<const char*, 2> mosaics = {"VRT", nullptr};
    const GDALDatasetUniquePtr mosaic(
        GDALDataset::Open(name.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, mosaics.data()));
    if (mosaic) add_files(*mosaic, files);
  }
}

}  // namespace

std::vector<std::string> digests_of_content(GDALDataset& raster) {
  const QuietGdal quiet;
  std::set<std::string> files;
  add_files(raster, files);
  std::vector<std::string> digests;
  for (const std::string& file : files) digests.push_back(digest_of_file(file));
  const std::string name = raster.GetDescription();
  if (!files.contains(name)) digests.push_back(sha256_of(name));
  return digests;
}

}  // namespace sigmascape::geo
