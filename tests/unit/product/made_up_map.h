#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <string>

#include "sigmascape/radar/ground_map.h"

namespace sigmascape::product {

inline constexpr float unseen_power = std::numeric_limits<float>::quiet_NaN();

/// A map of 2 m cells whose VV power is a function of the cell; the other channels are zero.
inline radar::GroundMap map_of(std::size_t columns, std::size_t rows,
                               const std::function<double(std::size_t column, std::size_t row)>& vv,
                               double cell_m = 2.0) {
  radar::GroundMap map;
  map.grid = {.west_m = 100.0, .north_m = 200.0, .cell_m = cell_m, .columns = columns, .rows = rows};
  map.sigma0 = Array2D<radar::Channels>(columns, rows);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      map.sigma0(column, row).vv = static_cast<float>(vv(column, row));
    }
  }
  return map;
}

/// A folder for the running test alone, empty at its start.
inline std::filesystem::path test_folder() {
  const auto* info = testing::UnitTest::GetInstance()->current_test_info();
  const auto folder = std::filesystem::path(testing::TempDir()) / "sigmascape_product" /
                      (std::string(info->test_suite_name()) + "." + info->name());
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace sigmascape::product
