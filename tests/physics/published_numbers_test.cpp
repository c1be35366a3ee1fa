#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>
#include <string>

#include "physics/conducting_facets.h"
#include "physics/facet_distributions.h"
#include "physics/level_scene.h"
#include "physics/two_surface_integral.h"
#include "validation/validation_record.h"

#include "sigmascape/scatter/nrl_sea.h"
#include "sigmascape/scatter/ulaby_dobson.h"

namespace sigmascape::physics_test {
namespace {

/// A line of a list of published or separately computed numbers, and how the program is asked for it.
struct Row {
  const char* name;
  double expected;
  double tolerance;
  const char* unit;
  const char* source;
  std::function<double()> measured;
};

void hold(const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    validation::expect_close({.group = "Published numbers",
                              .name = row.name,
                              .expected = row.expected,
                              .measured = row.measured(),
                              .tolerance = row.tolerance,
                              .unit = row.unit,
                              .source = row.source});
  }
}

double incidence(double degrees) {
  return radians_from_deg(degrees);
}

/// σ0_VV in dB of a library material in backscatter.
double library_sigma0_db(const char* name, double incidence_deg, double at_frequency_hz = 10e9) {
  const scatter::SurfaceModel model(scatter::library_material(name), at_frequency_hz);
  const double theta = radians_from_deg(incidence_deg);
  const radar::Channels brdf = model.backscatter(direction_at(theta), up);
  return db_from_linear(4.0 * pi * static_cast<double>(brdf.vv) * std::pow(std::cos(theta), 2));
}

TEST(PublishedNumbers, SurfacesInBackscatter) {
  const char* quadrature = "quadrature, separate program";
  hold({
      {"σ0 Beckmann α 0.1, normal", 20.0, 0.006, "dB", "closed form 1/α²",
       [] { return db_from_linear(sigma0(conducting(Beckmann, 0.1), 0.0)); }},
      {"σ0 Beckmann α 0.1, incidence 10°", 6.76, 0.006, "dB", quadrature,
       [] { return db_from_linear(sigma0(conducting(Beckmann, 0.1), incidence(10.0))); }},
      {"σ0 Beckmann α 0.6, incidence 30°", 2.91, 0.006, "dB", quadrature,
       [] { return db_from_linear(sigma0(conducting(Beckmann, 0.6), incidence(30.0))); }},
      {"σ0 GGX α 0.1, incidence 30°, separable masking", -8.22, 0.006, "dB", quadrature,
       [] { return db_from_linear(sigma0(conducting(Ggx, 0.1, {.masking = Masking::Separable}), incidence(30.0))); }},
      {"σ0 GGX over Beckmann, α 0.1, incidence 20°", 34.0, 0.5, "dB", quadrature,
       [] {
         return db_from_linear(sigma0(conducting(Ggx, 0.1), incidence(20.0)) /
                               sigma0(conducting(Beckmann, 0.1), incidence(20.0)));
       }},
      {"σ0 GGX over Beckmann, α 0.1, incidence 30°", 114.0, 0.5, "dB", quadrature,
       [] {
         return db_from_linear(sigma0(conducting(Ggx, 0.1), incidence(30.0)) /
                               sigma0(conducting(Beckmann, 0.1), incidence(30.0)));
       }},
      {"σ0 of the paper's building, normal", 19.97, 0.006, "dB", "|R(0)|²/α² at 10 GHz",
       [] { return library_sigma0_db("paper_building", 0.0); }},
      {"σ0 of the paper's bark, incidence 30°", 1.68, 0.012, "dB", "πD|R(0)|² at 10 GHz",
       [] { return library_sigma0_db("paper_bark", 30.0); }},
      {"directional albedo GGX α 1, normal", 0.306853, 3e-4, "1", "closed form 1 − ln 2",
       [] { return directional_albedo(conducting(Ggx, 1.0), 1.0, 0.0); }},
      {"directional albedo GGX α 0.3, incidence 60°, separable masking", 0.8181, 1e-3, "1", quadrature,
       [] { return directional_albedo(conducting(Ggx, 0.3, {.masking = Masking::Separable}), 0.3, incidence(60.0)); }},
      {"NRL sea, 10 GHz, sea state 3, grazing 10°, HH", -37.6, 0.06, "dB", "NRL fit evaluated directly",
       [] { return db_from_linear(scatter::nrl_sea_sigma0({.sea_state = 3.0}, 10e9, radians_from_deg(10.0)).hh); }},
      {"Ulaby–Dobson grass, C band, incidence 40°, VV", -12.61, 0.006, "dB", "Ulaby and Dobson 1989, fit of the row",
       [] { return library_sigma0_db("ulaby_dobson_grass", 40.0, 5.405e9); }},
      {"γ of Barton's urban land, 10 GHz", -5.0, 0.01, "dB", "MathWorks example: 0.1082 / sin 20°",
       [] { return library_sigma0_db("urban", 70.0) - db_from_linear(std::cos(incidence(70.0))); }},
  });
}

/// σ of a sphere of unit radius, 2π ∫ σ0(θ) sin θ dθ.
double lambert_sphere_m2(double radius_m) {
  const scatter::Material white{.name = "white", .model = scatter::LambertParameters{1.0, {0.0, 1.0}}, .source = {}};
  const scatter::SurfaceModel model(white, 10e9);
  return pi * radius_m * radius_m * sphere_over_disk([&](double theta) {
           return 4.0 * pi * static_cast<double>(model.backscatter(direction_at(theta), up).vv) *
                  std::pow(std::cos(theta), 2);
         });
}

/// The same through the tracer: a ball of flat facets with its corners on the sphere, above black ground.
double traced_lambert_sphere_m2(float radius_m) {
  const auto lambert = [](const char* name, double albedo) {
    return scatter::Material{.name = name, .model = scatter::LambertParameters{albedo, {0.0, 1.0}}, .source = {}};
  };
  scene::Scene scene = level_scene(lambert("black", 0.0));
  const auto white = scene.material_index(lambert("white", 1.0));
  constexpr int rings = 90, sectors = 180;
  const auto corner = [&](int ring, int sector) {
    const double theta = pi * ring / rings, phi = 2.0 * pi * sector / sectors;
    return Vec3d{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), -std::cos(theta)}.to<float>() *
           radius_m;
  };
  scene::Mesh ball;
  for (int ring = 0; ring < rings; ++ring) {
    for (int sector = 0; sector < sectors; ++sector) {
      std::vector<Vec3f> facet{corner(ring, sector), corner(ring, sector + 1), corner(ring + 1, sector + 1),
                               corner(ring + 1, sector)};
      if (ring == 0) facet.erase(facet.begin() + 1);
      if (ring == rings - 1) facet.pop_back();
      scene::append_facet(ball, facet, white);
    }
  }
  scene.prototypes = {ball};
  scene.instances = {{.lift_m = 2.0F}};
  const radar::Aspect aspect{pi, radians_from_deg(45.0)};
  return bounce_sums(traced_echoes(scene, aspect, {.area = {-2, -4, 2, 0}, .cell_m = 0.1, .samples = 64}))[1][0];
}

TEST(PublishedNumbers, Spheres) {
  const auto rough = [](double alpha) {
    return sphere_over_disk([=](double theta) { return unmasked_sigma0(Beckmann, alpha, theta); });
  };
  hold({
      {"rough Beckmann sphere α 0.1, no masking, σ/(πa²)", 1.004975, 1e-4, "1", "∫ √(1 + α²x) e^(−x) dx",
       [&] { return rough(0.1); }},
      {"rough Beckmann sphere α 0.3, no masking, σ/(πa²)", 1.043201, 1e-4, "1", "∫ √(1 + α²x) e^(−x) dx",
       [&] { return rough(0.3); }},
      {"Lambert sphere of radius 0.5 m, albedo 1", 2.094395, 1e-4, "m²", "8πa²/3",
       [] { return lambert_sphere_m2(0.5); }},
      // The facets lie within the sphere by a part in a thousand.
      {"Lambert sphere of radius 0.5 m, albedo 1, traced", 2.094395, 0.01, "m²", "8πa²/3",
       [] { return traced_lambert_sphere_m2(0.5F); }},
  });
}

// One order of two bounces, as powers: the mode in which the numbers were published. Their traced counterparts are held
// in wall_and_ground_test.cpp, the corners of mirrors in corner_reflector_test.cpp and traced_corner_test.cpp.
TEST(PublishedNumbers, WallAndGround) {
  const auto surface = [](double alpha) {
    return scatter::CookTorrance({{1.0, 0.0, 1e13, 0.0}, alpha, Beckmann}, frequency_hz,
                                 {.masking = Masking::Separable});
  };
  const auto one_order = [=](double alpha_wall, double alpha_ground, double azimuth_off_deg) {
    return two_surface_integral(surface(alpha_wall), surface(alpha_ground),
                                {radians_from_deg(45.0), radians_from_deg(azimuth_off_deg)}, 1U << 16U)
        .mean;
  };
  hold({
      {"mirror wall + Beckmann 0.3 ground, 10 m × 10 m, incidence 45°, one order", 1111.111, 0.3, "m²", "closed form",
       [&] { return one_order(0.002, 0.3, 0.0); }},
      {"the same, wall turned by 10°", 830.628, 0.3, "m²", "closed form", [&] { return one_order(0.002, 0.3, 10.0); }},
      {"Beckmann 0.1 wall + 0.3 ground, incidence 45°, one order", 1057.05, 0.1, "m²", "Monte Carlo, ±0.03",
       [&] { return one_order(0.1, 0.3, 0.0); }},
      {"Beckmann 0.1 wall + 0.1 ground, incidence 45°, one order", 5138.2, 1.2, "m²", "Monte Carlo, ±0.4",
       [&] { return one_order(0.1, 0.1, 0.0); }},
  });
}

}  // namespace
}  // namespace sigmascape::physics_test
