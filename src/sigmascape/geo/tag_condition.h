#pragma once

#include <map>
#include <memory>
#include <ogr_feature.h>
#include <optional>
#include <string>
#include <vector>

namespace sigmascape::geo {

/// A condition in OGR's SQL on a layer's columns and on the tags that one of them packs (`other_tags`), which OGR does
/// not look into. A tag that a feature lacks is NULL, as a column without a value is.
class TagCondition {
 public:
  /// Whatever the condition names that is no column of the layer is a tag, of text.
  TagCondition(const OGRFeatureDefn& columns, const std::string& condition);

  /// Why the condition cannot be asked of such features; nothing when it can.
  [[nodiscard]] const std::optional<std::string>& fault() const { return fault_; }
  /// Those that it names and that are no column of the layer, misspelled ones among them.
  [[nodiscard]] std::vector<std::string> tags() const;
  /// Whether a row of the layer, whose tags are unpacked among its attributes, meets it.
  [[nodiscard]] bool is_met_by(const OGRFeature& row, const std::map<std::string, std::string>& attributes);

 private:
  struct Release {
    void operator()(OGRFeatureDefn* columns) const { columns->Release(); }
  };
  std::unique_ptr<OGRFeatureDefn, Release> columns_;  ///< the layer's, then the tags
  OGRFeatureQuery query_;
  std::optional<std::string> fault_;
  std::vector<int> asked_columns_, asked_tags_;  ///< by number, those of each that the condition names
  bool asks_for_geometry_ = false;
};

}  // namespace sigmascape::geo
