#include "sigmascape/geo/byte_raster.h"

#include <cpl_string.h>
#include <gdal_priv.h>

#include "sigmascape/geo/gdal_memory_file.h"
#include "sigmascape/geo/geotiff_encoding.h"
#include "sigmascape/geo/quiet_gdal.h"

namespace sigmascape::geo {

std::string byte_geotiff_bytes(const RasterPlacement& placement, const std::string& band,
                               const Array2D<std::uint8_t>& values) {
  const QuietGdal quiet;
  const GdalMemoryFile file;
  CPLStringList options;
  for (const char* option : {"TILED=YES", "BLOCKXSIZE=256", "BLOCKYSIZE=256", "COMPRESS=ZSTD", "ZSTD_LEVEL=9"}) {
    options.AddString(option);
  }
  const auto columns = static_cast<int>(values.columns()), rows = static_cast<int>(values.rows());
  GDALDatasetUniquePtr dataset(gdal_driver("GTiff").Create(file.name(), columns, rows, 1, GDT_Byte, options.List()));
  if (!dataset) fail_to_encode(band);
  place(*dataset, placement);
  dataset->GetRasterBand(1)->SetDescription(band.c_str());
  // GDAL asks for a pointer that it could write through; writing leaves the values as they are.
  auto* bytes = const_cast<std::uint8_t*>(values.values().data());
  if (dataset->RasterIO(GF_Write, 0, 0, columns, rows, bytes, columns, rows, GDT_Byte, 1, nullptr, 0, 0, 0, nullptr) !=
      CE_None) {
    fail_to_encode(band);
  }
  dataset.reset();
  if (QuietGdal::failed()) fail_to_encode(band);
  return std::string(file.bytes());
}

}  // namespace sigmascape::geo
