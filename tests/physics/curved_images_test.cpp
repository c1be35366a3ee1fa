#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/product/slant_projection.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/simulate/coherent.h"

namespace sigmascape {
namespace {

constexpr std::string_view curved_earth_group = "Images over the curved Earth";
constexpr double distance_m = 60e3;

/// So far north of the origin, level at 120 m above the sea.
terrain::HeightField far_ground() {
  return {
      .west_m = -500.0, .north_m = distance_m + 500.0, .spacing_m = 50.0, .height_m = Array2D<float>(21, 21, 120.0F)};
}
const radar::Rectangle far_area{-100.0, distance_m - 100.0, 100.0, distance_m + 100.0};

/// Over the origin, flying east, over an Earth of 4/3.
radar::Radar high_radar(radar::Mode mode) {
  radar::Radar radar;
  radar.mode = mode;
  radar.position = {0.0, 0.0, 5000.0};
  radar.velocity_mps = {200.0, 0.0, 0.0};
  radar.range_resolution_m = 2.0;
  radar.waveform.pulse_repetition_hz = 1000.0;
  radar.earth_refraction = 4.0 / 3.0;
  return radar;
}

/// Straight lines in the bent frame have the lengths of the closed form.
TEST(BentFrame, has_the_slant_ranges_of_the_curved_earth) {
  const radar::CurvedEarth earth;
  const Vec2d foot{300.0, -700.0};
  for (const double radar_m : {100.0, 5000.0, 12e3}) {
    for (const double d : {10.0, 5e3, 60e3, 250e3}) {
      for (const double height_m : {-50.0, 0.0, 1500.0}) {
        const Vec3d point{foot.x + d * std::sin(0.7), foot.y + d * std::cos(0.7), height_m};
        const Vec3d seen = earth.bent(point, foot);
        EXPECT_NEAR(length(seen - Vec3d{foot.x, foot.y, radar_m}), earth.slant_range_m(radar_m, height_m, d), 1e-4);
        EXPECT_NEAR(std::atan2(seen.x - foot.x, seen.y - foot.y), 0.7, 1e-12);
      }
    }
  }
  const Vec3d anywhere{3.0, 4.0, 5.0};
  EXPECT_EQ(radar::CurvedEarth::flat().bent(anywhere, foot), anywhere);
}

/// Pulses and images have a target at the slant range over the curved Earth, 24 m from that of a flat one, and the map
/// puts it back where it is.
TEST(CurvedImages, have_the_range_of_the_curved_earth_and_map_it_back) {
  const auto terrain = far_ground();
  radar::Target target;
  target.track = radar::Track::straight({21.0, distance_m - 33.0, 121.0});
  target.rcs_m2 = radar::Channels{1e4F, 1e4F, 0.0F, 1e4F};
  const std::vector<radar::Target> targets{target};
  const simulate::CoherentScene scene{&terrain, [](Vec2d, const radar::Aspect&) { return radar::Channels{}; }, targets};
  const double expected_m = radar::CurvedEarth{}.slant_range_m(5000.0, 121.0, std::hypot(21.0, distance_m - 33.0));
  const auto brightest = [](const auto& bins, const auto& power_of) {
    std::size_t best = 0;
    for (std::size_t i = 0; i < bins.size(); ++i) {
      if (power_of(bins.values()[i]) > power_of(bins.values()[best])) best = i;
    }
    return best;
  };
  const auto of_amplitude = [](const radar::ComplexChannels& bin) { return static_cast<double>(std::norm(bin.vv)); };
  const auto radar = high_radar(radar::Mode::Spotlight);
  const auto pulses = simulate::phase_history(scene, radar, far_area, {.interval_s = 0.004});
  const std::size_t sample = brightest(pulses.samples, of_amplitude) % pulses.samples.columns();
  validation::expect_close({curved_earth_group, "range of a target in pulses", expected_m,
                            pulses.first_range_m + static_cast<double>(sample) * pulses.range_step_m,
                            0.6 * pulses.range_step_m, "m", "4/3 Earth"});
  EXPECT_GT(expected_m - std::hypot(21.0, distance_m - 33.0, 5000.0 - 121.0), 15.0);

  const radar::GroundGrid grid{-80.0, distance_m + 80.0, 1.0, 160, 160};
  const simulate::CoherentSettings settings{.interval_s = 2.0, .along_resolution_m = 2.0};
  const auto sharp = simulate::range_doppler_image(scene, radar, far_area, settings);
  const auto strip = simulate::stripmap_image(scene, high_radar(radar::Mode::Stripmap), far_area, settings);
  const std::size_t at = brightest(sharp.amplitude_m, of_amplitude) / sharp.amplitude_m.columns();
  validation::expect_close({curved_earth_group, "range of a target in an image", expected_m,
                            sharp.range_m.middle_of(static_cast<double>(at) + 0.5), sharp.range_m.step, "m",
                            "4/3 Earth"});
  for (const auto& map :
       {product::projected_to_ground(sharp, terrain, grid), product::projected_to_ground(strip, terrain, grid)}) {
    const std::size_t best = brightest(map.sigma0, [](const radar::Channels& cell) {
      return std::isnan(cell.vv) ? 0.0 : static_cast<double>(cell.vv);
    });
    const Vec2d found = grid.centre_of(best % grid.columns, best / grid.columns);
    EXPECT_NEAR(found.x, 21.0, 1.6);
    EXPECT_NEAR(found.y, distance_m - 33.0, 1.6);
  }
}

/// Ground has the grazing angle that the curved Earth gives it, and none is seen beyond the horizon.
TEST(CurvedImages, see_ground_at_its_grazing_angle_as_far_as_the_horizon) {
  const auto terrain = far_ground();
  const radar::CurvedEarth earth;
  std::vector<double> elevations(1, 0.0);
  const render::Reflectivity field = [&elevations](Vec2d place, const radar::Aspect& aspect) {
    if (std::abs(place.x) < 2.0 && std::abs(place.y - distance_m) < 2.0) elevations[0] = aspect.elevation_rad;
    return radar::Channels{0.1F, 0.1F, 0.0F, 0.0F};
  };
  const radar::ScattererLattice lattice({.seed = 1, .cell_m = 4.0});
  const auto seen_from = [&](double height_m) {
    return render::ground_scatterers(
        terrain, field, lattice,
        {.vantage = radar::Vantage(Vec3d{0.0, 0.0, height_m}), .area = far_area, .threads = 1, .earth = earth});
  };
  EXPECT_GT(seen_from(5000.0).size(), 2000U);
  validation::expect_close({curved_earth_group, "grazing angle 60 km off",
                            deg_from_radians(std::asin(earth.sin_grazing(5000.0, 120.0, distance_m))),
                            deg_from_radians(elevations[0]), 0.01, "°", "4/3 Earth"});
  // The patch of terrain alone stands in the way, and what lies below its own horizontal is seen by nobody: at 60 km
  // the sea has sunk by 212 m.
  EXPECT_LT(seen_from(200.0).size(), 100U);
  const simulate::Obstructions obstructions{terrain, nullptr, earth};
  EXPECT_EQ(simulate::part_seen(obstructions, {0.0, 0.0, 5000.0}, {0.0, distance_m, 120.5}), 1.0);
  EXPECT_EQ(simulate::part_seen(obstructions, {0.0, 0.0, 200.0}, {0.0, distance_m, 120.5}), 0.0);
}

}  // namespace
}  // namespace sigmascape
