#include "sigmascape/simulate/map_warnings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>

#include "sigmascape/base/error.h"

namespace sigmascape::simulate {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr radar::Rectangle extent{-500, -500, 500, 500};

/// Of a radar that nothing else is said about.
std::vector<std::string> warnings_of_area(const std::optional<radar::Rectangle>& area) {
  const terrain::HeightField terrain{-500, 500, 1000, Array2D<float>(2, 2, 0.0F)};
  radar::Radar radar{.range_resolution_m = 10.0,
                     .beam_width_rad = 0.01,
                     .waveform = {.pulse_length_s = 1e-7, .pulse_repetition_hz = 1000.0}};
  radar.position = {0, -20e3, 3e3};
  return map_warnings(radar, {.area = area, .cell_m = 10.0}, terrain, extent);
}

TEST(MapWarnings, NameTheSidesOnWhichAnAreaIsCutOff) {
  EXPECT_THAT(warnings_of_area(radar::Rectangle{-500, -620, 300, 540}),
              ElementsAre("the map's area reaches beyond the scene, 120 m in the south and 40 m in the north, and is "
                          "cut off there; 80 x 100 cells of it are left"));
  EXPECT_THAT(warnings_of_area(radar::Rectangle{-510, -100, 510, 100}),
              ElementsAre(::testing::StartsWith("the map's area reaches beyond the scene, 10 m in the west and 10 m in "
                                                "the east")));
}

TEST(MapWarnings, AreNoneWhereNoCellIsMissing) {
  EXPECT_THAT(warnings_of_area(std::nullopt), IsEmpty());
  EXPECT_THAT(warnings_of_area(extent), IsEmpty());
  EXPECT_THAT(warnings_of_area(radar::Rectangle{-505, -505, 505, 505}), IsEmpty());
}

TEST(MapWarnings, RefuseAnAreaOutside) {
  EXPECT_THROW(static_cast<void>(warnings_of_area(radar::Rectangle{600, 600, 700, 700})), Error);
}

}  // namespace
}  // namespace sigmascape::simulate
