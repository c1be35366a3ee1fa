#include <cmath>
#include <complex>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <span>
#include <vector>

#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/scatter/fresnel.h"

namespace sigmascape::physics_test {
namespace {

using Complex = std::complex<double>;

struct Mirror {
  Vec3d normal;
  std::complex<float> permittivity;
};

constexpr std::complex<float> conductor{1.0F, -1e14F};
constexpr std::complex<float> concrete{5.24F, -0.503F};
constexpr std::complex<float> medium_dry_ground{11.915F, -2.684F};

/// Elements S_pq for transmit p and receive q, both in the basis of the wave that the radar sends (backscatter
/// alignment).
struct ScatteringMatrix {
  Complex vv, vh, hv, hh;
};

Complex element(const scatter::Field& field, Vec3f unit) {
  const scatter::Amplitude a = field.along(unit);
  return {a.re, a.im};
}

Vec3d mirrored(Vec3d travel, Vec3d normal) {
  return travel - normal * (2.0 * dot(travel, normal));
}

/// Follows a wave from mirror to mirror and back to the radar that sent it.
ScatteringMatrix round_trip(Vec3d travel, std::span<const Mirror> mirrors) {
  const scatter::PolarizationBasis radar(travel.to<float>());
  scatter::FieldPair fields{{radar.v, {}}, {radar.h, {}}};
  for (const Mirror& mirror : mirrors) {
    const Vec3d next = mirrored(travel, mirror.normal);
    fields = scatter::reflected(fields, mirror.permittivity, travel.to<float>(), next.to<float>(),
                                mirror.normal.to<float>());
    travel = next;
  }
  return {element(fields.from_v, radar.v), element(fields.from_v, radar.h), element(fields.from_h, radar.v),
          element(fields.from_h, radar.h)};
}

void expect_element(std::string_view target, const char* name, Complex expected, Complex measured,
                    double tolerance = 2e-6) {
  const auto part = [&](const char* of, double e, double m) {
    validation::expect_close({.group = "Corner reflectors",
                              .name = fmt::format("{}, {} {}", target, of, name),
                              .expected = e,
                              .measured = m,
                              .tolerance = tolerance,
                              .unit = "1",
                              .source = "image theory for an ideal conductor"});
  };
  part("Re", expected.real(), measured.real());
  part("Im", expected.imag(), measured.imag());
}

void expect_matrix(std::string_view target, const ScatteringMatrix& expected, const ScatteringMatrix& measured) {
  expect_element(target, "S_VV", expected.vv, measured.vv);
  expect_element(target, "S_VH", expected.vh, measured.vh);
  expect_element(target, "S_HV", expected.hv, measured.hv);
  expect_element(target, "S_HH", expected.hh, measured.hh);
}

Vec3d turned_about_north(Vec3d a, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return {c * a.x + s * a.z, a.y, c * a.z - s * a.x};
}

/// A dihedral whose edge lies across the line of sight (northward, level), turned about that line.
std::vector<Mirror> dihedral_mirrors(double turn_rad) {
  const double half = std::sqrt(0.5);
  return {{turned_about_north({0.0, -half, half}, turn_rad), conductor},
          {turned_about_north({0.0, -half, -half}, turn_rad), conductor}};
}

TEST(CornerReflectors, DihedralTurnedAboutTheLineOfSight) {
  for (const double turn_deg : {0.0, 22.5, 45.0, 90.0}) {
    const double twice = 2.0 * radians_from_deg(turn_deg);
    // Two reflections by a conductor keep the field along the edge e and reverse it across: S = 2 e eᵀ − 1. Looking
    // north h is west and v is down, so that the edge (cos ψ, 0, −sin ψ) has the components h = −cos ψ and v = sin ψ.
    const ScatteringMatrix measured = round_trip({0.0, 1.0, 0.0}, dihedral_mirrors(radians_from_deg(turn_deg)));
    const double cross = -std::sin(twice);
    expect_matrix(fmt::format("dihedral turned by {}°", turn_deg), {-std::cos(twice), cross, cross, std::cos(twice)},
                  measured);
  }
}

TEST(CornerReflectors, DihedralOnTheGroundAtAnyElevation) {
  for (const double incidence_deg : {20.0, 45.0, 70.0}) {
    const double theta = radians_from_deg(incidence_deg);
    const Vec3d travel{0.0, std::sin(theta), -std::cos(theta)};
    const std::vector<Mirror> corner{{{0.0, 0.0, 1.0}, conductor}, {{0.0, -1.0, 0.0}, conductor}};
    expect_matrix(fmt::format("wall and ground, incidence {}°", incidence_deg), {-1.0, 0.0, 0.0, 1.0},
                  round_trip(travel, corner));
  }
}

TEST(CornerReflectors, TrihedralIsTheIdentityFromAnywhere) {
  const std::vector<Mirror> corner{
      {{1.0, 0.0, 0.0}, conductor}, {{0.0, 1.0, 0.0}, conductor}, {{0.0, 0.0, 1.0}, conductor}};
  for (const double azimuth_deg : {15.0, 45.0, 70.0}) {
    for (const double elevation_deg : {10.0, 35.26, 60.0}) {
      const double phi = radians_from_deg(azimuth_deg), psi = radians_from_deg(elevation_deg);
      const Vec3d travel{-std::cos(psi) * std::cos(phi), -std::cos(psi) * std::sin(phi), -std::sin(psi)};
      expect_matrix(fmt::format("trihedral, azimuth {}°, elevation {}°", azimuth_deg, elevation_deg),
                    {1.0, 0.0, 0.0, 1.0}, round_trip(travel, corner));
    }
  }
}

/// Wall and ground in the order wall, ground. The wall is an exact mirror turned by `turn_rad`; the ground facet is the
/// one that sends the wave home.
std::vector<Mirror> wall_then_ground(Vec3d travel, double turn_rad, std::complex<float> wall,
                                     std::complex<float> ground) {
  const Vec3d wall_normal{std::sin(turn_rad), -std::cos(turn_rad), 0.0};
  return {{wall_normal, wall}, {normalized(-travel - mirrored(travel, wall_normal)), ground}};
}

TEST(CornerReflectors, TurnedMirrorWallOverGround) {
  const struct {
    double turn_deg, cross_db, hh;
  } rows[] = {{5.0, -12.00, 0.9698}, {10.0, -5.49, 0.8829}, {20.0, 2.93, 0.5811}, {30.0, 13.80, 0.2000}};
  const double theta = radians_from_deg(45.0);
  const Vec3d travel{0.0, std::sin(theta), -std::cos(theta)};
  for (const auto& row : rows) {
    const std::vector<Mirror> corner = wall_then_ground(travel, radians_from_deg(row.turn_deg), conductor, conductor);
    const ScatteringMatrix s = round_trip(travel, corner);
    const auto report = [&](const char* name, double expected, double measured, double tolerance, const char* unit) {
      validation::expect_close(
          {.group = "Corner reflectors",
           .name = fmt::format("mirror wall turned by {}° over ground, incidence 45°, {}", row.turn_deg, name),
           .expected = expected,
           .measured = measured,
           .tolerance = tolerance,
           .unit = unit,
           .source = "separate Jones-matrix calculation"});
    };
    report("HV/HH", row.cross_db, db_from_linear(std::norm(s.hv) / std::norm(s.hh)), 0.006, "dB");
    report("|S_HH|", row.hh, std::abs(s.hh), 6e-5, "1");

    const std::vector<Mirror> reversed_corner{corner[1], corner[0]};
    const ScatteringMatrix reversed = round_trip(travel, reversed_corner);
    report("|S_HV − S_VH of the other order|", 0.0, std::abs(s.hv - reversed.vh), 1e-6, "1");
    report("|S_HH − S_HH of the other order|", 0.0, std::abs(s.hh - reversed.hh), 1e-6, "1");
    report("|S_VV − S_VV of the other order|", 0.0, std::abs(s.vv - reversed.vv), 1e-6, "1");
  }
}

TEST(CornerReflectors, ConcreteWallOnMediumDryGround) {
  const struct {
    double incidence_deg, hh_db, vv_db;
  } rows[] = {{30.0, -8.57, -25.16}, {45.0, -9.44, -18.88}, {60.0, -9.64, -20.05}};
  for (const auto& row : rows) {
    const double theta = radians_from_deg(row.incidence_deg);
    const Vec3d travel{0.0, std::sin(theta), -std::cos(theta)};
    const ScatteringMatrix s = round_trip(travel, wall_then_ground(travel, 0.0, concrete, medium_dry_ground));
    const auto report = [&](const char* name, double expected, double measured, double tolerance, const char* unit) {
      validation::expect_close({.group = "Corner reflectors",
                                .name = fmt::format("concrete wall on medium dry ground, 10 GHz, incidence {}°, {}",
                                                    row.incidence_deg, name),
                                .expected = expected,
                                .measured = measured,
                                .tolerance = tolerance,
                                .unit = unit,
                                .source = "separate Jones-matrix calculation"});
    };
    report("HH", row.hh_db, db_from_linear(std::norm(s.hh)), 0.006, "dB");
    report("VV", row.vv_db, db_from_linear(std::norm(s.vv)), 0.006, "dB");
    report("HV", 0.0, std::abs(s.hv), 1e-6, "1");
    if (row.incidence_deg == 45.0)
      report("phase HH − VV", -175.0, deg_from_radians(std::arg(s.hh * std::conj(s.vv))), 0.5, "°");
  }
}

}  // namespace
}  // namespace sigmascape::physics_test
