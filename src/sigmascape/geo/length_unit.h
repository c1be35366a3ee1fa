#pragma once

#include <optional>
#include <string_view>

namespace sigmascape::geo {

/// Metres to a unit of length by its name, as rasters and attribute tables give it: metres and their decimal parts, the
/// international foot and that of old American surveys, short or in full ("cm", "feet", "US survey foot"), whatever the
/// capitals, blanks, dots, hyphens and underscores. Nothing for a name that is none of these.
[[nodiscard]] std::optional<double> metres_per_unit(std::string_view name);

}  // namespace sigmascape::geo
