#include "sigmascape/bake/patch_room.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scratch_folder.h"

#include "sigmascape/base/units.h"
#include "sigmascape/scene/obstacle_raster.h"
#include "sigmascape/scene/simple_scene.h"
#include "sigmascape/trace/launch.h"
#include "sigmascape/trace/scene_heights.h"

namespace sigmascape::bake {
namespace {

BakeSettings settings_with_texels(double texel_m) {
  BakeSettings settings;
  settings.aspects = {{0.0}, {radians_from_deg(10.0), radians_from_deg(40.0)}, {10e9}};
  settings.patches = {texel_m, 256};
  return settings;
}

/// Of the patch north-east of the origin, as it is launched before rays are spared.
double launched(const scene::Scene& scene, double texel_m) {
  const BakeSettings settings = settings_with_texels(texel_m);
  const double side_m = std::min(64.0, settings.patches.side_m());
  const radar::Rectangle target{0.0, 0.0, side_m, side_m};
  const auto viewpoint = trace::Viewpoint::distant({0.0, settings.aspects.elevations_rad.front()});
  const trace::SceneHeights heights = trace::heights_of(scene, settings.footing);
  const auto reach = trace::multibounce_reach(scene, viewpoint, target);
  return static_cast<double>(trace::launch_area(viewpoint, target, texel_m, heights.lowest_m, heights.highest_m + 1.0,
                                                reach, trace::tile_side_cells)
                                 .cells.size());
}

TEST(PatchRoom, CellsOfAPatchAreKnownWithoutLayingThemOut) {
  const scene::Scene scene = scene::simple_scene();  // 128 m about the origin
  for (const double texel_m : {0.125, 0.25}) {
    const double expected = launched(scene, texel_m);
    EXPECT_NEAR(cells_of_a_patch(scene, settings_with_texels(texel_m)), expected, 0.15 * expected) << texel_m;
  }
}

TEST(PatchRoom, TexelsSoSmallThatMemoryRunsOutAreRefused) {
  const scene::Scene scene = scene::simple_scene();
  EXPECT_NO_THROW(check_room(scene, settings_with_texels(0.5), 1e9));
  EXPECT_THAT(message_of_error([&] { check_room(scene, settings_with_texels(0.001), 64e9); }),
              testing::AllOf(testing::HasSubstr("bake settings: with texels of 0.001 m a patch sends rays to"),
                             testing::HasSubstr("use larger texels")));
  EXPECT_THROW(check_room(scene, settings_with_texels(1e-3)), Error) << "whatever this machine has";
}

TEST(PatchRoom, PatchesOfSoManyTexelsThatMemoryRunsOutAreRefused) {
  BakeSettings settings = settings_with_texels(0.5);
  settings.patches.texels_per_side = 16384;
  settings.aspects.frequencies_hz = {1e9, 3e9, 10e9};
  scene::Scene scene = scene::simple_scene();  // on level ground
  EXPECT_EQ(bytes_of_texels(scene, settings), 16384.0 * 16384.0 * 3.0 * 80.0);
  EXPECT_THAT(
      message_of_error([&] { check_room(scene, settings, 24e9); }),
      testing::AllOf(testing::HasSubstr("a patch of 16384 × 16384 texels at 3 frequencies takes 64.4 GB of memory"),
                     testing::HasSubstr("use fewer texels a patch")));
  BakeSettings of_one = settings;
  of_one.aspects.frequencies_hz = {10e9};
  EXPECT_EQ(bytes_of_texels(scene, of_one), 16384.0 * 16384.0 * 80.0) << "obstacles before any look take less";
  BakeSettings small = of_one;
  small.patches = {2.0, 256};
  EXPECT_NEAR(bytes_of_texels(scene, small), 7.4e6, 0.1e6) << "obstacles, before any look";
  of_one.shadows = small.shadows = Shadows::Baked;
  EXPECT_EQ(bytes_of_texels(scene, of_one), 16384.0 * 16384.0 * 80.0);
  EXPECT_EQ(bytes_of_texels(scene, small), 256.0 * 256.0 * 80.0);
  scene.terrain.height_m(0, 0) += 1.0F;
  EXPECT_EQ(bytes_of_texels(scene, settings),
            16384.0 * 16384.0 * 3.0 * 80.0 + scene::obstacle_raster_bytes({0.0, 0.0, 0.5, 16384, 16384}));
}

TEST(BakeSettings, PatchesFitIntoALocalFrame) {
  EXPECT_NO_THROW(check(settings_with_texels(3900.0)));
  EXPECT_THAT(message_of_error([] { check(settings_with_texels(0.001)); }),
              testing::HasSubstr("bake settings: texels of 0.001 m; use texels of 0.01 m or more"));
  EXPECT_THAT(message_of_error([] { check(settings_with_texels(1e6)); }),
              testing::HasSubstr("texels of 1e+06 m make patches of 256000 km; use texels of 3906.25 m or less"));
}

}  // namespace
}  // namespace sigmascape::bake
