#include "sigmascape/geo/geotiff.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <limits>
#include <memory>
#include <mutex>
#include <ogr_spatialref.h>
#include <string_view>
#include <utility>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/geo/atomic_file.h"

namespace sigmascape::geo {
namespace {

constexpr int tile_side = 256;

void register_drivers() {
  static std::once_flag once;
  std::call_once(once, [] { GDALAllRegister(); });
}

/// Keeps GDAL from printing while it lives; what GDAL had to say is asked for instead.
class QuietGdal {
 public:
  QuietGdal() {
    register_drivers();
    CPLPushErrorHandler(CPLQuietErrorHandler);
    CPLErrorReset();
  }
  ~QuietGdal() { CPLPopErrorHandler(); }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;

  [[nodiscard]] static bool failed() { return CPLGetLastErrorType() >= CE_Failure; }
  [[nodiscard]] static std::string complaint() {
    const std::string message = CPLGetLastErrorMsg();
    return message.empty() ? "no reason was given" : message;
  }
};

using Options = CPLStringList;

/// A file that GDAL keeps in memory, under a name that nothing else uses.
class MemoryFile {
 public:
  MemoryFile() {
    static std::atomic<unsigned> serial{0};
    name_ = fmt::format("/vsimem/sigmascape/{}.tif", serial.fetch_add(1));
  }
  ~MemoryFile() { VSIUnlink(name_.c_str()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] const char* name() const { return name_.c_str(); }
  [[nodiscard]] std::string_view bytes() const {
    vsi_l_offset size = 0;
    const GByte* data = VSIGetMemFileBuffer(name_.c_str(), &size, FALSE);
    return {reinterpret_cast<const char*>(data), static_cast<std::size_t>(size)};
  }

 private:
  std::string name_;
};

OGRSpatialReference reference_from(const std::string& crs) {
  OGRSpatialReference reference;
  reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  if (crs.empty() || reference.SetFromUserInput(crs.c_str()) != OGRERR_NONE) {
    throw Error(fmt::format("CRS \"{}\"", crs), "is not understood", "give a PROJ string, WKT or an EPSG code");
  }
  return reference;
}

std::string wkt2_from(const OGRSpatialReference& reference) {
  char* text = nullptr;
  const std::array<const char*, 3> options{"FORMAT=WKT2_2019", "MULTILINE=NO", nullptr};
  const bool failed = reference.exportToWkt(&text, options.data()) != OGRERR_NONE;
  std::string wkt = text == nullptr ? "" : text;
  CPLFree(text);
  if (failed) throw Error("CRS", "cannot be expressed as WKT", "use another CRS");
  return wkt;
}

void place(GDALDataset& dataset, const RasterPlacement& placement) {
  std::array<double, 6> transform{placement.west_m, placement.cell_m, 0.0, placement.north_m, 0.0, -placement.cell_m};
  dataset.SetGeoTransform(transform.data());
  const OGRSpatialReference reference = reference_from(placement.crs);
  dataset.SetSpatialRef(&reference);
}

void describe(GDALDataset& dataset, const std::map<std::string, std::string>& metadata) {
  for (const auto& [key, value] : metadata) dataset.SetMetadataItem(key.c_str(), value.c_str());
}

GDALDriver& driver(const char* name) {
  GDALDriver* found = GetGDALDriverManager()->GetDriverByName(name);
  if (found == nullptr) throw Error("GDAL", fmt::format("has no {} driver", name), "install a complete GDAL");
  return *found;
}

[[noreturn]] void fail_to_encode(std::string_view what) {
  throw Error(std::string(what), fmt::format("GDAL cannot encode it ({})", QuietGdal::complaint()),
              "install a GDAL whose GeoTIFF driver has ZSTD and enough memory for the raster");
}

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
  for (std::size_t side = std::max(cells.columns(), cells.rows()); side > tile_side; side = (side + 1) / 2)
    factors.push_back(factors.empty() ? 2 : 2 * factors.back());
  return factors;
}

/// All bands with their overviews, which GDAL takes over as they are.
GDALDatasetUniquePtr raster_in_memory(const GeoRaster& raster) {
  const Array2D<float>& first = raster.bands.front().values;
  GDALDatasetUniquePtr dataset(driver("MEM").Create("", static_cast<int>(first.columns()),
                                                    static_cast<int>(first.rows()),
                                                    static_cast<int>(raster.bands.size()), GDT_Float32, nullptr));
  if (!dataset) fail_to_encode("raster");
  place(*dataset, raster.placement);
  describe(*dataset, raster.metadata);
  const std::vector<int> factors = overview_factors(first);
  if (!factors.empty() && dataset->BuildOverviews("NONE", static_cast<int>(factors.size()), factors.data(), 0, nullptr,
                                                  nullptr, nullptr) != CE_None) {
    fail_to_encode("raster");
  }
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

void check_shape(const HalfPyramid& pyramid) {
  const std::size_t bands = pyramid.band_names.size();
  bool right = bands > 0 && pyramid.columns == pyramid.rows && !pyramid.levels.empty() && pyramid.levels.size() < 16 &&
               pyramid.columns == (std::size_t{tile_side} << (pyramid.levels.size() - 1));
  for (std::size_t level = 0; right && level < pyramid.levels.size(); ++level) {
    right = pyramid.levels[level].size() == (pyramid.columns >> level) * (pyramid.rows >> level) * bands;
  }
  if (right) return;
  throw Error("half-float pyramid",
              fmt::format("{} x {} texels in {} bands and {} levels do not fit together", pyramid.columns, pyramid.rows,
                          bands, pyramid.levels.size()),
              "give 256 * 2^n texels a side and all n + 1 levels");
}

/// The finest level with all others as its overviews, which GDAL takes over as they are.
GDALDatasetUniquePtr pyramid_in_memory(const HalfPyramid& pyramid) {
  const auto side = static_cast<int>(pyramid.columns);
  const auto bands = static_cast<int>(pyramid.band_names.size());
  GDALDatasetUniquePtr dataset(driver("MEM").Create("", side, side, bands, GDT_Float32, nullptr));
  if (!dataset) fail_to_encode("half-float pyramid");
  place(*dataset, pyramid.placement);
  describe(*dataset, pyramid.metadata);
  std::vector<int> factors;
  for (std::size_t level = 1; level < pyramid.levels.size(); ++level) factors.push_back(1 << level);
  if (!factors.empty() && dataset->BuildOverviews("NONE", static_cast<int>(factors.size()), factors.data(), 0, nullptr,
                                                  nullptr, nullptr) != CE_None) {
    fail_to_encode("half-float pyramid");
  }
  for (int band = 1; band <= bands; ++band) {
    GDALRasterBand& base = *dataset->GetRasterBand(band);
    base.SetDescription(pyramid.band_names[static_cast<std::size_t>(band - 1)].c_str());
    base.SetScale(pyramid.scale);
    for (std::size_t level = 0; level < pyramid.levels.size(); ++level) {
      GDALRasterBand& target = level == 0 ? base : *base.GetOverview(static_cast<int>(level) - 1);
      const int texels = side >> level;
      auto* values = const_cast<float*>(pyramid.levels[level].data()) + (band - 1);
      const GSpacing pixel = GSpacing{sizeof(float)} * bands;
      if (target.RasterIO(GF_Write, 0, 0, texels, texels, values, texels, texels, GDT_Float32, pixel, pixel * texels,
                          nullptr) != CE_None) {
        fail_to_encode("half-float pyramid");
      }
    }
  }
  return dataset;
}

}  // namespace

void write_geotiff(const std::filesystem::path& path, const GeoRaster& raster) {
  check_bands(path, raster);
  const QuietGdal quiet;
  const MemoryFile file;
  Options options;
  // Bands apart, for whoever reads but one of them.
  for (const char* option : {"TILED=YES", "BLOCKXSIZE=256", "BLOCKYSIZE=256", "COMPRESS=ZSTD", "PREDICTOR=3",
                             "INTERLEAVE=BAND", "BIGTIFF=IF_SAFER", "COPY_SRC_OVERVIEWS=YES", "NUM_THREADS=1"}) {
    options.AddString(option);
  }
  const GDALDatasetUniquePtr source = raster_in_memory(raster);
  GDALDatasetUniquePtr dataset(
      driver("GTiff").CreateCopy(file.name(), source.get(), FALSE, options.List(), nullptr, nullptr));
  if (!dataset) fail_to_encode(path.string());
  dataset.reset();
  if (QuietGdal::failed()) fail_to_encode(path.string());
  write_atomically(path, file.bytes());
}

GeoRaster read_geotiff(const std::filesystem::path& path) {
  const QuietGdal quiet;
  const std::array<const char*, 2> drivers{"GTiff", nullptr};
  const GDALDatasetUniquePtr dataset(
      GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers.data(), nullptr, nullptr));
  if (!dataset) {
    if (!std::filesystem::exists(path)) throw Error(path.string(), "the file does not exist", "correct the path");
    throw Error(path.string(), fmt::format("cannot be opened as GeoTIFF ({})", QuietGdal::complaint()),
                "check the path and the format");
  }
  GeoRaster raster;
  raster.placement = placement_of(path, *dataset);
  raster.metadata = metadata_of(*dataset);
  for (int band = 1; band <= dataset->GetRasterCount(); ++band) {
    raster.bands.push_back(read_band(path, *dataset->GetRasterBand(band)));
  }
  int has_nodata = FALSE;
  const double nodata = dataset->GetRasterBand(1)->GetNoDataValue(&has_nodata);
  if (has_nodata != FALSE) raster.nodata = static_cast<float>(nodata);
  return raster;
}

std::string half_cog_bytes(const HalfPyramid& pyramid) {
  check_shape(pyramid);
  const QuietGdal quiet;
  const MemoryFile file;
  const GDALDatasetUniquePtr source = pyramid_in_memory(pyramid);
  Options options;
  for (const char* option :
       {"NBITS=16", "TILED=YES", "BLOCKXSIZE=256", "BLOCKYSIZE=256", "INTERLEAVE=PIXEL", "COMPRESS=ZSTD",
        "ZSTD_LEVEL=9", "PREDICTOR=1", "COPY_SRC_OVERVIEWS=YES", "NUM_THREADS=1"}) {
    options.AddString(option);
  }
  GDALDatasetUniquePtr copy(
      driver("GTiff").CreateCopy(file.name(), source.get(), FALSE, options.List(), nullptr, nullptr));
  if (!copy) fail_to_encode("half-float pyramid");
  copy.reset();
  if (QuietGdal::failed()) fail_to_encode("half-float pyramid");
  return std::string(file.bytes());
}

std::string byte_geotiff_bytes(const RasterPlacement& placement, const std::string& band,
                               const Array2D<std::uint8_t>& values) {
  const QuietGdal quiet;
  const MemoryFile file;
  Options options;
  for (const char* option : {"TILED=YES", "BLOCKXSIZE=256", "BLOCKYSIZE=256", "COMPRESS=ZSTD", "ZSTD_LEVEL=9"}) {
    options.AddString(option);
  }
  const auto columns = static_cast<int>(values.columns()), rows = static_cast<int>(values.rows());
  GDALDatasetUniquePtr dataset(driver("GTiff").Create(file.name(), columns, rows, 1, GDT_Byte, options.List()));
  if (!dataset) fail_to_encode(band);
  place(*dataset, placement);
  dataset->GetRasterBand(1)->SetDescription(band.c_str());
  // As in fill_band: GDAL asks for a pointer that it could write through.
  auto* bytes = const_cast<std::uint8_t*>(values.values().data());
  if (dataset->RasterIO(GF_Write, 0, 0, columns, rows, bytes, columns, rows, GDT_Byte, 1, nullptr, 0, 0, 0, nullptr) !=
      CE_None) {
    fail_to_encode(band);
  }
  dataset.reset();
  if (QuietGdal::failed()) fail_to_encode(band);
  return std::string(file.bytes());
}

std::array<Vec2d, 4> geographic_corners(const RasterPlacement& placement, std::size_t columns, std::size_t rows) {
  const QuietGdal quiet;
  const double east_m = placement.west_m + placement.cell_m * static_cast<double>(columns);
  const double south_m = placement.north_m - placement.cell_m * static_cast<double>(rows);
  std::array<double, 4> x{placement.west_m, east_m, east_m, placement.west_m};
  std::array<double, 4> y{south_m, south_m, placement.north_m, placement.north_m};
  const OGRSpatialReference local = reference_from(placement.crs);
  const OGRSpatialReference geographic = reference_from("OGC:CRS84");
  const std::unique_ptr<OGRCoordinateTransformation> transformation(
      OGRCreateCoordinateTransformation(&local, &geographic));
  if (!transformation || transformation->Transform(4, x.data(), y.data()) == FALSE) {
    throw Error(fmt::format("CRS \"{}\"", placement.crs), "has no longitude and latitude for the corners of the raster",
                "place the raster where its CRS is valid");
  }
  return {Vec2d{x[0], y[0]}, Vec2d{x[1], y[1]}, Vec2d{x[2], y[2]}, Vec2d{x[3], y[3]}};
}

bool is_in_degrees(const std::string& crs) {
  const QuietGdal quiet;
  return reference_from(crs).IsGeographic() != 0;
}

std::string wkt2_from(const std::string& crs) {
  const QuietGdal quiet;
  return wkt2_from(reference_from(crs));
}

}  // namespace sigmascape::geo
