#include "sigmascape/geo/tag_condition.h"

#include <cctype>
#include <cpl_string.h>
#include <string_view>

#include "sigmascape/geo/quiet_gdal.h"

namespace sigmascape::geo {
namespace {

/// All that may be the name of a column in a condition: words, and what stands in double quotes. The language's own
/// words are among them, which as names of columns do no harm.
std::vector<std::string> names_in(std::string_view condition) {
  std::vector<std::string> names;
  const auto is_of_word = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || static_cast<unsigned char>(c) > 127;
  };
  for (std::size_t i = 0; i < condition.size();) {
    const std::size_t begin = i++;
    const char first = condition[begin];
    if (first == '"' || first == '\'') {
      while (i < condition.size() && condition[i] != first) i += condition[i] == '\\' ? 2 : 1;
      if (first == '"' && i < condition.size()) names.emplace_back(condition.substr(begin + 1, i - begin - 1));
      ++i;
    } else if (is_of_word(first)) {
      while (i < condition.size() && is_of_word(condition[i])) ++i;
      names.emplace_back(condition.substr(begin, i - begin));
    }
  }
  return names;
}

/// What OGR's SQL tells of a feature beside its columns: its number, geometry and style.
bool is_special(const std::string& name) {
  return EQUAL(name.c_str(), "FID") || STARTS_WITH_CI(name.c_str(), "OGR_");
}

}  // namespace

TagCondition::TagCondition(const OGRFeatureDefn& columns, const std::string& condition) : columns_(columns.Clone()) {
  columns_->Reference();
  const int own = columns.GetFieldCount();
  for (const std::string& name : names_in(condition)) {
    const bool is_there = columns_->GetFieldIndex(name.c_str()) >= 0 || columns_->GetGeomFieldIndex(name.c_str()) >= 0;
    if (is_there || is_special(name)) continue;
    const OGRFieldDefn tag(name.c_str(), OFTString);
    columns_->AddFieldDefn(&tag);
  }
  const QuietGdal quiet;
  if (query_.Compile(columns_.get(), condition.c_str()) != OGRERR_NONE) {
    fault_ = QuietGdal::complaint();
    return;
  }
  const CPLStringList asked(query_.GetUsedFields());
  for (int i = 0; i < asked.size(); ++i) {
    const int number = columns_->GetFieldIndex(asked[i]);
    if (number >= 0) (number < own ? asked_columns_ : asked_tags_).push_back(number);
    if (number < 0 && !EQUAL(asked[i], "FID")) asks_for_geometry_ = true;
  }
}

std::vector<std::string> TagCondition::tags() const {
  std::vector<std::string> names;
  for (const int tag : asked_tags_) names.emplace_back(columns_->GetFieldDefn(tag)->GetNameRef());
  return names;
}

bool TagCondition::is_met_by(const OGRFeature& row, const std::map<std::string, std::string>& attributes) {
  OGRFeature asked(columns_.get());
  asked.SetFID(row.GetFID());
  if (asks_for_geometry_) asked.SetGeometry(row.GetGeometryRef());
  for (const int column : asked_columns_) {
    if (row.IsFieldSetAndNotNull(column)) asked.SetField(column, row.GetRawFieldRef(column));
  }
  for (const int tag : asked_tags_) {
    const auto found = attributes.find(columns_->GetFieldDefn(tag)->GetNameRef());
    if (found != attributes.end()) asked.SetField(tag, found->second.c_str());
  }
  const QuietGdal quiet;
  return query_.Evaluate(&asked) != FALSE;
}

}  // namespace sigmascape::geo
