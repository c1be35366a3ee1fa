#include "sigmascape/scene/crown.h"

#include <cmath>
#include <gtest/gtest.h>

#include "made_up_place.h"

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scatter/crown_medium.h"

namespace sigmascape::scene {
namespace {

const std::string trees =
    "[[trees]]\nfile = \"trees.csv\"\ncrs = \"EPSG:25830\"\nx = \"x\"\ny = \"y\"\nheight_attribute = \"h\"\nvariants = "
    "2\n";

Scene read(const std::string& more) {
  const MadeUpPlace place;
  place.write("trees.csv", "x,y,h\n501200,4795500,10\n501210,4795500,12\n");
  return place.read(trees + more);
}

const scatter::CrownParameters& medium_of(const Scene& scene, const Crown& crown) {
  return std::get<scatter::CrownParameters>(scene.materials[crown.medium].model);
}

TEST(Crown, OfTreesStandsAboutTheirBranches) {
  const Scene leaves = read(""), media = read("kind = \"crowns\"\n");
  EXPECT_TRUE(leaves.crowns.empty());
  ASSERT_EQ(media.crowns.size(), 2U);
  EXPECT_EQ(media.prototypes.size(), leaves.prototypes.size());
  EXPECT_LT(media.prototypes[0].vertices.size(), leaves.prototypes[0].vertices.size());
  EXPECT_NEAR(tallest_object_m(media), 12.0, 1e-4);
  EXPECT_NE(scene_hash(leaves), scene_hash(media));
}

TEST(Crown, FollowsFromTheLeaves) {
  const Scene scene = read("kind = \"crowns\"\n");
  const Mesh tree = tree_mesh(TreeForm::Broadleaf, {.bark = 0, .leaf = 1}, 1);
  const Ellipsoid crown = crown_ellipsoid(TreeForm::Broadleaf);
  const auto& medium = medium_of(scene, scene.crowns[0]);
  EXPECT_DOUBLE_EQ(medium.extinction_per_m, effective_extinction_per_m(tree, 1, crown));
  EXPECT_TRUE(scene.crowns[0].grows_with_tree);
  // Its leaves crowd in places, so that more passes than if they did not.
  const double even = even_extinction_per_m(surface_area_m2(tree, 1), volume_m3(crown));
  EXPECT_LT(medium.extinction_per_m, even);
  EXPECT_GT(medium.extinction_per_m, 0.5 * even);
  // Leaves scatter what a mirror of their permittivity reflects in the mean.
  const auto& leaf = std::get<scatter::CookTorranceParameters>(scatter::library_material("leaf").model);
  EXPECT_EQ(medium.leaf, leaf.permittivity);
}

TEST(Crown, IsAsTheSceneFileStates) {
  const std::string own =
      "kind = \"crowns\"\ncrown_material = \"mist\"\n[materials.mist]\nmodel = \"crown\"\nextinction_db_per_m = 2\n"
      "albedo = 0.3\nshares_gaps = false\ncross_ratio_db = -10\n";
  const Scene scene = read(own);
  const auto& medium = medium_of(scene, scene.crowns[0]);
  EXPECT_NEAR(std::exp(-medium.extinction_per_m * 5.0), std::pow(10.0, -1.0), 1e-9) << "10 dB in five metres";
  EXPECT_FALSE(scene.crowns[0].grows_with_tree);
  EXPECT_EQ(medium.albedo, 0.3);
  EXPECT_FALSE(medium.shares_gaps);
  EXPECT_NEAR(medium.depolarization.cross_ratio, 0.1, 1e-12);
  std::string denser = own;
  denser.replace(denser.find("per_m = 2"), 9, "per_m = 3");
  EXPECT_NE(scene_hash(read(denser)), scene_hash(scene));
}

TEST(Crown, IsNoSurfaceAndSurfacesAreNoCrowns) {
  EXPECT_THROW(read("bark_material = \"mist\"\n[materials.mist]\nmodel = \"crown\"\n"), Error);
  EXPECT_THROW(read("kind = \"crowns\"\ncrown_material = \"leaf\"\n"), Error);
  EXPECT_THROW(read("kind = \"balloons\"\n"), Error);
  EXPECT_THROW(read("crown_material = \"leaf\"\n"), Error) << "of trees with leaves";
}

TEST(Crown, MaterialNeedsAnAlbedo) {
  EXPECT_THROW(static_cast<void>(crown_material(scatter::library_material("grass"), 0.25)), Error);
  const scatter::Material lambert{.name = "l", .model = scatter::LambertParameters{0.4, {}}, .source = {}};
  const auto crown =
      std::get<scatter::CrownParameters>(crown_material(lambert, even_extinction_per_m(50.0, 100.0)).model);
  EXPECT_DOUBLE_EQ(crown.extinction_per_m, 0.25);
  EXPECT_DOUBLE_EQ(crown.albedo, 0.4);
}

TEST(Crown, OfABroadleafHoldsItsTree) {
  const Ellipsoid crown = crown_ellipsoid(TreeForm::Broadleaf);
  EXPECT_FLOAT_EQ(crown.centre.z + crown.radii_m.z, tree_height_m);
  EXPECT_FLOAT_EQ(crown.radii_m.x, tree_crown_radius_m);
}

TEST(Crown, OfAConiferLiesAsItsLeavesDo) {
  const Ellipsoid crown = crown_ellipsoid(TreeForm::Conifer);
  const Mesh tree = tree_mesh(TreeForm::Conifer, {.bark = 0, .leaf = 1}, 1);
  double count = 0.0, height = 0.0, from_axis2 = 0.0;
  for (std::size_t i = 0; i < tree.triangles.size(); ++i) {
    if (tree.materials[i] != 1) continue;
    for (const auto vertex : tree.triangles[i]) {
      const Vec3d leaf = tree.vertices[vertex].to<double>();
      count += 1.0;
      height += leaf.z;
      from_axis2 += leaf.x * leaf.x + leaf.y * leaf.y;
    }
  }
  // The mesh is stretched to its nominal height and radius afterwards, and its leaves are squares with corners.
  EXPECT_NEAR(height / count / static_cast<double>(crown.centre.z), 1.0, 0.05);
  const double across = static_cast<double>(crown.radii_m.x);
  EXPECT_NEAR(from_axis2 / count / (2.0 / 5.0 * across * across), 1.0, 0.15);
}

}  // namespace
}  // namespace sigmascape::scene
