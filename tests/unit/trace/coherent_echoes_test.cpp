#include <cmath>
#include <complex>
#include <gtest/gtest.h>

#include "plain_scene.h"

#include "sigmascape/trace/path_tracer.h"

namespace sigmascape::trace {
namespace {

using Complex = std::complex<double>;

struct CoherentEchoes {
  std::vector<radar::Echo> echoes;
  std::vector<radar::ComplexChannels> amplitudes_m;
};

CoherentEchoes traced(const scene::Scene& scene, const radar::Aspect& aspect, const PathOptions& options) {
  const SceneGeometry geometry(scene, Footing::LevelPlane);
  const auto viewpoint = Viewpoint::distant(aspect);
  const PathTracer tracer(geometry, surface_models(scene, x_band_hz), viewpoint, options, 1);
  const LaunchArea launch =
      launch_area(viewpoint, {-20, -20, 20, 20}, 1.0, 0.0, geometry.highest_m() + 1.0, {10.0, 10.0});
  CoherentEchoes all;
  tracer.trace(launch, {0, 64, 64}, 1, [&](const TileEchoes& tile) {
    all.echoes.insert(all.echoes.end(), tile.echoes.begin(), tile.echoes.end());
    all.amplitudes_m.insert(all.amplitudes_m.end(), tile.amplitudes_m.begin(), tile.amplitudes_m.end());
  });
  return all;
}

scatter::Material conductor(double alpha, double scattering_coefficient = 0.0) {
  return {.name = "conductor",
          .model =
              scatter::CookTorranceParameters{
                  {1.0, 0.0, 1e9, 0.0}, alpha, scatter::MicrofacetDistribution::Beckmann, scattering_coefficient},
          .source = {}};
}

/// Level ground of the material, with an upright wall of it across the line of sight from the south when asked for.
scene::Scene mirror_scene(const scatter::Material& material, bool with_wall) {
  scene::Scene scene = plain_scene(0.0);
  const scene::MaterialIndex index = scene.material_index(material);
  scene.ground.material(0, 0) = index;
  if (with_wall) {
    scene.prototypes.push_back(scene::wall_mesh(10, 10, index));
    scene.instances.push_back({});
  }
  return scene;
}

/// Σ a · exp(−j 4π r / λ) over the echoes of so many bounces.
struct Received {
  Complex vv, hh, hv;
};
Received received(const CoherentEchoes& all, int bounces) {
  Received sum;
  for (std::size_t i = 0; i < all.echoes.size(); ++i) {
    if (all.echoes[i].bounces != bounces) continue;
    const Complex travel = std::polar(1.0, -4.0 * pi * all.echoes[i].range_m / wavelength_m(x_band_hz));
    sum.vv += Complex(all.amplitudes_m[i].vv) * travel;
    sum.hh += Complex(all.amplitudes_m[i].hh) * travel;
    sum.hv += Complex(all.amplitudes_m[i].hv) * travel;
  }
  return sum;
}

double phase_deg(Complex a, Complex b) {
  return deg_from_radians(std::arg(a * std::conj(b)));
}

TEST(CoherentEchoes, AreMadeOnlyWhenAskedFor) {
  EXPECT_TRUE(traced(plain_scene(), {pi, 0.5}, {}).amplitudes_m.empty());
}

TEST(CoherentEchoes, SquaredModuliAreTheCrossSections) {
  scene::Scene scene = mirror_scene(conductor(0.3, 0.4), true);
  add_box(scene, {5, 5, 5}, {2, -8}, 0.7);
  const CoherentEchoes all = traced(scene, {pi, 0.7}, {.coherent = true});
  ASSERT_EQ(all.echoes.size(), all.amplitudes_m.size());
  int several = 0;
  for (std::size_t i = 0; i < all.echoes.size(); ++i) {
    const radar::Channels powers = radar::power_of(all.amplitudes_m[i]), stated = all.echoes[i].rcs_m2;
    const float tolerance = 1e-5F * stated.power(radar::Polarization::Sum);
    ASSERT_NEAR(powers.vv, stated.vv, tolerance);
    ASSERT_NEAR(powers.hh, stated.hh, tolerance);
    ASSERT_NEAR(powers.hv, stated.hv, tolerance);
    ASSERT_NEAR(powers.re_vvhh, stated.re_vvhh, tolerance);
    several += all.echoes[i].bounces > 1 ? 1 : 0;
  }
  EXPECT_GT(several, 100);
}

// Of surfaces whose powers a draw does not change, coherent tracing finds the very same echoes.
TEST(CoherentEchoes, HaveThePowersOfTracingWithoutPhase) {
  scene::Scene scene = plain_scene(0.5);
  add_box(scene, {8, 8, 8}, {0, 0}, 0.8);
  const CoherentEchoes with = traced(scene, {pi, 0.6}, {.coherent = true}), without = traced(scene, {pi, 0.6}, {});
  ASSERT_EQ(with.echoes.size(), without.echoes.size());
  for (std::size_t i = 0; i < with.echoes.size(); ++i) {
    ASSERT_EQ(with.echoes[i].range_m, without.echoes[i].range_m);
    ASSERT_NEAR(with.echoes[i].rcs_m2.vv / without.echoes[i].rcs_m2.vv, 1.0F, 1e-4F);
  }
}

// What facets met head-on return: all samples in step but for the way, VV and HH alike, no cross-polarization.
TEST(CoherentEchoes, PlateHasBothPolarizationsInStep) {
  const CoherentEchoes all =
      traced(mirror_scene(conductor(0.1), false), {pi, radians_from_deg(85.0)}, {.coherent = true});
  ASSERT_FALSE(all.amplitudes_m.empty());
  Received sum;
  double moduli = 0.0;
  for (const auto& a : all.amplitudes_m) {
    sum = {sum.vv + Complex(a.vv), sum.hh + Complex(a.hh), sum.hv + Complex(a.hv)};
    moduli += static_cast<double>(std::abs(a.vv));
  }
  EXPECT_NEAR(std::abs(sum.vv) / moduli, 1.0, 1e-4);
  EXPECT_NEAR(phase_deg(sum.hh, sum.vv), 0.0, 0.1);
  EXPECT_LT(std::abs(sum.hv), 1e-4 * std::abs(sum.vv));
}

// Wall and ground of smooth conductor: every way is as long as that to the foot of the wall, so that all are in step;
// HH and VV are opposed.
TEST(CoherentEchoes, DihedralHasThemOpposed) {
  const CoherentEchoes all =
      traced(mirror_scene(conductor(0.001), true), {pi, radians_from_deg(45.0)}, {.coherent = true});
  const Received sum = received(all, 2);
  double moduli = 0.0;
  for (std::size_t i = 0; i < all.echoes.size(); ++i)
    moduli += all.echoes[i].bounces == 2 ? static_cast<double>(std::abs(all.amplitudes_m[i].vv)) : 0.0;
  ASSERT_GT(moduli, 0.0);
  EXPECT_GT(std::abs(sum.vv) / moduli, 0.99);
  EXPECT_NEAR(std::abs(phase_deg(sum.hh, sum.vv)), 180.0, 0.5);
  EXPECT_NEAR(std::abs(sum.hh) / std::abs(sum.vv), 1.0, 0.01);
}

// Rough ground: ⟨VV HH*⟩ is its stated correlation, and phases are even over the circle.
TEST(CoherentEchoes, RoughGroundDrawsItsCovariance) {
  const CoherentEchoes all = traced(plain_scene(0.5), {pi, 1.0}, {.coherent = true});
  Complex correlation, sum, cross;
  double power = 0.0;
  for (const auto& a : all.amplitudes_m) {
    const Complex vv(a.vv), hh(a.hh), hv(a.hv);
    correlation += vv * std::conj(hh);
    cross += vv * std::conj(hv);
    sum += vv;
    power += std::norm(vv);
  }
  const auto count = static_cast<double>(all.amplitudes_m.size());
  ASSERT_GT(count, 1e5);
  EXPECT_NEAR(correlation.real() / power, 0.5, 1e-4);
  EXPECT_NEAR(correlation.imag() / power, 0.0, 5.0 / std::sqrt(count));
  EXPECT_LT(std::abs(cross) / power, 5.0 / std::sqrt(count));
  // |Σ a|² of N even phases is N |a|² in the mean; a tenth of a per mille of draws exceeds ten times that.
  EXPECT_LT(std::norm(sum), 10.0 * power);
}

TEST(CoherentEchoes, TellFromHowFarBelowTheyCome) {
  const auto located = Viewpoint::located({0, 0, 100});
  EXPECT_DOUBLE_EQ(located.sin_depression_of({100, 0, 0}, {100, 0, 0}), std::sqrt(0.5));
  EXPECT_DOUBLE_EQ(located.sin_depression_of({0, 0, 0}, {100, 0, 100}), 0.5);
  EXPECT_DOUBLE_EQ(Viewpoint::distant({pi, 0.5}).sin_depression_of({}, {}), 0.0);
}

}  // namespace
}  // namespace sigmascape::trace
