#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "from_south.h"
#include "plain_scene.h"

#include "sigmascape/trace/path_tracer.h"

namespace sigmascape::trace {
namespace {

constexpr std::array frequencies_hz{1.5e9, 5e9, 30e9};

/// Rough boxes whose lobes diffraction widens tenfold from the highest to the lowest frequency, on ground of concrete
/// that changes its permittivity between them.
scene::Scene dispersive_street() {
  scene::Scene scene = plain_scene(0.0);
  const auto concrete = scatter::library_material("concrete");
  auto mirrors = std::get<scatter::CookTorranceParameters>(concrete.model);
  mirrors.alpha = 0.3;
  const scene::MaterialIndex ground = scene.material_index({.name = "rough", .model = mirrors, .source = {}});
  scene.ground.material(0, 0) = ground;
  mirrors.alpha = 0.02;
  mirrors.scattering_coefficient = 0.0;
  const scene::MaterialIndex wall = scene.material_index({.name = "wall", .model = mirrors, .source = {}});
  for (const float x : {-3.0F, 3.0F}) {
    scene.prototypes.push_back(scene::box_mesh({2, 2, 2}, wall));
    scene.instances.push_back(
        {.prototype = static_cast<std::uint32_t>(scene.prototypes.size() - 1), .x_m = x, .yaw_rad = 0.1F * x});
  }
  return scene;
}

/// Mean and its standard error over seeds of what several bounces return, by frequency.
struct Estimate {
  double mean = 0.0, error = 0.0;
};

class Street {
 public:
  Street() : scene_(dispersive_street()), geometry_(scene_, Footing::LevelPlane) {}

  [[nodiscard]] std::vector<Estimate> estimates(std::span<const double> at_hz, TraceCounts* counts = nullptr) const {
    constexpr int seeds = 16;
    const LaunchArea launch =
        launch_area(from_south, {-8, -8, 8, 8}, 1.0, 0.0, geometry_.highest_m() + 1.0, {10.0, 10.0});
    const SpectralSurfaces surfaces = surface_models(scene_, at_hz);
    std::vector<double> sum(at_hz.size()), square(at_hz.size());
    for (int seed = 1; seed <= seeds; ++seed) {
      const PathTracer tracer(geometry_, surfaces, from_south, {}, static_cast<std::uint64_t>(seed));
      std::vector<double> power(at_hz.size());
      const TraceCounts counted = tracer.trace(launch, {0, 64, 64}, 1, [&](const TileEchoes& tile) {
        for (const radar::Echo& echo : tile.echoes)
          power[tile.frequency] += echo.bounces > 1 ? static_cast<double>(echo.rcs_m2.vv + echo.rcs_m2.hv) : 0.0;
      });
      if (counts != nullptr) *counts += counted;
      for (std::size_t f = 0; f < power.size(); ++f) {
        sum[f] += power[f];
        square[f] += power[f] * power[f];
      }
    }
    std::vector<Estimate> estimates;
    for (std::size_t f = 0; f < sum.size(); ++f) {
      const double mean = sum[f] / seeds;
      estimates.push_back({mean, std::sqrt((square[f] / seeds - mean * mean) / (seeds - 1))});
    }
    return estimates;
  }

 private:
  scene::Scene scene_;
  SceneGeometry geometry_;
};

TEST(SeveralFrequencies, EachHasTheMeanThatItHasAlone) {
  const Street street;
  TraceCounts together_counts, alone_counts;
  const auto together = street.estimates(frequencies_hz, &together_counts);
  for (std::size_t f = 0; f < frequencies_hz.size(); ++f) {
    const Estimate alone = street.estimates(std::span(&frequencies_hz[f], 1), &alone_counts).front();
    const double z = (together[f].mean - alone.mean) / std::hypot(together[f].error, alone.error);
    EXPECT_LT(std::abs(z), 3.0) << frequencies_hz[f] / 1e9 << " GHz";
    EXPECT_NEAR(together[f].mean / alone.mean, 1.0, 0.03) << frequencies_hz[f] / 1e9 << " GHz";
    EXPECT_LT(together[f].error / together[f].mean, 0.015) << "too noisy for the test to tell";
  }
  // One set of paths serves all.
  EXPECT_NEAR(static_cast<double>(together_counts.rays) / (static_cast<double>(alone_counts.rays) / 3.0), 1.0, 0.05);
}

// Of equal surfaces all frequencies have the same echoes, and those that the tracer of one frequency finds.
TEST(SeveralFrequencies, EqualSurfacesReturnWhatOneReturns) {
  scene::Scene scene = plain_scene(0.6);
  add_box(scene, {8, 20, 10}, {-9, 0}, 0.6);
  add_box(scene, {8, 20, 10}, {9, 0}, 0.6);
  const SceneGeometry geometry(scene, Footing::LevelPlane);
  const LaunchArea launch =
      launch_area(from_south, {-30, -30, 30, 30}, 2.0, 0.0, geometry.highest_m() + 1.0, {10.0, 10.0});
  const auto powers = [&](std::span<const double> at_hz) {
    std::vector<double> power(at_hz.size());
    const PathTracer tracer(geometry, surface_models(scene, at_hz), from_south, {}, 1);
    tracer.trace(launch, {0, 16, 16}, 1, [&](const TileEchoes& tile) {
      for (const radar::Echo& echo : tile.echoes) power[tile.frequency] += static_cast<double>(echo.rcs_m2.vv);
    });
    return power;
  };
  const double alone = powers(std::array{5e9}).front();
  for (const double power : powers(frequencies_hz)) EXPECT_NEAR(power / alone, 1.0, 1e-5);
}

}  // namespace
}  // namespace sigmascape::trace
