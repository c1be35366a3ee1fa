#include "sigmascape/scene/building_reader.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <set>
#include <string_view>
#include <utility>

#include "sigmascape/base/interruption.h"
#include "sigmascape/scene/building_extrusion.h"
#include "sigmascape/scene/footprint.h"
#include "sigmascape/scene/partner_key.h"
#include "sigmascape/scene/vector_section.h"

namespace sigmascape::scene {
namespace {

constexpr Interval height_range{0.5, 2000.0, "m"};

/// Height from the feature itself: its height, else its levels. Zero counts as unknown.
std::optional<double> stated_height_m(const geo::Feature& feature, const BuildingSource& source) {
  if (const auto height = number_in(feature, source.height_attribute, source.metres_per_plain_number)) {
    refuse_negative(*height, feature, *source.height_attribute, source.vector);
    if (*height >= height_range.lowest && *height <= height_range.highest) return height;
  }
  const double height_of_levels_m = number_in(feature, source.levels_attribute).value_or(0.0) * source.metres_per_level;
  return height_of_levels_m > 0.0 && height_of_levels_m <= height_range.highest ? std::optional(height_of_levels_m)
                                                                                : std::nullopt;
}

/// Whether a feature's attribute is a number above 0.
bool counts_some(const geo::Feature& feature, const std::string& attribute) {
  const auto count = number_in(feature, attribute);
  return count && *count > 0.0;
}

/// Whether it is one below 0.
bool counts_down(const geo::Feature& feature, const std::optional<std::string>& attribute) {
  const auto count = number_in(feature, attribute);
  return count && *count < 0.0;
}

/// Whether nothing of a building stands above the ground, as OpenStreetMap and Overture Maps tell: it lies underground
/// outright, or has levels beneath the ground, none above and no height. Some count those below from the ground down,
/// as -1. A layer below 0 alone says only that something passes over it.
bool is_underground(const geo::Feature& feature, const BuildingSource& source) {
  if (feature.attribute("location") == "underground" || is_said_of(feature, "is_underground")) return true;
  const bool goes_down = counts_down(feature, source.levels_attribute) || counts_down(feature, "building:levels");
  const bool has_cellars_alone = number_in(feature, "building:levels") == 0.0 &&
                                 counts_some(feature, "building:levels:underground") &&
                                 !counts_some(feature, "roof:levels");
  return (goes_down || has_cellars_alone) && !stated_height_m(feature, source);
}

/// Whether OpenStreetMap says that a building is something to walk or drive beneath.
bool is_open_beneath(const geo::Feature& feature) {
  static constexpr std::array<std::string_view, 4> open{"roof", "canopy", "carport", "bridge"};
  const auto kind = feature.attribute("building");
  return kind && std::ranges::find(open, *kind) != open.end();
}

/// Of what has air beneath it: every building is raised from the ground.
void tell_of_air_beneath(const geo::Feature& feature, FlawTally& tally) {
  if (counts_some(feature, "min_height") || counts_some(feature, "building:min_level")) {
    tally.note("buildings that begin above the ground by their min_height or building:min_level, raised from it",
               feature.id);
  } else if (is_open_beneath(feature)) {
    tally.note("roofs and bridges (building=roof, canopy, carport, bridge), raised as solid blocks", feature.id);
  }
}

/// Height of a building, or nothing when it is to be left out.
std::optional<double> height_m(const geo::Feature& feature, const BuildingSource& source, FlawTally& tally) {
  if (!source.height_attribute && !source.levels_attribute) return source.default_height_m;
  tell_of_doubtful_comma(feature, source.height_attribute, tally);
  if (const auto stated = stated_height_m(feature, source)) return stated;
  tell_of_doubtful_comma(feature, source.levels_attribute, tally);
  if (source.default_height_m) {
    tally.note(fmt::format("buildings without a height, given {:g} m", *source.default_height_m), feature.id);
  } else {
    tally.flaw("buildings without a height, left out", feature.id);
  }
  return source.default_height_m;
}

/// The valid parts of a feature's polygons.
geo::Polygons mended_shape(const geo::Feature& feature, const BuildingSource& source, FlawTally& tally) {
  geo::Polygons shape;
  std::set<geo::Rings> rings;
  for (const geo::Polygon& polygon : feature.polygons) {
    Interruption::heed();
    auto [parts, were] = geo::repaired(polygon);
    rings.insert(were);
    shape.insert(shape.end(), parts.begin(), parts.end());
  }
  if (rings.contains(geo::Rings::Cross)) {
    tally.flaw("self-crossing footprints, repaired", feature.id);
  } else if (rings.contains(geo::Rings::Touch)) {
    tally.note("footprints whose rings touch themselves or one another, parted there", feature.id);
  }
  // Parts of one feature may overlap one another; the valid whole is their union.
  if (feature.polygons.size() > 1) shape = geo::united_all(shape);
  return geo::simplified(shape, source.simplify_m);
}

/// By the mean of its corners.
bool lies_inside(const geo::Polygon& polygon, const radar::Rectangle& extent) {
  Vec2d sum;
  for (const Vec2d& corner : polygon.outer) sum = sum + corner;
  return !polygon.outer.empty() && extent.contains(sum * (1.0 / static_cast<double>(polygon.outer.size())));
}

std::size_t collect_footprints(Scene& scene, const BuildingSource& source, std::size_t source_number, FlawTally& tally,
                               std::vector<Footprint>& footprints) {
  const MaterialIndex wall = scene.material_index(source.wall), roof = scene.material_index(source.roof);
  const std::string all_outside = "buildings outside the scene, left out",
                    all_beneath = "buildings underground, left out";
  std::size_t inside = 0;
  const auto census = geo::for_each_feature(source.vector, scene.frame, [&](geo::Feature&& feature) {
    const std::size_t outside =
        std::erase_if(feature.polygons, [&](const geo::Polygon& part) { return !lies_inside(part, scene.extent); });
    if (feature.polygons.empty()) {
      tally.note(all_outside, feature.id);
      return;
    }
    if (is_underground(feature, source)) {
      tally.note(all_beneath, feature.id);
      return;
    }
    tally.note("parts of buildings outside the scene, left out", feature.id, outside);
    ++inside;
    auto shape = mended_shape(feature, source, tally);
    if (geo::area_m2(shape) < source.min_area_m2) {
      tally.note("buildings smaller than min_area_m2, left out", feature.id);
      return;
    }
    if (const auto height = height_m(feature, source, tally)) {
      tell_of_air_beneath(feature, tally);
      footprints.push_back({std::move(shape), *height, wall, roof, source_number, std::move(feature.id), {}});
    }
  });
  require_attribute(census, source.height_attribute, source.vector, source.where + ".height_attribute", tally);
  require_attribute(census, source.levels_attribute, source.vector, source.where + ".levels_attribute", tally);
  if (inside == 0) {
    for (const std::string& kind : {all_outside, all_beneath}) tally.leaves_nothing(kind);
  }
  settle_census(census, source.vector, source.limit, scene.remarks);
  return inside;
}

/// Whether the ground rises above a level at a corner of an outline, courtyards included.
bool lies_beneath_ground(const geo::Polygon& outline, double level_m, const terrain::HeightField& terrain) {
  const auto rises_above = [&](Vec2d corner) { return terrain.height_at(corner) > level_m; };
  return std::ranges::any_of(outline.outer, rises_above) ||
         std::ranges::any_of(outline.holes,
                             [&](const geo::Ring& hole) { return std::ranges::any_of(hole, rises_above); });
}

/// Raises a building, piece by piece.
void raise(Scene& scene, const Footprint& footprint, FlawTally& tally) {
  bool is_buried = false;
  for (std::size_t piece = 0; piece < footprint.shape.size(); ++piece) {
    Interruption::heed();
    const geo::Polygon& outline = footprint.shape[piece];
    const double footing_m = footing_of(whole_of(piece, footprint), scene.terrain);
    append_building(scene.buildings, outline, footprint.height_m, footing_m, footprint.wall, footprint.roof);
    is_buried = is_buried || lies_beneath_ground(outline, footing_m + footprint.height_m, scene.terrain);
  }
  tally.note("buildings whose roof lies beneath the ground at a corner, since their height counts from the lowest",
             footprint.id, is_buried ? 1 : 0);
}

}  // namespace

BuildingSource read_building_source(const TomlSection& section, const MaterialTable& materials,
                                    const FlawLimit& limit) {
  BuildingSource source;
  source.where = section.where();
  source.vector = read_vector_source(section, geo::GeometryKind::Areas);
  source.vector.osm_tag = "building";
  source.height_attribute = section.optional_text("height_attribute");
  source.levels_attribute = section.optional_text("levels_attribute");
  source.metres_per_plain_number = read_metres_per_plain_number(section, {"height_attribute"});
  source.metres_per_level = section.number_or("metres_per_level", {1.5, 10.0, "m"}, source.metres_per_level);
  refuse_without(section, "metres_per_level", "levels_attribute", source.levels_attribute.has_value());
  source.default_height_m = section.optional_number("default_height_m", height_range);
  source.min_area_m2 = section.number_or("min_area_m2", {0.0, 1e6, "m²"}, source.min_area_m2);
  source.simplify_m = section.number_or("simplify_m", {0.0, 10.0, "m"}, source.simplify_m);
  source.wall = materials.named_by(section, "wall_material", "concrete");
  source.roof = materials.named_by(section, "roof_material", "concrete");
  source.limit = read_flaw_limit(section, limit);
  section.refuse_unknown_keys();
  if (!source.height_attribute && !source.levels_attribute && !source.default_height_m) {
    throw Error(section.where(), "does not say how tall the buildings are",
                "give height_attribute, levels_attribute or default_height_m");
  }
  return source;
}

void add_buildings(Scene& scene, const std::vector<BuildingSource>& sources) {
  std::vector<FlawTally> tallies(sources.size());
  std::vector<std::size_t> inside;
  std::vector<Footprint> footprints;
  for (std::size_t i = 0; i < sources.size(); ++i)
    inside.push_back(collect_footprints(scene, sources[i], i, tallies[i], footprints));
  for (const Footprint& footprint : without_overlaps(std::move(footprints), tallies))
    raise(scene, footprint, tallies[footprint.source]);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    tallies[i].settle(sources[i].vector.file.string(), inside[i], sources[i].limit, scene.remarks);
  }
}

}  // namespace sigmascape::scene
