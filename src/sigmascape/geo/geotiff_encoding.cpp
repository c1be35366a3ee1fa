#include "sigmascape/geo/geotiff_encoding.h"

#include <array>
#include <cpl_string.h>
#include <fmt/format.h>

#include "sigmascape/base/error.h"
#include "sigmascape/geo/quiet_gdal.h"
#include "sigmascape/geo/spatial_reference.h"

namespace sigmascape::geo {

void fail_to_encode(std::string_view what) {
  throw Error(std::string(what), fmt::format("GDAL cannot encode it ({})", QuietGdal::complaint()),
              "install a GDAL whose GeoTIFF driver has ZSTD and enough memory for the raster");
}

GDALDatasetUniquePtr floats_in_memory(std::string_view what, int columns, int rows, int bands,
                                      const RasterPlacement& placement,
                                      const std::map<std::string, std::string>& metadata) {
  GDALDatasetUniquePtr dataset(gdal_driver("MEM").Create("", columns, rows, bands, GDT_Float32, nullptr));
  if (!dataset) fail_to_encode(what);
  place(*dataset, placement);
  for (const auto& [key, value] : metadata) {
    // GDAL keeps "key=value", and reads a key up to the first equals sign or colon.
    if (key.empty() || key.find_first_of("=:") != std::string::npos) {
      throw Error(std::string(what), fmt::format("has the metadata key '{}', which a GeoTIFF cannot hold", key),
                  "name it without equals signs and colons");
    }
    if (key.find('\0') != std::string::npos || value.find('\0') != std::string::npos) {
      throw Error(std::string(what),
                  fmt::format("has a zero byte in the metadata '{}', where a GeoTIFF's text ends",
                              key.substr(0, key.find('\0'))),
                  "leave it out");
    }
    dataset->SetMetadataItem(key.c_str(), value.c_str());
  }
  return dataset;
}

void add_empty_overviews(std::string_view what, GDALDataset& dataset, const std::vector<int>& factors) {
  if (factors.empty()) return;
  if (dataset.BuildOverviews("NONE", static_cast<int>(factors.size()), factors.data(), 0, nullptr, nullptr, nullptr) !=
      CE_None) {
    fail_to_encode(what);
  }
}

void place(GDALDataset& dataset, const RasterPlacement& placement) {
  std::array<double, 6> transform{placement.west_m, placement.cell_m, 0.0, placement.north_m, 0.0, -placement.cell_m};
  dataset.SetGeoTransform(transform.data());
  const OGRSpatialReference reference = reference_from(placement.crs, "CRS");
  dataset.SetSpatialRef(&reference);
}

void encode_geotiff(std::string_view what, GDALDataset& source, std::initializer_list<const char*> options,
                    const GdalMemoryFile& into) {
  CPLStringList list;
  for (const char* option : options) list.AddString(option);
  GDALDatasetUniquePtr copy(
      gdal_driver("GTiff").CreateCopy(into.name(), &source, FALSE, list.List(), nullptr, nullptr));
  if (!copy) fail_to_encode(what);
  // Whatever is still to be written is written now.
  copy.reset();
  if (QuietGdal::failed()) fail_to_encode(what);
  // What the keys of GeoTIFF cannot say GDAL writes beside the file, where nobody would find it.
  const std::string beside = std::string(into.name()) + ".aux.xml";
  VSIStatBufL found{};
  if (VSIStatL(beside.c_str(), &found) == 0) {
    VSIUnlink(beside.c_str());
    throw Error(std::string(what), "is in a coordinate reference system that GeoTIFF has no keys for",
                "choose another one");
  }
}

}  // namespace sigmascape::geo
