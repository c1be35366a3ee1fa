#include <gtest/gtest.h>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/trace/path_tracer.h"

namespace sigmascape::trace {
namespace {

// As that of classes that a raster lacks: 94 GHz are beyond the constants of grass.
TEST(SurfaceModels, AMaterialThatLiesNowhereAsksForNoFrequency) {
  scene::Scene scene;
  scene.ground = {{-50, 50, 100, 1, 1}, Array2D<scene::MaterialIndex>(1, 1, 1)};
  static_cast<void>(scene.material_index(scatter::library_material("grass")));
  static_cast<void>(scene.material_index(scatter::library_material("metal")));
  EXPECT_EQ(scene::used_materials(scene), (std::vector<bool>{false, true}));
  EXPECT_NO_THROW(static_cast<void>(surface_models(scene, 94e9)));
  scene.ground.material(0, 0) = 0;
  EXPECT_THROW(static_cast<void>(surface_models(scene, 94e9)), Error);
}

// As trees of a template none of which stand in the scene.
TEST(SurfaceModels, NorDoesWhatAPrototypeIsMadeOfThatStandsNowhere) {
  scene::Scene scene;
  const scene::MaterialIndex grass = scene.material_index(scatter::library_material("grass")),
                             metal = scene.material_index(scatter::library_material("metal")),
                             medium = scene.material_index(scatter::library_material("bark"));
  scene.ground = {{-50, 50, 100, 1, 1}, Array2D<scene::MaterialIndex>(1, 1, grass)};
  scene.prototypes.emplace_back().materials = {metal};
  scene.crowns.emplace_back().medium = medium;
  EXPECT_EQ(scene::used_materials(scene), (std::vector<bool>{true, false, false}));
  scene.instances.emplace_back();
  EXPECT_EQ(scene::used_materials(scene), (std::vector<bool>{true, true, true}));
}

}  // namespace
}  // namespace sigmascape::trace
