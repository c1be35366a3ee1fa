#include "sigmascape/dataset/bounce_labels.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/base/error.h"
#include "sigmascape/scene/paper_scene.h"

namespace sigmascape::dataset {
namespace {

constexpr std::array<std::string_view, 3> all_names{"bounce1", "bounce2", "multibounce"};

/// How many cells are NaN, the same in all layers.
std::size_t unseen_in_all(const std::vector<radar::Layer>& layers) {
  std::size_t unseen = 0;
  for (std::size_t i = 0; i < layers.front().values.size(); ++i) {
    const bool is_unseen = std::isnan(layers.front().values.values()[i]);
    unseen += is_unseen ? 1 : 0;
    for (const radar::Layer& layer : layers) EXPECT_EQ(std::isnan(layer.values.values()[i]), is_unseen) << layer.name;
  }
  return unseen;
}

// The scan ends within the scene: what it never comes to has no share of several bounces, not even none.
TEST(BounceLabels, SayNothingWhereTheRadarDoesNotLook) {
  const scene::Scene scene = scene::paper_scene({.scale = 0.1});
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  radar::Radar radar;
  radar.position = radar::position_seeing({}, pi, radians_from_deg(20.0), 2000.0);
  radar.range_resolution_m = 8.0;
  radar.beam_width_rad = 0.01;
  radar.scan = {.kind = radar::ScanKind::Sector, .azimuth_rad = 0.0, .sector_width_rad = 0.04};
  const radar::GroundGrid grid{-96.0, 96.0, 8.0, 24, 24};
  const std::vector<std::string> names(all_names.begin(), all_names.end());
  const simulate::TraceSettings settings{.cell_m = 8.0, .samples_per_cell = 4};
  const auto traced = traced_bounce_layers(names, scene, geometry, radar, grid, settings);
  ASSERT_EQ(traced.size(), 3U);
  EXPECT_GT(unseen_in_all(traced), 100U);
  EXPECT_LT(unseen_in_all(traced), 476U);
  simulate::TraceSettings short_paths = settings;
  short_paths.max_bounces = 1;
  EXPECT_THROW(static_cast<void>(traced_bounce_layers(names, scene, geometry, radar, grid, short_paths)), Error);

  // As of bakes with one bounce and with two.
  trace::TraceCounts counts;
  auto up_to = simulate::traced_bounces(scene, geometry, radar, grid.extent(), settings, 2, counts);
  for (std::size_t i = 0; i < up_to[0].rcs_m2.size(); ++i) up_to[1].rcs_m2.values()[i] += up_to[0].rcs_m2.values()[i];
  const auto baked = baked_bounce_layers(names, up_to[1], up_to, scene.terrain, grid, radar.polarization);
  ASSERT_EQ(baked.size(), 3U);
  EXPECT_EQ(unseen_in_all(baked), unseen_in_all(traced));
}

}  // namespace
}  // namespace sigmascape::dataset
