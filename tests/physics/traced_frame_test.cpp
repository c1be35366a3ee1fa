#include <cmath>
#include <complex>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "physics/ground_with_box.h"
#include "unit/live/live_ground_example.h"
#include "validation/validation_record.h"

#include "sigmascape/simulate/live_tracer.h"

namespace sigmascape::physics_test {
namespace {

constexpr std::string_view traced_frame_group = "Live frames";

TEST(TracedFrame, LambertGroundReturnsItsSigma0) {
  constexpr double albedo = 0.4, cross_ratio = 0.1;
  const scene::Scene scene = level_scene(
      {.name = "lambert", .model = scatter::LambertParameters{albedo, {cross_ratio, 0.5}}, .source = {}}, 512.0);
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
  for (const double elevation_deg : {8.6, 35.0, 70.0}) {
    live::ExampleView view;
    view.target = {};
    view.elevation_deg = elevation_deg;
    view.beams = view.ranges = 32;
    view.bin_m = 6.0;
    simulate::LiveTracer tracer(scene, geometry, view.settings(live::FrameContent::Powers),
                                {.frequency_hz = frequency_hz, .rays_per_cell = 8, .lattice_m = 2.0});
    const live::Frame& frame = tracer.render(view.pose());
    double sum = 0.0, expected = 0.0;
    for (std::size_t range = 2; range + 2 < view.ranges; ++range) {
      const double middle_m = frame.grid.first_range_m + (static_cast<double>(range) + 0.5) * frame.grid.range_step_m;
      const double sine = view.pose().position.z / middle_m;
      for (std::size_t beam = 2; beam + 2 < view.beams; ++beam) {
        sum += static_cast<double>(frame.powers_m2[(beam * view.ranges + range) * 4]);
        // Of a plane the area between two ranges is that of the ring, r Δr Δφ, whatever the height.
        expected += 4.0 * albedo / (1.0 + cross_ratio) * sine * sine * middle_m * frame.grid.range_step_m *
                    frame.grid.azimuth_step_rad;
      }
    }
    validation::expect_close({.group = traced_frame_group,
                              .name = fmt::format("traced, Lambert ground at {}°", elevation_deg),
                              .expected = 0.0,
                              .measured = db_from_linear(sum / expected),
                              .tolerance = 0.05,
                              .unit = "dB",
                              .source = "4 ρ sin²ψ / (1 + χ) times the area of the bins"});
  }
}

TEST(TracedFrame, LevelGroundHasTheScatterersThatItHasFromTextures) {
  constexpr double gamma = 0.1;
  live::ExampleGround example;
  example.sigma0 = [](const radar::Look& look) {
    const auto vv = static_cast<float>(gamma * std::sin(look.aspect.elevation_rad));
    return radar::Channels{vv, vv, 0.1F * vv, 0.5F * vv};
  };
  const ScratchFolder folder;
  const atlas::Store store = example.store(folder.path("atlas"));
  atlas::Pyramid(store).make_above(store.units());
  const auto ground = example.over(store);
  scene::Scene scene = level_scene(
      {.name = "gamma", .model = scatter::ConstantGammaParameters{gamma, {0.1, 0.5}}, .source = {}}, 1024.0);
  scene::shift(scene, example.middle());
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);

  live::ExampleView view;
  view.beams = view.ranges = 32;
  const live::LiveSettings settings = view.settings(live::FrameContent::Amplitudes);
  live::LiveRenderer renderer(ground, settings);
  simulate::LiveTracer tracer(scene, geometry, settings,
                              {.frequency_hz = frequency_hz, .rays_per_cell = 8, .lattice_m = example.texel_m});
  const auto baked = live::settled_frame(renderer, *ground, view.pose()).amplitudes_m;
  const auto traced = tracer.render(view.pose()).amplitudes_m;
  std::complex<double> cross;
  double of_baked = 0.0, of_traced = 0.0;
  for (std::size_t i = 0; i < baked.size(); ++i) {
    const std::complex<double> a(baked[i]), b(traced[i]);
    cross += a * std::conj(b);
    of_baked += std::norm(a);
    of_traced += std::norm(b);
  }
  // They differ where in the bins a scatterer's power goes: to its own place from textures, to where echoes came from
  // in the other.
  validation::expect_at_least({.group = traced_frame_group,
                               .name = "level ground, correlation of I/Q traced and from textures",
                               .limit = 0.85,
                               .measured = cross.real() / std::sqrt(of_baked * of_traced),
                               .unit = "1",
                               .source = "the same scatterers in the same places; 0 were they others"});
  validation::expect_close({.group = traced_frame_group,
                            .name = "level ground, power of I/Q traced and from textures",
                            .expected = 0.0,
                            .measured = db_from_linear(of_traced / of_baked),
                            .tolerance = 0.2,
                            .unit = "dB",
                            .source = "the same σ0"});
}

/// VV of squares of two by two bins.
std::vector<double> squares(const live::Frame& frame) {
  constexpr std::size_t side = 2;
  const std::size_t ranges = frame.grid.ranges, across = frame.grid.azimuths / side, along = ranges / side;
  std::vector<double> squares(across * along);
  for (std::size_t beam = 0; beam < across * side; ++beam) {
    for (std::size_t range = 0; range < along * side; ++range)
      squares[beam / side * along + range / side] += static_cast<double>(frame.powers_m2[4 * (beam * ranges + range)]);
  }
  return squares;
}

TEST(TracedFrame, ABoxAndItsShadowAreWhereTheTexturesHaveThem) {
  const scene::Scene scene = ground_with_box(0.0, true);
  bake::BakeSettings settings;
  settings.aspects = {{pi}, {radians_from_deg(seen_elevation_deg)}, {frequency_hz}};
  settings.patches = {2.0, 256};
  settings.sampling.samples_per_texel = 8;
  const ScratchFolder folder;
  SilentProgress silent;
  bake::bake(scene, settings, folder.path("atlas"), silent);
  const auto ground = live::LiveGround::open(folder.path("atlas"), frequency_hz);
  const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);

  live::ExampleView view;
  view.target = {};
  view.azimuth_deg = 180.0;
  view.elevation_deg = seen_elevation_deg;
  view.slant_range_m = 5e3;
  view.beams = view.ranges = 64;
  view.bin_m = 2.0;
  const live::LiveSettings bins = view.settings(live::FrameContent::Powers);
  live::LiveRenderer renderer(ground, bins);
  simulate::LiveTracer tracer(scene, geometry, bins, {.frequency_hz = frequency_hz, .lattice_m = 1.0});
  const std::vector<double> baked = squares(live::settled_frame(renderer, *ground, view.pose()));
  const std::vector<double> traced = squares(tracer.render(view.pose()));

  const double level = traced.front();
  double open_traced = 0.0, open_baked = 0.0;
  std::size_t dark = 0, differently_dark = 0, bright = 0;
  for (std::size_t square = 0; square < traced.size(); ++square) {
    const bool is_dark = traced[square] < 0.05 * level;
    dark += is_dark ? 1 : 0;
    bright += traced[square] > 2.0 * level ? 1 : 0;
    // The edge of a shadow may fall into a square's own edge.
    if (is_dark != (baked[square] < 0.05 * level)) ++differently_dark;
    if (std::abs(traced[square] / level - 1.0) > 0.02) continue;
    open_traced += traced[square];
    open_baked += baked[square];
  }
  // 12 m of box throw 33 m of shadow: two squares of 4 m across, the third and fourth half lit, by eight along.
  EXPECT_NEAR(static_cast<double>(dark), 16.0, 4.0);
  EXPECT_GE(bright, 2U);
  EXPECT_LE(differently_dark, 2U);
  validation::expect_close({.group = traced_frame_group,
                            .name = "open ground about a box, textures against traced",
                            .expected = 0.0,
                            .measured = db_from_linear(open_baked / open_traced),
                            .tolerance = 0.1,
                            .unit = "dB",
                            .source = "the same pose at levels 1 and 0"});
}

}  // namespace
}  // namespace sigmascape::physics_test
