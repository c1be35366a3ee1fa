#include "sigmascape/bake/ground_elevations.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "sigmascape/atlas/aspect_grid.h"
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

TEST(GroundElevations, ConstantGammaNeedsTwo) {
  const auto library = scatter::material_library();
  const auto grass = std::ranges::find(library, "grass", &scatter::Material::name);
  const auto elevations = ground_elevations_rad(ground_of(*grass), {5e9, 10e9});
  ASSERT_EQ(elevations.size(), 2U);
  EXPECT_NEAR(elevations[0], radians_from_deg(0.2), 1e-12);
  EXPECT_NEAR(elevations[1], radians_from_deg(89.0), 1e-12);
}

TEST(GroundElevations, WhatStandsOnTheGroundCountsForNothing) {
  const auto library = scatter::material_library();
  scene::Scene scene = ground_of(*std::ranges::find(library, "grass", &scatter::Material::name));
  static_cast<void>(scene.material_index(*std::ranges::find(library, "concrete", &scatter::Material::name)));
  EXPECT_EQ(ground_elevations_rad(scene, {10e9}).size(), 2U);
}

// Between the elevations that were looked at as well: a smooth surface gains 4 dB a degree. Where Billingsley's rows
// follow one another σ0 jumps: nothing is asked there.
TEST(GroundElevations, EveryMaterialIsReadAsItIs) {
  std::size_t most = 0;
  for (const scatter::Material& material : scatter::material_library()) {
    const auto* mirrors = std::get_if<scatter::CookTorranceParameters>(&material.model);
    if (material.is_medium() || (mirrors != nullptr && mirrors->alpha < 0.05)) continue;
    const double frequency_hz = std::clamp(10e9, material.lowest_frequency_hz, material.highest_frequency_hz);
    const atlas::AspectGrid grid{{0.0}, ground_elevations_rad(ground_of(material), {frequency_hz}), {frequency_hz}};
    most = std::max(most, grid.elevations_rad.size());
    const scatter::SurfaceModel surface(material, frequency_hz);
    const double floor = linear_from_db(ground_floor_db);
    double worst_db = 0.0, worst_deg = 0.0;
    for (double degrees = 0.25; degrees < 89.0; degrees += 0.1) {
      const double elevation_rad = radians_from_deg(degrees);
      double read = 0.0;
      const auto weights = atlas::weights_for(grid, {0.0, elevation_rad}, frequency_hz);
      for (std::size_t i = 0; i < weights.count; ++i) {
        const double baked_rad = grid.look(weights.look[i]).aspect.elevation_rad;
        read += static_cast<double>(weights.weight[i] * surface_sigma0(surface, baked_rad).hh);
      }
      const auto hh_at = [&](double at_deg) {
        return static_cast<double>(surface_sigma0(surface, radians_from_deg(at_deg)).hh);
      };
      const double beside_deg = degrees < 3.0 ? 0.1 : 0.2;
      const double change = hh_at(degrees + beside_deg) / hh_at(degrees - beside_deg);
      if (material.name.starts_with("billingsley") && std::abs(db_from_linear(change)) > 0.5) continue;
      const double away_db = std::abs(db_from_linear((read + floor) / (hh_at(degrees) + floor)));
      if (away_db > worst_db) {
        worst_db = away_db;
        worst_deg = degrees;
      }
    }
    EXPECT_LT(worst_db, 1.3 * ground_tolerance_db) << material.name << " at " << worst_deg << "°";
  }
  EXPECT_LT(most, 40U);
  RecordProperty("most", static_cast<int>(most));
}

}  // namespace
}  // namespace sigmascape::bake
