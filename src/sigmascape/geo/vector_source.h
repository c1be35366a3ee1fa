#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sigmascape/base/vec.h"
#include "sigmascape/geo/lattice.h"
#include "sigmascape/geo/local_frame.h"
#include "sigmascape/geo/polygon.h"

namespace sigmascape::geo {

enum class GeometryKind { Points, Lines, Areas };

/// What to read from a vector file of any format that OGR reads, text tables with coordinate columns among them.
struct VectorSource {
  std::filesystem::path file;
  GeometryKind kind = GeometryKind::Areas;
  std::string layer{};                 ///< empty: every layer
  std::string where{};                 ///< condition on attributes in OGR's SQL ("floors > 2"); empty: all
  std::string crs{};                   ///< overrides the file's own when not empty
  std::string x_column{}, y_column{};  ///< of a table without geometry
  std::string osm_tag{};  ///< of OpenStreetMap's features, only what carries this tag, as "key" or "key=value"
};

/// One thing on the map, in the local frame. Of the three geometries, only that of the kind asked for is filled.
struct Feature {
  std::string id;  ///< "layer buildings, feature 17"
  /// Those that are set. Tags of OpenStreetMap inside `other_tags` are among them, in files converted from it as well.
  std::map<std::string, std::string> attributes;
  std::vector<Vec2d> points;
  std::vector<std::vector<Vec2d>> lines;
  /// As found: not necessarily valid. Of faces in space (surfaces of polyhedra, TINs) what they cover of the ground.
  std::vector<Polygon> polygons;

  [[nodiscard]] std::optional<std::string> attribute(const std::string& name) const;
};

/// How many features are so, and the first of them by its id.
struct FeatureCount {
  std::size_t count = 0;
  std::string first;
};

/// What is known of a file once all its features have been seen.
struct FeatureCensus {
  std::size_t features = 0;  ///< that have a place in the frame
  /// All that features have and the columns of their layers, which may be empty throughout; sorted.
  std::vector<std::string> attribute_names;
  /// Whether features carry tags of OpenStreetMap that are no columns: none of a name may carry one by chance.
  bool has_free_tags = false;
  std::size_t nowhere = 0;    ///< features without geometry or with coordinates that have no place in the frame
  std::string first_nowhere;  ///< by its id, and its coordinates if it has any
  /// Names in the condition that are no column of a layer and no tag of a feature that was asked, sorted: they were
  /// NULL for all of them, be it that they are misspelled or that nothing has them. None when no feature was asked.
  std::vector<std::string> unknown_tags;
  /// Of a file converted from OpenStreetMap: what was passed over, since it does not carry the tag that is asked for.
  FeatureCount untagged;
  /// What was handed over without the tag, for nothing says that it is of OpenStreetMap, though its layer has a column
  /// of that name and other features carry it.
  FeatureCount taken_untagged;
};

/// Hands over the features of the wanted kind one by one, so that a file of a whole country needs no more memory than
/// what is kept of it, and passes over those of other kinds. Throws Error when the file is missing or unreadable, names
/// no CRS, lacks the layer or the coordinate columns asked for, is a table without places, or has features of other
/// kinds alone.
FeatureCensus for_each_feature(const VectorSource& source, const LocalFrame& frame,
                               const std::function<void(Feature&&)>& visit);

}  // namespace sigmascape::geo
