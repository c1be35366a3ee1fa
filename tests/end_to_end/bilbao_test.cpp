#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>
#include <optional>

#include "end_to_end/real_data.h"
#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/product/ground_projection.h"
#include "sigmascape/scene/scene_file.h"
#include "sigmascape/simulate/simulate.h"

namespace sigmascape::end_to_end {
namespace {

using radar::GroundMap;

constexpr double azimuth_rad = 130.0 * pi / 180.0;
constexpr double elevation_rad = 20.0 * pi / 180.0;

class BilbaoMap : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const auto file = std::filesystem::path(SIGMASCAPE_SOURCE_DIR) / "examples/bilbao/bilbao.toml";
    if (std::filesystem::exists(data_folder() / "bilbao")) scene_ = scene::read_scene(file);
  }
  void SetUp() override {
    if (!scene_) GTEST_SKIP() << "the folder bilbao is not in " << data_folder() << "; set SIGMASCAPE_DATA";
  }

  /// Direct echoes alone of `scene`, seen from 20 km away.
  static GroundMap map_of(const scene::Scene& scene, const radar::Rectangle& area, double cell_m,
                          double from_azimuth_rad, double from_elevation_rad = elevation_rad) {
    const Vec2d centre = area.centre();
    const radar::Radar radar{
        .position = radar::position_seeing({centre.x, centre.y, 0.0}, from_azimuth_rad, from_elevation_rad, 20e3),
        .frequency_hz = 10e9,
        .range_resolution_m = cell_m,
        .beam_width_rad = std::numbers::sqrt2 * cell_m / 20e3};
    const trace::SceneGeometry geometry(scene, trace::Footing::Terrain);
    trace::TraceCounts counts;
    const auto image = simulate::traced_image(scene, geometry, radar, area,
                                              {.cell_m = cell_m, .samples_per_cell = 16, .max_bounces = 1}, counts);
    return product::ground_map(image, scene.terrain,
                               {area.west_m, area.north_m, cell_m, static_cast<std::size_t>(area.width_m() / cell_m),
                                static_cast<std::size_t>(area.height_m() / cell_m)});
  }

  static inline std::optional<scene::Scene> scene_;
};

/// Where along a line of values, in steps from its middle, they first pass `level`; the line begins on the low side.
std::optional<double> crossing(const std::vector<double>& values, double level) {
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i - 1] < level && values[i] >= level) {
      const double step = (level - values[i - 1]) / (values[i] - values[i - 1]);
      return static_cast<double>(i - 1) + step - 0.5 * static_cast<double>(values.size() - 1);
    }
  }
  return std::nullopt;
}

/// σ0 along a line of cells that runs from the water onto the land.
std::vector<double> profile_of(const GroundMap& map, std::size_t column, std::size_t row, int d_column, int d_row,
                               int reach) {
  std::vector<double> profile;
  for (int step = -reach; step <= reach; ++step) {
    const auto c = static_cast<std::size_t>(static_cast<int>(column) + step * d_column);
    const auto r = static_cast<std::size_t>(static_cast<int>(row) + step * d_row);
    profile.push_back(map.sigma0(c, r).vv);
  }
  return profile;
}

// The river lies in the map where the land cover has it: from water to open ground the map changes within a cell of the
// border of the classes, whichever way the shore faces. Single places scatter more, for banks and piers are there too.
TEST_F(BilbaoMap, ShorelineIsWhereTheLandCoverHasIt) {
  constexpr double cell_m = 5.0;
  constexpr int reach = 4;
  const radar::Rectangle area{-1650.0, -1650.0, 1650.0, 1650.0};
  // From this high the banks, some metres tall, neither shade nor lie over a whole cell.
  const GroundMap map = map_of(*scene_, area, cell_m, azimuth_rad, radians_from_deg(45.0));
  const auto material_name = [&](std::size_t column, std::size_t row) {
    return scene_->materials[scene_->ground.at(map.grid.centre_of(column, row))].name;
  };
  std::map<std::pair<int, int>, std::vector<double>> offsets;  // by the direction from the water to the land
  for (std::size_t row = 10; row + 10 < map.grid.rows; ++row) {
    for (std::size_t column = 10; column + 10 < map.grid.columns; ++column) {
      for (const auto& [dc, dr] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        // Water on one side and open grass on the other, all along the line: no trees or walls that shadow or lie over.
        // At 45° a bank moves by its height and shades as much, so banks taller than half a cell are left out.
        const auto along = [&](int step) {
          return material_name(static_cast<std::size_t>(static_cast<int>(column) + step * dc),
                               static_cast<std::size_t>(static_cast<int>(row) + step * dr));
        };
        bool clean = true;
        for (int step = 1; step <= reach && clean; ++step) clean = along(step) == "grass" && along(1 - step) == "water";
        const Vec2d inland = map.grid.centre_of(static_cast<std::size_t>(static_cast<int>(column) + reach * dc),
                                                static_cast<std::size_t>(static_cast<int>(row) + reach * dr));
        if (!clean || scene_->terrain.height_at(inland) > 0.5 * cell_m) continue;
        const auto profile = profile_of(map, column, row, dc, dr, reach);
        // Half of the land's power: where a symmetric response centred on the border puts it, water being all but
        // black.
        const double half = 0.25 * (profile[profile.size() - 1] + profile[profile.size() - 2]);
        // The border lies half a cell beyond the last cell of water, which is the middle of the profile.
        if (const auto at = crossing(profile, half)) offsets[{dc, dr}].push_back(*at - 0.5);
      }
    }
  }
  ASSERT_EQ(offsets.size(), 4U);
  for (auto& [direction, found] : offsets) {
    ASSERT_GT(found.size(), 50U);
    std::ranges::nth_element(found, found.begin() + static_cast<std::ptrdiff_t>(found.size() / 2));
    const std::string name = fmt::format("offset of the shoreline, land {} columns east and {} rows south of the water",
                                         direction.first, direction.second);
    validation::expect_close(
        {"Bilbao", name, 0.0, found[found.size() / 2], 0.5, "cells of 5 m", "land cover of the data"});
    EXPECT_GT(std::ranges::count_if(found, [](double offset) { return std::abs(offset) <= 2.0; }),
              0.9 * static_cast<double>(found.size()));
  }
}

/// The direction in which buildings darken the ground, clockwise from each one's own line of sight from
/// `expected_azimuth_rad`, 20 km away: how much darkness lies along each direction from a tall building's centre out to
/// its shadow's length; then the centre of the peak.
double shadow_off_sight_rad(const scene::Scene& scene, const GroundMap& with, const GroundMap& without,
                            double expected_azimuth_rad) {
  const Vec2d radar = with.grid.extent().centre() +
                      radar::horizontal_direction(expected_azimuth_rad) * (20e3 * std::cos(elevation_rad));
  constexpr int directions = 720;
  std::vector<double> darkness(directions, 0.0);
  for (const scene::Building& building : scene.buildings.items) {
    Vec2d centre{};
    float height = 0.0F;
    for (std::uint32_t i = 0; i < building.vertex_count; ++i) {
      const Vec3f v = scene.buildings.mesh.vertices[building.first_vertex + i];
      centre = centre + Vec2d{v.x, v.y} * (1.0 / building.vertex_count);
      height = std::max(height, v.z);
    }
    if (height < 12.0F) continue;
    const double length_m = height / std::tan(elevation_rad);
    const double sight_rad = std::atan2(centre.x - radar.x, centre.y - radar.y);
    for (int k = 0; k < directions; ++k) {
      const Vec2d direction = radar::horizontal_direction(sight_rad + 2.0 * pi * k / directions);
      for (double part = 0.3; part < 0.95; part += 0.1) {
        const Vec2d cells = with.grid.cells_from(centre + direction * (part * length_m));
        if (cells.x < 0.0 || cells.y < 0.0 || cells.x >= static_cast<double>(with.grid.columns) ||
            cells.y >= static_cast<double>(with.grid.rows))
          continue;
        const auto column = static_cast<std::size_t>(cells.x), row = static_cast<std::size_t>(cells.y);
        const float lit = without.sigma0(column, row).vv;
        if (std::isnan(lit) || lit <= 0.0F) continue;
        if (with.sigma0(column, row).vv < 0.1F * lit) darkness[static_cast<std::size_t>(k)] += 1.0;
      }
    }
  }
  const double least = *std::ranges::min_element(darkness), most = *std::ranges::max_element(darkness);
  double east = 0.0, north = 0.0;
  for (int k = 0; k < directions; ++k) {
    const double weight = std::max(0.0, darkness[static_cast<std::size_t>(k)] - 0.5 * (least + most));
    const Vec2d direction = radar::horizontal_direction(2.0 * pi * k / directions);
    east += weight * direction.x;
    north += weight * direction.y;
  }
  return std::atan2(east, north);
}

TEST_F(BilbaoMap, BuildingShadowsPointAwayFromTheRadar) {
  const radar::Rectangle area{-1600.0, -1600.0, 1600.0, 1600.0};
  scene::Scene towns = *scene_;
  towns.instances.clear();
  scene::Scene bare = towns;
  bare.buildings = {};
  const auto off_deg = [&](double seen_from_rad) {
    const auto with = map_of(towns, area, 4.0, seen_from_rad), without = map_of(bare, area, 4.0, seen_from_rad);
    return deg_from_radians(shadow_off_sight_rad(towns, with, without, azimuth_rad));
  };
  validation::expect_close({"Bilbao", "direction of building shadows, off the line of sight", 0.0, off_deg(azimuth_rad),
                            2.0, "degrees", "geometry"});
  // With east and west exchanged the same check fails.
  EXPECT_GT(std::abs(off_deg(2.0 * pi - azimuth_rad)), 2.0);
}

}  // namespace
}  // namespace sigmascape::end_to_end
