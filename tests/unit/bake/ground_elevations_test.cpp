#include "sigmascape/bake/ground_elevations.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "sigmascape/atlas/aspect_grid.h"
#include "sigmascape/atlas/texture_name.h"
#include "sigmascape/base/units.h"
#include "sigmascape/scatter/material.h"
#include "sigmascape/scatter/surface_sigma0.h"

namespace sigmascape::bake {
namespace {

scene::Scene ground_of(const scatter::Material& material) {
  scene::Scene scene;
  scene.ground = {{-500, 500, 1000, 1, 1}, Array2D<scene::MaterialIndex>(1, 1, scene.material_index(material))};
  return scene;
}

/// Every 8° from 5°, as the paper has them, and one between tenths of degrees.
atlas::AspectGrid looks_at(const std::vector<double>& frequencies_hz) {
  atlas::AspectGrid looks = atlas::paper_aspect_grid();
  looks.elevations_rad.push_back(radians_from_deg(45.04));
  looks.frequencies_hz = frequencies_hz;
  return looks;
}

/// What is read of ground of one material that is kept at the elevations it needs beside those looks.
class ReadGround {
 public:
  ReadGround(const scatter::Material& material, double frequency_hz)
      : grid_{{0.0}, ground_elevations_rad(ground_of(material), looks_at({frequency_hz})), {frequency_hz}},
        surface_(material, frequency_hz) {}

  [[nodiscard]] std::size_t elevations() const { return grid_.elevations_rad.size(); }
  [[nodiscard]] radar::Channels sigma0(double elevation_rad) const {
    radar::Channels read;
    const auto weights = atlas::weights_for(grid_, {0.0, elevation_rad}, grid_.frequencies_hz.front());
    for (std::size_t i = 0; i < weights.count; ++i) {
      const double kept_rad = grid_.look(weights.look[i]).aspect.elevation_rad;
      read += surface_sigma0(surface_, kept_rad) * weights.weight[i];
    }
    return read;
  }
  /// Of HH, above the floor.
  [[nodiscard]] double error_db(double elevation_rad) const {
    const double floor = linear_from_db(ground_floor_db);
    const auto read = static_cast<double>(sigma0(elevation_rad).hh);
    return db_from_linear((read + floor) / (true_hh(elevation_rad) + floor));
  }
  [[nodiscard]] double true_hh(double elevation_rad) const {
    return static_cast<double>(surface_sigma0(surface_, elevation_rad).hh);
  }

 private:
  atlas::AspectGrid grid_;
  scatter::SurfaceModel surface_;
};

TEST(GroundElevations, ConstantGammaNeedsTwo) {
  const auto library = scatter::material_library();
  const auto grass = std::ranges::find(library, "grass", &scatter::Material::name);
  const auto elevations = ground_elevations_rad(ground_of(*grass), looks_at({5e9, 10e9}));
  ASSERT_EQ(elevations.size(), 2U);
  EXPECT_NEAR(elevations[0], radians_from_deg(0.2), 1e-12);
  EXPECT_NEAR(elevations[1], radians_from_deg(89.0), 1e-12);
}

TEST(GroundElevations, WhatStandsOnTheGroundCountsForNothing) {
  const auto library = scatter::material_library();
  scene::Scene scene = ground_of(*std::ranges::find(library, "grass", &scatter::Material::name));
  static_cast<void>(scene.material_index(*std::ranges::find(library, "concrete", &scatter::Material::name)));
  EXPECT_EQ(ground_elevations_rad(scene, looks_at({10e9})).size(), 2U);
}

// A Lambert surface of albedo ρ returns σ0 = 4 ρ sin² ψ, of which one part in 1 + 0.1 is co-polarized. Its γ is bent
// the same way over most of cot ψ, so that what is read would be too bright on the whole: at looks it is not.
TEST(GroundElevations, ALambertSurfaceIsReadAsItIsAtLooksAndBetweenThem) {
  constexpr double albedo = 0.3, cross = 0.1;
  const ReadGround read({.name = "lambert", .model = scatter::LambertParameters{albedo, {cross, 0.5}}, .source = {}},
                        10e9);
  const auto error_db = [&](double elevation_rad) {
    const double vv = 4.0 * albedo * std::pow(std::sin(elevation_rad), 2.0) / (1.0 + cross);
    return db_from_linear(static_cast<double>(read.sigma0(elevation_rad).vv) / vv);
  };
  for (const double elevation_rad : looks_at({10e9}).elevations_rad)
    EXPECT_NEAR(error_db(elevation_rad), 0.0, at_looks_tolerance_db) << deg_from_radians(elevation_rad) << "°";
  double mean_db = 0.0;
  for (int degrees = 1; degrees < 89; ++degrees) {
    EXPECT_NEAR(error_db(radians_from_deg(degrees)), 0.0, 1.05 * ground_tolerance_db) << degrees << "°";
    mean_db += error_db(radians_from_deg(degrees)) / 88.0;
  }
  EXPECT_LT(mean_db, 0.1);
}

// Between the elevations that were looked at as well: a smooth surface gains 4 dB a degree. Where Billingsley's rows
// follow one another σ0 jumps: nothing is asked there. Below half a degree tenths are too coarse for some seas.
TEST(GroundElevations, EveryMaterialIsReadAsItIs) {
  std::size_t most = 0;
  for (const scatter::Material& material : scatter::material_library()) {
    const auto* mirrors = std::get_if<scatter::CookTorranceParameters>(&material.model);
    if (material.is_medium() || (mirrors != nullptr && mirrors->alpha < 0.05)) continue;
    const double frequency_hz = std::clamp(10e9, material.lowest_frequency_hz, material.highest_frequency_hz);
    const ReadGround read(material, frequency_hz);
    most = std::max(most, read.elevations());
    for (const double elevation_rad : looks_at({frequency_hz}).elevations_rad)
      EXPECT_NEAR(read.error_db(elevation_rad), 0.0, at_looks_tolerance_db)
          << material.name << " at " << deg_from_radians(elevation_rad) << "°";
    double worst_db = 0.0, worst_deg = 0.0;
    for (double degrees = 0.55; degrees < 89.0; degrees += 0.1) {
      const double beside_deg = degrees < 3.0 ? 0.1 : 0.2;
      const double change =
          read.true_hh(radians_from_deg(degrees + beside_deg)) / read.true_hh(radians_from_deg(degrees - beside_deg));
      if (material.name.starts_with("billingsley") && std::abs(db_from_linear(change)) > 0.5) continue;
      const double away_db = std::abs(read.error_db(radians_from_deg(degrees)));
      if (!(away_db <= worst_db)) {
        worst_db = away_db;
        worst_deg = degrees;
      }
    }
    EXPECT_LT(worst_db, 1.1 * ground_tolerance_db) << material.name << " at " << worst_deg << "°";
  }
  EXPECT_LT(most, 60U);
  RecordProperty("most", static_cast<int>(most));
}

// A look at 86.04° and a tenth of a degree would have one name, of which a store has no two. The lobe of a mirror that
// is all but smooth needs all elevations near the vertical that there are to choose from.
TEST(GroundElevations, LooksBetweenTenthsOfDegreesStandForTheTenth) {
  const auto library = scatter::material_library();
  const auto mirror = std::ranges::find(library, "ideal_conductor", &scatter::Material::name);
  atlas::AspectGrid looks{{0.0}, {}, {10e9}};
  for (int i = 0; i < 10; ++i) looks.elevations_rad.push_back(radians_from_deg(86.04 + 0.2 * i));
  std::vector<std::string> names;
  const std::vector<double> elevations = ground_elevations_rad(ground_of(*mirror), looks);
  for (const double elevation_rad : elevations) names.push_back(atlas::look_name({{0.0, elevation_rad}, 10e9}));
  EXPECT_EQ(std::ranges::adjacent_find(names, std::greater_equal{}), names.end());
  EXPECT_NE(std::ranges::find(elevations, looks.elevations_rad[5]), elevations.end());
}

}  // namespace
}  // namespace sigmascape::bake
