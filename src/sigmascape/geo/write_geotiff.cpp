#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gdal_priv.h>

#include "sigmascape/base/error.h"
#include "sigmascape/base/file_ending.h"
#include "sigmascape/base/units.h"
#include "sigmascape/geo/atomic_file.h"
#include "sigmascape/geo/gdal_memory_file.h"
#include "sigmascape/geo/geo_raster.h"
#include "sigmascape/geo/geotiff_encoding.h"
#include "sigmascape/geo/quiet_gdal.h"

namespace sigmascape::geo {
namespace {

void check_bands(const std::filesystem::path& path, const GeoRaster& raster) {
  if (raster.bands.empty()) throw Error(path.string(), "the raster has no bands", "give at least one");
  const Array2D<float>& first = raster.bands.front().values;
  if (first.empty()) throw Error(path.string(), "the raster has no cells", "give at least one column and row");
  for (const NamedBand& band : raster.bands) {
    if (band.values.columns() == first.columns() && band.values.rows() == first.rows()) continue;
    throw Error(fmt::format("{}, band {}", path.string(), band.name),
                fmt::format("has {} x {} cells", band.values.columns(), band.values.rows()),
                fmt::format("all bands must have the {} x {} of band {}", first.columns(), first.rows(),
                            raster.bands.front().name));
  }
}

void write_cells(GDALRasterBand& target, const Array2D<float>& cells) {
  const auto columns = static_cast<int>(cells.columns());
  const auto rows = static_cast<int>(cells.rows());
  // GDAL's interface serves reading and writing alike, hence the cast; writing leaves the values as they are.
  auto* values = const_cast<float*>(cells.values().data());
  if (target.RasterIO(GF_Write, 0, 0, columns, rows, values, columns, rows, GDT_Float32, 0, 0, nullptr) != CE_None) {
    fail_to_encode(fmt::format("band {}", target.GetDescription()));
  }
}

/// Overview cells cover `factor` × `factor` cells, at the southern and eastern edge what there is of them.
Array2D<float> overview_of(const NamedBand& band, std::size_t factor, std::optional<float> nodata) {
  const Array2D<float>& fine = band.values;
  Array2D<float> coarse((fine.columns() + factor - 1) / factor, (fine.rows() + factor - 1) / factor);
  for (std::size_t row = 0; row < coarse.rows(); ++row) {
    for (std::size_t column = 0; column < coarse.columns(); ++column) {
      const std::size_t left = column * factor, top = row * factor;
      coarse(column, row) = fine(left, top);
      if (band.is_classes) continue;
      double sum = 0.0;
      std::size_t known = 0;
      for (std::size_t y = top; y < std::min(top + factor, fine.rows()); ++y) {
        for (std::size_t x = left; x < std::min(left + factor, fine.columns()); ++x) {
          if (std::isnan(fine(x, y)) || fine(x, y) == nodata) continue;
          sum += band.is_decibels ? linear_from_db(fine(x, y)) : static_cast<double>(fine(x, y));
          ++known;
        }
      }
      if (known == 0) continue;
      const double mean = sum / static_cast<double>(known);
      coarse(column, row) = static_cast<float>(band.is_decibels ? db_from_linear(mean) : mean);
    }
  }
  return coarse;
}

/// 2, 4, …: the last overview fits one tile.
std::vector<int> overview_factors(const Array2D<float>& cells) {
  std::vector<int> factors;
  for (std::size_t side = std::max(cells.columns(), cells.rows()); side > geotiff_tile_side; side = (side + 1) / 2)
    factors.push_back(factors.empty() ? 2 : 2 * factors.back());
  return factors;
}

/// All bands with their overviews, which GDAL takes over as they are.
GDALDatasetUniquePtr raster_in_memory(const GeoRaster& raster) {
  const Array2D<float>& first = raster.bands.front().values;
  GDALDatasetUniquePtr dataset =
      floats_in_memory("raster", static_cast<int>(first.columns()), static_cast<int>(first.rows()),
                       static_cast<int>(raster.bands.size()), raster.placement, raster.metadata);
  const std::vector<int> factors = overview_factors(first);
  add_empty_overviews("raster", *dataset, factors);
  for (std::size_t k = 0; k < raster.bands.size(); ++k) {
    const NamedBand& source = raster.bands[k];
    GDALRasterBand& target = *dataset->GetRasterBand(static_cast<int>(k) + 1);
    target.SetDescription(source.name.c_str());
    if (!source.unit.empty()) target.SetUnitType(source.unit.c_str());
    if (raster.nodata) target.SetNoDataValue(*raster.nodata);
    write_cells(target, source.values);
    for (std::size_t level = 0; level < factors.size(); ++level) {
      write_cells(*target.GetOverview(static_cast<int>(level)),
                  overview_of(source, static_cast<std::size_t>(factors[level]), raster.nodata));
    }
  }
  return dataset;
}

}  // namespace

bool is_geotiff_name(const std::filesystem::path& path) {
  const std::string ending = file_ending(path);
  return ending == ".tif" || ending == ".tiff";
}

std::string geotiff_bytes(const std::filesystem::path& path, const GeoRaster& raster) {
  check_bands(path, raster);
  const QuietGdal quiet;
  const GdalMemoryFile file;
  // Bands apart, for whoever reads but one of them.
  encode_geotiff(path.string(), *raster_in_memory(raster),
                 {"TILED=YES", "BLOCKXSIZE=256", "BLOCKYSIZE=256", "COMPRESS=ZSTD", "PREDICTOR=3", "INTERLEAVE=BAND",
                  "BIGTIFF=IF_SAFER", "COPY_SRC_OVERVIEWS=YES", "NUM_THREADS=1"},
                 file);
  return std::string(file.bytes());
}

void write_geotiff(const std::filesystem::path& path, const GeoRaster& raster) {
  write_geotiff_bytes(path, geotiff_bytes(path, raster));
}

void write_geotiff_bytes(const std::filesystem::path& path, std::string_view bytes) {
  write_atomically(path, bytes);
  // What others noted of the file that lay there, statistics above all, does not hold of this one.
  std::error_code ignored;
  for (const std::filesystem::path& name : {path, end_of_links(path)})
    std::filesystem::remove(name.string() + ".aux.xml", ignored);
}

}  // namespace sigmascape::geo
