#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sigmascape/base/toml_reader.h"
#include "sigmascape/geo/vector_source.h"
#include "sigmascape/scene/flaw_tally.h"

namespace sigmascape::scene {

/// The keys that every section about vector data shares: file, layer, where, crs, x, y.
[[nodiscard]] geo::VectorSource read_vector_source(const TomlSection& section, geo::GeometryKind kind);

/// Metres to the unit of plain numbers in the attributes that some keys of the section name: of its key unit, 1
/// without. Throws Error for a unit that is not known, and for one that stands without any of these keys.
[[nodiscard]] double read_metres_per_plain_number(const TomlSection& section,
                                                  const std::vector<std::string_view>& keys_of_lengths);

/// The section's own max_flawed_share, or the scene's.
[[nodiscard]] FlawLimit read_flaw_limit(const TomlSection& section, const FlawLimit& of_scene);

/// Whether a feature is so in any way, as OpenStreetMap and extracts from it tell: tunnel=yes, tunnel=building_passage,
/// covered=arcade and others; of tables also T.
[[nodiscard]] bool is_said_of(const geo::Feature& feature, const std::string& attribute);

/// A length, or a count, as a feature's attribute tells it (metres_from_text); nothing where it tells none, or where no
/// attribute is asked for.
[[nodiscard]] std::optional<double> number_in(const geo::Feature& feature, const std::optional<std::string>& attribute,
                                              double metres_per_plain_number = 1.0);

/// Throws Error for a height below 0, which quotes the attribute as the feature has it.
void refuse_negative(double value, const geo::Feature& feature, const std::string& attribute,
                     const geo::VectorSource& source);

/// Tallies a number in an attribute that was passed over because of its doubtful comma.
void tell_of_doubtful_comma(const geo::Feature& feature, const std::optional<std::string>& attribute, FlawTally& tally);

/// Remarks what may be wrong with any file: features without usable coordinates, or none at all that is asked for, or a
/// condition that names a tag of which the file knows nothing, or features without the tag that others have. Throws
/// Error as FlawTally does, when more of all features of the file have no place than the limit says.
void settle_census(const geo::FeatureCensus& census, const geo::VectorSource& source, const FlawLimit& limit,
                   std::vector<Remark>& remarks);

/// Throws Error when a file knows nothing of the attribute that the key at `where` names, if it names one. A column in
/// which nothing stands is known. Of tags of OpenStreetMap, which anything may lack, that is a likely mistake.
void require_attribute(const geo::FeatureCensus& census, const std::optional<std::string>& attribute,
                       const geo::VectorSource& source, const std::string& where, FlawTally& tally);

}  // namespace sigmascape::scene
