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
///     .tif .tiff   cloud-optimised float32 GeoTIFF with overviews of the mean power: bands VV, HH and HV (linear σ0
///     with
///                  respect to horizontal area) and RE_VVHH (the correlation Re⟨S_VV S_HH*⟩ on the same scale), in
///                  decibels without the last; NaN where the radar did not look, the CRS of the local frame, and the
///                  map's metadata as tags, of which those that begin with SIGMASCAPE_ are the file's own
///     .npy         float32 [row, column, channel], and beside it .json with grid and metadata: both or neither
///     .npz         the same as `sigma0` or `sigma0_db`, with `x_m` and `y_m` of the cells' middles and
///                  `description_json`
///
/// Channels are VV, HH, HV and, when linear, Re VV·HH*. Throws Error for another ending, when the map's cells do not
/// fit its grid, the CRS is not understood or the file cannot be written.
void write_map(const std::filesystem::path& path, const radar::GroundMap& map, MapScale scale = MapScale::Linear);

/// The same for received power: VV, HH and HV alone, in W or dBW, each band with its unit; in .npz as `power_w` or
/// `power_dbw`. The noise travels in the metadata as `noise_w`.
void write_map(const std::filesystem::path& path, const radar::PowerMap& map, MapScale scale = MapScale::Linear);

/// The same for a map of either whose parts lie in different places.
void write_map(const std::filesystem::path& path, const MapView& map, MapScale scale = MapScale::Linear);

/// Whether `write_map` knows what to write under this name.
[[nodiscard]] bool is_map_name(const std::filesystem::path& path);

/// Throws Error when `write_map` would not know what to write under this name: for asking before the work.
void check_map_name(const std::filesystem::path& path);

}  // namespace sigmascape::product
