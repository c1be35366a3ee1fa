#include "sigmascape/product/map_metrics.h"

#include <cmath>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>

#include "scratch_folder.h"
#include "unit/product/made_up_map.h"

#include "sigmascape/base/error.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/geo/coordinate_reference_system.h"
#include "sigmascape/geo/local_frame.h"
#include "sigmascape/product/block_mean.h"

namespace sigmascape::product {
namespace {

using radar::GroundMap;
using radar::Polarization;

double rough(std::size_t column, std::size_t row) {
  return 0.01 + static_cast<double>(unit_float(hashed(column, row)));
}

CompareOptions at_cells(std::vector<double> cells_m) {
  return {.cells_m = std::move(cells_m), .polarization = Polarization::VV};
}

TEST(MapMetrics, EqualMapsAgreeAtEveryCellSize) {
  const GroundMap map = map_of(64, 64, rough);
  const MapComparison comparison = compare_maps(map, map);
  ASSERT_EQ(comparison.at.size(), 5U);
  for (const CellComparison& row : comparison.at) {
    const double blocks = 64.0 * 2.0 / row.cell_m;
    EXPECT_EQ(row.cells, static_cast<std::size_t>(blocks * blocks));
    EXPECT_NEAR(row.correlation_db, 1.0, 1e-12);
    EXPECT_EQ(row.rms_db, 0.0);
    EXPECT_EQ(row.bias_db, 0.0);
    EXPECT_EQ(row.l1, 0.0);
    EXPECT_EQ(row.shadow_iou, 1.0);
  }
}

TEST(MapMetrics, GainOfTwoIsThreeDecibelsOfBiasAndFullCorrelation) {
  const GroundMap truth = map_of(32, 32, rough);
  const GroundMap tested = map_of(32, 32, [](auto c, auto r) { return 2.0 * rough(c, r); });
  for (const CellComparison& row : compare_maps(tested, truth).at) {
    EXPECT_NEAR(row.bias_db, 3.0103, 1e-4);
    EXPECT_NEAR(row.rms_db, 3.0103, 1e-4);
    EXPECT_NEAR(row.l1, 1.0, 1e-6);
    EXPECT_NEAR(row.correlation_db, 1.0, 1e-9);
  }
}

TEST(MapMetrics, AnInfiniteCellIsRefusedWithItsPlace) {
  const GroundMap map = map_of(16, 16, rough);
  GroundMap bright = map;
  bright.sigma0(5, 3).hh = std::numeric_limits<float>::infinity();
  EXPECT_THAT(message_of_error([&] { static_cast<void>(compare_maps(bright, map)); }),
              ::testing::StartsWith("the tested map, column 5, row 3: is infinite"));
  EXPECT_THAT(message_of_error([&] { static_cast<void>(compare_maps(map, bright)); }),
              ::testing::StartsWith("the truth, column 5, row 3: is infinite"));
  EXPECT_NO_THROW(static_cast<void>(compare_maps(bright, map, at_cells({})))) << "of VV alone";
}

TEST(MapMetrics, SwappingTheMapsTurnsTheBiasRound) {
  const GroundMap a = map_of(16, 16, rough);
  const GroundMap b = map_of(16, 16, [](auto c, auto r) { return 0.5 * rough(r + 7, c); });
  const CellComparison forth = compare_maps(a, b, at_cells({4.0})).at.front();
  const CellComparison back = compare_maps(b, a, at_cells({4.0})).at.front();
  EXPECT_GT(forth.bias_db, 1.0);
  EXPECT_NEAR(forth.bias_db, -back.bias_db, 1e-12);
  EXPECT_NEAR(forth.rms_db, back.rms_db, 1e-12);
  EXPECT_NEAR(forth.correlation_db, back.correlation_db, 1e-12);
  EXPECT_EQ(forth.shadow_iou, back.shadow_iou);
  EXPECT_NE(forth.l1, back.l1);
}

TEST(MapMetrics, NegatedDecibelsAreFullyAnticorrelated) {
  const GroundMap truth = map_of(16, 16, rough);
  const GroundMap tested = map_of(16, 16, [](auto c, auto r) { return 0.1 / rough(c, r); });
  EXPECT_NEAR(compare_maps(tested, truth, at_cells({2.0})).at.front().correlation_db, -1.0, 1e-6);
}

TEST(MapMetrics, ChequerboardAgainstItsInverseCancelsInBlocks) {
  const GroundMap white = map_of(8, 8, [](auto c, auto r) { return (c + r) % 2 == 0 ? 1.0 : 0.1; });
  const GroundMap black = map_of(8, 8, [](auto c, auto r) { return (c + r) % 2 == 1 ? 1.0 : 0.1; });
  const MapComparison comparison = compare_maps(white, black, at_cells({2.0, 4.0}));
  EXPECT_NEAR(comparison.at[0].correlation_db, -1.0, 1e-9);
  EXPECT_NEAR(comparison.at[0].rms_db, 10.0, 1e-5);
  EXPECT_NEAR(comparison.at[0].l1, 0.9 / 0.55, 1e-6);
  EXPECT_NEAR(comparison.at[0].bias_db, 0.0, 1e-9);
  EXPECT_NEAR(comparison.at[1].rms_db, 0.0, 1e-9);
  EXPECT_NEAR(comparison.at[1].l1, 0.0, 1e-9);
}

TEST(MapMetrics, CyclicShiftOfARampHasItsKnownCorrelation) {
  // dB values 0..3 against 1, 2, 3, 0: covariance −1/4 over variance 5/4.
  const auto db = [](std::size_t c) { return std::pow(10.0, static_cast<double>(c) / 10.0); };
  const GroundMap truth = map_of(4, 1, [&](auto c, auto) { return db(c); });
  const GroundMap tested = map_of(4, 1, [&](auto c, auto) { return db((c + 1) % 4); });
  const CellComparison row = compare_maps(tested, truth, at_cells({2.0})).at.front();
  EXPECT_NEAR(row.correlation_db, -0.2, 1e-6);
  EXPECT_NEAR(row.rms_db, std::sqrt(3.0), 1e-6);
}

TEST(MapMetrics, ShadowOverlapCountsCells) {
  const auto dark_between = [](std::size_t first, std::size_t last) {
    return map_of(16, 4, [=](auto c, auto) { return c >= first && c < last ? 1e-5 : 0.1; });
  };
  const auto iou = [&](const GroundMap& a, const GroundMap& b) {
    return compare_maps(a, b, at_cells({2.0})).at.front().shadow_iou;
  };
  EXPECT_EQ(iou(dark_between(0, 4), dark_between(8, 12)), 0.0);
  EXPECT_NEAR(iou(dark_between(0, 4), dark_between(2, 6)), 1.0 / 3.0, 1e-12);
  EXPECT_EQ(iou(dark_between(3, 9), dark_between(3, 9)), 1.0);
  EXPECT_EQ(iou(dark_between(0, 0), dark_between(0, 0)), 1.0);
  EXPECT_EQ(iou(dark_between(0, 0), dark_between(1, 2)), 0.0);
}

TEST(MapMetrics, ShadowLimitIsTheCallersChoice) {
  const GroundMap dim = map_of(4, 4, [](auto, auto) { return 1e-3; });
  const GroundMap bright = map_of(4, 4, [](auto, auto) { return 1.0; });
  CompareOptions options = at_cells({2.0});
  EXPECT_EQ(compare_maps(dim, bright, options).at.front().shadow_iou, 1.0);
  options.shadow_db = -29.0;
  EXPECT_EQ(compare_maps(dim, bright, options).at.front().shadow_iou, 0.0);
}

TEST(MapMetrics, BelowTheFloorAllIsEqual) {
  const GroundMap black = map_of(4, 4, [](auto, auto) { return 0.0; });
  const GroundMap nearly_black = map_of(4, 4, [](auto c, auto) { return c == 0 ? 1e-9 : 1e-6; });
  EXPECT_EQ(compare_maps(black, nearly_black, at_cells({2.0})).at.front().rms_db, 0.0);
  CompareOptions deep = at_cells({2.0});
  deep.floor_db = -65.0;
  EXPECT_NEAR(compare_maps(black, nearly_black, deep).at.front().rms_db, std::sqrt(0.75 * 25.0), 1e-4);
}

TEST(MapMetrics, LevelsThatAreNoNumbersAreRefused) {
  const GroundMap map = map_of(4, 4, rough);
  for (const double wrong : {std::nan(""), -std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(static_cast<void>(compare_maps(map, map, {.floor_db = wrong})), Error) << wrong;
    EXPECT_THROW(static_cast<void>(compare_maps(map, map, {.shadow_db = wrong})), Error) << wrong;
  }
}

TEST(MapMetrics, UnseenCellsAreLeftOutWithTheirWholeBlock) {
  const GroundMap truth = map_of(8, 8, rough);
  GroundMap tested = truth;
  tested.sigma0(0, 0).vv = unseen_power;
  tested.sigma0(1, 1).vv = 1000.0F;
  const MapComparison comparison = compare_maps(tested, truth, at_cells({2.0, 4.0}));
  EXPECT_EQ(comparison.at[0].cells, 63U);
  EXPECT_GT(comparison.at[0].l1, 1.0);
  EXPECT_EQ(comparison.at[1].cells, 15U);
  EXPECT_EQ(comparison.at[1].l1, 0.0);
}

TEST(MapMetrics, PolarizationIsChosen) {
  GroundMap truth = map_of(4, 4, rough);
  GroundMap tested = truth;
  for (radar::Channels& cell : truth.sigma0.values()) cell.hv = 0.25F * cell.vv;
  for (radar::Channels& cell : tested.sigma0.values()) cell.hv = 0.75F * cell.vv;
  CompareOptions options = at_cells({2.0});
  EXPECT_EQ(compare_maps(tested, truth, options).at.front().l1, 0.0);
  options.polarization = Polarization::VH;
  EXPECT_NEAR(compare_maps(tested, truth, options).at.front().l1, 2.0, 1e-6);
  options.polarization = Polarization::Sum;
  EXPECT_NEAR(compare_maps(tested, truth, options).at.front().l1, 1.0 / 1.5, 1e-6);
}

TEST(MapMetrics, UsualCellSizesAreThoseThatFitTheMap) {
  const GroundMap map = map_of(12, 12, rough, 4.0);
  const MapComparison comparison = compare_maps(map, map);
  EXPECT_THAT(comparison.options.cells_m, testing::ElementsAre(4.0, 8.0, 16.0, 32.0));
  EXPECT_EQ(comparison.at_cell(32.0)->cells, 1U);
  EXPECT_EQ(comparison.at_cell(2.0), nullptr);
}

void expect_error(const std::function<void()>& call, const std::string& part) {
  try {
    call();
    ADD_FAILURE() << "no error was thrown where one with '" << part << "' was due";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(part));
  }
}

TEST(MapMetrics, MapsOfDifferentCellsAreRefusedSayingHow) {
  const GroundMap truth = map_of(8, 8, rough);
  expect_error([&] { (void)compare_maps(map_of(8, 9, rough), truth); }, "8 x 9 cells, the truth 8 x 8");
  expect_error([&] { (void)compare_maps(map_of(8, 8, rough, 4.0), truth); }, "4 m, the truth's 2 m");
  GroundMap moved = truth;
  moved.grid.west_m += 1.0;
  expect_error([&] { (void)compare_maps(moved, truth); }, "(101, 200) m");
  GroundMap elsewhere = truth;
  elsewhere.crs = "EPSG:32630";
  expect_error([&] { (void)compare_maps(elsewhere, truth); }, "EPSG:32630");
}

// Cells of 2 feet would pass for cells of 2 m.
TEST(MapMetrics, MapsThatDoNotCountInMetresAreRefused) {
  GroundMap map = map_of(8, 8, rough);
  map.crs = "EPSG:2263";
  expect_error([&] { (void)compare_maps(map, map, at_cells({2.0})); },
               "the tested map counts its places in us_ft, and cells are compared by their metres");
  map.crs = "EPSG:4326";
  expect_error([&] { (void)compare_maps(map_of(8, 8, rough), map); }, "the truth counts its places in deg");
}

// A GIS that cuts a map out gives it the frame in words of its own.
TEST(MapMetrics, MapsOfOneFrameInOtherWordsAreCompared) {
  GroundMap truth = map_of(8, 8, rough);
  truth.crs = geo::LocalFrame(43.26, -2.93).proj();
  GroundMap cut_out = truth;
  cut_out.crs = geo::wkt2_from(truth.crs);
  ASSERT_NE(cut_out.crs, truth.crs);
  EXPECT_NO_THROW((void)compare_maps(cut_out, truth, at_cells({2.0})));
}

TEST(MapMetrics, MapsWhoseCellsGoIntoNoUsualSizeAreComparedAtTheirOwn) {
  GroundMap map = map_of(40, 24, rough);
  const auto sizes_at = [&](double cell_m) {
    map.grid.cell_m = cell_m;
    std::vector<double> sizes;
    for (const CellComparison& row : compare_maps(map, map).at) sizes.push_back(row.cell_m);
    return sizes;
  };
  EXPECT_THAT(sizes_at(5.0), testing::ElementsAre(5.0, 10.0, 20.0, 40.0, 80.0));
  EXPECT_THAT(sizes_at(1.0), testing::ElementsAre(2.0, 4.0, 8.0, 16.0)) << "of 32 m there is none in 24 m";
  EXPECT_THAT(sizes_at(4.0), testing::ElementsAre(4.0, 8.0, 16.0, 32.0));
}

TEST(MapMetrics, CellSizesThatCannotBeAreRefused) {
  const GroundMap map = map_of(8, 8, rough);
  expect_error([&] { (void)compare_maps(map, map, at_cells({3.0})); }, "3 m is no multiple");
  expect_error([&] { (void)compare_maps(map, map, at_cells({32.0})); }, "no cell of 32 m");
  const GroundMap blind = map_of(8, 8, [](auto, auto) { return static_cast<double>(unseen_power); });
  expect_error([&] { (void)compare_maps(blind, map); }, "seen wholly by both");
}

TEST(MapMetrics, JsonHasTheStatedKeysAndNothingElseInARow) {
  const GroundMap truth = map_of(16, 16, rough);
  const GroundMap tested = map_of(16, 16, [](auto c, auto r) { return 2.0 * rough(c, r); });
  const MapComparison comparison = compare_maps(tested, truth);
  const auto json = nlohmann::json::parse(comparison_json(comparison, compare_maps(truth, truth)));
  EXPECT_EQ(json["floor_db"], -45.0);
  EXPECT_EQ(json["shadow_db"], -35.0);
  EXPECT_EQ(json["polarization"], "VV+HH+2HV");
  ASSERT_EQ(json["cells"].size(), comparison.at.size());
  ASSERT_EQ(json["noise_floor"].size(), comparison.at.size());
  std::vector<std::string> keys;
  for (const auto& [key, value] : json["cells"][0].items()) keys.push_back(key);
  EXPECT_THAT(keys, testing::UnorderedElementsAre("cell_m", "correlation_db", "rms_db", "bias_db", "l1", "shadow_iou"));
  EXPECT_EQ(json["cells"][1]["cell_m"], 4.0);
  EXPECT_NEAR(json["cells"][1]["bias_db"].get<double>(), 3.0103, 1e-4);
  EXPECT_EQ(json["noise_floor"][1]["bias_db"], 0.0);
}

TEST(MapMetrics, WhatIsNotDefinedIsNullInJsonAndADashInTheTable) {
  const GroundMap flat = map_of(2, 2, [](auto, auto) { return 1.0; });
  const MapComparison comparison = compare_maps(flat, flat, at_cells({2.0}));
  EXPECT_TRUE(std::isnan(comparison.at.front().correlation_db));
  EXPECT_TRUE(nlohmann::json::parse(comparison_json(comparison))["cells"][0]["correlation_db"].is_null());
  EXPECT_THAT(comparison_table(comparison), testing::HasSubstr("               - "));
}

TEST(MapMetrics, TableStatesItsOptionsAndTheNoiseFloorBesideTheNumbers) {
  const GroundMap truth = map_of(4, 4, rough);
  const GroundMap tested = map_of(4, 4, [](auto c, auto r) { return 2.0 * rough(c, r); });
  const std::string table =
      comparison_table(compare_maps(tested, truth, at_cells({2.0})), compare_maps(truth, truth, at_cells({2.0})));
  EXPECT_THAT(table, testing::HasSubstr("+3.01 (0.00)"));
  EXPECT_THAT(table, testing::HasSubstr("-45 dB"));
  EXPECT_THAT(table, testing::HasSubstr("-35 dB"));
}

TEST(MapMetrics, TableSaysThatNoNoiseFloorWasMeasured) {
  const GroundMap map = map_of(4, 4, rough);
  const MapComparison comparison = compare_maps(map, map, at_cells({2.0}));
  EXPECT_THAT(comparison_table(comparison), testing::HasSubstr("noise floor not measured"));
  EXPECT_THAT(comparison_table(comparison, comparison), testing::Not(testing::HasSubstr("not measured")));
}

TEST(MapMetrics, TableSaysNoOverlapOfFewCellsInShadow) {
  const auto with_shadow = [](std::size_t cells) {
    return map_of(8, 8, [cells](auto c, auto r) { return c + 8 * r < cells ? 1e-6 : 1.0; });
  };
  const auto iou_text = [&](std::size_t cells) {
    const GroundMap map = with_shadow(cells);
    return comparison_table(compare_maps(map, map, at_cells({2.0})));
  };
  EXPECT_EQ(compare_maps(with_shadow(3), with_shadow(12), at_cells({2.0})).at.front().shadow_cells, 12U);
  EXPECT_THAT(iou_text(least_shadow_cells), testing::HasSubstr("1.000\nVV"));
  EXPECT_THAT(iou_text(least_shadow_cells - 1), testing::HasSubstr(" -\nVV"));
  const auto iou_json = [&](std::size_t cells) {
    const GroundMap map = with_shadow(cells);
    return nlohmann::json::parse(comparison_json(compare_maps(map, map, at_cells({2.0}))))["cells"][0]["shadow_iou"];
  };
  EXPECT_EQ(iou_json(least_shadow_cells), 1.0);
  EXPECT_TRUE(iou_json(least_shadow_cells - 1).is_null());
}

TEST(BlockMean, LeavesOutWhatFillsNoBlock) {
  const GroundMap map = map_of(5, 7, [](auto c, auto r) { return static_cast<double>(c + 10 * r); });
  const Array2D<double> means = block_mean(map, Polarization::VV, 2);
  ASSERT_EQ(means.columns(), 2U);
  ASSERT_EQ(means.rows(), 3U);
  EXPECT_EQ(means(1, 2), (42.0 + 43.0 + 52.0 + 53.0) / 4.0);
}

}  // namespace
}  // namespace sigmascape::product
