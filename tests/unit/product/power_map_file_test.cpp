#include "sigmascape/product/power_map_file.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scratch_folder.h"

#include "sigmascape/geo/geo_raster.h"
#include "sigmascape/geo/local_frame.h"
#include "sigmascape/product/described_map.h"
#include "sigmascape/product/ground_map_file.h"
#include "sigmascape/product/map_file.h"
#include "sigmascape/product/reprojection.h"

namespace sigmascape::product {
namespace {

const geo::LocalFrame frame(43.26, -2.93);

/// Powers from 1e-18 to 1e-9 W, a cell without any and one that was not looked at.
radar::PowerMap made_up_power() {
  radar::PowerMap map{.grid = {-150.5, 301.25, 0.75, 300, 41},
                      .power_w = Array2D<radar::Channels>(300, 41),
                      .noise_w = 3.25e-15,
                      .crs = {},
                      .metadata = {}};
  for (std::size_t i = 0; i < map.power_w.size(); ++i) {
    const float power = std::pow(10.0F, -18.0F + 9.0F * static_cast<float>(i) / 12300.0F);
    map.power_w.values()[i] = {power, 0.5F * power, 0.01F * power, -power};
  }
  map.power_w(3, 2) = {};
  const float nan = std::nanf("");
  map.power_w(7, 7) = {nan, nan, nan, nan};
  return described_map(std::move(map), radar::Radar{.name = "mapper"}, frame, {{"seed", "4"}});
}

TEST(DescribedMap, SaysWhereTheRadarStandsUnlessOverWhatItMaps) {
  const radar::PowerMap map = made_up_power();
  const Vec2d middle = map.grid.extent().centre();
  const auto described_from = [&](Vec3d position) {
    return described_map(map, radar::Radar{.position = position}, frame, {}).metadata;
  };
  EXPECT_EQ(described_from({middle.x + 1000.0, middle.y - 1000.0, 500.0}).at(radar_azimuth_key), "135.00");
  EXPECT_EQ(described_from({middle.x - 2000.0, middle.y, 500.0}).at(radar_azimuth_key), "270.00");
  EXPECT_FALSE(described_from({middle.x, middle.y, 500.0}).contains(radar_azimuth_key));
}

TEST(PowerMapFile, HoldsWattsPerPolarizationWithTheirUnit) {
  const ScratchFolder folder;
  const auto written = made_up_power();
  write_map(folder.path("power.tif"), written);
  const auto raster = geo::read_geotiff(folder.path("power.tif"));
  ASSERT_EQ(raster.bands.size(), 3U);
  EXPECT_EQ(raster.bands[0].name + raster.bands[1].name + raster.bands[2].name, "VVHHHV");
  for (const auto& band : raster.bands) EXPECT_EQ(band.unit, "W");
  EXPECT_EQ(raster.metadata.at("radar"), "mapper");
  EXPECT_EQ(raster.metadata.at("noise_w"), "3.25e-15");
  EXPECT_EQ(raster.metadata.at("quantity"), "mean power of one compressed pulse at the antenna's terminals");

  const auto read = read_power_map(folder.path("power.tif"));
  EXPECT_EQ(read.grid, written.grid);
  EXPECT_EQ(read.crs, written.crs);
  EXPECT_EQ(read.metadata, written.metadata);
  EXPECT_EQ(read.noise_w, 3.25e-15);
  for (std::size_t i = 0; i < read.power_w.size(); ++i) {
    const auto& got = read.power_w.values()[i];
    const auto& put = written.power_w.values()[i];
    if (std::isnan(put.vv)) {
      EXPECT_TRUE(std::isnan(got.vv) && std::isnan(got.hh) && std::isnan(got.hv));
    } else {
      ASSERT_TRUE(got.vv == put.vv && got.hh == put.hh && got.hv == put.hv) << i;
    }
  }
}

TEST(PowerMapFile, HoldsDecibelsOverAWattWithOverviewsOfTheMeanPower) {
  const ScratchFolder folder;
  const auto written = made_up_power();
  write_map(folder.path("power.tif"), written, MapScale::Decibels);
  const auto raster = geo::read_geotiff(folder.path("power.tif"));
  ASSERT_EQ(raster.bands.size(), 3U);
  for (const auto& band : raster.bands) EXPECT_EQ(band.unit, "dBW");
  for (std::size_t i = 0; i < written.power_w.size(); ++i) {
    const float power = written.power_w.values()[i].hh;
    if (power > 0.0F) {
      ASSERT_NEAR(raster.bands[1].values.values()[i], 10.0 * std::log10(static_cast<double>(power)), 1e-4);
    }
  }
  EXPECT_EQ(raster.bands[0].values(3, 2), -300.0F);
  EXPECT_TRUE(std::isnan(raster.bands[0].values(7, 7)));
  const auto read = read_power_map(folder.path("power.tif"));
  EXPECT_NEAR(read.power_w(200, 20).vv / written.power_w(200, 20).vv, 1.0, 2e-5);
  EXPECT_EQ(read.metadata, written.metadata);
}

TEST(PowerMapFile, IsNotTakenForReflectivityNorTheOtherWayRound) {
  const ScratchFolder folder;
  radar::GroundMap sigma0{.grid = {0.0, 0.0, 1.0, 4, 4},
                          .sigma0 = Array2D<radar::Channels>(4, 4, {1.0F, 1.0F, 1.0F, 1.0F}),
                          .crs = frame.proj(),
                          .metadata = {}};
  for (const MapScale scale : {MapScale::Linear, MapScale::Decibels}) {
    write_map(folder.path("power.tif"), made_up_power(), scale);
    write_map(folder.path("sigma0.tif"), sigma0, scale);
    EXPECT_THAT(message_of_error([&] { (void)read_ground_map(folder.path("power.tif")); }),
                testing::HasSubstr("give a map of \"sigma0"));
    EXPECT_THAT(message_of_error([&] { (void)read_power_map(folder.path("sigma0.tif")); }),
                testing::HasSubstr("give a map of \"mean power"));
  }
}

TEST(PowerMap, KeepsItsWattsInAnotherCoordinateSystem) {
  auto map = made_up_power();
  for (auto& cell : map.power_w.values()) cell = {2e-12F, 1e-12F, 1e-14F, 0.0F};
  const auto turned = reprojected(map, frame, "EPSG:25830");
  EXPECT_EQ(turned.crs, "EPSG:25830");
  EXPECT_EQ(turned.noise_w, map.noise_w);
  auto kept = turned.metadata;
  EXPECT_EQ(kept.extract("local_frame").mapped(), frame.proj()) << "in which the radar's place is told";
  EXPECT_EQ(kept, map.metadata);
  std::size_t seen = 0;
  for (const auto& cell : turned.power_w.values()) {
    if (std::isnan(cell.vv)) continue;
    ASSERT_NEAR(cell.vv / 2e-12F, 1.0, 1e-5);
    ++seen;
  }
  EXPECT_GT(seen, 11000U);
}

}  // namespace
}  // namespace sigmascape::product
