#pragma once

#include <array>
#include <mutex>
#include <numbers>

#include "sigmascape/bake/echo_landing.h"
#include "sigmascape/base/units.h"
#include "sigmascape/receiver/ground_accumulator.h"
#include "sigmascape/scene/scene.h"
#include "sigmascape/scene/solid_mesh.h"
#include "sigmascape/trace/path_tracer.h"

namespace sigmascape::physics_test {

inline constexpr double frequency_hz = 10e9;

/// A perfectly reflecting rough surface.
inline scatter::Material rough_conductor(
    std::string name, double alpha,
    scatter::MicrofacetDistribution distribution = scatter::MicrofacetDistribution::Beckmann) {
  return {.name = std::move(name),
          .model = scatter::CookTorranceParameters{{1.0, 0.0, 1e9, 0.0}, alpha, distribution},
          .source = {}};
}

/// A diffuse surface that leaves polarizations as they are.
inline scatter::Material lambert(std::string name, double albedo) {
  return {.name = std::move(name), .model = scatter::LambertParameters{albedo, {0.0, 1.0}}, .source = {}};
}

inline constexpr double ground_gamma = 0.03;

/// Ground of constant γ; a tenth of what it returns in VV comes back in HV.
inline scatter::Material gamma_ground() {
  return {.name = "gamma", .model = scatter::ConstantGammaParameters{ground_gamma, {0.1, 0.5}}, .source = {}};
}

/// Level ground of one material about the origin, nothing on it.
inline scene::Scene level_scene(const scatter::Material& ground, double side_m = 256.0) {
  scene::Scene scene;
  scene.name = "level";
  scene.extent = {-side_m / 2, -side_m / 2, side_m / 2, side_m / 2};
  scene.terrain = {-side_m / 2, side_m / 2, side_m, Array2D<float>(2, 2, 0.0F)};
  scene.ground = {{-side_m / 2, side_m / 2, side_m, 1, 1},
                  Array2D<scene::MaterialIndex>(1, 1, scene.material_index(ground))};
  return scene;
}

/// Adds an upright wall of `length` by `height` through the origin, facing the given azimuth.
inline void add_wall(scene::Scene& scene, const scatter::Material& material, float length_m, float height_m,
                     double facing_rad) {
  scene.prototypes.push_back(scene::wall_mesh(length_m, height_m, scene.material_index(material)));
  // The mesh faces −y, that is south at no yaw.
  scene.instances.push_back({.prototype = static_cast<std::uint32_t>(scene.prototypes.size() - 1),
                             .yaw_rad = static_cast<float>(facing_rad - pi)});
}

/// Cross-sections that one look at a scene returns, summed by number of bounces.
using BounceSums = std::array<std::array<double, radar::Channels::count>, 9>;

struct LookSettings {
  radar::Rectangle area{-70, -65, 70, 10};
  double cell_m = 1.0;
  std::uint32_t samples = 64;
  trace::PathOptions options = {};
  std::uint64_t seed = 1;
};

inline std::vector<radar::Echo> traced_echoes(const scene::Scene& scene, const radar::Aspect& aspect,
                                              const LookSettings& settings = {},
                                              double at_frequency_hz = frequency_hz) {
  const trace::SceneGeometry geometry(scene, trace::Footing::LevelPlane);
  const auto viewpoint = trace::Viewpoint::distant(aspect);
  const trace::PathTracer tracer(geometry, trace::surface_models(scene, at_frequency_hz), viewpoint, settings.options,
                                 settings.seed);
  const auto launch =
      trace::launch_area(viewpoint, settings.area, settings.cell_m, 0.0, geometry.highest_m() + 1.0, {});
  std::vector<radar::Echo> echoes;
  std::mutex guard;
  tracer.trace(launch, {0, settings.samples, settings.samples}, 0, [&](std::span<const radar::Echo> some, unsigned) {
    const std::lock_guard lock(guard);
    echoes.insert(echoes.end(), some.begin(), some.end());
  });
  return echoes;
}

/// Echoes of a distant radar where they stand on level ground.
inline receiver::GroundAccumulator landed(const std::vector<radar::Echo>& echoes, const radar::Aspect& aspect,
                                          const radar::GroundGrid& grid) {
  const bake::EchoLanding landing(aspect);
  receiver::GroundAccumulator texels(grid);
  for (const radar::Echo& echo : echoes) {
    if (const auto texel = texels.cell_at(landing.place_of(echo))) texels.add(*texel, echo.rcs_m2, 0.0);
  }
  return texels;
}

inline BounceSums bounce_sums(const std::vector<radar::Echo>& echoes) {
  BounceSums sums{};
  for (const radar::Echo& echo : echoes) {
    auto& sum = sums[echo.bounces];
    sum[0] += echo.rcs_m2.vv;
    sum[1] += echo.rcs_m2.hh;
    sum[2] += echo.rcs_m2.hv;
    sum[3] += echo.rcs_m2.re_vvhh;
  }
  return sums;
}

}  // namespace sigmascape::physics_test
