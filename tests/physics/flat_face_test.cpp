#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

#include "validation/validation_record.h"

#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scatter/cook_torrance.h"
#include "sigmascape/scene/facet_area.h"

namespace sigmascape::scatter {
namespace {

constexpr double plate_wavelength = 0.03;
constexpr double plate_frequency_hz = speed_of_light_mps / plate_wavelength;
const Vec3f plate_normal{0.0F, 0.0F, 1.0F};

/// A perfectly conducting, all but smooth plate.
CookTorrance plate() {
  return {{{1.0, 0.0, 1e9, 0.0}, 1e-4}, plate_frequency_hz};
}

double cross_section_m2(const CookTorrance& surface, double incidence_rad, double area_m2) {
  const Vec3f to_radar = Vec3d{std::sin(incidence_rad), 0.0, std::cos(incidence_rad)}.to<float>();
  const float brdf = surface.backscatter(to_radar, {plate_normal, static_cast<float>(1.0 / area_m2)}).vv;
  return 4.0 * pi * brdf * area_m2 * std::pow(std::cos(incidence_rad), 2);
}

TEST(FlatFace, PeaksLikeThePlateOfPhysicalOptics) {
  for (const double area_m2 : {0.02, 0.25, 1.0, 100.0}) {
    const double expected = 4.0 * pi * area_m2 * area_m2 / (plate_wavelength * plate_wavelength);
    validation::expect_close({.group = "Flat faces",
                              .name = fmt::format("peak of a plate, {} m², 3 cm", area_m2),
                              .expected = db_from_linear(expected),
                              .measured = db_from_linear(cross_section_m2(plate(), 0.0, area_m2)),
                              .tolerance = 0.1,
                              .unit = "dBsm",
                              .source = "physical optics, 4πA²/λ²"});
  }
}

// ∫ σ dΩ = π A |R|², over the angles to which the plate is turned.
TEST(FlatFace, ReturnsThePlatesPowerOverAllAngles) {
  for (const double area_m2 : {0.25, 1.0}) {
    double integral = 0.0;
    const double step = 1e-5;
    for (double theta = 0.5 * step; theta < 0.4; theta += step) {
      integral += cross_section_m2(plate(), theta, area_m2) * 2.0 * pi * std::sin(theta) * step;
    }
    validation::expect_close({.group = "Flat faces",
                              .name = fmt::format("angular integral of a plate, {} m²", area_m2),
                              .expected = pi * area_m2,
                              .measured = integral,
                              .tolerance = 0.01 * pi * area_m2,
                              .unit = "m² sr",
                              .source = "physical optics, πA"});
  }
}

/// Of a disc of physical optics: 4πA²/λ² cos² θ (2 J1(x)/x)², x = 2 k a sin θ.
double disc_cross_section_m2(double incidence_rad, double area_m2) {
  const double x = 2.0 * (2.0 * pi / plate_wavelength) * std::sqrt(area_m2 / pi) * std::sin(incidence_rad);
  const double lobe = x < 1e-6 ? 1.0 : 2.0 * std::cyl_bessel_j(1.0, x) / x;
  return 4.0 * pi * area_m2 * area_m2 / (plate_wavelength * plate_wavelength) *
         std::pow(std::cos(incidence_rad) * lobe, 2);
}

/// Over all ways in which a plate may be turned.
template <typename CrossSection>
double mean_over_orientations_m2(CrossSection cross_section_m2) {
  double mean = 0.0;
  const double step = 1e-3;
  for (double theta = 0.5 * step; theta < 0.5 * pi; theta += step)
    mean += cross_section_m2(theta) * std::sin(theta) * step;
  return mean;
}

// A face smaller than λ²/2π: the lobe of its diffraction is as wide as a lobe can be.
TEST(FlatFace, SmallOnesAreStrongestAlongTheNormal) {
  for (const double part_of_square_wavelength : {0.02, 0.05, 0.1, 0.159}) {
    const double area_m2 = part_of_square_wavelength * plate_wavelength * plate_wavelength;
    const double peak_m2 = cross_section_m2(plate(), 0.0, area_m2);
    EXPECT_NEAR(peak_m2, 4.0 * pi * std::pow(area_m2 / plate_wavelength, 2), 1e-3 * peak_m2);
    for (double incidence_deg = 1.0; incidence_deg < 90.0; incidence_deg += 1.0)
      EXPECT_LE(cross_section_m2(plate(), radians_from_deg(incidence_deg), area_m2), peak_m2 * (1.0 + 1e-6))
          << incidence_deg << "°";
  }
}

TEST(FlatFace, SmallOnesReturnThePowerOfDiscsOverAllOrientations) {
  // A leaf of 0.02 m² at 435 MHz has 0.042 λ².
  for (const double part_of_square_wavelength : {0.005, 0.02, 0.042}) {
    const double area_m2 = part_of_square_wavelength * plate_wavelength * plate_wavelength;
    const double expected =
        mean_over_orientations_m2([&](double theta) { return disc_cross_section_m2(theta, area_m2); });
    const double measured =
        mean_over_orientations_m2([&](double theta) { return cross_section_m2(plate(), theta, area_m2); });
    EXPECT_NEAR(db_from_linear(measured / expected), 0.0, 0.5) << part_of_square_wavelength << " λ²";
  }
}

// What passes by is taken from the fields; directions are drawn as if all were met.
TEST(FlatFace, SmallOnesPassOnWhatTheyMeet) {
  const double area_m2 = 0.042 * plate_wavelength * plate_wavelength;
  const Facet face(plate_normal, static_cast<float>(1.0 / area_m2));
  const CookTorrance small = plate();
  // The same mirrors as ground without end, whose slopes are as wide as diffraction makes those of a small face.
  const CookTorrance wide{{{1.0, 0.0, 1e9, 0.0}, std::sqrt(0.5)}, plate_frequency_hz};
  const double met = 0.5 / (1e-8 + plate_wavelength * plate_wavelength / (4.0 * pi * area_m2));
  const Vec3f to_source = normalized(Vec3f{0.3F, 0.1F, 0.8F}), to_sink = normalized(Vec3f{-0.5F, 0.4F, 0.7F});
  const PolarizationBasis basis(-to_source);
  const FieldPair in{{basis.v, {}}, {basis.h, {}}};
  const Passage passed = small.pass_on(in, to_source, to_sink, face, {});
  const Passage reference = wide.pass_on(in, to_source, to_sink, plate_normal, {});
  EXPECT_NEAR(passed.fields.mean_power(), met * reference.fields.mean_power(), 1e-5 * reference.fields.mean_power());
  EXPECT_FLOAT_EQ(passed.pdf, reference.pdf);
  EXPECT_FLOAT_EQ(passed.reverse_pdf, reference.reverse_pdf);
  EXPECT_FLOAT_EQ(small.sample(to_source, face, {0.3F, 0.6F}).pdf,
                  wide.sample(to_source, plate_normal, {0.3F, 0.6F}).pdf);
}

/// An octahedron whose triangles were halved along all edges so many times, blown up to a sphere.
scene::Mesh sphere_mesh(float radius_m, int halvings) {
  scene::Mesh mesh;
  mesh.vertices = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
  for (int halving = 0; halving < halvings; ++halving) {
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [a, b, c] : std::exchange(mesh.triangles, {})) {
      const auto between = [&mesh](std::uint32_t i, std::uint32_t j) {
        mesh.vertices.push_back(normalized(mesh.vertices[i] + mesh.vertices[j]));
        return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
      };
      const std::uint32_t ab = between(a, b), bc = between(b, c), ca = between(c, a);
      for (const auto& part : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) finer.push_back(part);
    }
    mesh.triangles = std::move(finer);
  }
  for (Vec3f& vertex : mesh.vertices) vertex = vertex * radius_m;
  return mesh;
}

// 131 072 triangles of a sphere are a fifth of a wavelength wide: they diffract as the skin that they are, not as
// plates.
TEST(CurvedSkin, ReturnsAsMuchHoweverFinelyItIsCut) {
  constexpr double radius_m = 2.5, alpha = 0.1, wavelength_m = 0.23;
  const CookTorrance surface({{1.0, 0.0, 1e9, 0.0}, alpha}, speed_of_light_mps / wavelength_m);
  const Vec3f to_radar = normalized(Vec3f{0.3F, 0.2F, 0.8F});
  for (const int halvings : {4, 7}) {
    const scene::Mesh mesh = sphere_mesh(static_cast<float>(radius_m), halvings);
    const std::vector<float> areas_m2 = scene::facet_areas_m2(mesh);
    double sum_m2 = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto [a, b, c] = mesh.triangles[t];
      const Vec3f doubled = cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
      const Vec3f normal = normalized(doubled);
      const float cosine = dot(normal, to_radar);
      if (cosine <= 0.0F) continue;
      const float brdf = surface.backscatter(to_radar, {normal, 1.0F / areas_m2[t]}).vv;
      sum_m2 += 2.0 * pi * static_cast<double>(brdf * cosine * cosine * length(doubled));
    }
    validation::expect_close(
        {.group = "Flat faces",
         .name = fmt::format("rough sphere of {} triangles over πa², 23 cm", mesh.triangles.size()),
         .expected = 1.0 + alpha * alpha / 2.0 - std::pow(alpha, 4) / 4.0,
         .measured = sum_m2 / (pi * radius_m * radius_m),
         .tolerance = 0.02,
         .unit = "",
         .source = "geometric optics, ∫ √(1 + α² x) e^(−x) dx"});
  }
}

// The diffuse part of a façade adds to the lobe as power, whatever the phases of single draws.
TEST(Facade, PartsAddAsPowers) {
  CookTorranceParameters parameters{{5.24, 0.0, 0.0462, 0.7822}, 0.3};
  parameters.scattering_coefficient = 0.6;
  parameters.depolarization = {0.2, 0.3};
  const CookTorrance facade(parameters, plate_frequency_hz);
  const Vec3f to_radar = normalized(Vec3f{0.3F, 0.1F, 1.0F});
  const radar::Channels expected = facade.backscatter(to_radar, plate_normal);
  const PolarizationBasis basis(-to_radar);
  radar::Channels mean;
  constexpr int draws = 40'000;
  for (int i = 0; i < draws; ++i) {
    const PhaseDraw draw{unit_float(hashed(1, i)), unit_float(hashed(2, i))};
    const FieldPair out = facade.scatter({{basis.v, {}}, {basis.h, {}}}, to_radar, to_radar, plate_normal, draw);
    const Amplitude vv = out.from_v.along(basis.v), hh = out.from_h.along(basis.h);
    mean += radar::Channels{power_of(vv), power_of(hh), power_of(out.from_v.along(basis.h)), correlation_of(vv, hh)} *
            (1.0F / draws);
  }
  EXPECT_NEAR(mean.vv, expected.vv, 0.01F * expected.vv);
  EXPECT_NEAR(mean.hh, expected.hh, 0.01F * expected.hh);
  EXPECT_NEAR(mean.hv, expected.hv, 0.01F * expected.vv);
  EXPECT_NEAR(mean.re_vvhh, expected.re_vvhh, 0.01F * expected.vv);
  EXPECT_GT(expected.hv, 0.0F);
}

// Lobe and diffuse part together return what the mirrors alone would, no more.
TEST(Facade, StaysPassive) {
  for (const double s : {0.3, 0.7, 1.0}) {
    CookTorranceParameters parameters{{1.0, 0.0, 1e9, 0.0}, 0.1};
    parameters.scattering_coefficient = s;
    const CookTorrance facade(parameters, plate_frequency_hz);
    const Vec3f to_source = normalized(Vec3f{1.0F, 0.0F, 1.0F});
    const PolarizationBasis basis(-to_source);
    double albedo = 0.0;
    constexpr int draws = 40'000;
    for (int i = 0; i < draws; ++i) {
      const auto next = facade.sample(to_source, plate_normal, {unit_float(hashed(3, i)), unit_float(hashed(4, i))});
      if (next.pdf <= 0.0F || next.direction.z <= 0.0F) continue;
      const FieldPair out = facade.scatter({{basis.v, {}}, {basis.h, {}}}, to_source, next.direction, plate_normal,
                                           {unit_float(hashed(5, i)), unit_float(hashed(6, i))});
      albedo += static_cast<double>(out.mean_power() * next.direction.z / next.pdf) / draws;
    }
    EXPECT_LE(albedo, 1.005) << "S = " << s;
    EXPECT_GE(albedo, 0.98) << "S = " << s;
  }
}

}  // namespace
}  // namespace sigmascape::scatter
