#pragma once

#include "sigmascape/radar/ground_grid.h"

namespace sigmascape::live {

/// Cells of a lattice, along one of its axes, that have something of a stretch. They are counted from the origin.
class CellsAlong {
 public:
  CellsAlong() = default;
  CellsAlong(double from_m, double to_m, double cell_m);

  [[nodiscard]] double first() const { return first_; }
  /// Behind the last.
  [[nodiscard]] double end() const { return end_; }
  /// What part of a cell's length lies in the stretch: 1 but at its ends.
  [[nodiscard]] double part_of(double cell) const;

 private:
  double from_ = 0.0, to_ = 0.0;  // in cells
  double first_ = 0.0, end_ = 0.0;
};

/// The cells of one level that have ground of the atlas' extent. There live frames end, wherever patches do: the scene
/// ends in one place (docs/decisions/0157-the-scene-ends-in-one-place.md).
struct ExtentCells {
  CellsAlong columns;  ///< eastwards
  CellsAlong rows;     ///< northwards

  ExtentCells() = default;
  ExtentCells(const radar::Rectangle& extent, double cell_m)
      : columns(extent.west_m, extent.east_m, cell_m), rows(extent.south_m, extent.north_m, cell_m) {}

  /// How many cells of a row, from one column to before another, are among them.
  [[nodiscard]] double cells_of_row(double row, double from, double to) const;
};

}  // namespace sigmascape::live
