#include <cmath>
#include <gtest/gtest.h>

#include "physics/ground_with_box.h"
#include "validation/validation_record.h"

#include "sigmascape/product/slant_projection.h"
#include "sigmascape/simulate/mode_image.h"

namespace sigmascape::physics_test {
namespace {

constexpr radar::GroundGrid grid{-120.0, 120.0, 2.0, 120, 120};

/// Sees the map from the south, 3 km away, flying so far off that direction.
radar::Radar sharpening(double off_course_deg, double repetition_hz) {
  radar::Radar radar;
  radar.mode = radar::Mode::DopplerBeamSharpening;
  radar.frequency_hz = frequency_hz;
  radar.position = radar::position_seeing({}, pi, radians_from_deg(seen_elevation_deg), 3e3);
  const double course = -radians_from_deg(off_course_deg);
  radar.velocity_mps = {100.0 * std::sin(course), 100.0 * std::cos(course), 0.0};
  radar.beam_width_rad = radians_from_deg(4.8);
  radar.range_resolution_m = 4.0;
  radar.waveform.pulse_repetition_hz = repetition_hz;
  radar.processing.looks = 4;
  return radar;
}

/// Over γ sin ψ, on the two outermost columns of the west or the east, of eight seeds.
double edge_db(const atlas::Atlas& atlas, const scene::Scene& scene, const radar::Radar& radar, bool of_west) {
  double sum = 0.0, count = 0.0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const simulate::ModeRequest request{.atlas = atlas,
                                        .terrain = scene.terrain,
                                        .radar = radar,
                                        .grid = grid,
                                        .texture_frequency_hz = frequency_hz,
                                        .seed = seed};
    product::LooksOnGround looks(scene.terrain, grid);
    simulate::mode_looks(request, simulate::mode_plan(request).plan,
                         [&](const simulate::ModeImage& look) { looks.add(std::get<radar::RangeDopplerImage>(look)); });
    const radar::GroundMap map = looks.map();
    for (std::size_t row = 0; row < grid.rows; ++row) {
      for (const std::size_t column : {std::size_t{0}, std::size_t{1}}) {
        const std::size_t at = of_west ? column : grid.columns - 1 - column;
        const Vec2d away = grid.centre_of(at, row) - Vec2d{radar.position.x, radar.position.y};
        const double sine = radar.position.z / std::hypot(length(away), radar.position.z);
        sum += static_cast<double>(map.sigma0(at, row).vv) / (ground_gamma * sine);
        count += 1.0;
      }
    }
  }
  return db_from_linear(sum / count);
}

/// Abeam 240 m span 2 · 100/λ · 240 m/3 km of Doppler, and each rim of two resolutions a third of that: what of the rim
/// pulses fold over would double the outermost columns.
TEST(MapRim, ground_beside_a_map_does_not_fold_onto_its_other_edge) {
  const scene::Scene scene = ground_with_box(0.0, false);
  const atlas::Atlas atlas = baked_from_south(scene, bake::Shadows::RunTime);
  const double span_hz = 2.0 * 100.0 / wavelength_m(frequency_hz) * 240.0 / 3e3;
  for (const bool of_west : {true, false}) {
    validation::expect_close(
        {"Coherent maps",
         std::string("σ0 on the ") + (of_west ? "first" : "last") + " columns, whose rim has the Doppler of the others",
         0.0, edge_db(atlas, scene, sharpening(90.0, 1.02 * span_hz), of_west), 0.35, "dB over γ sin ψ",
         "definition of constant gamma"});
  }
}

/// The middle is 3.1° off the course and the western edge 0.7°, where a cell is more than four times as wide.
TEST(MapRim, reaches_as_far_as_cells_do_towards_the_course) {
  const scene::Scene scene = ground_with_box(0.0, false);
  const atlas::Atlas atlas = baked_from_south(scene, bake::Shadows::RunTime);
  radar::Radar radar = sharpening(3.1, 400.0);
  radar.beam_width_rad = radians_from_deg(2.4);
  validation::expect_close({"Coherent maps", "σ0 on the edge of a map, two thirds of a degree off the course", 0.0,
                            edge_db(atlas, scene, radar, true), 0.6, "dB over γ sin ψ",
                            "definition of constant gamma"});
}

}  // namespace
}  // namespace sigmascape::physics_test
