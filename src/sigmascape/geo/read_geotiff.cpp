#include <array>
#include <cmath>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <string_view>

#include "sigmascape/base/error.h"
#include "sigmascape/base/machine_memory.h"
#include "sigmascape/geo/geo_raster.h"
#include "sigmascape/geo/is_absent.h"
#include "sigmascape/geo/quiet_gdal.h"
#include "sigmascape/geo/spatial_reference.h"

namespace sigmascape::geo {
namespace {

/// Fails unless the raster is north up with square cells.
RasterPlacement placement_of(const std::filesystem::path& path, GDALDataset& dataset) {
  std::array<double, 6> transform{};
  if (dataset.GetGeoTransform(transform.data()) != CE_None) {
    throw Error(path.string(), "has no georeference", "give a raster that knows where it lies");
  }
  const double cell_m = transform[1];
  if (transform[2] != 0.0 || transform[4] != 0.0 || cell_m <= 0.0 || std::abs(transform[5] + cell_m) > 1e-9 * cell_m) {
    throw Error(path.string(), "is not north up with square cells", "warp it first, for example with gdalwarp");
  }
  const OGRSpatialReference* reference = dataset.GetSpatialRef();
  if (reference == nullptr)
    throw Error(path.string(), "has no CRS", "assign one, for example with gdal_edit.py -a_srs");
  return {transform[0], transform[3], cell_m, wkt2_from(*reference)};
}

/// Bands are read whole.
void require_room(const std::filesystem::path& path, GDALDataset& dataset) {
  const double cells = static_cast<double>(dataset.GetRasterXSize()) * dataset.GetRasterYSize(),
               bytes = cells * dataset.GetRasterCount() * static_cast<double>(sizeof(float)),
               memory_bytes = machine_memory_bytes();
  if (bytes <= memory_bytes) return;
  throw Error(path.string(),
              fmt::format("holds {} × {} cells in {} bands, which take {:.3g} GB of memory, and there are {:.3g}",
                          dataset.GetRasterXSize(), dataset.GetRasterYSize(), dataset.GetRasterCount(), bytes / 1e9,
                          memory_bytes / 1e9),
              "give another file, or a part of this one, for example by gdal_translate -projwin");
}

NamedBand read_band(const std::filesystem::path& path, GDALRasterBand& source) {
  const int columns = source.GetXSize();
  const int rows = source.GetYSize();
  NamedBand band{source.GetDescription(),
                 Array2D<float>(static_cast<std::size_t>(columns), static_cast<std::size_t>(rows))};
  band.unit = source.GetUnitType();
  if (source.RasterIO(GF_Read, 0, 0, columns, rows, band.values.values().data(), columns, rows, GDT_Float32, 0, 0,
                      nullptr) != CE_None) {
    throw Error(fmt::format("{}, band {}", path.string(), source.GetBand()),
                fmt::format("cannot be read ({})", QuietGdal::complaint()),
                "the file is damaged: make or fetch it again");
  }
  const auto scale = static_cast<float>(source.GetScale());
  const auto offset = static_cast<float>(source.GetOffset());
  int has_nodata = FALSE;
  const auto nodata = static_cast<float>(source.GetNoDataValue(&has_nodata));
  if (scale == 1.0F && offset == 0.0F) return band;
  for (float& value : band.values.values()) {
    if (has_nodata == FALSE || value != nodata) value = value * scale + offset;
  }
  return band;
}

std::map<std::string, std::string> metadata_of(GDALDataset& dataset) {
  std::map<std::string, std::string> metadata;
  for (const char* const* item = dataset.GetMetadata(); item != nullptr && *item != nullptr; ++item) {
    const std::string_view pair = *item;
    const std::size_t equals = pair.find('=');
    if (equals == std::string_view::npos || pair.starts_with("AREA_OR_POINT=")) continue;
    metadata.emplace(pair.substr(0, equals), pair.substr(equals + 1));
  }
  return metadata;
}

GDALDatasetUniquePtr opened(const std::filesystem::path& path) {
  register_gdal_drivers();
  const std::array<const char*, 2> drivers{"GTiff", nullptr};
  GDALDatasetUniquePtr dataset(
      GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers.data(), nullptr, nullptr));
  if (dataset) return dataset;
  if (is_absent(path)) throw Error(path.string(), "the file does not exist", "correct the path");
  throw Error(path.string(), fmt::format("cannot be opened as GeoTIFF ({})", QuietGdal::complaint()),
              "check the path and the format");
}

}  // namespace

RasterCells read_cells(const std::filesystem::path& path) {
  const QuietGdal quiet;
  const GDALDatasetUniquePtr dataset = opened(path);
  return {placement_of(path, *dataset), static_cast<std::size_t>(dataset->GetRasterXSize()),
          static_cast<std::size_t>(dataset->GetRasterYSize())};
}

GeoRaster read_geotiff(const std::filesystem::path& path) {
  const QuietGdal quiet;
  const GDALDatasetUniquePtr dataset = opened(path);
  GeoRaster raster;
  raster.placement = placement_of(path, *dataset);
  raster.metadata = metadata_of(*dataset);
  require_room(path, *dataset);
  for (int band = 1; band <= dataset->GetRasterCount(); ++band) {
    raster.bands.push_back(read_band(path, *dataset->GetRasterBand(band)));
  }
  int has_nodata = FALSE;
  const double nodata = dataset->GetRasterBand(1)->GetNoDataValue(&has_nodata);
  if (has_nodata != FALSE) raster.nodata = static_cast<float>(nodata);
  return raster;
}

}  // namespace sigmascape::geo
