#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/product/slant_projection.h"
#include "sigmascape/simulate/coherent.h"

namespace sigmascape {
namespace {

constexpr std::string_view coherent_map_group = "Coherent maps";

struct MapCell {
  std::size_t column = 0, row = 0;
};

MapCell brightest_cell(const radar::GroundMap& map) {
  MapCell best;
  for (std::size_t row = 0; row < map.grid.rows; ++row) {
    for (std::size_t column = 0; column < map.grid.columns; ++column) {
      if (map.sigma0(column, row).vv > map.sigma0(best.column, best.row).vv) best = {column, row};
    }
  }
  return best;
}

double mean_db_over(const radar::GroundMap& map, double sigma0) {
  double sum = 0.0, count = 0.0;
  for (const radar::Channels& cell : map.sigma0.values()) {
    if (std::isnan(cell.vv)) continue;
    sum += cell.vv;
    count += 1.0;
  }
  return db_from_linear(sum / count / sigma0);
}

/// Even ground has its σ0 on the map and a target stands where it is, at any squint and in each coherent mode.
TEST(CoherentMap, shows_sigma0_and_targets_where_they_are) {
  const terrain::HeightField terrain{
      .west_m = -1000.0, .north_m = 1000.0, .spacing_m = 50.0, .height_m = Array2D<float>(41, 41, 20.0F)};
  const radar::Rectangle area{-220.0, -220.0, 220.0, 220.0};
  const radar::GroundGrid grid{.west_m = -120.0, .north_m = 120.0, .cell_m = 1.0, .columns = 240, .rows = 240};
  const float sigma0 = 0.02F;
  const render::Reflectivity even = [sigma0](Vec2d, const radar::Aspect&) {
    return radar::Channels{sigma0, sigma0, 0.0F, 0.0F};
  };
  radar::Target target;
  target.track = radar::Track::straight({40.5, -30.5, 20.0});
  target.rcs_m2 = radar::Channels{3000.0F, 3000.0F, 0.0F, 3000.0F};
  const std::vector<radar::Target> targets{target};
  for (const double squint_deg : {90.0, 50.0}) {
    radar::Radar radar;
    // Flies north; the middle of the area lies at this angle off the nose.
    radar.position =
        radar::position_seeing({0.0, 0.0, 20.0}, pi + radians_from_deg(squint_deg), radians_from_deg(15.0), 6000.0);
    radar.velocity_mps = {0.0, 120.0, 0.0};
    radar.range_resolution_m = 2.0;
    radar.waveform.pulse_repetition_hz = 4000.0;
    const std::string at = ", " + std::to_string(static_cast<int>(squint_deg)) + "° off the nose";
    const simulate::CoherentScene ground{&terrain, even},
        alone{&terrain, [](Vec2d, const radar::Aspect&) { return radar::Channels{}; }, targets};
    const simulate::CoherentSettings settings{.interval_s = 0.4, .along_resolution_m = 2.0};
    const auto map =
        product::projected_to_ground(simulate::range_doppler_image(ground, radar, area, settings), terrain, grid);
    validation::expect_close({coherent_map_group, "σ0 of even ground, range–Doppler" + at, 0.0,
                              mean_db_over(map, sigma0), 0.2, "dB", "σ0 put in"});
    const auto strip =
        product::projected_to_ground(simulate::stripmap_image(ground, radar, area, settings), terrain, grid);
    validation::expect_close({coherent_map_group, "σ0 of even ground, stripmap" + at, 0.0, mean_db_over(strip, sigma0),
                              0.2, "dB", "σ0 put in"});
    for (const auto& shown :
         {product::projected_to_ground(simulate::range_doppler_image(alone, radar, area, settings), terrain, grid),
          product::projected_to_ground(simulate::stripmap_image(alone, radar, area, settings), terrain, grid)}) {
      const MapCell place = brightest_cell(shown);
      const Vec2d centre = grid.centre_of(place.column, place.row);
      EXPECT_NEAR(centre.x, 40.5, 1.01);
      EXPECT_NEAR(centre.y, -30.5, 1.01);
    }
  }
}

}  // namespace
}  // namespace sigmascape
