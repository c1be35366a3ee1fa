#include "sigmascape/bake/paper_baker.h"

#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/base/units.h"
#include "sigmascape/scene/simple_scene.h"

namespace sigmascape::bake {
namespace {

constexpr radar::GroundGrid metre_texels{.west_m = -64, .north_m = 64, .cell_m = 1.0, .columns = 128, .rows = 128};

double mean_of(const Array2D<radar::Channels>& sigma0, const radar::Rectangle& area) {
  double sum = 0.0, count = 0.0;
  for (std::size_t row = 0; row < metre_texels.rows; ++row) {
    for (std::size_t column = 0; column < metre_texels.columns; ++column) {
      if (!area.contains(metre_texels.centre_of(column, row))) continue;
      sum += static_cast<double>(sigma0(column, row).power(radar::Polarization::Sum));
      count += 1.0;
    }
  }
  return sum / count;
}

TEST(PaperBaker, ShadowsAreInTheTexturesAndLayoverBeforeTheObject) {
  // The box stands at x −32 to −8, y −8 to 8, 12 m high, on ground as diffuse as itself. Seen from the south at 31°
  // it hides 20 m of ground to the north and lies over 7.2 m to the south.
  const scene::Scene scene = scene::simple_scene({.ground_material = "grass", .object_material = "grass"});
  BakeSettings settings;
  settings.sampling.samples_per_texel = 16;
  const PaperBaker baker(scene, settings);
  const auto sigma0 = baker.bake(metre_texels, {pi, std::atan2(12.0, 20.0)});
  const double open = mean_of(sigma0, {-30, -50, -10, -30});
  EXPECT_GT(open, 0.0);
  EXPECT_LT(mean_of(sigma0, {-28, 10, -12, 24}), 0.05 * open);
  EXPECT_NEAR(mean_of(sigma0, {-28, 33, -12, 50}) / open, 1.0, 0.1);
  EXPECT_GT(mean_of(sigma0, {-28, -14, -12, -9}), 1.5 * open);
}

}  // namespace
}  // namespace sigmascape::bake
