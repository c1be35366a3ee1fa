#include "sigmascape/bake/mean_ground.h"

#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/base/units.h"

namespace sigmascape::bake {
namespace {

// Of constant gamma VV and HH are γ sin ψ and HV a tenth of it, so that their sum is 2.2 γ sin ψ.
TEST(MeanGround, IsThatOfEachMaterialByItsPartOfThePatch) {
  scene::Scene scene;
  scene.extent = {0, 0, 512, 512};
  const auto material = [&](const char* name, double gamma) {
    return scene.material_index(
        {.name = name, .model = scatter::ConstantGammaParameters{gamma, {0.1, 0.5}}, .source = {}});
  };
  const scene::MaterialIndex dark = material("dark", 0.01), bright = material("bright", 0.2);
  scene.ground = {{0, 512, 128, 4, 4}, Array2D<scene::MaterialIndex>(4, 4, dark)};
  for (std::size_t row = 0; row < 4; ++row) scene.ground.material(0, row) = bright;
  const atlas::AspectGrid aspects{{0.0, 1.0}, {radians_from_deg(10.0), radians_from_deg(40.0)}, {5e9, 10e9}};
  const atlas::PatchGrid patches{.texel_m = 1.0, .texels_per_side = 256};
  const MeanGround ground(scene, aspects, patches);
  for (std::size_t frequency = 0; frequency < 2; ++frequency) {
    for (std::size_t elevation = 0; elevation < 2; ++elevation) {
      const double sine = 2.2 * std::sin(aspects.elevations_rad[elevation]);
      const atlas::LookIndex look = aspects.index_of(1, elevation, frequency);
      EXPECT_NEAR(ground.power_of({0, 0}, look), 0.5 * (0.01 + 0.2) * sine, 1e-6) << "half of it is bright";
      EXPECT_NEAR(ground.power_of({1, 1}, look), 0.01 * sine, 1e-6);
      EXPECT_EQ(ground.power_of({2, 0}, look), 0.0) << "beyond the scene";
    }
  }
}

}  // namespace
}  // namespace sigmascape::bake
