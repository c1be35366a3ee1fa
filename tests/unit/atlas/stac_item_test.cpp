#include "sigmascape/atlas/stac_item.h"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

#include "example_texels.h"
#include "scratch_folder.h"

#include "sigmascape/atlas/stac_document.h"
#include "sigmascape/atlas/terrain_file.h"
#include "sigmascape/atlas/texture_file.h"
#include "sigmascape/geo/geo_raster.h"

namespace sigmascape::atlas {
namespace {

constexpr const char* own_hash = "sigmascape:item_sha256";
/// 70 by 50 cells of 30 m that begin 1500 m west and 1200 m north of the frame's origin, over and beyond two patches.
constexpr radar::GroundGrid heights{-1500.0, 1200.0, 30.0, 70, 50};

const Json shape_of_heights = {50, 70};
const Json transform_of_heights = {30.0, 0.0, -1500.0, 0.0, -30.0, 1200.0};

TextureRecord record() {
  return {.size_bytes = 1234, .sha256 = std::string(64, 'a')};
}

// Metres a degree on the ellipsoid of WGS 84: π/180 M along the meridian and π/180 N cos φ across it, with
// M = a (1 − e²) / w³, N = a / w and w² = 1 − e² sin² φ. Within 2 km the frame is true to 1e-7, and its grid is turned
// against the meridians by no more than 0.02° · sin φ, 0.4 m.
TEST(TerrainItem, CoversTheHeightsAndNotThePatches) {
  const AtlasDescription description = example_description();
  const Json item = Json::parse(terrain_item_text(description, heights, record()));
  const double a = 6378137.0, e2 = 0.00669437999014, latitude = radians_from_deg(43.26);
  const double w = std::sqrt(1.0 - e2 * std::pow(std::sin(latitude), 2));
  const double metres_north = radians_from_deg(a * (1.0 - e2) / (w * w * w));
  const double metres_east = radians_from_deg(a / w * std::cos(latitude));
  const auto box = item.at("bbox").get<std::vector<double>>();
  ASSERT_EQ(box.size(), 4U);
  EXPECT_NEAR((box[0] + 2.93) * metres_east, -1500.0, 1.0);
  EXPECT_NEAR((box[1] - 43.26) * metres_north, 1200.0 - 50 * 30.0, 1.0);
  EXPECT_NEAR((box[2] + 2.93) * metres_east, -1500.0 + 70 * 30.0, 1.0);
  EXPECT_NEAR((box[3] - 43.26) * metres_north, 1200.0, 1.0);
  const Json& properties = item.at("properties");
  EXPECT_EQ(properties.at("proj:shape"), shape_of_heights);
  EXPECT_EQ(properties.at("proj:transform"), transform_of_heights);
  EXPECT_TRUE(item_from(item.dump(2) + "\n", description, terrain_name).record);
}

TEST(TerrainItem, TellsOfTheFileThatItStandsBeside) {
  const ScratchFolder folder;
  const Store atlas = Store::create(folder.path("atlas"), example_description());
  geo::write_geotiff(atlas.folder() / terrain_name,
                     {.placement = {heights.west_m, heights.north_m, heights.cell_m, atlas.description().frame.proj()},
                      .bands = {{"HEIGHT_M", Array2D<float>(heights.columns, heights.rows)}},
                      .nodata = {},
                      .metadata = {}});
  vouch_for_terrain(atlas);
  std::ifstream stream(atlas.folder() / "terrain.json");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const Json properties = Json::parse(text).at("properties");
  EXPECT_EQ(properties.at("proj:shape"), shape_of_heights);
  EXPECT_EQ(properties.at("proj:transform"), transform_of_heights);
  EXPECT_FALSE(terrain_fault(atlas, Scrutiny::Content));
}

// Of atlases that were baked before items told of the cells.
TEST(TerrainItem, VouchesWithoutItsCellsToo) {
  const AtlasDescription description = example_description();
  Json item = Json::parse(terrain_item_text(description, heights, record()));
  Json& properties = item.at("properties");
  properties.erase("proj:shape");
  properties.erase("proj:transform");
  properties[own_hash] = "";
  const FoundItem found = item_from(sealed(written(item, 2) + "\n", own_hash), description, terrain_name);
  ASSERT_TRUE(found.record) << found.fault;
  EXPECT_EQ(found.record->size_bytes, 1234U);
}

}  // namespace
}  // namespace sigmascape::atlas
