#include "sigmascape/atlas/error_texture.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/error.h"
#include "sigmascape/geo/byte_raster.h"
#include "sigmascape/geo/geo_raster.h"

namespace sigmascape::atlas {
namespace {

constexpr double smallest = 1e-3;
constexpr double steps_per_decade = 50.0;

}  // namespace

std::uint8_t error_code(float relative_error, bool is_lit) {
  if (!is_lit) return 0;
  const double error = std::max(static_cast<double>(relative_error), smallest);
  return static_cast<std::uint8_t>(std::min(1.0 + std::round(std::log10(error / smallest) * steps_per_decade), 255.0));
}

float error_of(std::uint8_t code) {
  return code == 0 ? 0.0F : static_cast<float>(smallest * std::pow(10.0, (code - 1) / steps_per_decade));
}

std::string error_texture_bytes(const Array2D<float>& errors, const Array2D<radar::Channels>& texels,
                                const radar::GroundGrid& grid, const AtlasDescription& description,
                                const std::filesystem::path& file) {
  Array2D<std::uint8_t> codes(texels.columns(), texels.rows());
  for (std::size_t i = 0; i < codes.size(); ++i) {
    if (errors.size() != codes.size() || !std::isfinite(errors.values()[i])) {
      throw Error(file.string(), "its standard errors are not finite numbers, one a texel",
                  "the bake that made them is at fault");
    }
    codes.values()[i] = error_code(errors.values()[i], texels.values()[i].power(radar::Polarization::Sum) > 0.0F);
  }
  return geo::byte_geotiff_bytes({grid.west_m, grid.north_m, grid.cell_m, description.frame.proj()}, "ERROR", codes);
}

std::filesystem::path errors_path(const std::filesystem::path& texture) {
  std::filesystem::path name = texture.stem();
  name += "_error.tif";
  return texture.parent_path() / name;
}

}  // namespace sigmascape::atlas
