#include "sigmascape/product/ground_map_file.h"

#include <algorithm>
#include <cstddef>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/geo/geotiff.h"
#include "sigmascape/product/decibels.h"

namespace sigmascape::product {
namespace {

struct ChannelBand {
  const char* name;
  float radar::Channels::*value;
};

constexpr ChannelBand channel_bands[] = {{"VV", &radar::Channels::vv},
                                         {"HH", &radar::Channels::hh},
                                         {"HV", &radar::Channels::hv},
                                         {"RE_VVHH", &radar::Channels::re_vvhh}};

// A GeoTIFF rewords its CRS, so the frame's own wording travels beside it; the grid tells whether the wording still
// holds.
constexpr const char* frame_key = "SIGMASCAPE_FRAME";
constexpr const char* grid_key = "SIGMASCAPE_GRID";
constexpr const char* quantity_key = "SIGMASCAPE_QUANTITY";
constexpr const char* linear_words = "sigma0 with respect to horizontal area, linear power";
constexpr const char* decibel_words = "sigma0 with respect to horizontal area, dB";

std::string grid_text(const radar::GroundGrid& grid) {
  return fmt::format("west {} m, north {} m, cell {} m, {} x {} cells", grid.west_m, grid.north_m, grid.cell_m,
                     grid.columns, grid.rows);
}

geo::NamedBand band_of(const radar::GroundMap& map, const ChannelBand& channel, MapScale scale) {
  geo::NamedBand band{.name = channel.name,
                      .values = Array2D<float>(map.sigma0.columns(), map.sigma0.rows()),
                      .is_decibels = scale == MapScale::Decibels};
  std::transform(map.sigma0.values().begin(), map.sigma0.values().end(), band.values.values().begin(),
                 [&](const radar::Channels& cell) {
                   return band.is_decibels ? decibels_of(cell.*channel.value) : cell.*channel.value;
                 });
  return band;
}

const geo::NamedBand& band_named(const geo::GeoRaster& raster, const char* name, const std::filesystem::path& path) {
  const auto found =
      std::find_if(raster.bands.begin(), raster.bands.end(), [&](const geo::NamedBand& b) { return b.name == name; });
  if (found != raster.bands.end()) return *found;
  throw Error(path.string(), fmt::format("is not a ground map: it has no band named {}", name),
              "give a GeoTIFF that sigmascape render wrote, with bands VV, HH, HV and RE_VVHH");
}

void fill_channel(radar::GroundMap& map, const ChannelBand& channel, const geo::NamedBand& band,
                  std::optional<float> nodata, MapScale scale) {
  for (std::size_t i = 0; i < map.sigma0.size(); ++i) {
    const float value = band.values.values()[i];
    const float linear = scale == MapScale::Decibels ? static_cast<float>(linear_from_db(value)) : value;
    map.sigma0.values()[i].*channel.value = value == nodata ? std::numeric_limits<float>::quiet_NaN() : linear;
  }
}

/// The metadata entry taken out of the map, empty when there is none.
std::string taken(radar::GroundMap& map, const char* key) {
  const auto node = map.metadata.extract(key);
  return node.empty() ? std::string() : node.mapped();
}

}  // namespace

void write_ground_map(const std::filesystem::path& path, const radar::GroundMap& map, MapScale scale) {
  if (map.sigma0.columns() != map.grid.columns || map.sigma0.rows() != map.grid.rows) {
    throw Error(path.string(),
                fmt::format("the map's {} x {} values do not fit its grid of {} x {} cells", map.sigma0.columns(),
                            map.sigma0.rows(), map.grid.columns, map.grid.rows),
                "give one value a cell");
  }
  geo::GeoRaster raster{.placement = {map.grid.west_m, map.grid.north_m, map.grid.cell_m, map.crs},
                        .bands = {},
                        .nodata = std::numeric_limits<float>::quiet_NaN(),
                        .metadata = map.metadata};
  for (const ChannelBand& channel : channel_bands) {
    if (scale == MapScale::Linear || channel.value != &radar::Channels::re_vvhh)
      raster.bands.push_back(band_of(map, channel, scale));
  }
  raster.metadata[frame_key] = map.crs;
  raster.metadata[grid_key] = grid_text(map.grid);
  raster.metadata[quantity_key] = scale == MapScale::Linear ? linear_words : decibel_words;
  geo::write_geotiff(path, raster);
}

radar::GroundMap read_ground_map(const std::filesystem::path& path) {
  geo::GeoRaster raster = geo::read_geotiff(path);
  const geo::NamedBand& first = band_named(raster, channel_bands[0].name, path);
  radar::GroundMap map;
  map.grid = {raster.placement.west_m, raster.placement.north_m, raster.placement.cell_m, first.values.columns(),
              first.values.rows()};
  map.sigma0 = Array2D<radar::Channels>(map.grid.columns, map.grid.rows);
  const auto quantity = raster.metadata.find(quantity_key);
  const bool is_db = quantity != raster.metadata.end() && quantity->second == decibel_words;
  for (const ChannelBand& channel : channel_bands) {
    if (is_db && channel.value == &radar::Channels::re_vvhh) {
      for (radar::Channels& cell : map.sigma0.values()) cell.re_vvhh = std::numeric_limits<float>::quiet_NaN();
    } else {
      fill_channel(map, channel, band_named(raster, channel.name, path), raster.nodata,
                   is_db ? MapScale::Decibels : MapScale::Linear);
    }
  }
  map.metadata = std::move(raster.metadata);
  const std::string frame = taken(map, frame_key);
  const std::string grid = taken(map, grid_key);
  (void)taken(map, quantity_key);
  map.crs = grid == grid_text(map.grid) ? frame : raster.placement.crs;
  return map;
}

}  // namespace sigmascape::product
