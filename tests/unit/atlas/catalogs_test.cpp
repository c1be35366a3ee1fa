#include "sigmascape/atlas/catalogs.h"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "example_obstacles.h"
#include "example_texels.h"
#include "scratch_folder.h"

#include "sigmascape/atlas/ground_layers.h"
#include "sigmascape/atlas/levels_above.h"
#include "sigmascape/atlas/obstacle_file.h"
#include "sigmascape/atlas/pyramid.h"
#include "sigmascape/atlas/stac_catalog.h"
#include "sigmascape/atlas/terrain_file.h"
#include "sigmascape/atlas/verify.h"
#include "sigmascape/base/units.h"
#include "sigmascape/geo/geo_raster.h"

namespace sigmascape::atlas {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json parsed(const fs::path& file) {
  std::ifstream stream(file);
  return json::parse(stream);
}

std::vector<std::string> links(const json& document, const std::string& relation) {
  std::vector<std::string> targets;
  for (const json& link : document.at("links")) {
    if (link.at("rel") == relation) targets.push_back(link.at("href"));
  }
  return targets;
}

std::vector<std::string> links(const std::string& text, const std::string& relation) {
  return links(json::parse(text), relation);
}

/// Goes through a store as a browser does, from its collection on, and counts how often it comes to each document that
/// is there. Whoever is come to must name the document he is come from as parent, and the collection as root.
class Browsed {
 public:
  explicit Browsed(const fs::path& folder) : folder_(fs::canonical(folder)) { visit(folder_ / collection_name); }
  [[nodiscard]] const std::map<std::string, int>& visits() const { return visits_; }

 private:
  void visit(const fs::path& file) {
    ++visits_[fs::relative(file, folder_).string()];
    const json document = parsed(file);
    EXPECT_EQ(target_of(document, "root", file), folder_ / collection_name) << file;
    for (const char* relation : {"child", "item"}) {
      for (const std::string& target : links(document, relation)) {
        const fs::path next = (file.parent_path() / target).lexically_normal();
        if (!fs::exists(next)) continue;
        EXPECT_EQ(target_of(parsed(next), "parent", next), file) << next;
        visit(next);
      }
    }
  }

  static fs::path target_of(const json& document, const char* relation, const fs::path& file) {
    const auto targets = links(document, relation);
    EXPECT_EQ(targets.size(), 1U) << file << " " << relation;
    return targets.empty() ? fs::path() : (file.parent_path() / targets.front()).lexically_normal();
  }

  fs::path folder_;
  std::map<std::string, int> visits_;
};

/// Every JSON document of a store once, those of its ground among them.
std::map<std::string, int> documents_of(const fs::path& folder) {
  std::map<std::string, int> documents;
  for (const auto& [name, content] : files_of(folder)) {
    if (name.ends_with(".json")) documents[name] = 1;
  }
  return documents;
}

/// Five by two patches on both sides of the origin, two levels above them, ground apart.
class Catalogs : public ::testing::Test {
 protected:
  void bake(PatchIndex patch) const {
    store_.write(patch, 0, example_texels(512, 1), {});
    write_obstacles(store_, patch, example_obstacles(store_, patch));
  }
  void bake_all() const {
    for (const PatchIndex& patch : patches_) bake(patch);
    make_levels_above(store_);
  }
  [[nodiscard]] std::vector<std::string> faulty() const {
    std::vector<std::string> files;
    for (const StoreFault& fault : catalog_faults(store_, Scrutiny::Content)) files.push_back(fault.file.string());
    return files;
  }

  ScratchFolder folder_;
  Store store_ = Store::create(folder_.path("a"), wide_ground_apart());
  std::vector<PatchIndex> patches_ = store_.description().patches.covering(store_.description().extent);
};

TEST_F(Catalogs, LeadFromTheCollectionToEachItemOnce) {
  bake_all();
  const auto documents = documents_of(store_.folder());
  // Items of looks and obstacles and a catalog at ten patches and ten places above, and the collection.
  EXPECT_EQ(documents.size(), 3U * (10U + 10U) + 1U);
  EXPECT_EQ(Browsed(store_.folder()).visits(), documents);
}

TEST(CatalogsOfGround, AreReachedFromTheAtlasAsItsTerrainIs) {
  const ScratchFolder folder;
  const Store atlas = Store::create(folder.path("a"), small_ground_apart());
  const Store ground = create_ground_store(atlas, {radians_from_deg(13.0)});
  for (const Store& store : {atlas, ground}) {
    for (const Unit& unit : store.units()) store.write(unit.patch, unit.look, example_texels(256, 1), {});
  }
  write_all_obstacles(atlas);
  make_levels_above(atlas);
  const geo::RasterPlacement placement{0.0, 512.0, 8.0, atlas.description().frame.proj()};
  geo::write_geotiff(
      atlas.folder() / terrain_name,
      {.placement = placement, .bands = {{"height_m", Array2D<float>(64, 64, 5.0F)}}, .nodata = {}, .metadata = {}});
  vouch_for_terrain(atlas);
  const auto documents = documents_of(atlas.folder());
  // At four patches and one place above a catalog and items of look and obstacles, of the ground a catalog and an item;
  // two collections and the terrain's item.
  EXPECT_EQ(documents.size(), 3U * (4U + 1U) + 2U * (4U + 1U) + 2U + 1U);
  EXPECT_EQ(Browsed(atlas.folder()).visits(), documents);
  EXPECT_THAT(verify(atlas), ::testing::IsEmpty());
}

// Collections without links to terrain and ground, and a ground that is a tree of its own.
TEST(CatalogsOfGround, ThoseOfAFormerVersionStayAsTheyAre) {
  const ScratchFolder folder;
  const Store atlas = Store::create(folder.path("a"), small_ground_apart());
  const Store ground = create_ground_store(atlas, {radians_from_deg(13.0)});
  ground.write({0, 0}, 0, example_texels(256, 2), {});
  const fs::path catalog = catalog_path({0, {0, 0}});
  std::ofstream(ground.folder() / catalog, std::ios::binary) << former_catalog_text(ground.description(), {0, {0, 0}});
  EXPECT_EQ(links(parsed(ground.folder() / catalog), "root"), std::vector<std::string>{"../collection.json"});
  for (const Store& store : {atlas, ground}) {
    for (const std::string& former : former_collection_texts(store.description())) {
      std::ofstream(store.folder() / collection_name, std::ios::binary) << former;
      EXPECT_THAT(links(former, "item"), ::testing::IsEmpty());
      EXPECT_THAT(links(former, "root"), ::testing::ElementsAre("./collection.json"));
      EXPECT_THAT(catalog_faults(store, Scrutiny::Content), ::testing::IsEmpty());
      EXPECT_THAT(mend_catalogs(store, Scrutiny::Content), ::testing::IsEmpty());
    }
  }
  EXPECT_FALSE(ground_collection_fault(atlas).has_value());
}

TEST_F(Catalogs, LeadToWhatIsBakedOfAnAtlasHalfDone) {
  EXPECT_EQ(Browsed(store_.folder()).visits().size(), 1U);
  bake({-3, 0});
  const auto documents = documents_of(store_.folder());
  EXPECT_EQ(documents.size(), 2U + 3U + 1U) << "items of one patch, catalogs over it, the collection";
  EXPECT_EQ(Browsed(store_.folder()).visits(), documents);
  EXPECT_THAT(faulty(), ::testing::IsEmpty()) << "of what was not begun no catalog is missed";
}

TEST_F(Catalogs, OfPatchesAreThoseOfThePlan) {
  const std::string text = catalog_text(store_.description(), {0, {-1, 0}});
  EXPECT_THAT(links(text, "root"), ::testing::ElementsAre("../collection.json"));
  EXPECT_THAT(links(text, "parent"), ::testing::ElementsAre("../pyramid_1/patch_-002_+000/catalog.json"));
  EXPECT_THAT(links(text, "item"), ::testing::ElementsAre("./az000.0_el13.0_f10.000GHz.json", "./obstacles.json"));
  EXPECT_THAT(links(text, "child"), ::testing::IsEmpty());
  EXPECT_THAT(links(catalog_text(store_.description(), {1, {-4, -2}}), "child"),
              ::testing::ElementsAre("../../patch_-003_-001/catalog.json"));
  EXPECT_THAT(links(catalog_text(store_.description(), {2, {-4, 0}}), "child"),
              ::testing::ElementsAre("../../pyramid_1/patch_-004_+000/catalog.json",
                                     "../../pyramid_1/patch_-002_+000/catalog.json"));
  AtlasDescription baked = store_.description();
  baked.settings.clear();
  EXPECT_THAT(links(catalog_text(baked, {0, {-1, 0}}), "item"),
              ::testing::ElementsAre("./az000.0_el13.0_f10.000GHz.json"));
}

TEST_F(Catalogs, AreWrittenOnce) {
  bake({0, 0});
  const fs::path catalog = store_.folder() / "pyramid_1/patch_+000_+000/catalog.json";
  std::ofstream(catalog) << "kept";
  bake({1, 0});
  EXPECT_EQ(files_of(store_.folder()).at("pyramid_1/patch_+000_+000/catalog.json"), "kept");
}

TEST_F(Catalogs, DamageIsNamedAndMended) {
  bake_all();
  const auto whole = files_of(store_.folder());
  const fs::path missing = "pyramid_2/patch_-004_+000/catalog.json", altered = "patch_+001_-001/catalog.json";
  fs::remove(store_.folder() / missing);
  std::fstream(store_.folder() / altered, std::ios::in | std::ios::out | std::ios::binary).put('[');
  std::map<std::string, std::string> named;
  for (const StoreFault& fault : verify(store_)) named[fault.file.string()] = fault.what;
  EXPECT_EQ(named.erase("ground/collection.json") + named.erase("terrain.tif"), 2U) << "this example has neither";
  ASSERT_EQ(named.size(), 2U);
  EXPECT_EQ(named[missing.string()], "is missing");
  EXPECT_THAT(named[altered.string()], ::testing::HasSubstr("was altered"));
  EXPECT_EQ(mend_catalogs(store_, Scrutiny::Size).size(), 1U) << "the length of the other is right";
  EXPECT_EQ(mend_catalogs(store_, Scrutiny::Content, [](std::size_t) { return false; }).size(), 0U);
  EXPECT_EQ(mend_catalogs(store_, Scrutiny::Content).size(), 1U);
  EXPECT_EQ(difference_of(files_of(store_.folder()), whole), "");
}

TEST_F(Catalogs, AreNotMendedOverTheCollectionOfAnotherAtlas) {
  bake({0, 0});
  const fs::path collection = store_.folder() / collection_name;
  AtlasDescription other = store_.description();
  other.mantissa_bits = 5;
  const std::string others = collection_text(other);
  std::ofstream(collection, std::ios::binary) << others;
  EXPECT_THAT(message_of_error([&] { mend_catalogs(store_, Scrutiny::Content); }),
              ::testing::HasSubstr("mantissa_bits is 5 there and 10 here"));
  EXPECT_EQ(files_of(store_.folder()).at(collection_name), others);
}

// A collection as it was before there were catalogs.
TEST_F(Catalogs, AnAtlasOfAFormerKindOpensAndIsMended) {
  bake_all();
  const auto whole = files_of(store_.folder());
  json collection = parsed(store_.folder() / collection_name);
  collection.erase(collection_hash);
  collection["links"] = {{{"rel", "item"}, {"href", "./patch_+000_+000/az000.0_el13.0_f10.000GHz.json"}}};
  std::ofstream(store_.folder() / collection_name) << collection.dump(2) << "\n";
  for (const auto& [name, content] : whole) {
    if (name.ends_with(catalog_name)) fs::remove(store_.folder() / name);
  }
  const Store opened = Store::create(store_.folder(), wide_ground_apart());
  EXPECT_TRUE(opened.is_done({0, 0}, 0));
  EXPECT_EQ(faulty().size(), 1U + 10U + 10U);
  EXPECT_EQ(make_levels_above(opened).written.all(), 0U);
  EXPECT_EQ(difference_of(files_of(store_.folder()), whole), "");
}

TEST_F(Catalogs, ACollectionIsAsSmallWhateverTheArea) {
  AtlasDescription description = wide_ground_apart();
  description.aspects.azimuths_rad.clear();
  for (int i = 0; i < 40; ++i) description.aspects.azimuths_rad.push_back(i * radians_from_deg(9.0));
  const auto size_of = [&](double half_side_m) {
    description.extent = {-half_side_m, -half_side_m, half_side_m, half_side_m};
    return collection_text(description).size();
  };
  EXPECT_LT(size_of(256 * 512.0), size_of(512.0) + 100);
  const PyramidTiles places(description.patches, description.extent);
  for (std::size_t level = 0; level <= places.levels(); ++level) {
    EXPECT_LT(catalog_text(description, places.tiles(level).front()).size(), 8000U) << level;
  }
}

}  // namespace
}  // namespace sigmascape::atlas
