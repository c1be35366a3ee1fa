#include "sigmascape/scene/road_reader.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <span>
#include <utility>

#include "sigmascape/base/interruption.h"
#include "sigmascape/base/small_letters.h"
#include "sigmascape/radar/rectangle_parts.h"
#include "sigmascape/scene/vector_section.h"

namespace sigmascape::scene {
namespace {

constexpr Interval width_range{0.5, 100.0, "m"};

/// Paved widths of OpenStreetMap's road classes: lanes of 3 to 3.5 m, as many as are usual.
const std::map<std::string, double> usual_width_m = {
    {"motorway", 22.0},     {"motorway_link", 7.0}, {"trunk", 14.0},      {"trunk_link", 7.0},
    {"primary", 12.0},      {"primary_link", 6.0},  {"secondary", 9.0},   {"secondary_link", 6.0},
    {"tertiary", 7.0},      {"tertiary_link", 5.0}, {"residential", 6.0}, {"unclassified", 6.0},
    {"living_street", 5.0}, {"service", 4.0},       {"busway", 7.0},      {"pedestrian", 5.0},
};

/// As OpenStreetMap draws them, each carriageway by a line of its own.
const std::map<std::string, double> usual_carriageway_m = {{"motorway", 11.0}, {"trunk", 7.0}};

/// What `oneway` says in OpenStreetMap and tables made of it. Tables of Geofabrik's write B, F and T in capitals for
/// both ways, forwards and backwards; small f and t are false and true, as databases write them. Where the way changes
/// with the hour, or from one vehicle to the next, there is traffic both ways.
const std::map<std::string, Way> way_said{
    {"no", Way::Both},   {"false", Way::Both},      {"n", Way::Both},           {"f", Way::Both},
    {"B", Way::Both},    {"reversible", Way::Both}, {"alternating", Way::Both}, {"", Way::Both},
    {"yes", Way::Along}, {"true", Way::Along},      {"y", Way::Along},          {"t", Way::Along},
    {"F", Way::Along},   {"T", Way::Against},       {"reverse", Way::Against},
};

/// Of a road that says nothing, or nothing that is known, both ways.
Way way_of(const geo::Feature& feature, FlawTally& tally) {
  const auto said = feature.attribute("oneway");
  if (!said) return Way::Both;
  for (const std::string& word : {*said, in_small_letters(*said)}) {
    if (const auto known = way_said.find(word); known != way_said.end()) return known->second;
  }
  const auto number = number_in(feature, "oneway");
  if (number == 1.0) return Way::Along;
  if (number == -1.0) return Way::Against;
  if (number != 0.0) {
    tally.note("roads whose oneway is of no known meaning, taken for both ways",
               fmt::format("{} ({})", feature.id, *said));
  }
  return Way::Both;
}

constexpr const char* without_width = "roads of a class without a width, left out";

std::optional<double> width_m(const geo::Feature& feature, Way way, const RoadSource& source, FlawTally& tally) {
  if (source.width_attribute) {
    const auto stated = number_in(feature, source.width_attribute, source.metres_per_plain_number);
    if (stated && *stated >= width_range.lowest && *stated <= width_range.highest) return stated;
    tell_of_doubtful_comma(feature, source.width_attribute, tally);
  }
  if (source.class_attribute) {
    const auto name = feature.attribute(*source.class_attribute);
    const auto half = name ? source.carriageway_m_by_class.find(*name) : source.carriageway_m_by_class.end();
    if (half != source.carriageway_m_by_class.end() && way != Way::Both) return half->second;
    const auto known = name ? source.width_m_by_class.find(*name) : source.width_m_by_class.end();
    if (known != source.width_m_by_class.end()) return known->second;
  }
  if (!source.width_m) tally.note(without_width, feature.id);
  return source.width_m;
}

/// What hides a road from above, by the attribute that tells it, as remarks call it.
constexpr std::array<std::pair<const char*, const char*>, 2> hidings{
    {{"tunnel", "roads in tunnels, left out"}, {"covered", "roads under cover, left out"}}};

/// By the box about its line, drawn out by half the width.
bool reaches_into(const radar::Rectangle& extent, std::span<const Vec2d> line, double half_width_m) {
  if (line.empty()) return false;
  const radar::Rectangle within = radar::widened(extent, half_width_m);
  const auto [west, east] = std::ranges::minmax(line, {}, &Vec2d::x);
  const auto [south, north] = std::ranges::minmax(line, {}, &Vec2d::y);
  return west.x <= within.east_m && east.x >= within.west_m && south.y <= within.north_m && north.y >= within.south_m;
}

double distance_m(Vec2d point, Vec2d from, Vec2d to) {
  const Vec2d along = to - from;
  const double square = dot(along, along);
  const double t = square > 0.0 ? std::clamp(dot(point - from, along) / square, 0.0, 1.0) : 0.0;
  return length(point - (from + along * t));
}

struct Stretch {
  double least, greatest;
};

/// Between which x lies what of the line from one point to another has a y within a span; nothing where none of it has.
std::optional<Stretch> x_between(Vec2d from, Vec2d to, const Stretch& y) {
  if (from.y > to.y) std::swap(from, to);
  if (to.y < y.least || from.y > y.greatest) return std::nullopt;
  const auto x_at = [&](double at) {
    return std::lerp(from.x, to.x, std::clamp((at - from.y) / (to.y - from.y), 0.0, 1.0));
  };
  const bool is_level = from.y == to.y;
  const auto [least, greatest] =
      is_level ? std::minmax({from.x, to.x}) : std::minmax({x_at(y.least), x_at(y.greatest)});
  return Stretch{least, greatest};
}

/// Paints every dry cell whose centre lies within the half width of a line. Of each row only the cells beside the line
/// are looked at: the box about a long one slantwise would be a hundred times as many.
void pave(MaterialMap& ground, const WaterMask& water, std::span<const Vec2d> line, double half_width_m,
          MaterialIndex paving) {
  const radar::GroundGrid& grid = ground.grid;
  const double reach = half_width_m / grid.cell_m;
  const auto drawn_in = [](double cells, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(cells, 0.0, static_cast<double>(count)));
  };
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    Interruption::heed();
    const Vec2d a = grid.cells_from(line[i]), b = grid.cells_from(line[i + 1]);
    const std::size_t first_row = drawn_in(std::min(a.y, b.y) - reach, grid.rows);
    const std::size_t end_row = drawn_in(std::max(a.y, b.y) + reach + 1.0, grid.rows);
    for (std::size_t row = first_row; row < end_row; ++row) {
      const double centre = static_cast<double>(row) + 0.5;
      const auto beside = x_between(a, b, {centre - reach - 0.5, centre + reach + 0.5});
      if (!beside) continue;
      const std::size_t first_column = drawn_in(beside->least - reach - 1.0, grid.columns);
      const std::size_t end_column = drawn_in(beside->greatest + reach + 1.0, grid.columns);
      for (std::size_t column = first_column; column < end_column; ++column) {
        if (water(column, row) != 0) continue;
        if (distance_m(grid.centre_of(column, row), line[i], line[i + 1]) <= half_width_m)
          ground.material(column, row) = paving;
      }
    }
  }
}

}  // namespace

RoadSource read_road_source(const TomlSection& section, const MaterialTable& materials, const FlawLimit& limit) {
  RoadSource source;
  source.where = section.where();
  source.vector = read_vector_source(section, geo::GeometryKind::Lines);
  source.vector.osm_tag = "highway";
  source.width_attribute = section.optional_text("width_attribute");
  source.metres_per_plain_number = read_metres_per_plain_number(section, {"width_attribute"});
  source.class_attribute = section.optional_text("class_attribute");
  source.width_m_by_class = usual_width_m;
  source.carriageway_m_by_class = usual_carriageway_m;
  if (const auto widths = section.section("width_m_by_class")) {
    for (const std::string& name : widths->keys()) {
      source.width_m_by_class[name] = widths->number(name, width_range);
      source.carriageway_m_by_class.erase(name);
    }
  }
  source.width_m = section.optional_number("width_m", width_range);
  source.paving = materials.named_by(section, "material", "asphalt");
  if (const auto traffic = section.section("traffic")) source.traffic = read_traffic(*traffic, materials);
  source.limit = read_flaw_limit(section, limit);
  section.refuse_unknown_keys();
  if (!source.width_attribute && !source.class_attribute && !source.width_m) {
    throw Error(section.where(), "does not say how wide the roads are",
                "give width_m, width_attribute or class_attribute");
  }
  return source;
}

void add_roads(Scene& scene, const RoadSource& source, const WaterMask& water) {
  const std::string outside = "roads outside the scene, left out";
  std::size_t inside = 0;
  FlawTally tally;
  const MaterialIndex paving = scene.material_index(source.paving);
  std::optional<TrafficFlow> flow;
  if (source.traffic) flow.emplace(scene, *source.traffic);
  const auto census = geo::for_each_feature(source.vector, scene.frame, [&](const geo::Feature& feature) {
    const auto hiding =
        std::ranges::find_if(hidings, [&](const auto& hides) { return is_said_of(feature, hides.first); });
    if (hiding != hidings.end()) {
      tally.note(hiding->second, feature.id);
      return;
    }
    const Way way = way_of(feature, tally);
    const auto width = width_m(feature, way, source, tally);
    if (!width) return;
    const bool is_inside = std::ranges::any_of(
        feature.lines, [&](const auto& line) { return reaches_into(scene.extent, line, *width / 2.0); });
    inside += is_inside ? 1 : 0;
    tally.note(outside, feature.id, is_inside ? 0 : 1);
    for (const auto& line : feature.lines) {
      pave(scene.ground, water, line, *width / 2.0, paving);
      if (flow) flow->fill(line, *width, way, water);
    }
  });
  require_attribute(census, source.width_attribute, source.vector, source.where + ".width_attribute", tally);
  require_attribute(census, source.class_attribute, source.vector, source.where + ".class_attribute", tally);
  if (inside == 0) {
    for (const std::string& kind : {outside, std::string(without_width)}) tally.leaves_nothing(kind);
    for (const auto& [attribute, kind] : hidings) tally.leaves_nothing(kind);
  }
  settle_census(census, source.vector, source.limit, scene.remarks);
  tally.settle(source.vector.file.string(), census.features + census.nowhere, source.limit, scene.remarks);
}

}  // namespace sigmascape::scene
