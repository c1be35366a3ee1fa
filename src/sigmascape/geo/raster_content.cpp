#include "sigmascape/geo/raster_content.h"

#include <array>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <memory>
#include <set>

#include "sigmascape/base/error.h"
#include "sigmascape/base/interruption.h"
#include "sigmascape/base/sha256.h"
#include "sigmascape/geo/quiet_gdal.h"

namespace sigmascape::geo {
namespace {

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

/// Of what goes by that name, be it a file or not.
std::string digest_of(const std::string& name) {
  VSIStatBufL status;
  if (VSIStatL(name.c_str(), &status) != 0 || VSI_ISREG(status.st_mode) == 0) return sha256_of(name);
  if (VSIIsLocal(name.c_str())) return digest_of_file(name);
  return sha256_of(fmt::format("{} {} {}", name, status.st_size, status.st_mtime));
}

/// Adds what a raster lists, and what that lists by itself: of a mosaic GDAL names its parts, but not what these are
/// read from.
void add_names(GDALDataset& raster, std::set<std::string>& names) {
  names.insert(raster.GetDescription());
  const CPLStringList listed(raster.GetFileList());
  for (int i = 0; i < listed.size(); ++i) {
    if (!names.insert(listed[i]).second) continue;
    const GDALDatasetUniquePtr part(GDALDataset::Open(listed[i], GDAL_OF_RASTER | GDAL_OF_READONLY));
    if (part) add_names(*part, names);
  }
}

}  // namespace

std::vector<std::string> digests_of_content(GDALDataset& raster) {
  const QuietGdal quiet;
  std::set<std::string> names;
  add_names(raster, names);
  std::vector<std::string> digests;
  for (const std::string& name : names) digests.push_back(digest_of(name));
  return digests;
}

}  // namespace sigmascape::geo
