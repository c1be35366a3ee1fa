#pragma once

#include <cmath>
#include <fmt/format.h>
#include <string>

namespace sigmascape::geo {

/// An Arc/Info ASCII grid, north row first: value(x, y) at the centre of each cell, "-9999" where it is NaN.
struct AsciiGrid {
  double west = 0.0, south = 0.0, cell = 1.0;
  int columns = 0, rows = 0;

  template <typename Value>
  [[nodiscard]] std::string text(const Value& value) const {
    std::string grid =
        fmt::format("ncols {}\nnrows {}\nxllcorner {:.9f}\nyllcorner {:.9f}\ncellsize {:.9f}\nNODATA_value -9999\n",
                    columns, rows, west, south, cell);
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const double v = value(west + (column + 0.5) * cell, south + (rows - row - 0.5) * cell);
        grid += std::isnan(v) ? std::string("-9999 ") : fmt::format("{:.6f} ", v);
      }
      grid += "\n";
    }
    return grid;
  }
};

}  // namespace sigmascape::geo
