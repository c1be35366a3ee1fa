#include "sigmascape/atlas/aspect_grid.h"

#include <cmath>
#include <gtest/gtest.h>
#include <map>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"

namespace sigmascape::atlas {
namespace {

radar::Aspect aspect_deg(double azimuth_deg, double elevation_deg) {
  return {radians_from_deg(azimuth_deg), radians_from_deg(elevation_deg)};
}

std::map<LookIndex, double> as_map(const AspectWeights& weights) {
  std::map<LookIndex, double> map;
  for (std::size_t i = 0; i < weights.count; ++i) map[weights.look[i]] += static_cast<double>(weights.weight[i]);
  return map;
}

double sum(const AspectWeights& weights) {
  double total = 0.0;
  for (const auto& [look, weight] : as_map(weights)) total += weight;
  return total;
}

AspectGrid two_frequencies() {
  AspectGrid grid = paper_aspect_grid();
  grid.frequencies_hz = {1e9, 4e9};
  return grid;
}

TEST(AspectGrid, ThePaperHasFortyLooksAtTenGigahertz) {
  const AspectGrid grid = paper_aspect_grid();
  EXPECT_NO_THROW(check(grid, "test"));
  EXPECT_EQ(grid.look_count(), 40U);
  EXPECT_DOUBLE_EQ(grid.azimuths_rad[3], radians_from_deg(135.0));
  EXPECT_DOUBLE_EQ(grid.elevations_rad[4], radians_from_deg(37.0));
  EXPECT_EQ(grid.frequencies_hz, std::vector<double>{10e9});
}

TEST(AspectGrid, AzimuthsAreSpreadEvenlyFromNorth) {
  const auto azimuths_rad = even_azimuths(16);
  ASSERT_EQ(azimuths_rad.size(), 16U);
  for (std::size_t i = 0; i < 16; ++i)
    EXPECT_DOUBLE_EQ(azimuths_rad[i], radians_from_deg(22.5 * static_cast<double>(i)));
  EXPECT_EQ(even_azimuths(most_azimuths).size(), 3600U);
  EXPECT_THROW(static_cast<void>(even_azimuths(0)), Error);
  EXPECT_THROW(static_cast<void>(even_azimuths(most_azimuths + 1)), Error);
}

TEST(AspectGrid, LookAndIndexAreInverse) {
  const AspectGrid grid = two_frequencies();
  for (std::size_t f = 0; f < 2; ++f) {
    for (std::size_t e = 0; e < 5; ++e) {
      for (std::size_t a = 0; a < 8; ++a) {
        const radar::Look look = grid.look(grid.index_of(a, e, f));
        EXPECT_EQ(look.aspect.azimuth_rad, grid.azimuths_rad[a]);
        EXPECT_EQ(look.aspect.elevation_rad, grid.elevations_rad[e]);
        EXPECT_EQ(look.frequency_hz, grid.frequencies_hz[f]);
      }
    }
  }
}

TEST(AspectGrid, AxesThatMakeNoSenseAreRefused) {
  AspectGrid grid = paper_aspect_grid();
  grid.azimuths_rad = {0.0, 2.0 * pi};
  EXPECT_THROW(check(grid, "test"), Error);
  grid = paper_aspect_grid();
  grid.elevations_rad = {0.0};
  EXPECT_THROW(check(grid, "test"), Error);
  grid.elevations_rad = {0.3, 0.3};
  EXPECT_THROW(check(grid, "test"), Error);
  grid.elevations_rad = {std::nan("")};
  EXPECT_THROW(check(grid, "test"), Error);
  grid = paper_aspect_grid();
  grid.frequencies_hz.clear();
  EXPECT_THROW(check(grid, "test"), Error);
}

TEST(AspectWeights, EveryBakedLookHasTheOneWeightOne) {
  const AspectGrid grid = two_frequencies();
  for (LookIndex index = 0; index < grid.look_count(); ++index) {
    const radar::Look look = grid.look(index);
    const AspectWeights weights = weights_for(grid, look.aspect, look.frequency_hz);
    ASSERT_EQ(weights.count, 1U) << index;
    EXPECT_EQ(weights.look[0], index);
    EXPECT_EQ(weights.weight[0], 1.0F);
  }
}

TEST(AspectWeights, AzimuthClosesOnItself) {
  const AspectGrid grid = paper_aspect_grid();
  for (const double turn_deg : {-720.0, 0.0, 360.0}) {
    const auto weights = as_map(weights_for(grid, aspect_deg(340.5 + turn_deg, 5.0), 10e9));
    ASSERT_EQ(weights.size(), 2U);
    EXPECT_NEAR(weights.at(grid.index_of(7, 0, 0)), 3.0 / 12.0, 1e-6);
    EXPECT_NEAR(weights.at(grid.index_of(0, 0, 0)), 9.0 / 12.0, 1e-6);
  }
}

// Azimuths 45° apart are blended over 12° about the middle, those 10° apart over all 10°.
TEST(AspectWeights, NeighboursFarApartAreBlendedInTheMiddleAlone) {
  AspectGrid grid = paper_aspect_grid();
  const auto part_of_second = [&](double azimuth_deg) {
    const auto weights = as_map(weights_for(grid, aspect_deg(azimuth_deg, 5.0), 10e9));
    const auto second = weights.find(grid.index_of(1, 0, 0));
    return second == weights.end() ? 0.0 : second->second;
  };
  EXPECT_EQ(part_of_second(1.0), 0.0);
  EXPECT_EQ(part_of_second(16.4), 0.0);
  EXPECT_NEAR(part_of_second(22.5), 0.5, 1e-6);
  EXPECT_NEAR(part_of_second(27.0), 10.5 / 12.0, 1e-6);
  EXPECT_NEAR(part_of_second(28.6), 1.0, 1e-6);
  grid.azimuths_rad = {0.0, radians_from_deg(10.0)};
  EXPECT_NEAR(part_of_second(1.0), 0.1, 1e-6);
  EXPECT_NEAR(part_of_second(8.0), 0.8, 1e-6);
}

TEST(AspectWeights, AGapAcrossNorthThatDoesNotTouchItIsSpanned) {
  AspectGrid grid = paper_aspect_grid();
  grid.azimuths_rad = {radians_from_deg(20.0), radians_from_deg(320.0)};
  const auto west_of_north = as_map(weights_for(grid, aspect_deg(350.0, 5.0), 10e9));
  EXPECT_NEAR(west_of_north.at(1), 0.5, 1e-6);
  const auto east_of_that = as_map(weights_for(grid, aspect_deg(353.0, 5.0), 10e9));
  EXPECT_NEAR(east_of_that.at(0), 0.75, 1e-6);
  EXPECT_NEAR(east_of_that.at(1), 0.25, 1e-6);
  EXPECT_NEAR(as_map(weights_for(grid, aspect_deg(5.0, 5.0), 10e9)).at(0), 1.0, 1e-6);
}

TEST(AspectWeights, ASingleAzimuthServesAllDirections) {
  AspectGrid grid = paper_aspect_grid();
  grid.azimuths_rad = {radians_from_deg(130.0)};
  EXPECT_NEAR(as_map(weights_for(grid, aspect_deg(17.0, 5.0), 10e9)).at(0), 1.0, 1e-6);
}

TEST(AspectWeights, GammaIsLinearInTheCotangentOfElevation) {
  const AspectGrid grid = paper_aspect_grid();
  const double cot_5 = 1.0 / std::tan(radians_from_deg(5.0));
  const double cot_13 = 1.0 / std::tan(radians_from_deg(13.0));
  const double half_way_rad = std::atan(2.0 / (cot_5 + cot_13));
  const auto weights = as_map(weights_for(grid, {0.0, half_way_rad}, 10e9));
  const double sine = std::sin(half_way_rad);
  EXPECT_NEAR(weights.at(grid.index_of(0, 0, 0)), 0.5 * sine / std::sin(radians_from_deg(5.0)), 1e-6);
  EXPECT_NEAR(weights.at(grid.index_of(0, 1, 0)), 0.5 * sine / std::sin(radians_from_deg(13.0)), 1e-6);
}

TEST(AspectWeights, BelowTheLowestElevationPowerGoesWithTheSineAndEndsAtTheHorizon) {
  const AspectGrid grid = paper_aspect_grid();
  const double expected = std::sin(radians_from_deg(2.0)) / std::sin(radians_from_deg(5.0));
  EXPECT_NEAR(sum(weights_for(grid, aspect_deg(10.0, 2.0), 10e9)), expected, 1e-6);
  EXPECT_NEAR(sum(weights_for(grid, aspect_deg(10.0, 1e-4), 10e9)), 0.0, 1e-4);
  EXPECT_EQ(weights_for(grid, aspect_deg(10.0, 0.0), 10e9).count, 0U);
  EXPECT_EQ(weights_for(grid, aspect_deg(10.0, -3.0), 10e9).count, 0U);
}

TEST(AspectWeights, AboveTheHighestElevationTheValueIsHeld) {
  const AspectGrid grid = paper_aspect_grid();
  const auto weights = as_map(weights_for(grid, aspect_deg(90.0, 80.0), 10e9));
  ASSERT_EQ(weights.size(), 1U);
  EXPECT_NEAR(weights.at(grid.index_of(2, 4, 0)), 1.0, 1e-6);
}

TEST(AspectWeights, FrequencyIsLinearInItsLogarithm) {
  const AspectGrid grid = two_frequencies();
  const auto weights = as_map(weights_for(grid, aspect_deg(0.0, 5.0), 2e9));
  EXPECT_NEAR(weights.at(grid.index_of(0, 0, 0)), 0.5, 1e-6);
  EXPECT_NEAR(weights.at(grid.index_of(0, 0, 1)), 0.5, 1e-6);
}

// σ0 = γ sin ψ at every node gives γ sin ψ at every elevation between them.
TEST(AspectWeights, ConstantGammaGroundStaysSoBetweenBakedElevations) {
  const AspectGrid grid = two_frequencies();
  for (int i = 0; i < 500; ++i) {
    const radar::Aspect aspect = aspect_deg(0.72 * i, 5.0 + 0.064 * i);
    const AspectWeights weights = weights_for(grid, aspect, 1e9 + 6e6 * i);
    EXPECT_LE(weights.count, 8U);
    double sigma0 = 0.0;
    for (std::size_t k = 0; k < weights.count; ++k) {
      sigma0 += weights.weight[k] * 0.03 * std::sin(grid.look(weights.look[k]).aspect.elevation_rad);
    }
    EXPECT_NEAR(sigma0, 0.03 * std::sin(aspect.elevation_rad), 1e-7) << i;
  }
}

}  // namespace
}  // namespace sigmascape::atlas
