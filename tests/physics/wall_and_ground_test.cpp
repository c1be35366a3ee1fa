#include <algorithm>
#include <cmath>
#include <complex>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "physics/facet_distributions.h"
#include "physics/level_scene.h"
#include "physics/two_surface_integral.h"
#include "validation/validation_record.h"

namespace sigmascape::physics_test {
namespace {

constexpr const char* wall_and_ground_group = "Wall and ground";

/// A wall of 10 m × 10 m on open ground, both ideal conductors, and from where it is seen.
struct Corner {
  double alpha_wall, alpha_ground;
  double incidence_deg = 45.0;
  double azimuth_off_deg = 0.0;
  scatter::MicrofacetDistribution distribution = Beckmann;
};

std::string corner_name(const Corner& corner) {
  std::string name = fmt::format("{} α {} wall, {} ground, incidence {}°", name_of(corner.distribution),
                                 corner.alpha_wall, corner.alpha_ground, corner.incidence_deg);
  return corner.azimuth_off_deg == 0.0 ? name : name + fmt::format(", wall turned by {}°", corner.azimuth_off_deg);
}

BounceSums traced(const Corner& corner, const LookSettings& settings = {.samples = 32}) {
  scene::Scene scene = level_scene(rough_conductor("ground", corner.alpha_ground, corner.distribution));
  add_wall(scene, rough_conductor("wall", corner.alpha_wall, corner.distribution), 10.0F, 10.0F, pi);
  const radar::Aspect aspect{pi + radians_from_deg(corner.azimuth_off_deg),
                             radians_from_deg(90.0 - corner.incidence_deg)};
  return bounce_sums(traced_echoes(scene, aspect, settings));
}

/// Both receive polarizations of a wave sent vertically.
double all_receive(const std::array<double, 4>& sums) {
  return sums[0] + sums[2];
}

Estimate integrated(const Corner& corner, std::uint32_t points_per_batch = 1U << 16U) {
  const auto surface = [&](double alpha) {
    return scatter::CookTorrance({{1.0, 0.0, 1e13, 0.0}, alpha, corner.distribution}, frequency_hz,
                                 {.masking = scatter::Masking::Separable});
  };
  return two_surface_integral(surface(corner.alpha_wall), surface(corner.alpha_ground),
                              {radians_from_deg(corner.incidence_deg), radians_from_deg(corner.azimuth_off_deg)},
                              points_per_batch);
}

void expect_returned_m2(const std::string& name, double expected_m2, double measured_m2, const char* source,
                        double tolerance_db = 0.1) {
  validation::expect_close({.group = wall_and_ground_group,
                            .name = name,
                            .expected = db_from_linear(expected_m2),
                            .measured = db_from_linear(measured_m2),
                            .tolerance = tolerance_db,
                            .unit = "dBsm",
                            .source = source});
}

// One order of bounces at a mirror wall over a Beckmann ground returns L h tan θ cos φ exp(−tan²θ sin²φ/α²)
// (1 + tan²θ sin²φ)² G/α²; both orders together, being coherent, four times that.
TEST(WallAndGround, MirrorWallOnRoughGroundIsTheClosedForm) {
  const struct {
    Corner corner;
    double one_order_m2;
  } rows[] = {{{0.002, 0.3}, 1111.111},
              {{0.002, 0.3, 30.0}, 641.500},
              {{0.002, 0.3, 45.0, 10.0}, 830.628},
              {{0.002, 0.6, 60.0}, 454.074}};
  for (const auto& row : rows) {
    expect_returned_m2(corner_name(row.corner) + ", traced, both orders", 4.0 * row.one_order_m2,
                       all_receive(traced(row.corner)[2]), "closed form of one order, times four");
  }
}

// L h tan θ / √((αg² + αw²)(αg² + αw² tan²θ)) for small slopes; the Monte Carlo reference says what the slopes add.
TEST(WallAndGround, BothSlightlyRoughIsTheClosedForm) {
  const struct {
    double incidence_deg, closed_m2, monte_carlo_m2;
  } rows[] = {{30.0, 39283.7, 39359.0}, {45.0, 55555.6, 55688.0}, {60.0, 68041.4, 68265.0}};
  for (const auto& row : rows) {
    const Corner corner{0.03, 0.03, row.incidence_deg};
    const double measured = all_receive(traced(corner)[2]);
    expect_returned_m2(corner_name(corner) + ", traced, against the closed form", 4.0 * row.closed_m2, measured,
                       "closed form of one order for small slopes, times four");
    expect_returned_m2(corner_name(corner) + ", traced, both orders", 4.0 * row.monte_carlo_m2, measured,
                       "separate Monte Carlo integral of one order, times four");
  }
}

TEST(WallAndGround, FinitelyRoughAgreesWithTheMonteCarloReferences) {
  const struct {
    Corner corner;
    double one_order_m2, standard_error_m2;
  } rows[] = {{{0.1, 0.1}, 5138.2, 0.4},
              {{0.1, 0.3}, 1057.05, 0.03},
              {{0.1, 0.6}, 285.15, 0.01},
              {{0.1, 0.3, 45.0, 0.0, Ggx}, 805.24, 0.04},
              {{0.1, 0.3, 45.0, 20.0}, 358.70, 0.02}};
  for (const auto& row : rows) {
    // In the mode in which it was published: powers of one order, separable masking.
    const Estimate integral = integrated(row.corner);
    EXPECT_LT(integral.standard_error, 4.0 * row.standard_error_m2) << corner_name(row.corner);
    validation::expect_close({.group = wall_and_ground_group,
                              .name = corner_name(row.corner) + ", integrated, one order",
                              .expected = row.one_order_m2,
                              .measured = integral.mean,
                              .tolerance = 3.0 * std::hypot(row.standard_error_m2, integral.standard_error),
                              .unit = "m²",
                              .source = "separate Monte Carlo integral, separable masking"});
    const double measured = all_receive(traced(row.corner)[2]);
    expect_returned_m2(corner_name(row.corner) + ", traced, both orders", 4.0 * row.one_order_m2, measured,
                       "separate Monte Carlo integral of one order, times four");
  }
}

// What the incoherent sum of both orders would be, by an integral without a tracer, is 3.01 dB below what is traced.
TEST(WallAndGround, ThePairOfOrdersAddsThreeDecibels) {
  for (const Corner& corner : {Corner{0.002, 0.3}, Corner{0.03, 0.1}, Corner{0.1, 0.3}, Corner{0.1, 0.3, 60.0}}) {
    validation::expect_close(
        {.group = wall_and_ground_group,
         .name = corner_name(corner) + ", traced over both orders as powers",
         .expected = db_from_linear(2.0),
         .measured = db_from_linear(all_receive(traced(corner)[2]) / (2.0 * integrated(corner, 1U << 14U).mean)),
         .tolerance = 0.05,
         .unit = "dB",
         .source = "amplitudes of a path and its reversal are equal"});
  }
}

TEST(WallAndGround, CrossPolarizationOfATurnedWall) {
  const struct { double turn_deg, cross_db; } rows[] = {{5.0, -12.00}, {10.0, -5.49}};
  for (const auto& row : rows) {
    const auto sums = traced({0.002, 0.3, 45.0, row.turn_deg}, {.area = {-14, -14, 14, 12}, .samples = 256});
    validation::expect_close({.group = wall_and_ground_group,
                              .name = fmt::format("mirror wall turned by {}°, traced, HV/HH", row.turn_deg),
                              .expected = row.cross_db,
                              .measured = db_from_linear(sums[2][2] / sums[2][1]),
                              .tolerance = 0.05,
                              .unit = "dB",
                              .source = "separate Jones-matrix calculation"});
  }
}

TEST(WallAndGround, OddAndEvenBouncesHaveOppositePhases) {
  for (const double incidence_deg : {30.0, 45.0, 60.0}) {
    const auto sums = traced({0.002, 0.3, incidence_deg}, {.samples = 8});
    for (const std::size_t bounces : {1U, 2U}) {
      if (bounces == 1 && incidence_deg == 60.0) continue;  // the ground returns nothing that steeply
      validation::expect_close({.group = wall_and_ground_group,
                                .name = fmt::format("correlation of VV and HH, incidence {}°, {} bounce{}",
                                                    incidence_deg, bounces, bounces == 1 ? "" : "s"),
                                .expected = bounces == 1 ? 1.0 : -1.0,
                                .measured = sums[bounces][3] / std::sqrt(sums[bounces][0] * sums[bounces][1]),
                                .tolerance = 0.02,
                                .unit = "1",
                                .source = "image theory for an ideal conductor"});
    }
  }
}

// Through the tracer the concrete corner of the Jones calculation: what each polarization loses against a conductor.
TEST(WallAndGround, ConcreteWallOnMediumDryGround) {
  const auto corner = [](std::complex<double> wall, std::complex<double> ground) {
    const auto material = [](const char* name, std::complex<double> epsilon, double alpha) {
      const double conductivity = -epsilon.imag() * 2.0 * pi * frequency_hz * 8.8541878128e-12;
      return scatter::Material{
          .name = name,
          .model = scatter::CookTorranceParameters{{epsilon.real(), 0.0, conductivity, 0.0}, alpha},
          .source = {}};
    };
    scene::Scene scene = level_scene(material("ground", ground, 0.05));
    add_wall(scene, material("wall", wall, 0.002), 10.0F, 10.0F, pi);
    return bounce_sums(traced_echoes(scene, {pi, radians_from_deg(45.0)}, {.samples = 1024}))[2];
  };
  const auto real = corner({5.24, -0.503}, {11.915, -2.684});
  const auto ideal = corner({1.0, -1e12}, {1.0, -1e12});
  const auto report = [&](const char* name, std::size_t channel, double expected_db) {
    validation::expect_close(
        {.group = wall_and_ground_group,
         .name = fmt::format("concrete wall on medium dry ground, incidence 45°, traced, {}", name),
         .expected = expected_db,
         .measured = db_from_linear(real[channel] / ideal[channel]),
         .tolerance = 0.1,
         .unit = "dB over conductors",
         .source = "separate Jones-matrix calculation"});
  };
  report("HH", 1, -9.44);
  report("VV", 0, -18.88);
  EXPECT_LT(real[3], 0.0) << "two bounces leave VV and HH in opposite phases";
}

// 8 ρ² cos² A F with F = 0.200044 for perpendicular squares is 80.0175 m² when orders add as powers; as amplitudes
// twice that.
TEST(WallAndGround, LambertWallOnLambertGround) {
  const scatter::Material white{.name = "white", .model = scatter::LambertParameters{1.0, {0.0, 1.0}}, .source = {}};
  scatter::Material black = white;
  black.name = "black";
  std::get<scatter::LambertParameters>(black.model).albedo = 0.0;
  scene::Scene scene = level_scene(black);
  add_wall(scene, white, 10.0F, 10.0F, pi);
  // The white square before the wall, in a map of 10 m cells around it.
  scene.ground.grid = {-15.0, 10.0, 10.0, 3, 3};
  scene.ground.material = Array2D<scene::MaterialIndex>(3, 3, scene.material_index(black));
  scene.ground.material(1, 1) = scene.material_index(white);
  const auto sums =
      bounce_sums(traced_echoes(scene, {pi, radians_from_deg(45.0)}, {.samples = 256, .options = {.max_bounces = 2}}));
  expect_returned_m2("Lambert wall and ground of 10 m × 10 m, incidence 45°, both orders", 2.0 * 80.0175, sums[2][0],
                     "view factor of perpendicular squares, times two");
}

// For a mirror wall every way over ground and wall is as long as to the wall's foot and back, and lands there.
TEST(WallAndGround, DoubleBounceLiesOnTheFootOfTheWall) {
  constexpr double texel_m = 1.0;
  for (const double azimuth_deg : {-60.0, -30.0, 0.0, 30.0, 60.0}) {
    for (const double elevation_deg : {5.0, 10.0, 20.0, 30.0, 40.0}) {
      const scatter::Material ground{
          .name = "ground", .model = scatter::ConstantGammaParameters{0.1, {0.1, 0.5}}, .source = {}};
      scene::Scene scene = level_scene(ground);
      add_wall(scene, rough_conductor("wall", 0.002), 10.0F, 6.0F, pi);
      const radar::Aspect aspect{pi + radians_from_deg(azimuth_deg), radians_from_deg(elevation_deg)};
      const Vec2d towards = radar::horizontal_direction(aspect.azimuth_rad);
      double power = 0.0, square = 0.0;
      for (const auto& echo : traced_echoes(scene, aspect, {.area = {-80, -80, 80, 20}, .samples = 4})) {
        if (echo.bounces != 2) continue;
        const double y = towards.y * (-echo.range_m / std::cos(aspect.elevation_rad)) + towards.x * echo.cross;
        const double share = static_cast<double>(echo.rcs_m2.vv + echo.rcs_m2.hv);
        power += share;
        square += share * y * y;
      }
      ASSERT_GT(power, 0.0);
      validation::expect_close(
          {.group = wall_and_ground_group,
           .name =
               fmt::format("double bounce, rms distance from the foot of the wall, azimuth {:+}° off, elevation {}°",
                           azimuth_deg, elevation_deg),
           .expected = 0.0,
           .measured = std::sqrt(square / power),
           .tolerance = 0.25 * texel_m,
           .unit = "m",
           .source = "mirror image; a quarter of a texel of 1 m"});
    }
  }
}

}  // namespace
}  // namespace sigmascape::physics_test
