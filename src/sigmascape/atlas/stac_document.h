#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "sigmascape/atlas/pyramid_tiles.h"
#include "sigmascape/atlas/store.h"
#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::atlas {

/// What all documents of the SpatioTemporal Asset Catalog (STAC 1.0.0) in a store have in common, which browsers of
/// satellite images read. Under "sigmascape:" stands in them what this library needs back. Equal input gives equal
/// text; no clock goes in.

using Json = nlohmann::ordered_json;

inline constexpr const char* stac_version = "1.0.0";
/// STAC wants a time for everything. A bake has none, and a clock in it would make equal bakes differ.
inline constexpr const char* no_time = "1970-01-01T00:00:00Z";

/// Degrees as a person would have typed them, so that radians → degrees → radians comes back to the same number.
[[nodiscard]] double tidy_deg(double angle_rad);

/// Text that is not UTF-8 (an old attribution, say) gets replacement characters rather than an exception.
[[nodiscard]] std::string written(const Json& json, int indent);

/// A text with its own SHA-256 put in where it says `"key": ""`: that of the text without these 64 digits.
[[nodiscard]] std::string sealed(std::string text, std::string_view key);

/// What is wrong with a document by its own hash, which it records under `key`.
enum class Seal { Fits, Broken, Absent };
[[nodiscard]] Seal seal_of(std::string text, std::string_view key);

/// As faults say it of a document whose seal is broken.
inline constexpr const char* broken_seal = "was altered: its own SHA-256 is not the recorded one";

[[nodiscard]] Json link(const char* relation, const std::string& target);

/// "pyramid_2_patch_+000_-004", at level 0 "patch_+003_-002": names the place among all of the store.
[[nodiscard]] std::string place_name(const PyramidTile& tile);

/// How documents in the folder of a place call a file of the store: "../../collection.json".
[[nodiscard]] std::string href_from(const PyramidTile& tile, const std::filesystem::path& file);

/// All patches as one grid of texels.
[[nodiscard]] radar::GroundGrid whole_grid(const AtlasDescription& description);

/// A ring of longitudes and latitudes; two where it crosses the antimeridian, and then the box's west lies east of its
/// east (RFC 7946, 3.1.9 and 5.2). Nine decimals of a degree are a tenth of a millimetre.
struct Footprint {
  Json polygon, box;

  Footprint(const AtlasDescription& description, const radar::GroundGrid& grid);
};

}  // namespace sigmascape::atlas
