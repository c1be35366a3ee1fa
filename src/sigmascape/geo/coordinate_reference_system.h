#pragma once

#include <string>

namespace sigmascape::geo {

/// Whether a CRS counts in degrees and not in metres. Throws Error when PROJ does not understand it.
[[nodiscard]] bool is_in_degrees(const std::string& crs);

/// Whether two say the same, however they say it and whatever they call it. What PROJ does not understand is the same
/// only letter by letter.
[[nodiscard]] bool is_same_crs(const std::string& a, const std::string& b);

/// The CRS as WKT2 (ISO 19162:2019), on one line. Throws Error when PROJ does not understand it.
[[nodiscard]] std::string wkt2_from(const std::string& crs);

/// Throws Error at `where` for a known system that a GeoTIFF cannot tell, or of which it would lose the axes, so that
/// nobody works for a file that will not be written.
void require_geotiff_keys(const std::string& crs, const std::string& where);

}  // namespace sigmascape::geo
