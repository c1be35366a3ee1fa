#include "sigmascape/terrain/terrain_pyramid.h"

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <sys/stat.h>
#include <thread>

#include "keep_worst.h"
#include "scratch_folder.h"
#include "unit/geo/ascii_grid.h"
#include "unit/terrain/round_hills.h"

#include "sigmascape/geo/geo_raster.h"
#include "sigmascape/terrain/pyramid_builder.h"
#include "sigmascape/terrain/pyramid_faults.h"
#include "sigmascape/terrain/pyramid_files.h"
#include "sigmascape/terrain/pyramid_levels.h"
#include "sigmascape/terrain/terrain_window.h"

namespace sigmascape::terrain {
namespace {

using ::testing::HasSubstr;

/// 5 × 3 tiles of rough hills, 5 m apart.
HeightField rough(std::size_t columns = 1100, std::size_t rows = 700) {
  HeightField field{.west_m = -1000.0, .north_m = 2000.0, .spacing_m = 5.0, .height_m = Array2D<float>(columns, rows)};
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const double x = static_cast<double>(column), y = static_cast<double>(row);
      field.height_m(column, row) =
          static_cast<float>(200.0 + 90.0 * std::sin(0.011 * x + 0.004 * y) + 8.0 * std::cos(0.17 * y - 0.13 * x) +
                             2.0 * std::sin(1.3 * x * y));
    }
  }
  return field;
}

/// The window's surface as a field, to be asked anywhere.
HeightField surface_of(const TerrainView& view) {
  HeightField field{.west_m = view.extent().west_m,
                    .north_m = view.extent().north_m,
                    .spacing_m = view.spacing_m,
                    .height_m = Array2D<float>(view.columns, view.rows)};
  std::ranges::copy(view.height_m, field.height_m.values().begin());
  return field;
}

TEST(TerrainPyramid, LevelZeroIsTheFieldItself) {
  const HeightField field = rough();
  TerrainPyramid pyramid = pyramid_in_memory(field);
  EXPECT_EQ(pyramid.layout().tiles_across, 5U);
  EXPECT_EQ(pyramid.layout().tiles_down, 3U);
  EXPECT_EQ(pyramid.levels(), 4);
  TerrainWindow window(1500);
  const auto report = window.fill(pyramid, field.extent(), 0);
  EXPECT_EQ(report.level, 0);
  EXPECT_EQ(report.tiles, 15U);
  const HeightField seen = surface_of(window.view());
  for (double x = -990.0; x < 4400.0; x += 37.3) {
    for (double y = -1400.0; y < 1990.0; y += 41.7)
      ASSERT_FLOAT_EQ(static_cast<float>(seen.height_at({x, y})), static_cast<float>(field.height_at({x, y})));
  }
}

TEST(TerrainPyramid, NoPointLiesFurtherFromATileThanItsError) {
  const HeightField field = rough();
  TerrainPyramid pyramid = pyramid_in_memory(field);
  for (int level = 1; level < pyramid.levels(); ++level) {
    float furthest = 0.0F, stated = 0.0F;
    const TileKey key{level, 0, 0};
    const auto tile = pyramid.load(key);
    stated = pyramid.summary(key).error_m;
    const double nodes = static_cast<double>(1U << static_cast<unsigned>(level));
    for (std::size_t row = 0; row < std::min<std::size_t>(700, 256U << static_cast<unsigned>(level)); ++row) {
      for (std::size_t column = 0; column < std::min<std::size_t>(1100, 256U << static_cast<unsigned>(level));
           ++column) {
        const float surface = tile->at(static_cast<double>(column) / nodes, static_cast<double>(row) / nodes);
        keep_worst(furthest, std::abs(surface - field.height_m(column, row)));
      }
    }
    EXPECT_LE(furthest, stated + 1e-3F);
    EXPECT_GT(furthest, 0.2F * stated) << "the bound is idle";
  }
}

/// What a pyramid says of its tiles, one array a level.
std::vector<Array2D<TileSummary>> summaries_of(const TerrainPyramid& pyramid) {
  std::vector<Array2D<TileSummary>> levels;
  for (int level = 0; level < pyramid.levels(); ++level) {
    Array2D<TileSummary>& tiles = levels.emplace_back(pyramid.layout().across(level), pyramid.layout().down(level));
    for (std::uint32_t row = 0; row < tiles.rows(); ++row) {
      for (std::uint32_t column = 0; column < tiles.columns(); ++column)
        tiles(column, row) = pyramid.summary({level, column, row});
    }
  }
  return levels;
}

TEST(TerrainPyramid, NeighboursShareTheirEdges) {
  TerrainPyramid pyramid = pyramid_in_memory(rough());
  for (int level = 0; level < pyramid.levels(); ++level) {
    for (std::uint32_t column = 0; column + 1 < pyramid.layout().across(level); ++column) {
      const auto west = pyramid.load({level, column, 0}), east = pyramid.load({level, column + 1, 0});
      for (std::size_t row = 0; row < HeightTile::nodes; ++row) {
        ASSERT_EQ(west->height_m[row * HeightTile::nodes + HeightTile::cells], east->height_m[row * HeightTile::nodes]);
      }
    }
  }
}

/// Height of a pyramid's ground at a node of level 0, as the finest tile has it that is there of those over `tile`.
float finest_there(TerrainPyramid& pyramid, TileKey tile, std::size_t column, std::size_t row) {
  std::shared_ptr<const HeightTile> there = pyramid.load(tile);
  for (; !there; there = pyramid.load(tile)) tile = tile.parent();
  const double cells = static_cast<double>(HeightTile::cells), scale = std::ldexp(1.0, -tile.level);
  return there->at(scale * static_cast<double>(column) - cells * tile.column,
                   scale * static_cast<double>(row) - cells * tile.row);
}

TEST(TerrainWindow, LevelsMeetWithoutCracks) {
  // Every other tile of the finest level cannot be had, nor one of the next: tiles of three levels lie side by side.
  TerrainPyramid whole = pyramid_in_memory(rough());
  const PyramidLayout& layout = whole.layout();
  const auto read = [&whole](TileKey key) {
    if ((key.level == 0 && (key.column + key.row) % 2 == 0) || key == TileKey{1, 0, 0})
      throw Error("tile", "is missing", "");
    return whole.load(key);
  };
  TerrainPyramid pyramid(layout, whole.extent(), summaries_of(whole), read, 100 * HeightTile::bytes);
  TerrainWindow window(1500);
  EXPECT_EQ(window.fill(pyramid, layout.extent(), 0).lacking.size(), 8U);
  // One lattice of nodes, bilinear between them: a node on an edge has the height of one of the two sides.
  const TerrainView view = window.view();
  std::size_t edges = 0;
  for (std::size_t row = 0; row + 1 < view.rows; ++row) {
    for (std::size_t column = 0; column + 1 < view.columns; ++column) {
      const auto tile_of = [](std::size_t c, std::size_t r) {
        return TileKey{0, static_cast<std::uint32_t>(c / HeightTile::cells),
                       static_cast<std::uint32_t>(r / HeightTile::cells)};
      };
      const std::size_t before_column = column - std::min<std::size_t>(column, 1),
                        before_row = row - std::min<std::size_t>(row, 1);
      const std::array heights{finest_there(pyramid, tile_of(column, row), column, row),
                               finest_there(pyramid, tile_of(before_column, row), column, row),
                               finest_there(pyramid, tile_of(column, before_row), column, row),
                               finest_there(pyramid, tile_of(before_column, before_row), column, row)};
      edges += heights[0] != heights[3] ? 1 : 0;
      ASSERT_THAT(heights, ::testing::Contains(view.height_m[row * view.columns + column])) << column << ", " << row;
    }
  }
  EXPECT_GT(edges, 1000U);
}

TEST(TerrainWindow, TakesTheFinestLevelThatFits) {
  TerrainPyramid pyramid = pyramid_in_memory(rough());
  TerrainWindow window(300);
  const auto report = window.fill(pyramid, {-1000.0, -1400.0, 4400.0, 2000.0}, 0);
  EXPECT_EQ(report.level, 2);
  EXPECT_LE(window.view().columns, 300U);
}

TEST(TerrainWindow, SlopesAreThoseOfThePlane) {
  HeightField plane = rough();
  for (std::size_t row = 0; row < plane.height_m.rows(); ++row) {
    for (std::size_t column = 0; column < plane.height_m.columns(); ++column) {
      plane.height_m(column, row) = 0.5F * static_cast<float>(column) - 1.25F * static_cast<float>(row);
    }
  }
  TerrainPyramid pyramid = pyramid_in_memory(plane);
  TerrainWindow window(500);
  window.fill(pyramid, {0.0, 0.0, 2000.0, 1000.0}, 1);
  const TerrainView view = window.view();
  const PackedSlope slope = view.slope[40 * view.columns + 50];
  EXPECT_NEAR(slope.east / PackedSlope::steps_per_unit, 0.1F, 1e-3F);
  EXPECT_NEAR(slope.north / PackedSlope::steps_per_unit, 0.25F, 1e-3F);
}

TEST(TerrainWindow, SlopesOfHillsChangeEvenlyBetweenNodes) {
  const RoundHills hills;
  TerrainPyramid pyramid = pyramid_in_memory(hills.field(600, 500));
  for (const int level : {1, 2}) {
    TerrainWindow window(500);
    window.fill(pyramid, {-500.0, 0.0, 1500.0, 1500.0}, level);
    const TerrainView view = window.view();
    ASSERT_EQ(view.spacing_m, 5.0 * (1 << level));
    double worst = 0.0;
    for (double x = -400.0; x < 1400.0; x += 17.3) {
      for (double y = 100.0; y < 1400.0; y += 19.7) {
        const Vec2d found = slope_at(view, {x, y}), expected = hills.slope_at({x, y});
        keep_worst(worst, std::abs(found.x - expected.x));
        keep_worst(worst, std::abs(found.y - expected.y));
      }
    }
    EXPECT_LT(worst, hills.slope_error(level)) << "level " << level;
  }
}

class PyramidOnDisk : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    built_ = std::make_unique<ScratchFolder>();
    build_pyramid(built_->path("pyramid"), rough(), {43.0, -3.0});
  }
  static void TearDownTestSuite() { built_.reset(); }
  PyramidOnDisk() {
    std::filesystem::copy(built_->path("pyramid"), folder_.path("pyramid"), std::filesystem::copy_options::recursive);
  }

  [[nodiscard]] std::filesystem::path tile(const std::string& name) const { return folder_.path("pyramid") / name; }

  inline static std::unique_ptr<ScratchFolder> built_;  ///< for each test to copy
  ScratchFolder folder_;
  HeightField field_ = rough();
  radar::Rectangle area_{-1000.0, -1400.0, 4400.0, 2000.0};
};

TEST_F(PyramidOnDisk, IsTheOneInMemory) {
  TerrainPyramid stored = open_pyramid(folder_.path("pyramid"), 100 * HeightTile::bytes);
  TerrainPyramid held = pyramid_in_memory(field_);
  for (int level = 0; level < held.levels(); ++level) {
    for (std::uint32_t row = 0; row < held.layout().down(level); ++row) {
      const TileKey key{level, 0, row};
      ASSERT_EQ(stored.load(key)->height_m, held.load(key)->height_m);
      EXPECT_EQ(stored.summary(key).error_m, held.summary(key).error_m);
    }
  }
  EXPECT_TRUE(stored.faults().empty());
}

TEST_F(PyramidOnDisk, KnowsWhereItsGroundEnds) {
  ASSERT_NE(field_.extent(), PyramidLayout::covering(field_.extent(), field_.spacing_m).extent());
  EXPECT_EQ(pyramid_in_memory(field_).extent(), field_.extent());
  EXPECT_EQ(open_pyramid(folder_.path("pyramid"), 100 * HeightTile::bytes).extent(), field_.extent());
  // A heading of a former kind does not tell, until the pyramid is built again; its tiles stay.
  PyramidHeading heading = read_heading(tile("pyramid.toml"));
  folder_.write("pyramid/pyramid.toml",
                fmt::format("west_m = {}\nnorth_m = {}\nspacing_m = {}\ntiles_across = {}\ntiles_down = {}\n"
                            "source_hash = \"{}\"\n",
                            field_.west_m, field_.north_m, field_.spacing_m, heading.layout.tiles_across,
                            heading.layout.tiles_down, heading.source_hash));
  EXPECT_EQ(open_pyramid(folder_.path("pyramid"), 100 * HeightTile::bytes).extent(), heading.layout.extent());
  EXPECT_EQ(build_pyramid(folder_.path("pyramid"), field_, {43.0, -3.0}), 0U);
  EXPECT_EQ(open_pyramid(folder_.path("pyramid"), 100 * HeightTile::bytes).extent(), field_.extent());
}

TEST_F(PyramidOnDisk, KeepsWithinItsBudget) {
  constexpr std::size_t budget = 5 * HeightTile::bytes;
  TerrainPyramid pyramid = open_pyramid(folder_.path("pyramid"), budget);
  TerrainWindow window(1500);
  for (int level = 3; level >= 0; --level) {
    window.fill(pyramid, area_, level);
    EXPECT_LE(pyramid.resident_bytes(), budget);
  }
  EXPECT_NE(pyramid.resident({3, 0, 0}), nullptr) << "the last level is never forgotten";
}

TEST_F(PyramidOnDisk, AMissingTileGivesItsParentAndAReport) {
  std::filesystem::remove(tile("level_0/1_1.tif"));
  TerrainPyramid pyramid = open_pyramid(folder_.path("pyramid"), 100 * HeightTile::bytes);
  TerrainWindow window(1500);
  const auto report = window.fill(pyramid, area_, 0);
  ASSERT_EQ(report.lacking, (std::vector<TileKey>{{0, 1, 1}}));
  EXPECT_EQ(report.error_m, pyramid.summary({1, 0, 0}).error_m);
  ASSERT_EQ(pyramid.faults().size(), 1U);
  EXPECT_THAT(pyramid.faults()[0].message, HasSubstr("1_1.tif"));
  const HeightField surface = surface_of(window.view());
  const Vec2d inside{-1000.0 + 5.0 * 380, 2000.0 - 5.0 * 380};
  const double error_m = static_cast<double>(pyramid.summary({1, 0, 0}).error_m);
  EXPECT_NEAR(surface.height_at(inside), field_.height_at(inside), error_m);
  EXPECT_GT(surface.height_at(inside), 50.0);
}

TEST(TerrainPyramid, AsksAgainForATileThatCouldNotBeHad) {
  TerrainPyramid whole = pyramid_in_memory(rough());
  const TileKey key{0, 1, 1};
  bool is_short = true;
  int asked = 0;
  const TerrainPyramid::Reader reader = [&](TileKey wanted) {
    asked += wanted == key ? 1 : 0;
    if (is_short && wanted == key) throw Error("1_1.tif", "cannot be read", "try again");
    return whole.load(wanted);
  };
  std::vector<Array2D<TileSummary>> summaries;
  for (int level = 0; level < whole.levels(); ++level) {
    auto& of_level = summaries.emplace_back(whole.layout().across(level), whole.layout().down(level));
    for (std::uint32_t row = 0; row < of_level.rows(); ++row)
      for (std::uint32_t column = 0; column < of_level.columns(); ++column)
        of_level(column, row) = whole.summary({level, column, row});
  }
  TerrainPyramid patient(whole.layout(), whole.extent(), summaries, reader, 8 * HeightTile::bytes,
                         std::chrono::hours(1));
  EXPECT_EQ(patient.load(key), nullptr);
  EXPECT_EQ(patient.load(key), nullptr);
  EXPECT_EQ(asked, 1) << "not at once";
  TerrainPyramid pyramid(whole.layout(), whole.extent(), summaries, reader, 8 * HeightTile::bytes,
                         std::chrono::milliseconds(0));
  EXPECT_EQ(pyramid.load(key), nullptr);
  EXPECT_EQ(pyramid.faults().size(), 1U);
  is_short = false;
  EXPECT_NE(pyramid.load(key), nullptr);
  EXPECT_TRUE(pyramid.faults().empty());
}

// What the system says of it is no Error; before a loader that nobody waits for it would end the program.
TEST_F(PyramidOnDisk, ALinkToItselfIsAFault) {
  std::filesystem::remove(tile("level_0/0_0.tif"));
  std::filesystem::create_symlink(tile("level_0/0_0.tif"), tile("level_0/0_0.tif"));
  TerrainPyramid pyramid = open_pyramid(folder_.path("pyramid"), 100 * HeightTile::bytes);
  EXPECT_EQ(pyramid.load({0, 0, 0}), nullptr);
  ASSERT_EQ(pyramid.faults().size(), 1U);
  EXPECT_THAT(pyramid.faults()[0].message, ::testing::HasSubstr("0_0.tif"));
}

TEST_F(PyramidOnDisk, TruncatedAndAlteredTilesAreNotTaken) {
  std::filesystem::resize_file(tile("level_0/0_0.tif"), 900);
  std::filesystem::copy_file(tile("level_0/2_1.tif"), tile("level_0/3_1.tif"),
                             std::filesystem::copy_options::overwrite_existing);
  {
    std::fstream file(tile("level_0/2_0.tif"), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(-3000, std::ios::end);
    file.put('x').put('y').put('z');
  }
  TerrainPyramid pyramid = open_pyramid(folder_.path("pyramid"), 100 * HeightTile::bytes);
  TerrainWindow window(1500);
  const auto report = window.fill(pyramid, area_, 0);
  EXPECT_THAT(report.lacking, ::testing::UnorderedElementsAre(TileKey{0, 0, 0}, TileKey{0, 2, 0}, TileKey{0, 3, 1}));
  EXPECT_EQ(pyramid.faults().size(), report.lacking.size());
  EXPECT_THAT(report.standing_in,
              ::testing::UnorderedElementsAre(TileKey{1, 0, 0}, TileKey{1, 1, 0}, TileKey{1, 1, 0}));
}

TEST_F(PyramidOnDisk, IsNotBuiltTwiceNorTakenForAnother) {
  const auto when = std::filesystem::last_write_time(tile("level_0/0_0.tif"));
  build_pyramid(folder_.path("pyramid"), field_, {43.0, -3.0});
  EXPECT_EQ(std::filesystem::last_write_time(tile("level_0/0_0.tif")), when);
  field_.height_m(10, 10) += 5.0F;
  build_pyramid(folder_.path("pyramid"), field_, {43.0, -3.0});
  TerrainPyramid pyramid = open_pyramid(folder_.path("pyramid"), 100 * HeightTile::bytes);
  EXPECT_EQ(pyramid.load({0, 0, 0})->height_m[10 * HeightTile::nodes + 10], field_.height_m(10, 10));
}

TEST_F(PyramidOnDisk, BoundsHoldForAllLevelsOfTheGroundBeneath) {
  TerrainPyramid pyramid = open_pyramid(folder_.path("pyramid"), 100 * HeightTile::bytes);
  const auto whole = pyramid.bounds_over(area_);
  EXPECT_EQ(whole.lowest_m, field_.lowest_m());
  EXPECT_EQ(whole.highest_m, field_.highest_m());
  // One tile of level 0 lies under this.
  const auto here = pyramid.bounds_over({300.0, 100.0, 600.0, 600.0});
  const HeightTile& tile = *pyramid.load({0, 1, 1});
  EXPECT_EQ(here.lowest_m, *std::ranges::min_element(tile.height_m));
  EXPECT_EQ(here.highest_m, *std::ranges::max_element(tile.height_m));
  for (int level = 0; level < pyramid.levels(); ++level) {
    EXPECT_EQ(pyramid.load({level, 0, 0})->summary.lowest_m, pyramid.summary({level, 0, 0}).lowest_m);
  }
  const TileSummary& all = pyramid.summary({pyramid.levels() - 1, 0, 0});
  EXPECT_EQ(all.lowest_m, field_.lowest_m());
  EXPECT_EQ(all.highest_m, field_.highest_m());
}

TEST_F(PyramidOnDisk, AnUnfinishedOneIsRefused) {
  std::filesystem::remove(tile("pyramid.toml"));
  EXPECT_THAT(message_of_error([&] { static_cast<void>(open_pyramid(folder_.path("pyramid"), 1U << 20U).levels()); }),
              HasSubstr("pyramid.toml"));
}

/// Names of all files with when they were written.
std::map<std::filesystem::path, std::filesystem::file_time_type> times_in(const std::filesystem::path& folder) {
  std::map<std::filesystem::path, std::filesystem::file_time_type> times;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) times[entry.path().lexically_relative(folder)] = entry.last_write_time();
  }
  return times;
}

TEST_F(PyramidOnDisk, GoesOnWhereItWasInterrupted) {
  // As a killed process leaves it: tiles up to somewhere, no heading but that of what was begun.
  std::filesystem::rename(tile("pyramid.toml"), tile("unfinished.toml"));
  std::filesystem::remove_all(tile("level_1"));
  for (const char* name : {"level_2/0_0.tif", "level_2/1_0.tif", "level_3/0_0.tif", "level_0/4_2.tif", "level_0.tif"}) {
    std::filesystem::remove(tile(name));
  }
  std::filesystem::resize_file(tile("level_0/3_2.tif"), 700);
  const auto before = times_in(folder_.path("pyramid"));
  // 3 × 2 tiles of level 1, 2 of level 2, 1 of level 3 and the two of level 0.
  EXPECT_EQ(build_pyramid(folder_.path("pyramid"), field_, {43.0, -3.0}), 6U + 2U + 1U + 2U);
  EXPECT_FALSE(std::filesystem::exists(tile("unfinished.toml")));
  EXPECT_THAT(verify_pyramid(folder_.path("pyramid"), {43.0, -3.0}), ::testing::IsEmpty());
  for (const auto& [file, when] : times_in(folder_.path("pyramid"))) {
    if (file.parent_path() == "level_0" && file.filename() != "3_2.tif" && file.filename() != "4_2.tif") {
      EXPECT_EQ(before.at(file), when) << file;
    }
  }
  TerrainPyramid mended = open_pyramid(folder_.path("pyramid"), 100 * HeightTile::bytes);
  TerrainPyramid held = pyramid_in_memory(field_);
  for (int level = 0; level < held.levels(); ++level) {
    for (std::uint32_t column = 0; column < held.layout().across(level); ++column) {
      const TileKey key{level, column, held.layout().down(level) - 1};
      EXPECT_EQ(mended.load(key)->height_m, held.load(key)->height_m);
      EXPECT_EQ(mended.summary(key).error_m, held.summary(key).error_m);
    }
  }
}

TEST_F(PyramidOnDisk, TilesOfOtherHeightsAreNotGoneOnFrom) {
  std::filesystem::rename(tile("pyramid.toml"), tile("unfinished.toml"));
  for (float& height : field_.height_m.values()) height += 1.0F;
  EXPECT_EQ(build_pyramid(folder_.path("pyramid"), field_, {43.0, -3.0}), 15U + 6U + 2U + 1U);
  TerrainPyramid pyramid = open_pyramid(folder_.path("pyramid"), 100 * HeightTile::bytes);
  EXPECT_EQ(pyramid.load({0, 0, 0})->height_m[0], field_.height_m(0, 0));
}

TEST_F(PyramidOnDisk, StaysUntilOtherHeightsAreWhole) {
  // Heights that cannot be read to their end: a raster that is no raster any more from some tile on.
  const PyramidLayout layout = PyramidLayout::covering(field_.extent(), field_.spacing_m);
  const auto raster = folder_.write("cut.asc", "ncols 4\nnrows 4\nxllcorner 0\nyllcorner 0\ncellsize 10\n1 2 3");
  TerrainSource cut;
  cut.raster = {raster, 1, "EPSG:25830"};
  EXPECT_FALSE(message_of_error([&] {
                 build_pyramid(folder_.path("pyramid"), cut, {43.0, -3.0}, {0.0, 0.0, 100.0, 100.0});
               }).empty());
  EXPECT_THAT(verify_pyramid(folder_.path("pyramid"), {43.0, -3.0}), ::testing::IsEmpty());

  const geo::AsciiGrid grid{500'600.0, 4'795'000.0, 100.0, 20, 20};
  cut.raster.file = folder_.write("nothing.asc", grid.text([](double, double) { return 1e30; }));
  for (int again = 0; again < 2; ++again) {
    EXPECT_THAT(message_of_error([&] {
                  build_pyramid(folder_.path("pyramid"), cut, {43.312, -2.986}, {-1000.0, -1000.0, 1000.0, 1000.0});
                }),
                HasSubstr("nothing.asc: holds no heights"));
    EXPECT_FALSE(std::filesystem::exists(folder_.path("pyramid/.unfinished")));
  }
  EXPECT_THAT(verify_pyramid(folder_.path("pyramid"), {43.0, -3.0}), ::testing::IsEmpty());

  const float before = field_.height_m(0, 0);
  for (float& height : field_.height_m.values()) height += 1.0F;
  EXPECT_EQ(build_pyramid(folder_.path("pyramid"), field_, {43.0, -3.0}),
            static_cast<std::size_t>(layout.tiles_across * layout.tiles_down) + 6U + 2U + 1U);
  EXPECT_THAT(verify_pyramid(folder_.path("pyramid"), {43.0, -3.0}), ::testing::IsEmpty());
  TerrainPyramid pyramid = open_pyramid(folder_.path("pyramid"), 100 * HeightTile::bytes);
  EXPECT_EQ(pyramid.load({0, 0, 0})->height_m[0], before + 1.0F);
  EXPECT_FALSE(std::filesystem::exists(folder_.path("pyramid/.unfinished")));
}

// Nothing can be renamed from one disk to another.
TEST_F(PyramidOnDisk, IsReplacedWhereItsFolderIsALinkToAnotherDisk) {
  const std::filesystem::path disk = "/dev/shm", there = disk / folder_.path("").parent_path().filename();
  struct stat here {
  }, other{};
  if (::stat(folder_.path("").c_str(), &here) != 0 || ::stat(disk.c_str(), &other) != 0 || here.st_dev == other.st_dev)
    GTEST_SKIP() << "there is no other disk in " << disk;
  std::filesystem::rename(folder_.path("pyramid"), folder_.path("former"));
  std::filesystem::copy(folder_.path("former"), there, std::filesystem::copy_options::recursive);
  std::filesystem::create_directory_symlink(there, folder_.path("pyramid"));
  for (float& height : field_.height_m.values()) height += 1.0F;
  build_pyramid(folder_.path("pyramid"), field_, {43.0, -3.0});
  EXPECT_THAT(verify_pyramid(folder_.path("pyramid"), {43.0, -3.0}), ::testing::IsEmpty());
  EXPECT_EQ(open_pyramid(there, 100 * HeightTile::bytes).load({0, 0, 0})->height_m[0], field_.height_m(0, 0));
  EXPECT_FALSE(std::filesystem::exists(there / ".unfinished"));
  std::filesystem::remove_all(there);
}

// Killed while the other heights' tiles were being removed, whose heading goes first.
TEST_F(PyramidOnDisk, TakesItsPlaceWhenThatWasInterrupted) {
  for (float& height : field_.height_m.values()) height += 1.0F;
  build_pyramid(folder_.path("pyramid/.unfinished"), field_, {43.0, -3.0});
  std::filesystem::remove(tile("pyramid.toml"));
  std::filesystem::remove_all(tile("level_1"));
  EXPECT_EQ(build_pyramid(folder_.path("pyramid"), field_, {43.0, -3.0}), 0U);
  EXPECT_THAT(verify_pyramid(folder_.path("pyramid"), {43.0, -3.0}), ::testing::IsEmpty());
  EXPECT_EQ(open_pyramid(folder_.path("pyramid"), 100 * HeightTile::bytes).load({0, 0, 0})->height_m[0],
            field_.height_m(0, 0));
  EXPECT_FALSE(std::filesystem::exists(folder_.path("pyramid/.unfinished")));
}

TEST_F(PyramidOnDisk, VerificationNamesWhatIsMissingOrDamaged) {
  EXPECT_THAT(verify_pyramid(folder_.path("pyramid"), {43.0, -3.0}), ::testing::IsEmpty());
  std::filesystem::remove(tile("level_1/2_1.tif"));
  std::filesystem::resize_file(tile("level_0/0_0.tif"), 900);
  std::filesystem::copy_file(tile("level_0/2_1.tif"), tile("level_0/3_1.tif"),
                             std::filesystem::copy_options::overwrite_existing);
  std::filesystem::remove(tile("level_2.tif"));
  std::vector<std::string> faults;
  for (const PyramidFault& fault : verify_pyramid(folder_.path("pyramid"), {43.0, -3.0})) {
    faults.push_back(fault.file.string() + " " + fault.what);
  }
  EXPECT_THAT(faults, ::testing::ElementsAre("level_0/0_0.tif is truncated or was altered",
                                             "level_0/3_1.tif is truncated or was altered",
                                             "level_1/2_1.tif is missing", "level_2.tif is missing"));
  // The same heights mend what they name, and no more.
  EXPECT_EQ(build_pyramid(folder_.path("pyramid"), field_, {43.0, -3.0}), 3U);
  EXPECT_THAT(verify_pyramid(folder_.path("pyramid"), {43.0, -3.0}), ::testing::IsEmpty());
  std::filesystem::remove(tile("pyramid.toml"));
  ASSERT_EQ(verify_pyramid(folder_.path("pyramid"), {43.0, -3.0}).size(), 1U);
  EXPECT_EQ(verify_pyramid(folder_.path("pyramid"), {43.0, -3.0})[0].file, "pyramid.toml");
}

/// The one fault of a pyramid, "file what".
std::string only_fault(const std::filesystem::path& folder) {
  const auto faults = verify_pyramid(folder, {43.0, -3.0});
  if (faults.empty()) return "none";
  return faults.size() == 1 ? faults.front().file.string() + " " + faults.front().what : "several";
}

void alter(const std::filesystem::path& file, const std::string& from, const std::string& to) {
  std::string text;
  {
    std::ifstream stream(file, std::ios::binary);
    text = {std::istreambuf_iterator<char>(stream), {}};
  }
  ASSERT_NE(text.find(from), std::string::npos) << from;
  std::ofstream(file, std::ios::binary) << text.replace(text.find(from), from.size(), to);
}

/// A tile that does not tell the SHA-256 of its file, as those of a former kind.
geo::GeoRaster read_former(const std::filesystem::path& file) {
  geo::GeoRaster tile = geo::read_geotiff(file);
  EXPECT_EQ(tile.metadata.erase("file_sha256") + tile.metadata.erase("file_sha256_is_of"), 2U);
  return tile;
}

// Be it in the heights, in the cells of an overview, in the header or in what it says of itself.
TEST(PyramidOfOneTile, NoByteOfItIsAlteredUnnoticed) {
  const ScratchFolder folder;
  const geo::LocalFrame frame(43.0, -3.0);
  const HeightField field = rough(257, 257);
  const auto pyramid = folder.path("pyramid"), tile = pyramid / "level_0/0_0.tif";
  build_pyramid(pyramid, field, frame);
  const auto whole = files_of(pyramid);
  const std::string& right = whole.at("level_0/0_0.tif");
  const auto is_found = [&](const std::string& bytes) {
    std::ofstream(tile, std::ios::binary) << bytes;
    const auto faults = verify_pyramid(pyramid, frame);
    return faults.size() == 1 && faults.front().file == "level_0/0_0.tif";
  };
  ASSERT_FALSE(is_found(right));
  const std::size_t words = right.find("<GDALMetadata>"), end_of_words = right.find("</GDALMetadata>");
  ASSERT_LT(end_of_words, right.size());
  for (std::size_t at = 0; at < right.size(); at += at >= words && at < end_of_words ? 7 : 997) {
    std::string altered = right;
    altered[at] = static_cast<char>(altered[at] ^ 1);
    ASSERT_TRUE(is_found(altered)) << "byte " << at;
  }
  EXPECT_TRUE(is_found(right.substr(0, right.size() - 10)));
  EXPECT_TRUE(is_found(right + "x"));
  std::ofstream(tile.string() + ".aux.xml") << "<PAMDataset><SRS>EPSG:25830</SRS></PAMDataset>";
  EXPECT_EQ(build_pyramid(pyramid, field, frame), 1U);
  EXPECT_EQ(difference_of(files_of(pyramid), whole), "");
}

// As written by somebody who knows what a GeoTIFF is, so that the file is whole in itself.
TEST_F(PyramidOnDisk, AlteredHeadingsIndexesAndSummariesAreFoundAndMended) {
  const auto whole = files_of(folder_.path("pyramid"));
  const auto mended = [&] {
    build_pyramid(folder_.path("pyramid"), field_, {43.0, -3.0});
    return difference_of(files_of(folder_.path("pyramid")), whole);
  };
  for (const auto& [from, to] :
       {std::pair("north_m = 2000", "north_m = 2001"), std::pair("spacing_m = 5", "spacing_m = 6"),
        std::pair("index_sha256", "index_sha255")}) {
    alter(tile("pyramid.toml"), from, to);
    EXPECT_EQ(only_fault(folder_.path("pyramid")), "pyramid.toml is truncated or was altered") << to;
    EXPECT_FALSE(message_of_error([&] { static_cast<void>(open_pyramid(folder_.path("pyramid"), 0)); }).empty());
    EXPECT_EQ(mended(), "") << to;
  }
  {
    geo::GeoRaster index = geo::read_geotiff(tile("level_0.tif"));
    index.bands[1].values.values()[3] += 100.0F;
    geo::write_geotiff(tile("level_0.tif"), index);
  }
  EXPECT_EQ(only_fault(folder_.path("pyramid")), "level_0.tif is truncated or was altered");
  EXPECT_THAT(message_of_error([&] { static_cast<void>(open_pyramid(folder_.path("pyramid"), 0)); }),
              HasSubstr("level_0.tif: has been altered"));
  EXPECT_EQ(mended(), "");
  {
    geo::GeoRaster summary = read_former(tile("level_1/0_0.tif"));
    summary.metadata["error_m"] = "0";
    geo::write_geotiff(tile("level_1/0_0.tif"), summary);
  }
  EXPECT_EQ(only_fault(folder_.path("pyramid")), "level_1/0_0.tif is truncated or was altered");
  EXPECT_EQ(mended(), "");
}

// Their heights are as they were, and a GIS would show them elsewhere.
TEST_F(PyramidOnDisk, TilesThatSayThatTheyLieElsewhereAreFoundAndMended) {
  const auto whole = files_of(folder_.path("pyramid"));
  const auto moved = [](geo::RasterPlacement placement, double east_m, double cell_m) {
    placement.west_m += east_m;
    placement.cell_m = cell_m;
    return placement;
  };
  const geo::GeoRaster right = read_former(tile("level_1/1_0.tif"));
  geo::RasterPlacement northward = right.placement, in_another_frame = right.placement;
  northward.north_m += 1000.0;
  in_another_frame.crs = geo::LocalFrame(43.001, -3.0).proj();
  for (const geo::RasterPlacement& wrong : {moved(right.placement, 0.1, right.placement.cell_m),
                                            moved(right.placement, 0.0, 11.0), northward, in_another_frame}) {
    geo::GeoRaster elsewhere = right;
    elsewhere.placement = wrong;
    geo::write_geotiff(tile("level_1/1_0.tif"), elsewhere);
    EXPECT_EQ(only_fault(folder_.path("pyramid")), "level_1/1_0.tif is truncated or was altered");
    EXPECT_EQ(build_pyramid(folder_.path("pyramid"), field_, {43.0, -3.0}), 1U);
    EXPECT_EQ(difference_of(files_of(folder_.path("pyramid")), whole), "");
  }
}

// They tell neither their own hash nor those of the indexes, nor tiles those of their summary and of their file.
TEST_F(PyramidOnDisk, ThoseOfAFormerKindAreTakenAsTheyAre) {
  std::string heading = files_of(folder_.path("pyramid")).at("pyramid.toml");
  heading.erase(heading.find("index_sha256"));
  std::ofstream(tile("pyramid.toml"), std::ios::binary) << heading;
  geo::GeoRaster former = read_former(tile("level_0/0_0.tif"));
  ASSERT_EQ(former.metadata.erase("tile_sha256"), 1U);
  geo::write_geotiff(tile("level_0/0_0.tif"), former);
  EXPECT_EQ(only_fault(folder_.path("pyramid")), "none");
  EXPECT_TRUE(holds_pyramid_of(folder_.path("pyramid"), field_, {43.0, -3.0}));
  EXPECT_NE(open_pyramid(folder_.path("pyramid"), 100 * HeightTile::bytes).load({0, 0, 0}), nullptr);
  EXPECT_EQ(build_pyramid(folder_.path("pyramid"), field_, {43.0, -3.0}), 0U) << "no tile is made again";
}

TEST_F(PyramidOnDisk, ManyThreadsMayAsk) {
  TerrainPyramid pyramid = open_pyramid(folder_.path("pyramid"), 4 * HeightTile::bytes);
  std::atomic<int> wrong{0};
  {
    std::vector<std::jthread> threads;
    for (unsigned t = 0; t < 4; ++t) {
      threads.emplace_back([&, t] {
        for (unsigned i = 0; i < 20; ++i) {
          const TileKey key{0, (i + t) % 4, (i / 4) % 2};
          const auto held = pyramid.load(key);
          const float expected = field_.height_m(256 * key.column, 256 * key.row);
          if (!held || held->height_m[0] != expected) ++wrong;
        }
      });
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_LE(pyramid.resident_bytes(), 4 * HeightTile::bytes);
}

TEST(PyramidFromRaster, ReadsATileAtATime) {
  const ScratchFolder folder;
  const geo::AsciiGrid grid{500'600.0, 4'795'000.0, 10.0, 100, 80};
  TerrainSource source;
  source.raster = {folder.write("heights.asc", grid.text([](double x, double) { return 0.1 * (x - 500'000.0); })), 1,
                   "EPSG:25830"};
  const geo::LocalFrame frame(43.312, -2.986);
  const auto whole = read_terrain(source, frame, std::nullopt);
  const radar::Rectangle extent = whole.field.extent();
  source.spacing_m = 2.0;
  EXPECT_EQ(build_pyramid(folder.path("pyramid"), source, frame, extent).nodes_without_height, 0U);
  TerrainPyramid pyramid = open_pyramid(folder.path("pyramid"), 100 * HeightTile::bytes);
  EXPECT_GE(pyramid.levels(), 2);
  TerrainWindow window(600);
  window.fill(pyramid, extent, 0);
  const HeightField surface = surface_of(window.view());
  const Vec2d middle = extent.centre();
  for (const Vec2d p : {middle, middle + Vec2d{200.0, -100.0}, middle + Vec2d{-321.0, 222.0}}) {
    EXPECT_NEAR(surface.height_at(p), whole.field.height_at(p), 0.02);
  }
}

std::string mosaic_of(const std::string& file) {
  return fmt::format(R"(<VRTDataset rasterXSize="100" rasterYSize="80"><SRS>EPSG:25830</SRS>
      <GeoTransform>500600, 10, 0, 4795800, 0, -10</GeoTransform><VRTRasterBand dataType="Float32" band="1"><SimpleSource>
      <SourceFilename relativeToVRT="1">{}</SourceFilename><SourceBand>1</SourceBand>
      </SimpleSource></VRTRasterBand></VRTDataset>)",
                     file);
}

/// Builds a pyramid of a raster that `heights.asc` is read through, twice at each of two heights of the latter.
void expect_made_anew(const ScratchFolder& folder, const std::string& raster) {
  const geo::AsciiGrid grid{500'600.0, 4'795'000.0, 10.0, 100, 80};
  TerrainSource source;
  source.raster = {raster, 1, "EPSG:25830"};
  source.spacing_m = 5.0;
  const geo::LocalFrame frame(43.312, -2.986);
  for (const double height_m : {100.0, 500.0}) {
    folder.write("heights.asc", grid.text([height_m](double, double) { return height_m; }));
    const radar::Rectangle extent = read_terrain(source, frame, std::nullopt).field.extent();
    EXPECT_GT(build_pyramid(folder.path("pyramid"), source, frame, extent).tiles_written, 0U) << height_m;
    TerrainPyramid pyramid = open_pyramid(folder.path("pyramid"), 100 * HeightTile::bytes);
    EXPECT_EQ(pyramid.load({0, 0, 0})->height_m[0], static_cast<float>(height_m));
    EXPECT_EQ(build_pyramid(folder.path("pyramid"), source, frame, extent).tiles_written, 0U) << "nothing has changed";
  }
}

TEST(PyramidFromRaster, IsMadeAnewWhenAPartOfAMosaicHasChanged) {
  const ScratchFolder folder;
  folder.write("mosaic.vrt", mosaic_of("heights.asc"));
  expect_made_anew(folder, folder.path("mosaic.vrt").string());
}

// GDAL lists of a mosaic of mosaics these alone.
TEST(PyramidFromRaster, IsMadeAnewWhenAPartOfAMosaicOfMosaicsHasChanged) {
  const ScratchFolder folder;
  folder.write("region.vrt", mosaic_of("heights.asc"));
  folder.write("country.vrt", mosaic_of("region.vrt"));
  expect_made_anew(folder, folder.path("country.vrt").string());
}

TEST(PyramidFromRaster, IsMadeAnewWhenWhatAVirtualPathLeadsToHasChanged) {
  const ScratchFolder folder;
  expect_made_anew(folder, "/vsisubfile/0_10000000," + folder.path("heights.asc").string());
}

// 100 × 80 cells of 10 m are less than a tile of 256 nodes.
TEST(PyramidFromRaster, GoesOnBeyondTheRasterAsHighAsAtItsEdge) {
  const ScratchFolder folder;
  const geo::AsciiGrid grid{500'600.0, 4'795'000.0, 10.0, 100, 80};
  TerrainSource source;
  source.raster = {folder.write("heights.asc", grid.text([](double, double) { return 500.0; })), 1, "EPSG:25830"};
  const geo::LocalFrame frame(43.312, -2.986);
  const radar::Rectangle extent = read_terrain(source, frame, std::nullopt).field.extent();
  EXPECT_EQ(build_pyramid(folder.path("pyramid"), source, frame, extent).nodes_without_height, 0U);
  TerrainPyramid pyramid = open_pyramid(folder.path("pyramid"), 100 * HeightTile::bytes);
  EXPECT_GT(pyramid.layout().extent().width_m(), extent.width_m() + 1000.0);
  const auto tile = pyramid.load({0, 0, 0});
  for (const float height : tile->height_m) ASSERT_EQ(height, 500.0F);
  EXPECT_EQ(pyramid.summary({0, 0, 0}).lowest_m, 500.0F);
}

// A void of 100 m × 60 m, which nobody wants to find as a pit at sea level without having been told.
TEST(PyramidFromRaster, CountsNodesWithoutHeight) {
  const ScratchFolder folder;
  const geo::AsciiGrid grid{500'600.0, 4'795'000.0, 10.0, 100, 80};
  const auto height_at = [](double x, double y) {
    const bool is_void = x > 501'000.0 && x < 501'100.0 && y > 4'795'300.0 && y < 4'795'360.0;
    return is_void ? -99'999.0 : 250.0;
  };
  TerrainSource source;
  source.raster = {folder.write("heights.asc", grid.text(height_at)), 1, "EPSG:25830"};
  const geo::LocalFrame frame(43.312, -2.986);
  const radar::Rectangle extent = read_terrain(source, frame, std::nullopt).field.extent();
  const PyramidBuild built = build_pyramid(folder.path("pyramid"), source, frame, extent);
  EXPECT_NEAR(static_cast<double>(built.nodes_without_height), 60.0, 25.0) << "and those whose neighbours are void";
}

}  // namespace
}  // namespace sigmascape::terrain
