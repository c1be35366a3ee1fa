#include "sigmascape/product/map_geotiff.h"

#include <algorithm>
#include <cstddef>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/geo/axis_units.h"
#include "sigmascape/geo/coordinate_reference_system.h"
#include "sigmascape/geo/geo_raster.h"
#include "sigmascape/product/decibels.h"
#include "sigmascape/product/described_map.h"

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

// A GeoTIFF rewords its CRS, so the frame's own wording travels beside it. It holds while the file is of that frame and
// on that grid: others may have given it another.
constexpr const char* frame_key = "SIGMASCAPE_FRAME";
constexpr const char* grid_key = "SIGMASCAPE_GRID";
constexpr const char* quantity_key = "SIGMASCAPE_QUANTITY";

bool is_correlation(const ChannelBand& channel) {
  return channel.value == &radar::Channels::re_vvhh;
}

bool has_band(const MappedQuantity& quantity, const ChannelBand& channel, MapScale scale) {
  return !is_correlation(channel) || (quantity.has_correlation && scale == MapScale::Linear);
}

std::string grid_text(const radar::GroundGrid& grid, const std::string& crs) {
  return fmt::format("west {} {unit}, north {} {unit}, cell {} {unit}, {} x {} cells", grid.west_m, grid.north_m,
                     grid.cell_m, grid.columns, grid.rows, fmt::arg("unit", geo::axis_unit(crs)));
}

geo::NamedBand band_of(const MapView& map, const ChannelBand& channel, MapScale scale) {
  const bool is_decibels = scale == MapScale::Decibels;
  geo::NamedBand band{.name = channel.name,
                      .values = Array2D<float>(map.cells.columns(), map.cells.rows()),
                      .is_decibels = is_decibels,
                      .unit = is_decibels ? map.quantity.decibel_unit : map.quantity.unit};
  std::transform(map.cells.values().begin(), map.cells.values().end(), band.values.values().begin(),
                 [&](const radar::Channels& cell) {
                   const float linear = cell.*channel.value;
                   return is_decibels ? decibels_of(linear, map.quantity.darkest_db) : linear;
                 });
  return band;
}

/// Whether the power of a polarization is of this channel among others.
bool is_part_of(radar::Polarization polarization, const ChannelBand& channel) {
  radar::Channels alone{};
  alone.*channel.value = 1.0F;
  return alone.power(polarization) != 0.0F;
}

/// Nothing when there is none of that name.
const geo::NamedBand* band_named(const geo::GeoRaster& raster, const char* name) {
  const auto found = std::ranges::find(raster.bands, name, &geo::NamedBand::name);
  return found == raster.bands.end() ? nullptr : &*found;
}

/// The bands that a map must have to be read. Throws Error when it lacks one.
void require_bands(const geo::GeoRaster& raster, const std::vector<ChannelBand>& wanted,
                   const std::filesystem::path& path) {
  std::vector<const char*> names;
  for (const ChannelBand& channel : wanted) names.push_back(channel.name);
  for (const char* name : names) {
    if (band_named(raster, name) != nullptr) continue;
    throw Error(path.string(), fmt::format("is not a ground map: it has no band named {}", name),
                fmt::format("give a GeoTIFF that sigmascape render wrote, of which {} {} needed",
                            fmt::join(names, ", "), names.size() == 1 ? "is" : "are"));
  }
}

void fill_channel(Array2D<radar::Channels>& cells, const ChannelBand& channel, const geo::NamedBand& band,
                  std::optional<float> nodata, MapScale scale) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const float value = band.values.values()[i];
    const float linear = scale == MapScale::Decibels ? static_cast<float>(linear_from_db(value)) : value;
    cells.values()[i].*channel.value = value == nodata ? std::numeric_limits<float>::quiet_NaN() : linear;
  }
}

/// In which scale the file is written. A file without a tag, as another program makes it, passes for linear σ0.
MapScale scale_of(const geo::GeoRaster& raster, const MappedQuantity& quantity, const std::filesystem::path& path) {
  const auto found = raster.metadata.find(quantity_key);
  const std::string tag = found == raster.metadata.end() ? sigma0_quantity().tag : found->second;
  if (tag == quantity.tag) return MapScale::Linear;
  if (tag == quantity.decibel_tag) return MapScale::Decibels;
  throw Error(path.string(), fmt::format("is a map of \"{}\"", tag),
              fmt::format("give a map of \"{}\", in decibels or not", quantity.tag));
}

/// The metadata entry taken out of the map, empty when there is none.
std::string taken(MapContent& map, const char* key) {
  const auto node = map.metadata.extract(key);
  return node.empty() ? std::string() : node.mapped();
}

}  // namespace

void write_map_geotiff(const std::filesystem::path& path, const MapView& map, MapScale scale) {
  if (map.cells.columns() != map.grid.columns || map.cells.rows() != map.grid.rows) {
    throw Error(path.string(),
                fmt::format("the map's {} x {} values do not fit its grid of {} x {} cells", map.cells.columns(),
                            map.cells.rows(), map.grid.columns, map.grid.rows),
                "give one value a cell");
  }
  geo::GeoRaster raster{.placement = {map.grid.west_m, map.grid.north_m, map.grid.cell_m, map.crs},
                        .bands = {},
                        .nodata = std::numeric_limits<float>::quiet_NaN(),
                        .metadata = map.metadata};
  for (const ChannelBand& channel : channel_bands) {
    if (has_band(map.quantity, channel, scale)) raster.bands.push_back(band_of(map, channel, scale));
  }
  raster.metadata[frame_key] = map.crs;
  raster.metadata[grid_key] = grid_text(map.grid, map.crs);
  raster.metadata[quantity_key] = scale == MapScale::Linear ? map.quantity.tag : map.quantity.decibel_tag;
  geo::write_geotiff(path, raster);
}

MapContent read_map_geotiff(const std::filesystem::path& path, const MappedQuantity& quantity,
                            std::optional<radar::Polarization> polarization) {
  geo::GeoRaster raster = geo::read_geotiff(path);
  const MapScale scale = scale_of(raster, quantity, path);
  std::vector<ChannelBand> wanted;
  for (const ChannelBand& channel : channel_bands) {
    const bool is_wanted = polarization ? is_part_of(*polarization, channel) : has_band(quantity, channel, scale);
    if (is_wanted) wanted.push_back(channel);
  }
  require_bands(raster, wanted, path);
  const Array2D<float>& first = raster.bands.front().values;
  MapContent map{.grid = {raster.placement.west_m, raster.placement.north_m, raster.placement.cell_m, first.columns(),
                          first.rows()},
                 .cells = {},
                 .crs = {},
                 .metadata = {}};
  map.cells = Array2D<radar::Channels>(map.grid.columns, map.grid.rows);
  for (const ChannelBand& channel : channel_bands) {
    const geo::NamedBand* const band = band_named(raster, channel.name);
    if (band != nullptr && has_band(quantity, channel, scale)) {
      fill_channel(map.cells, channel, *band, raster.nodata, scale);
    } else {
      for (radar::Channels& cell : map.cells.values()) cell.*channel.value = std::numeric_limits<float>::quiet_NaN();
    }
  }
  map.metadata = std::move(raster.metadata);
  const std::string frame = taken(map, frame_key);
  const std::string grid = taken(map, grid_key);
  (void)taken(map, quantity_key);
  const bool is_of_frame = geo::is_same_crs(frame, raster.placement.crs);
  map.crs = is_of_frame && grid == grid_text(map.grid, frame) ? frame : raster.placement.crs;
  // What is told of the radar stays in that frame, in whichever system others have laid the map.
  if (!is_of_frame && !frame.empty()) map.metadata.try_emplace(local_frame_key, frame);
  return map;
}

}  // namespace sigmascape::product
