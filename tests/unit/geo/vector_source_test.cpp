#include "sigmascape/geo/vector_source.h"

#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>
#include <utility>
#include <vector>

#include "scratch_folder.h"
#include "unit/geo/read_features.h"

#include "sigmascape/geo/coordinate_transform.h"
#include "sigmascape/geo/osm_tags.h"
#include "sigmascape/geo/quiet_gdal.h"
#include "sigmascape/geo/spatial_reference.h"

namespace sigmascape::geo {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const LocalFrame frame(45.0, 7.0);

TEST(VectorSource, ReadsPolygonsWithHolesAndAttributes) {
  const ScratchFolder folder;
  const auto file = folder.write("houses.geojson", R"({"type":"FeatureCollection","features":[{"type":"Feature",
    "properties":{"height_m":12.5,"name":"town hall","levels":null},"geometry":{"type":"MultiPolygon","coordinates":[
    [[[7.0,45.0],[7.001,45.0],[7.001,45.001],[7.0,45.001],[7.0,45.0]],[[7.0002,45.0002],[7.0004,45.0002],[7.0004,45.0004],[7.0002,45.0002]]],
    [[[7.002,45.0],[7.003,45.0],[7.003,45.001],[7.002,45.0]]]]}}]})");
  const auto found = read_features({.file = file}, frame);
  ASSERT_EQ(found.size(), 1U);
  const Feature& hall = found[0];
  EXPECT_EQ(hall.attribute("height_m"), "12.5");
  EXPECT_EQ(hall.attribute("name"), "town hall");
  EXPECT_FALSE(hall.attribute("levels").has_value());
  ASSERT_EQ(hall.polygons.size(), 2U);
  EXPECT_EQ(hall.polygons[0].holes.size(), 1U);
  // 0.001° of latitude is 111.1 m, of longitude at 45° 78.8 m.
  EXPECT_NEAR(signed_area_m2(hall.polygons[0].outer), 111.1 * 78.8, 20.0);
  EXPECT_LT(signed_area_m2(hall.polygons[0].holes[0]), 0.0);
}

// A block with floor, roof and a wall, a roof of two triangles, and one triangle alone.
TEST(VectorSource, FacesInSpaceAreWhatTheyCoverOfTheGround) {
  const ScratchFolder folder;
  const auto file = folder.write("faces.csv",
                                 "WKT,h\n"
                                 "\"POLYHEDRALSURFACE Z (((7 45 0,7 45.001 0,7.001 45.001 0,7.001 45 0,7 45 0)),"
                                 "((7 45 9,7.001 45 9,7.001 45.001 9,7 45.001 9,7 45 9)),"
                                 "((7 45 0,7.001 45 0,7.001 45 9,7 45 9,7 45 0)))\",9\n"
                                 "\"TIN Z (((7 45 3,7.001 45 3,7.001 45.001 3,7 45 3)),"
                                 "((7 45 3,7.001 45.001 3,7 45.001 3,7 45 3)))\",8\n"
                                 "\"TRIANGLE ((7 45,7.001 45,7.001 45.001,7 45))\",7\n");
  const auto found = read_features({.file = file, .crs = "EPSG:4326"}, frame);
  ASSERT_EQ(found.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(found[i].polygons.size(), 1U) << i;
    EXPECT_NEAR(area_m2(found[i].polygons), 111.1 * 78.8 * (i == 2 ? 0.5 : 1.0), 20.0) << i;
  }
  EXPECT_EQ(found[1].attribute("h"), "8");
}

TEST(VectorSource, TableOfCoordinatesNeedsACrsAndItsColumns) {
  const ScratchFolder folder;
  const auto file = folder.write("trees.csv", "east,north,height\n7.001,45.0,12\n7.0,45.001,8\n");
  const VectorSource source{
      .file = file, .kind = GeometryKind::Points, .crs = "EPSG:4326", .x_column = "east", .y_column = "north"};
  const auto found = read_features(source, frame);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].points[0].x, 78.85, 0.1);
  EXPECT_NEAR(found[1].points[0].y, 111.13, 0.1);
  EXPECT_EQ(found[1].attribute("height"), "8");

  VectorSource without_crs = source;
  without_crs.crs.clear();
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_features(without_crs, frame)); }),
              HasSubstr("trees.csv: carries no coordinate reference system"));
  VectorSource misnamed = source;
  misnamed.x_column = "x";
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_features(misnamed, frame)); }),
              HasSubstr("has no column 'x'; choose among its columns east, north, height"));
}

TEST(VectorSource, PassesOverOtherKindsOfFeaturesButNotWhenThereIsNothingElse) {
  const ScratchFolder folder;
  const std::string point =
      R"({"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":[7.0,45.0]}})";
  const std::string area =
      R"({"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[7,45],[7.001,45],[7,45.001],[7,45]]]}})";
  const auto collection = [&](const std::string& features) {
    return folder.write("mixed.geojson", R"({"type":"FeatureCollection","features":[)" + features + "]}");
  };
  EXPECT_EQ(read_features({.file = collection(point + "," + area)}, frame).size(), 1U);
  EXPECT_THAT(
      message_of_error([&] { static_cast<void>(read_features({.file = collection(point + "," + point)}, frame)); }),
      HasSubstr("mixed.geojson: none of its 2 features is an area; choose another layer or file"));
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_features({.file = collection(point)}, frame)); }),
              HasSubstr("mixed.geojson: its only feature is not an area; choose another layer or file"));
}

TEST(VectorSource, OpenStreetMapTagsBecomeAttributes) {
  const ScratchFolder folder;
  const auto file = folder.write("town.osm", R"(<osm version="0.6">
    <node id="1" lat="45.0" lon="7.0"/><node id="2" lat="45.0" lon="7.001"/><node id="3" lat="45.001" lon="7.001"/>
    <way id="10"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="1"/><tag k="building" v="yes"/><tag k="height" v="17"/><tag k="building:levels" v="5"/></way>
    <way id="11"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="1"/><tag k="landuse" v="forest"/></way>
    <way id="12"><nd ref="1"/><nd ref="2"/><tag k="highway" v="primary"/><tag k="lanes" v="2"/></way>
    <way id="13"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="1"/><tag k="building" v="no"/></way></osm>)");
  const auto houses = read_features({.file = file, .osm_tag = "building"}, frame);
  ASSERT_EQ(houses.size(), 1U);
  EXPECT_EQ(houses[0].attribute("height"), "17");
  EXPECT_EQ(houses[0].attribute("building:levels"), "5");
  const auto roads = read_features({.file = file, .kind = GeometryKind::Lines, .osm_tag = "highway"}, frame);
  ASSERT_EQ(roads.size(), 1U);
  EXPECT_EQ(roads[0].lines[0].size(), 2U);
  EXPECT_EQ(roads[0].attribute("lanes"), "2");
  EXPECT_TRUE(read_features({.file = file, .osm_tag = "building=church"}, frame).empty());
}

/// Three ways of a town: the second runs under an arcade and the third is a house of five levels.
std::filesystem::path ways(const ScratchFolder& folder) {
  return folder.write("town.osm", R"(<osm version="0.6">
    <node id="1" lat="45.0" lon="7.0"/><node id="2" lat="45.0" lon="7.001"/><node id="3" lat="45.001" lon="7.001"/>
    <way id="10"><nd ref="1"/><nd ref="2"/><tag k="highway" v="primary"/><tag k="lanes" v="2"/></way>
    <way id="11"><nd ref="1"/><nd ref="2"/><tag k="highway" v="service"/><tag k="covered" v="arcade"/></way>
    <way id="12"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="1"/><tag k="building" v="yes"/><tag k="building:levels" v="5"/></way></osm>)");
}

TEST(VectorSource, ConditionSeesTagsOfOpenStreetMapThatHaveNoColumn) {
  const ScratchFolder folder;
  VectorSource source{.file = ways(folder), .kind = GeometryKind::Lines, .osm_tag = "highway"};
  const auto found = [&](const std::string& condition) {
    source.where = condition;
    std::vector<std::string> ids;
    for (const Feature& feature : read_features(source, frame)) ids.push_back(feature.attribute("osm_id").value());
    return ids;
  };
  using Ids = std::vector<std::string>;
  EXPECT_EQ(found("covered IS NULL"), Ids{"10"});
  EXPECT_EQ(found("covered = 'arcade'"), Ids{"11"});
  EXPECT_EQ(found("highway = 'service' AND covered IS NOT NULL"), Ids{"11"});
  EXPECT_EQ(found("highway = 'primary' OR \"covered\" IN ('yes', 'it''s so', 'arcade')"), (Ids{"10", "11"}));
  EXPECT_EQ(found("CAST(lanes AS integer) >= 2 AND NOT FID = 11"), Ids{"10"});
  EXPECT_EQ(found("lanes LIKE '2' AND OGR_GEOMETRY = 'LINESTRING'"), Ids{"10"});
  EXPECT_EQ(found("other_tags IS NOT NULL AND lanes IS NULL"), Ids{"11"});
  EXPECT_EQ(found("highway = 'primary'"), Ids{"10"});
  EXPECT_EQ(found("surface = 'paved'"), Ids{});
  source.kind = GeometryKind::Areas;
  source.osm_tag = "building";
  source.where = "CAST(\"building:levels\" AS float) > 4.5";
  EXPECT_EQ(read_features(source, frame).size(), 1U);
  source.where = "CAST(\"building:levels\" AS float) > 5.5";
  EXPECT_TRUE(read_features(source, frame).empty());
}

TEST(VectorSource, TagsOfAConditionThatNoFeatureCarriesAreNamed) {
  const ScratchFolder folder;
  VectorSource source{.file = ways(folder), .kind = GeometryKind::Lines, .osm_tag = "highway"};
  const auto unknown = [&](const std::string& condition) {
    source.where = condition;
    return for_each_feature(source, frame, [](const Feature&) {}).unknown_tags;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(unknown("highway = \"primary\""), Names{"primary"});
  EXPECT_EQ(unknown("highway = 'primary' OR highwy IS NULL"), Names{"highwy"});
  EXPECT_EQ(unknown("surface = 'paved' OR location IS NULL OR highwy = lanes"),
            (Names{"highwy", "location", "surface"}));
  EXPECT_EQ(unknown("\"building:levels\" IS NULL"), Names{"building:levels"}) << "houses are not asked";
  EXPECT_EQ(unknown("covered = 'yes' OR CAST(lanes AS integer) > 4"), Names{}) << "carried, if not so";
  EXPECT_EQ(unknown("Highway IS NOT NULL OR z_order IS NULL OR barrier IS NULL"), Names{}) << "columns";
  EXPECT_EQ(unknown(""), Names{});
  source.osm_tag = "waterway";
  EXPECT_EQ(unknown("highwy IS NULL"), Names{}) << "nothing was asked";
}

TEST(VectorSource, ConditionOnTagsMustBeOneOfOgr) {
  const ScratchFolder folder;
  VectorSource source{.file = ways(folder), .kind = GeometryKind::Lines, .where = "lanes > 1"};
  const auto fault = [&] { return message_of_error([&] { static_cast<void>(read_features(source, frame)); }); };
  EXPECT_THAT(fault(), AllOf(HasSubstr("town.osm: the condition 'lanes > 1' does not fit its attributes"),
                             HasSubstr("Type mismatch"), Not(HasSubstr("not recognised"))));
  source.where = "covered = = 'yes'";
  EXPECT_THAT(fault(), HasSubstr("syntax error"));
}

TEST(VectorSource, FilesConvertedFromOpenStreetMapHaveItsTagsToo) {
  const ScratchFolder folder;
  const std::string at = R"("geometry":{"type":"Point","coordinates":[7.0,45.0]}})";
  const auto file =
      folder.write("trees.geojson", R"({"type":"FeatureCollection","features":[
    {"type":"Feature","properties":{"name":"a","other_tags":"\"height\"=>\"12\",\"name\"=>\"b\""},)" +
                                        at + R"(,{"type":"Feature","properties":{"other_tags":"none"},)" + at +
                                        R"(,{"type":"Feature","properties":{"name":"c"},"geometry":
    {"type":"LineString","coordinates":[[7.0,45.0],[7.1,45.0]]}}]})");
  VectorSource source{.file = file, .kind = GeometryKind::Points};
  const auto all = read_features(source, frame);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].attribute("height"), "12");
  EXPECT_EQ(all[0].attribute("name"), "a") << "its own column";
  EXPECT_EQ(all[1].attribute("other_tags"), "none") << "no tags";
  source.where = "CAST(height AS float) > 10";
  EXPECT_EQ(read_features(source, frame).size(), 1U);
  source.where = "CAST(height AS float) > 20";
  EXPECT_TRUE(read_features(source, frame).empty()) << "which is no lack of points";
}

/// What a converter makes of an extract: a house, a lawn, a house that is none and another whose tags are packed.
std::filesystem::path converted_town(const ScratchFolder& folder, const char* driver, const std::string& name) {
  const auto file = folder.path(name);
  GDALDatasetUniquePtr data(gdal_driver(driver).Create(file.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  const OGRSpatialReference globe = reference_from("EPSG:4326", name);
  OGRLayer& layer = *data->CreateLayer("multipolygons", const_cast<OGRSpatialReference*>(&globe), wkbPolygon);
  const std::vector<std::string> columns{"osm_way_id", "building", "landuse", "other_tags"};
  for (const std::string& column : columns) {
    OGRFieldDefn text(column.c_str(), OFTString);
    EXPECT_EQ(layer.CreateField(&text), OGRERR_NONE);
  }
  const std::vector<std::vector<const char*>> rows{{"10", "yes", nullptr, R"("height"=>"17")"},
                                                   {"11", nullptr, "grass", nullptr},
                                                   {"12", "no", nullptr, nullptr},
                                                   {"13", nullptr, nullptr, R"("building"=>"house")"}};
  for (const auto& row : rows) {
    const OGRFeatureUniquePtr feature(OGRFeature::CreateFeature(layer.GetLayerDefn()));
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (row[i] != nullptr) feature->SetField(columns[i].c_str(), row[i]);
    }
    OGRGeometry* area = nullptr;
    EXPECT_EQ(OGRGeometryFactory::createFromWkt("POLYGON ((7 45,7.001 45,7.001 45.001,7 45))", nullptr, &area),
              OGRERR_NONE);
    feature->SetGeometryDirectly(area);
    EXPECT_EQ(layer.CreateFeature(feature.get()), OGRERR_NONE);
  }
  return file;
}

TEST(VectorSource, OfFilesConvertedFromOpenStreetMapOnlyWhatCarriesTheTagIsTaken) {
  const ScratchFolder folder;
  for (const auto& [driver, name] : {std::pair{"GPKG", "town.gpkg"}, std::pair{"GeoJSON", "town.geojson"}}) {
    const VectorSource source{.file = converted_town(folder, driver, name), .osm_tag = "building"};
    std::vector<std::string> ways;
    const auto census = for_each_feature(
        source, frame, [&](const Feature& feature) { ways.push_back(feature.attribute("osm_way_id").value_or("")); });
    EXPECT_EQ(ways, (std::vector<std::string>{"10", "13"})) << driver;
    EXPECT_EQ(census.untagged.count, 2U) << driver;
    EXPECT_EQ(census.taken_untagged.count, 0U) << driver;
    EXPECT_EQ(read_features({.file = source.file}, frame).size(), 4U) << driver << ", no tag is asked for";
  }
}

/// Points with these properties, all at one place.
std::filesystem::path points(const ScratchFolder& folder, const std::vector<std::string>& properties) {
  std::string features;
  for (const std::string& of_one : properties) {
    features += (features.empty() ? "" : ",") + (R"({"type":"Feature","properties":{)" + of_one) +
                R"(},"geometry":{"type":"Point","coordinates":[7.0,45.0]}})";
  }
  return folder.write("points.geojson", R"({"type":"FeatureCollection","features":[)" + features + "]}");
}

TEST(VectorSource, OpenStreetMapIsKnownByTheNamesOfItsFeaturesToo) {
  const ScratchFolder folder;
  const auto taken = [&](const std::vector<std::string>& properties) {
    return read_features({.file = points(folder, properties), .kind = GeometryKind::Points, .osm_tag = "natural=tree"},
                         frame)
        .size();
  };
  // As OGR writes them, Overpass, QuickOSM, OSMnx and osmtogeojson.
  for (const std::string id :
       {R"("osm_id":"1")", R"("@id":"node/1")", R"("full_id":"n1")", R"("osmid":1)", R"("id":"node/1")"}) {
    EXPECT_EQ(taken({id + R"(,"natural":"tree")", id + R"(,"amenity":"cafe")", id + R"(,"natural":"peak")"}), 1U) << id;
  }
  EXPECT_EQ(taken({R"("osm_id":"1","fclass":"tree")", R"("osm_id":"2","fclass":"tree")"}), 2U) << "Geofabrik's tables";
  EXPECT_EQ(taken({R"("other_tags":"\"natural\"=>\"tree\"")", R"("other_tags":"\"amenity\"=>\"cafe\"")"}), 1U);
}

// A column of other data may be called as a tag is and be empty, wholly or in part, or mean something else.
TEST(VectorSource, ColumnsOfOtherDataAreNoTags) {
  const ScratchFolder folder;
  const auto census_of = [&](const std::vector<std::string>& properties) {
    return for_each_feature({.file = points(folder, properties), .kind = GeometryKind::Points, .osm_tag = "building"},
                            frame, [](const Feature&) {});
  };
  const auto empty = census_of({R"("building":null,"id":1)", R"("building":null,"id":2)"});
  EXPECT_EQ(empty.features, 2U);
  EXPECT_EQ(empty.taken_untagged.count, 0U) << "says nothing";
  const auto partly = census_of({R"("building":"church")", R"("building":null)", R"("building":"no")"});
  EXPECT_EQ(partly.features, 3U);
  EXPECT_EQ(partly.untagged.count, 0U);
  EXPECT_EQ(partly.taken_untagged.count, 2U);
  EXPECT_EQ(partly.taken_untagged.first, "layer points, feature 1");
  EXPECT_EQ(census_of({R"("h":3)", R"("h":4)"}).taken_untagged.count, 0U);
}

TEST(VectorSource, ConditionChoosesFeaturesAndMustFit) {
  const ScratchFolder folder;
  const auto file = folder.write("t.csv", "x,y,height\n7,45,12\n7,45,-8\n");
  VectorSource source{.file = file,
                      .kind = GeometryKind::Points,
                      .where = "CAST(height AS float) > 0",
                      .crs = "EPSG:4326",
                      .x_column = "x",
                      .y_column = "y"};
  EXPECT_EQ(read_features(source, frame).size(), 1U);
  source.where = "hight > 0";
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_features(source, frame)); }),
              HasSubstr("the condition 'hight > 0'"));
  source.where = "height = = 3";
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_features(source, frame)); }),
              AllOf(HasSubstr("(SQL Expression Parsing Error: syntax error, unexpected '=')"), Not(HasSubstr("\n"))));
}

/// Two houses in one layer, 12 and 4 m high, and three parcels in another that know no heights.
std::filesystem::path town(const ScratchFolder& folder, const char* driver, const std::string& name) {
  const auto file = folder.path(name);
  GDALDatasetUniquePtr data(gdal_driver(driver).Create(file.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  const OGRSpatialReference globe = reference_from("EPSG:4326", name);
  const auto add = [&](const char* layer_name, std::size_t count, std::vector<double> heights) {
    OGRLayer& layer = *data->CreateLayer(layer_name, const_cast<OGRSpatialReference*>(&globe), wkbPoint);
    OGRFieldDefn height("height_m", OFTReal);
    if (!heights.empty()) {
      EXPECT_EQ(layer.CreateField(&height), OGRERR_NONE);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const OGRFeatureUniquePtr feature(OGRFeature::CreateFeature(layer.GetLayerDefn()));
      OGRPoint place(7.0, 45.0);
      EXPECT_EQ(feature->SetGeometry(&place), OGRERR_NONE);
      if (!heights.empty()) feature->SetField("height_m", heights[i]);
      EXPECT_EQ(layer.CreateFeature(feature.get()), OGRERR_NONE);
    }
  };
  add("parcels", 3, {});
  add("houses", 2, {12.0, 4.0});
  return file;
}

TEST(VectorSource, ConditionIsOfTheLayersThatHaveItsAttributes) {
  const ScratchFolder folder;
  for (const auto& [driver, name] : {std::pair{"GPKG", "town.gpkg"}, std::pair{"ESRI Shapefile", "town"}}) {
    VectorSource source{
        .file = town(folder, driver, name), .kind = GeometryKind::Points, .layer = "houses", .where = "height_m > 5"};
    EXPECT_EQ(read_features(source, frame).size(), 1U) << driver;
    source.layer = "";
    EXPECT_EQ(read_features(source, frame).size(), 1U) << driver;
    source.where = "\"height_m\" > 5";
    EXPECT_EQ(read_features(source, frame).size(), 1U) << driver;
    source.where = "height_m > 5";
    source.layer = "parcels";
    EXPECT_THAT(message_of_error([&] { static_cast<void>(read_features(source, frame)); }),
                HasSubstr("the condition 'height_m > 5' does not fit its attributes"))
        << driver;
    source.where = "";
    EXPECT_EQ(read_features(source, frame).size(), 3U) << driver;
  }
}

// QGIS keeps the styles of a GeoPackage in such a table.
TEST(VectorSource, TablesWithoutPlacesAreNotAskedForAny) {
  const ScratchFolder folder;
  const auto file = town(folder, "GPKG", "town.gpkg");
  {
    const GDALDatasetUniquePtr data(GDALDataset::Open(file.c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE));
    OGRLayer& styles = *data->CreateLayer("layer_styles", nullptr, wkbNone);
    for (int i = 0; i < 9; ++i) {
      const OGRFeatureUniquePtr row(OGRFeature::CreateFeature(styles.GetLayerDefn()));
      ASSERT_EQ(styles.CreateFeature(row.get()), OGRERR_NONE);
    }
  }
  VectorSource source{.file = file, .kind = GeometryKind::Points};
  const auto census = for_each_feature(source, frame, [](const Feature&) {});
  EXPECT_EQ(census.features, 5U);
  EXPECT_EQ(census.nowhere, 0U);
  source.layer = "layer_styles";
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_features(source, frame)); }),
              HasSubstr("town.gpkg: is a table without places"));
}

TEST(VectorSource, TablesNeedTheNamesOfTheirColumnsOfCoordinates) {
  const ScratchFolder folder;
  const auto file = folder.write("trees.csv", "lon,lat\n7,45\n");
  EXPECT_THAT(
      message_of_error([&] { static_cast<void>(read_features({.file = file, .kind = GeometryKind::Points}, frame)); }),
      HasSubstr("trees.csv: is a table without places; name its columns of coordinates with the keys x and y"));
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_features({.file = file}, frame)); }),
              HasSubstr("give data that hold lines or areas"));
}

TEST(VectorSource, CoordinatesThatAreNoNumbersAreCountedWithoutAWordOfGdals) {
  const ScratchFolder folder;
  const auto file = folder.write("t.csv", "x,y\n7,45\nabc,45\n");
  testing::internal::CaptureStderr();
  const auto census = for_each_feature(
      {.file = file, .kind = GeometryKind::Points, .crs = "EPSG:4326", .x_column = "x", .y_column = "y"}, frame,
      [](const Feature&) {});
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(census.features, 1U);
  EXPECT_EQ(census.nowhere, 1U);
}

TEST(VectorSource, FeaturesNowhereAreCounted) {
  const ScratchFolder folder;
  const auto file = folder.write("f.geojson", R"({"type":"FeatureCollection","features":[
    {"type":"Feature","properties":{},"geometry":null},
    {"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":[7.0,45.0]}}]})");
  std::vector<std::string> seen;
  const auto census = for_each_feature({.file = file, .kind = GeometryKind::Points}, frame,
                                       [&](const Feature& feature) { seen.push_back(feature.id); });
  EXPECT_EQ(seen, (std::vector<std::string>{"layer f, feature 1"}));
  EXPECT_EQ(census.nowhere, 1U);
  EXPECT_EQ(census.first_nowhere, "layer f, feature 0");
}

TEST(VectorSource, MissingFileAndLayerAreErrors) {
  const ScratchFolder folder;
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_features({.file = folder.path("none.shp")}, frame)); }),
              HasSubstr("none.shp: the file does not exist"));
  const auto file = folder.write("t.csv", "x,y\n7,45\n");
  EXPECT_THAT(message_of_error([&] { static_cast<void>(read_features({.file = file, .layer = "roads"}, frame)); }),
              HasSubstr("has no layer 'roads'; choose among its layers t"));
}

TEST(OsmTags, QuotesAndCommasInsideValuesSurvive) {
  const auto tags = unpacked_tags(R"("height"=>"12","name"=>"a \"b\", c=>d","x"=>"\\")");
  ASSERT_EQ(tags.size(), 3U);
  EXPECT_EQ(tags.at("name"), "a \"b\", c=>d");
  EXPECT_EQ(tags.at("x"), "\\");
}

TEST(OsmTags, DamagedTextKeepsWhatCameBefore) {
  EXPECT_EQ(unpacked_tags(R"("a"=>"1","b"=)").size(), 1U);
  EXPECT_TRUE(unpacked_tags("nothing").empty());
}

}  // namespace
}  // namespace sigmascape::geo
