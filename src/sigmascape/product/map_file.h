#pragma once

#include <filesystem>

#include "sigmascape/product/map_view.h"
#include "sigmascape/radar/ground_map.h"
#include "sigmascape/radar/power_map.h"

namespace sigmascape::product {

/// In which numbers a map is written.
enum class MapScale { Linear, Decibels };

/// Cells that are darker, those without any power included, are written as this many decibels: the logarithm of nothing
/// is of no use to anyone.
inline constexpr double darkest_db = -100.0;
/// The same for watts: far below the noise of any receiver, which lies above -204 dBW in every hertz.
inline constexpr double darkest_dbw = -300.0;

/// Writes a ground map as the kind of file that its name asks for, atomically:
///
///     .tif .tiff   cloud-optimised GeoTIFF, as write_ground_map; in decibels without the band RE_VVHH
///     .npy         float32 [row, column, channel], and beside it .json with grid and metadata: both or neither
///     .npz         the same as `sigma0` or `sigma0_db`, with `x_m` and `y_m` of the cells' middles and
///                  `description_json`
///
/// Channels are VV, HH, HV and, when linear, Re VV·HH*. Throws Error for another ending and when the file cannot be
/// written.
void write_map(const std::filesystem::path& path, const radar::GroundMap& map, MapScale scale = MapScale::Linear);

/// The same for received power: VV, HH and HV alone, in W or dBW; in .npz as `power_w` or `power_dbw`. As GeoTIFF see
/// write_power_map.
void write_map(const std::filesystem::path& path, const radar::PowerMap& map, MapScale scale = MapScale::Linear);

/// The same for a map of either whose parts lie in different places.
void write_map(const std::filesystem::path& path, const MapView& map, MapScale scale = MapScale::Linear);

/// Whether `write_map` knows what to write under this name.
[[nodiscard]] bool is_map_name(const std::filesystem::path& path);

/// Throws Error when `write_map` would not know what to write under this name: for asking before the work.
void check_map_name(const std::filesystem::path& path);

}  // namespace sigmascape::product
