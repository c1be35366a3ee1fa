#include "sigmascape/geo/half_pyramid.h"

#include <fmt/format.h>
#include <gdal_priv.h>

#include "sigmascape/base/error.h"
#include "sigmascape/geo/gdal_memory_file.h"
#include "sigmascape/geo/geotiff_encoding.h"
#include "sigmascape/geo/quiet_gdal.h"

namespace sigmascape::geo {
namespace {

constexpr const char* what = "half-float pyramid";

void check_shape(const HalfPyramid& pyramid) {
  const std::size_t bands = pyramid.band_names.size();
  bool right = bands > 0 && pyramid.columns == pyramid.rows && !pyramid.levels.empty() && pyramid.levels.size() < 16 &&
               pyramid.columns == (std::size_t{geotiff_tile_side} << (pyramid.levels.size() - 1));
  for (std::size_t level = 0; right && level < pyramid.levels.size(); ++level) {
    right = pyramid.levels[level].size() == (pyramid.columns >> level) * (pyramid.rows >> level) * bands;
  }
  if (right) return;
  throw Error(what,
              fmt::format("{} x {} texels in {} bands and {} levels do not fit together", pyramid.columns, pyramid.rows,
                          bands, pyramid.levels.size()),
              "give 256 * 2^n texels a side and all n + 1 levels");
}

/// One of the bands, which lie pixel by pixel among one another.
void write_level(GDALRasterBand& target, const std::vector<float>& level, int texels, int band, int bands) {
  // GDAL's interface serves reading and writing alike, hence the cast; writing leaves the values as they are.
  auto* values = const_cast<float*>(level.data()) + (band - 1);
  const GSpacing pixel = GSpacing{sizeof(float)} * bands;
  if (target.RasterIO(GF_Write, 0, 0, texels, texels, values, texels, texels, GDT_Float32, pixel, pixel * texels,
                      nullptr) != CE_None) {
    fail_to_encode(what);
  }
}

/// The finest level with all others as its overviews, which GDAL takes over as they are.
GDALDatasetUniquePtr pyramid_in_memory(const HalfPyramid& pyramid) {
  const auto side = static_cast<int>(pyramid.columns);
  const auto bands = static_cast<int>(pyramid.band_names.size());
  GDALDatasetUniquePtr dataset = floats_in_memory(what, side, side, bands, pyramid.placement, pyramid.metadata);
  std::vector<int> factors;
  for (std::size_t level = 1; level < pyramid.levels.size(); ++level) factors.push_back(1 << level);
  add_empty_overviews(what, *dataset, factors);
  for (int band = 1; band <= bands; ++band) {
    GDALRasterBand& base = *dataset->GetRasterBand(band);
    base.SetDescription(pyramid.band_names[static_cast<std::size_t>(band - 1)].c_str());
    base.SetScale(pyramid.scale);
    for (std::size_t level = 0; level < pyramid.levels.size(); ++level) {
      GDALRasterBand& target = level == 0 ? base : *base.GetOverview(static_cast<int>(level) - 1);
      write_level(target, pyramid.levels[level], side >> level, band, bands);
    }
  }
  return dataset;
}

}  // namespace

std::string half_cog_bytes(const HalfPyramid& pyramid) {
  check_shape(pyramid);
  const QuietGdal quiet;
  const GdalMemoryFile file;
  encode_geotiff(what, *pyramid_in_memory(pyramid),
                 {"NBITS=16", "TILED=YES", "BLOCKXSIZE=256", "BLOCKYSIZE=256", "INTERLEAVE=PIXEL", "COMPRESS=ZSTD",
                  "ZSTD_LEVEL=9", "PREDICTOR=1", "COPY_SRC_OVERVIEWS=YES", "NUM_THREADS=1"},
                 file);
  return std::string(file.bytes());
}

}  // namespace sigmascape::geo
