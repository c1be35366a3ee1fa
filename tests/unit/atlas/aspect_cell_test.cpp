#include "sigmascape/atlas/aspect_cell.h"

#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <vector>

#include "sigmascape/base/units.h"

namespace sigmascape::atlas {
namespace {

AspectGrid uneven_grid() {
  AspectGrid grid;
  for (const double degrees : {12.0, 40.0, 100.0, 190.0, 330.0}) grid.azimuths_rad.push_back(radians_from_deg(degrees));
  for (const double degrees : {5.0, 13.0, 37.0}) grid.elevations_rad.push_back(radians_from_deg(degrees));
  grid.frequencies_hz = {4e9, 9e9, 16e9};
  return grid;
}

/// Part of each look by the cells: linear over the middle of a cell's width in azimuth, over its two cotangents in
/// elevation, where γ = σ0 / sin ψ is blended, and by the parts of the frequencies.
std::map<LookIndex, double> parts_by_cells(const AspectCells& cells, const radar::Aspect& aspect) {
  const double cotangent = 1.0 / std::tan(aspect.elevation_rad);
  const AspectCell cell{cells.azimuth_cell(aspect.azimuth_rad), cells.elevation_cell(static_cast<float>(cotangent))};
  const double width_rad = cells.azimuth_width(cell.azimuth);
  const double along = wrapped_azimuth(aspect.azimuth_rad - cells.azimuth_start(cell.azimuth)) / width_rad;
  EXPECT_GE(along, 0.0);
  EXPECT_LE(along, 1.0);
  const double right = part_of_second_azimuth(along, width_rad);
  const double below = static_cast<double>(cells.cotangents()[cell.elevation]);
  const double above = static_cast<double>(cells.cotangents()[cell.elevation + 1U]);
  const double up = (below - cotangent) / (below - above);
  const auto looks = cells.looks_of(cell);
  std::map<LookIndex, double> parts;
  for (std::size_t i = 0; i < cells.looks_a_cell(); ++i) {
    const std::size_t azimuth = i % 2, elevation = i / 2 % 2;
    parts[looks[i]] += (azimuth == 1 ? right : 1.0 - right) * (elevation == 1 ? up : 1.0 - up) *
                       std::sin(aspect.elevation_rad) / static_cast<double>(cells.sine(cell.elevation + elevation)) *
                       static_cast<double>(cells.frequency_part(i / 4));
  }
  return parts;
}

TEST(AspectCells, GiveEveryLookThePartThatTheMapsGiveIt) {
  const AspectGrid grid = uneven_grid();
  for (const double frequency_hz : {4e9, 6e9, 9e9, 15e9}) {
    const AspectCells cells(grid, frequency_hz);
    for (const double azimuth_deg : {0.0, 5.0, 11.9, 12.1, 24.0, 29.0, 39.0, 75.0, 143.0, 150.0, 171.0, 189.0, 260.0,
                                     329.0, 331.0, 350.0, 359.9}) {
      for (const double elevation_deg : {5.5, 8.6, 12.9, 20.0, 36.0}) {
        const radar::Aspect aspect{radians_from_deg(azimuth_deg), radians_from_deg(elevation_deg)};
        std::map<LookIndex, double> parts = parts_by_cells(cells, aspect);
        const AspectWeights weights = weights_for(grid, aspect, frequency_hz);
        for (std::size_t i = 0; i < weights.count; ++i)
          parts[weights.look[i]] -= static_cast<double>(weights.weight[i]);
        for (const auto& [look, difference] : parts)
          EXPECT_NEAR(difference, 0.0, 1e-5)
              << azimuth_deg << "°, " << elevation_deg << "°, " << frequency_hz << " Hz, look " << look;
      }
    }
  }
}

TEST(AspectCells, TheLastAzimuthAndTheFirstAreNeighboursAcrossNorth) {
  const AspectGrid grid = uneven_grid();
  const AspectCells cells(grid, 9e9);
  ASSERT_EQ(cells.azimuth_cells(), 5U);
  EXPECT_NEAR(deg_from_radians(cells.azimuth_width(4)), 42.0, 1e-9);
  for (const double azimuth_deg : {330.0, 350.0, 360.0, 0.0, 371.0, -10.0, 11.0})
    EXPECT_EQ(cells.azimuth_cell(radians_from_deg(azimuth_deg)), 4U) << azimuth_deg;
  EXPECT_EQ(cells.azimuth_cell(radians_from_deg(12.5)), 0U);
  EXPECT_EQ(cells.azimuth_cell(radians_from_deg(329.5)), 3U);
  const auto looks = cells.looks_of({4, 0});
  EXPECT_EQ(looks[0], grid.index_of(4, 0, 1));
  EXPECT_EQ(looks[1], grid.index_of(0, 0, 1));
  EXPECT_EQ(looks[2], grid.index_of(4, 1, 1));
  EXPECT_EQ(looks[3], grid.index_of(0, 1, 1));
}

TEST(AspectCells, OneElevationAndOneAzimuthAreTheirOwnNeighbours) {
  AspectGrid grid = uneven_grid();
  grid.azimuths_rad = {radians_from_deg(30.0)};
  grid.elevations_rad = {radians_from_deg(10.0)};
  const AspectCells cells(grid, 4e9);
  EXPECT_NEAR(cells.azimuth_width(0), 2.0 * pi, 1e-12);
  EXPECT_EQ(cells.azimuth_cell(radians_from_deg(29.0)), 0U);
  EXPECT_EQ(cells.elevation_cells(), 1U);
  for (std::size_t i = 0; i < cells.looks_a_cell(); ++i) EXPECT_EQ(cells.looks_of({0, 0})[i], 0U);
}

}  // namespace
}  // namespace sigmascape::atlas
