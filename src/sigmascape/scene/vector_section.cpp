#include "sigmascape/scene/vector_section.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string_view>

#include "sigmascape/base/small_letters.h"
#include "sigmascape/geo/coordinate_transform.h"
#include "sigmascape/geo/length_unit.h"
#include "sigmascape/scene/attribute_number.h"
#include "sigmascape/scene/partner_key.h"

namespace sigmascape::scene {

geo::VectorSource read_vector_source(const TomlSection& section, geo::GeometryKind kind) {
  geo::VectorSource source;
  source.file = section.file("file");
  source.kind = kind;
  source.layer = section.text_or("layer", "");
  source.where = section.text_or("where", "");
  source.crs = section.text_or("crs", "");
  if (!source.crs.empty()) geo::require_known_reference(source.crs, section.where("crs"));
  source.x_column = section.text_or("x", "");
  source.y_column = section.text_or("y", "");
  if (source.x_column.empty() != source.y_column.empty()) {
    throw section.fault(source.x_column.empty() ? "x" : "y", "is missing", "name both coordinate columns, x and y");
  }
  return source;
}

double read_metres_per_plain_number(const TomlSection& section, const std::vector<std::string_view>& keys_of_lengths) {
  const std::string unit = section.choice_or("unit", {"m", "cm", "ft", "us-ft"}, "m");
  refuse_without(section, "unit", fmt::format("{}", fmt::join(keys_of_lengths, " or ")),
                 std::ranges::any_of(keys_of_lengths, [&](auto key) { return section.has(key); }));
  return geo::metres_per_unit(unit).value();
}

FlawLimit read_flaw_limit(const TomlSection& section, const FlawLimit& of_scene) {
  return {section.number_or("max_flawed_share", {0.0, 1.0, ""}, of_scene.max_share), of_scene.strict};
}

namespace {

/// A condition, and what may have been meant where it names a tag that no feature carries.
std::string explained(const std::string& condition, const std::string& unknown_tag,
                      const std::vector<std::string>& known) {
  const std::string condition_text = fmt::format("where = \"{}\"", condition);
  if (condition.find(fmt::format("\"{}\"", unknown_tag)) != std::string::npos)
    return fmt::format("{} (a text stands in single quotes: '{}')", condition_text, unknown_tag);
  const auto nearest = nearest_word(unknown_tag, known);
  return nearest ? fmt::format("{} (did you mean {}?)", condition_text, *nearest) : condition_text;
}

/// The condition on a tag, given as "key" or "key=value", that whoever has it meets.
std::string condition_on(const std::string& tag) {
  const auto equals = tag.find('=');
  return equals == std::string::npos ? fmt::format("{0} <> '' AND {0} <> 'no'", tag)
                                     : fmt::format("{} = '{}'", tag.substr(0, equals), tag.substr(equals + 1));
}

/// Of features without the tag that is asked of OpenStreetMap's: how many were left out, and how many were not, unless
/// a condition on the tag says that this is meant.
void tell_of_untagged(const geo::FeatureCensus& census, const geo::VectorSource& source, FlawTally& tally) {
  tally.note(fmt::format("features of OpenStreetMap without the tag {}, left out", source.osm_tag),
             census.untagged.first, census.untagged.count);
  if (source.where.find(source.osm_tag.substr(0, source.osm_tag.find('='))) != std::string::npos) return;
  tally.mistake(fmt::format("features without the tag {} that others of the file carry, taken all the same "
                            "(where = \"{}\" leaves them out)",
                            source.osm_tag, condition_on(source.osm_tag)),
                census.taken_untagged.first, census.taken_untagged.count);
}

/// As tables write a number that is 0: "0", "0.000", "-0.0".
bool is_zero(const std::string& text) {
  double number = 1.0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  return fault == std::errc() && end == text.data() + text.size() && number == 0.0;
}

}  // namespace

bool is_said_of(const geo::Feature& feature, const std::string& attribute) {
  static constexpr std::array<std::string_view, 5> noes{"", "no", "n", "false", "f"};
  const auto said = feature.attribute(attribute);
  return said && std::ranges::find(noes, in_small_letters(*said)) == noes.end() && !is_zero(*said);
}

std::optional<double> number_in(const geo::Feature& feature, const std::optional<std::string>& attribute,
                                double metres_per_plain_number) {
  if (!attribute) return std::nullopt;
  const auto text = feature.attribute(*attribute);
  return text ? metres_from_text(*text, metres_per_plain_number) : std::nullopt;
}

void refuse_negative(double value, const geo::Feature& feature, const std::string& attribute,
                     const geo::VectorSource& source) {
  if (value >= 0.0) return;
  throw Error(fmt::format("{}: {}", source.file.string(), feature.id),
              fmt::format("its {} is {}", attribute, *feature.attribute(attribute)),
              "correct it to a height above the ground, or leave such features out with the key where");
}

void tell_of_doubtful_comma(const geo::Feature& feature, const std::optional<std::string>& attribute,
                            FlawTally& tally) {
  if (!attribute) return;
  const auto text = feature.attribute(*attribute);
  if (!text || !has_doubtful_comma(*text)) return;
  tally.flaw(fmt::format("values of {} whose comma may part decimals or thousands, passed over", *attribute),
             fmt::format("{} ({})", feature.id, *text));
}

void settle_census(const geo::FeatureCensus& census, const geo::VectorSource& source, const FlawLimit& limit,
                   std::vector<Remark>& remarks) {
  FlawTally tally;
  tally.flaw("features without usable coordinates, left out", census.first_nowhere, census.nowhere);
  for (const std::string& tag : census.unknown_tags) {
    tally.mistake(fmt::format("conditions on the tag {}, which no feature carries", tag),
                  explained(source.where, tag, census.attribute_names));
  }
  tell_of_untagged(census, source, tally);
  if (census.features == 0 && census.nowhere == 0) {
    tally.mistake("files without a feature that is asked for, of which nothing is used",
                  source.where.empty() ? "has none" : fmt::format("none meets where = \"{}\"", source.where));
  }
  tally.settle(source.file.string(), census.features + census.nowhere, limit, remarks);
}

void require_attribute(const geo::FeatureCensus& census, const std::optional<std::string>& attribute,
                       const geo::VectorSource& source, const std::string& where, FlawTally& tally) {
  const auto& names = census.attribute_names;
  if (!attribute || census.features == 0 || std::ranges::find(names, *attribute) != names.end()) return;
  const auto nearest = nearest_word(*attribute, names);
  if (census.has_free_tags) {
    const std::string meant = nearest ? fmt::format(" (did you mean {}?)", *nearest) : "";
    tally.mistake("tags that no feature carries, as though all had been left out", *attribute + meant);
    return;
  }
  throw Error(
      where, fmt::format("no feature of {} has the attribute '{}'", source.file.filename().string(), *attribute),
      nearest ? fmt::format("did you mean {}?", *nearest) : fmt::format("use one of {}", fmt::join(names, ", ")));
}

}  // namespace sigmascape::scene
