#include "sigmascape/geo/vector_source.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cpl_error.h>
#include <cpl_string.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gdal_priv.h>
#include <iterator>
#include <ogrsf_frmts.h>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "sigmascape/base/error.h"
#include "sigmascape/base/interruption.h"
#include "sigmascape/geo/coordinate_transform.h"
#include "sigmascape/geo/heeding_progress.h"
#include "sigmascape/geo/is_absent.h"
#include "sigmascape/geo/osm_tags.h"
#include "sigmascape/geo/polygon_overlay.h"
#include "sigmascape/geo/quiet_gdal.h"
#include "sigmascape/geo/spatial_reference.h"
#include "sigmascape/geo/tag_condition.h"

namespace sigmascape::geo {
namespace {

GDALDatasetUniquePtr open_vector(const VectorSource& source) {
  const std::string name = source.file.string();
  if (is_absent(source.file)) throw Error(name, "the file does not exist", "correct the path of the vector data");
  CPLStringList options;
  if (!source.x_column.empty()) {
    options.SetNameValue("X_POSSIBLE_NAMES", source.x_column.c_str());
    options.SetNameValue("Y_POSSIBLE_NAMES", source.y_column.c_str());
    options.SetNameValue("KEEP_GEOM_COLUMNS", "YES");
  }
  const QuietGdal quiet;
  register_gdal_drivers();
  GDALDatasetUniquePtr dataset(
      GDALDataset::Open(name.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr, options.List(), nullptr));
  if (!dataset) {
    throw Error(name, "is not vector data that OGR can read" + QuietGdal::complaint_beside(),
                "give GeoJSON, GeoPackage, Shapefile, OSM PBF, CSV or another OGR source");
  }
  return dataset;
}

std::vector<std::string> column_names(OGRLayer& layer) {
  std::vector<std::string> names;
  for (int i = 0; i < layer.GetLayerDefn()->GetFieldCount(); ++i) {
    names.emplace_back(layer.GetLayerDefn()->GetFieldDefn(i)->GetNameRef());
  }
  return names;
}

void require_columns(GDALDataset& dataset, const VectorSource& source) {
  if (source.x_column.empty()) return;
  for (OGRLayer* layer : dataset.GetLayers()) {
    for (const std::string& column : {source.x_column, source.y_column}) {
      if (layer->GetLayerDefn()->GetFieldIndex(column.c_str()) >= 0) continue;
      throw Error(source.file.string(), fmt::format("has no column '{}'", column),
                  fmt::format("choose among its columns {}", fmt::join(column_names(*layer), ", ")));
    }
  }
}

/// Of a tag given as "key" or "key=value".
std::string key_of(const std::string& tag) {
  return tag.substr(0, tag.find('='));
}

bool is_osm(GDALDataset& dataset) {
  return std::string(dataset.GetDriverName()) == "OSM";
}

/// Leaves only the layer's features that meet the condition to be read; nothing, or why it does not fit. Asked of OGR's
/// own SQL first: databases take an attribute that they do not know for text, or look only when a feature is read.
std::optional<std::string> condition_fault(OGRLayer& layer, const std::string& condition) {
  const QuietGdal quiet;
  const bool fits = OGRFeatureQuery().Compile(&layer, condition.c_str()) == OGRERR_NONE &&
                    layer.SetAttributeFilter(condition.c_str()) == OGRERR_NONE;
  return fits ? std::nullopt : std::optional(QuietGdal::complaint());
}

/// In which OGR packs the tags of OpenStreetMap that have no column of their own, as do the files that it converts.
constexpr const char* packed_tags = "other_tags";

/// In which converters keep what OpenStreetMap itself calls a feature: OGR, Overpass and osmium, QuickOSM, OSMnx.
constexpr std::array<const char*, 5> osm_identities{"osm_id", "osm_way_id", "@id", "full_id", "osmid"};

/// A layer, and what its features are still to be asked when OGR cannot ask it by itself.
struct WantedLayer {
  OGRLayer* layer = nullptr;
  std::unique_ptr<TagCondition> condition{};
  bool has_packed_tags = false;
  bool has_column_of_tag = false;  ///< that is asked for
};

/// Leaves only what meets the condition to be read or asked; nothing, or why it does not fit.
std::optional<std::string> condition_fault(WantedLayer& wanted, const std::string& condition) {
  const auto fault = condition_fault(*wanted.layer, condition);
  const OGRFeatureDefn& columns = *wanted.layer->GetLayerDefn();
  if (!fault || columns.GetFieldIndex(packed_tags) < 0) return fault;
  wanted.condition = std::make_unique<TagCondition>(columns, condition);
  return wanted.condition->fault();
}

/// Names in conditions that are no column of any of the layers, as long as no feature carries them.
class UnknownTags {
 public:
  explicit UnknownTags(const std::vector<WantedLayer>& layers) {
    for (const WantedLayer& wanted : layers) {
      if (wanted.condition) std::ranges::copy(wanted.condition->tags(), std::inserter(names_, names_.end()));
    }
    for (const WantedLayer& wanted : layers) {
      std::erase_if(names_, [&](const std::string& name) {
        return wanted.layer->GetLayerDefn()->GetFieldIndex(name.c_str()) >= 0;
      });
    }
  }
  /// Of a feature that a condition is asked of.
  void look_at(const std::map<std::string, std::string>& attributes) {
    any_asked_ = true;
    std::erase_if(names_, [&](const std::string& name) { return attributes.contains(name); });
  }
  [[nodiscard]] std::vector<std::string> left() const {
    return any_asked_ ? std::vector(names_.begin(), names_.end()) : std::vector<std::string>();
  }

 private:
  std::set<std::string> names_;
  bool any_asked_ = false;
};

Error without_places(const VectorSource& source) {
  const std::string remedy = source.kind != GeometryKind::Points
                                 ? "give data that hold lines or areas, such as GeoJSON or GeoPackage"
                             : source.x_column.empty() ? "name its columns of coordinates with the keys x and y"
                                                       : "save it as CSV, of which columns of coordinates are read";
  return {source.file.string(), "is a table without places", remedy};
}

/// The layer that is named, or all, less those that are tables without places, such as the styles that a GIS keeps in a
/// GeoPackage, and those whose features cannot meet the condition, for they lack its attributes.
std::vector<WantedLayer> wanted_layers(GDALDataset& dataset, const VectorSource& source) {
  std::vector<WantedLayer> layers;
  std::vector<std::string> names, condition_faults;
  bool has_tables = false;
  for (OGRLayer* layer : dataset.GetLayers()) {
    names.emplace_back(layer->GetName());
    if (!source.layer.empty() && source.layer != names.back()) continue;
    if (layer->GetGeomType() == wkbNone) {
      has_tables = true;
      continue;
    }
    WantedLayer wanted{layer};
    const auto columns = column_names(*layer);
    wanted.has_packed_tags = std::ranges::find(columns, packed_tags) != columns.end();
    wanted.has_column_of_tag = std::ranges::find(columns, key_of(source.osm_tag)) != columns.end();
    const auto fault = source.where.empty() ? std::nullopt : condition_fault(wanted, source.where);
    if (fault) condition_faults.push_back(*fault);
    if (!fault) layers.push_back(std::move(wanted));
  }
  if (!layers.empty() || names.empty()) return layers;
  const std::string name = source.file.string();
  if (condition_faults.empty() && has_tables) throw without_places(source);
  if (condition_faults.empty()) {
    throw Error(name, fmt::format("has no layer '{}'", source.layer),
                fmt::format("choose among its layers {}", fmt::join(names, ", ")));
  }
  throw Error(
      name, fmt::format("the condition '{}' does not fit its attributes ({})", source.where, condition_faults.front()),
      "correct the key where");
}

std::vector<Vec2d> positions_of(const OGRSimpleCurve& line) {
  std::vector<Vec2d> positions;
  positions.reserve(static_cast<std::size_t>(line.getNumPoints()));
  for (int i = 0; i < line.getNumPoints(); ++i) positions.push_back({line.getX(i), line.getY(i)});
  return positions;
}

Polygon polygon_of(const OGRPolygon& area) {
  Polygon polygon;
  for (const OGRLinearRing* ring : area) {
    (ring == area.getExteriorRing() ? polygon.outer : polygon.holes.emplace_back()) = positions_of(*ring);
  }
  return polygon;
}

/// Whether a geometry is made of faces in space, as are buildings with walls and roofs, and terrain.
bool has_faces(const OGRGeometry& geometry) {
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection) == FALSE)
    return OGR_GT_IsSubClassOf(type, wkbPolyhedralSurface) != FALSE;
  const OGRGeometryCollection& parts = *geometry.toGeometryCollection();
  return std::any_of(parts.begin(), parts.end(), [](const OGRGeometry* part) { return has_faces(*part); });
}

void append_geometry(const OGRGeometry& geometry, GeometryKind kind, Feature& feature) {
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (type == wkbPoint && kind == GeometryKind::Points) {
    const OGRPoint& point = *geometry.toPoint();
    if (point.IsEmpty() == FALSE) feature.points.push_back({point.getX(), point.getY()});
  } else if (type == wkbLineString && kind == GeometryKind::Lines) {
    feature.lines.push_back(positions_of(*geometry.toLineString()));
  } else if ((type == wkbPolygon || type == wkbTriangle) && kind == GeometryKind::Areas) {
    Polygon polygon = polygon_of(*geometry.toPolygon());
    if (!polygon.outer.empty()) feature.polygons.push_back(std::move(polygon));
  } else if (OGR_GT_IsSubClassOf(type, wkbPolyhedralSurface) != FALSE) {
    for (const OGRPolygon* face : *geometry.toPolyhedralSurface()) append_geometry(*face, kind, feature);
  } else if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection) != FALSE) {
    for (const OGRGeometry* part : geometry.toGeometryCollection()) append_geometry(*part, kind, feature);
  } else if (OGR_GT_IsNonLinear(type) != FALSE) {
    const std::unique_ptr<OGRGeometry> straight(geometry.getLinearGeometry());
    if (straight && OGR_GT_IsNonLinear(straight->getGeometryType()) == FALSE) append_geometry(*straight, kind, feature);
  }
}

bool all_finite(const std::vector<Vec2d>& positions) {
  return std::ranges::all_of(positions, [](Vec2d p) { return std::isfinite(p.x) && std::isfinite(p.y); });
}

/// Brings a feature into the frame; false when some of it has no place there.
bool bring_to_frame(Feature& feature, const CoordinateTransform& transform) {
  bool good = true;
  const auto bring = [&](std::vector<Vec2d>& positions) {
    good = good && all_finite(positions);
    transform.to_frame(positions);
    good = good && all_finite(positions);
  };
  bring(feature.points);
  for (auto& line : feature.lines) bring(line);
  for (Polygon& polygon : feature.polygons) {
    bring(polygon.outer);
    polygon.outer = tidy_ring(std::move(polygon.outer), true);
    for (Ring& hole : polygon.holes) {
      bring(hole);
      hole = tidy_ring(std::move(hole), false);
    }
  }
  return good;
}

/// What faces cover of the ground, seen from above: walls nothing, a floor and the roof over it the same. As they are
/// where all stand upright.
std::vector<Polygon> ground_plan_of(std::vector<Polygon> faces) {
  Polygons seen;
  for (const Polygon& face : faces) {
    for (Polygon& part : repaired(face).polygons) seen.push_back(std::move(part));
  }
  return seen.empty() ? std::move(faces) : united_all(seen);
}

void read_attributes(const OGRFeature& row, Feature& feature) {
  for (int i = 0; i < row.GetFieldCount(); ++i) {
    if (!row.IsFieldSetAndNotNull(i)) continue;
    const std::string name = row.GetFieldDefnRef(i)->GetNameRef();
    // GetFieldAsString is not const only because it caches its answer.
    std::string text = const_cast<OGRFeature&>(row).GetFieldAsString(i);
    auto tags = name == packed_tags ? unpacked_tags(text) : std::map<std::string, std::string>();
    if (!tags.empty()) {
      feature.attributes.merge(tags);
    } else if (!text.empty()) {
      feature.attributes[name] = std::move(text);
    }
  }
}

/// The transform of each layer, made when its first feature arrives.
class LayerTransforms {
 public:
  LayerTransforms(const VectorSource& source, const LocalFrame& frame) : source_(source), frame_(frame) {}

  const CoordinateTransform& of(OGRLayer& layer) {
    const auto known = transforms_.find(&layer);
    if (known != transforms_.end()) return known->second;
    return transforms_.emplace(&layer, CoordinateTransform(crs_of(layer), frame_, source_.file.string())).first->second;
  }

 private:
  [[nodiscard]] std::string crs_of(OGRLayer& layer) const {
    if (!source_.crs.empty()) return source_.crs;
    if (const OGRSpatialReference* reference = layer.GetSpatialRef()) return wkt2_from(*reference);
    throw Error(source_.file.string(), "carries no coordinate reference system",
                "state it with the key crs, for example crs = \"EPSG:25830\"");
  }

  const VectorSource& source_;
  const LocalFrame& frame_;
  std::map<OGRLayer*, CoordinateTransform> transforms_;
};

/// Yields the features of some layers, one after another. OpenStreetMap files are walked as a whole, for they yield the
/// features of all layers in one pass; of others nothing is read that is not wanted.
class FeatureWalk {
 public:
  FeatureWalk(GDALDataset& dataset, std::vector<WantedLayer> wanted) : dataset_(dataset), wanted_(std::move(wanted)) {}

  /// With its layer; null after the last one.
  std::pair<OGRFeatureUniquePtr, const WantedLayer*> next() {
    return is_osm(dataset_) ? next_of_all() : next_by_layer();
  }

 private:
  /// Before there is one the file may have to be read through.
  std::pair<OGRFeatureUniquePtr, const WantedLayer*> next_of_all() {
    while (true) {
      OGRLayer* layer = nullptr;
      HeedingProgress heeding;
      OGRFeatureUniquePtr feature(dataset_.GetNextFeature(&layer, nullptr, HeedingProgress::advanced, &heeding));
      heeding.settle();
      if (feature == nullptr) return {};
      const auto found = std::ranges::find(wanted_, layer, &WantedLayer::layer);
      if (found != wanted_.end()) return {std::move(feature), &*found};
      Interruption::heed();
    }
  }

  std::pair<OGRFeatureUniquePtr, const WantedLayer*> next_by_layer() {
    for (; at_ < wanted_.size(); ++at_) {
      OGRFeatureUniquePtr feature(wanted_[at_].layer->GetNextFeature());
      if (feature != nullptr) return {std::move(feature), &wanted_[at_]};
    }
    return {};
  }

  GDALDataset& dataset_;
  std::vector<WantedLayer> wanted_;
  std::size_t at_ = 0;
};

/// Whether a feature carries a tag given as "key", with any value but "no", or as "key=value".
bool carries_tag(const Feature& feature, const std::string& tag) {
  const auto equals = tag.find('=');
  const auto value = feature.attribute(key_of(tag));
  return value && (equals == std::string::npos ? *value != "no" : *value == tag.substr(equals + 1));
}

/// Whether a feature has the name that OpenStreetMap itself gives it, in a column of a converter's or as "way/123".
bool has_osm_identity(const Feature& feature) {
  if (std::ranges::any_of(osm_identities, [&](const char* column) { return feature.attributes.contains(column); }))
    return true;
  const std::string id = feature.attribute("id").value_or("");
  return id.starts_with("node/") || id.starts_with("way/") || id.starts_with("relation/");
}

/// Whether a feature of a file converted from OpenStreetMap shows that it is of there, with the tag asked for if it had
/// it: its layer packs tags that have no column, and its own can be read, or has a column for this one beside the names
/// of OpenStreetMap's features. Columns of other data may be called `building` and mean what they will.
bool is_of_osm(const Feature& feature, const WantedLayer& wanted) {
  return wanted.has_packed_tags ? !feature.attributes.contains(packed_tags)
                                : wanted.has_column_of_tag && has_osm_identity(feature);
}

/// Chooses by the tag that is asked for, and counts for the census what goes without it.
class TagChoice {
 public:
  TagChoice(const std::string& tag, bool osm_file) : tag_(tag), osm_file_(osm_file) {}

  /// Whether a feature is passed over for want of the tag.
  bool leaves_out(const Feature& feature, const WantedLayer& wanted) {
    if (tag_.empty() || carries_tag(feature, tag_)) return false;
    if (osm_file_) return true;
    if (!is_of_osm(feature, wanted)) return false;
    count(feature, untagged_);
    return true;
  }

  /// Of a feature that is handed over.
  void take(const Feature& feature, const WantedLayer& wanted) {
    if (tag_.empty() || osm_file_) return;
    if (carries_tag(feature, tag_)) {
      any_tagged_ = true;
    } else if (wanted.has_packed_tags || wanted.has_column_of_tag) {
      count(feature, taken_);
    }
  }

  void tell(FeatureCensus& census) const {
    census.untagged = untagged_;
    if (any_tagged_) census.taken_untagged = taken_;
  }

 private:
  static void count(const Feature& feature, FeatureCount& of) {
    if (of.count++ == 0) of.first = feature.id;
  }

  const std::string& tag_;
  bool osm_file_, any_tagged_ = false;
  FeatureCount untagged_, taken_;
};

std::string_view word_for(GeometryKind kind) {
  return kind == GeometryKind::Points ? "a point" : kind == GeometryKind::Lines ? "a line" : "an area";
}

/// A feature that has no place in the frame, and why where it has coordinates.
std::string named_nowhere(const std::string& id, const OGRGeometry* geometry) {
  if (geometry == nullptr || geometry->IsEmpty() != FALSE) return id;
  OGREnvelope box;
  geometry->getEnvelope(&box);
  return fmt::format(
      "{} (at {:.10g}, {:.10g}, which has no place in the scene's frame: the key crs can state another reference "
      "system)",
      id, box.MinX, box.MinY);
}

bool has_geometry(const Feature& feature) {
  return !feature.points.empty() || !feature.lines.empty() || !feature.polygons.empty();
}

}  // namespace

std::optional<std::string> Feature::attribute(const std::string& name) const {
  const auto found = attributes.find(name);
  return found == attributes.end() ? std::nullopt : std::optional(found->second);
}

FeatureCensus for_each_feature(const VectorSource& source, const LocalFrame& frame,
                               const std::function<void(Feature&&)>& visit) {
  const GDALDatasetUniquePtr dataset = open_vector(source);
  require_columns(*dataset, source);
  std::vector<WantedLayer> layers = wanted_layers(*dataset, source);
  UnknownTags unknown_tags(layers);
  const bool osm = is_osm(*dataset);
  TagChoice tags(source.osm_tag, osm);
  LayerTransforms transforms(source, frame);
  FeatureCensus census;
  std::set<std::string> names;
  for (const WantedLayer& wanted : layers) {
    for (std::string& column : column_names(*wanted.layer)) names.insert(std::move(column));
  }
  census.has_free_tags = names.erase(packed_tags) > 0 || osm;
  FeatureWalk walk(*dataset, std::move(layers));
  std::size_t of_this_kind = 0, of_other_kinds = 0;

  const QuietGdal quiet;
  for (auto [row, wanted] = walk.next(); row != nullptr; std::tie(row, wanted) = walk.next()) {
    Interruption::heed();
    OGRLayer* const layer = wanted->layer;
    Feature feature;
    feature.id = fmt::format("layer {}, feature {}", layer->GetName(), row->GetFID());
    const OGRGeometry* geometry = row->GetGeometryRef();
    if (geometry != nullptr) append_geometry(*geometry, source.kind, feature);
    if (!has_geometry(feature) && geometry != nullptr && geometry->IsEmpty() == FALSE) {
      ++of_other_kinds;
      continue;
    }
    ++of_this_kind;
    read_attributes(*row, feature);
    if (tags.leaves_out(feature, *wanted)) continue;
    if (wanted->condition) {
      unknown_tags.look_at(feature.attributes);
      if (!wanted->condition->is_met_by(*row, feature.attributes)) continue;
    }
    for (const auto& [name, value] : feature.attributes) names.insert(name);
    if (!has_geometry(feature) || !bring_to_frame(feature, transforms.of(*layer))) {
      if (census.nowhere++ == 0) census.first_nowhere = named_nowhere(feature.id, geometry);
      continue;
    }
    if (has_faces(*geometry)) feature.polygons = ground_plan_of(std::move(feature.polygons));
    ++census.features;
    tags.take(feature, *wanted);
    const QuietGdal apart;  // what a visitor asks of GDAL is no fault of the file
    visit(std::move(feature));
  }
  if (QuietGdal::failed()) {
    throw Error(source.file.string(), fmt::format("cannot be read to its end ({})", QuietGdal::complaint()),
                "replace the damaged file");
  }
  if (!osm && of_other_kinds > 0 && of_this_kind == 0) {
    throw Error(source.file.string(),
                of_other_kinds == 1
                    ? fmt::format("its only feature is not {}", word_for(source.kind))
                    : fmt::format("none of its {} features is {}", of_other_kinds, word_for(source.kind)),
                "choose another layer or file");
  }
  census.unknown_tags = unknown_tags.left();
  tags.tell(census);
  census.attribute_names.assign(names.begin(), names.end());
  return census;
}

}  // namespace sigmascape::geo
