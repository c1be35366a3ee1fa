#include "sigmascape/live/extent_cells.h"

#include <algorithm>
#include <cmath>

namespace sigmascape::live {

CellsAlong::CellsAlong(double from_m, double to_m, double cell_m)
    : from_(from_m / cell_m), to_(to_m / cell_m), first_(std::floor(from_)), end_(std::ceil(to_)) {}

double CellsAlong::part_of(double cell) const {
  return std::clamp(std::min(cell + 1.0, to_) - std::max(cell, from_), 0.0, 1.0);
}

double ExtentCells::cells_of_row(double row, double from, double to) const {
  if (row < rows.first() || row >= rows.end()) return 0.0;
  return std::max(std::min(to, columns.end()) - std::max(from, columns.first()), 0.0);
}

}  // namespace sigmascape::live
