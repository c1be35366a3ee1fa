#pragma once

#include "sigmascape/base/array2d.h"

namespace sigmascape::product {

/// Smooths linear power with a Gaussian of standard deviation `width_cells`, cut off at three of them: the simple image
/// filter that makes bright points stand out on a scope. Unseen (NaN) cells stay so; the part of a cell's weight that
/// would fall on them or beyond the edge stays in the cell, so that both a constant map and the total power are kept:
///
///     P'(x) = Σ_y k(x − y) P(y) + P(x) · (1 − Σ_y k(x − y)),   y over the seen cells
///
/// A width of zero leaves the map as it is.
[[nodiscard]] Array2D<double> low_pass(const Array2D<double>& power, double width_cells);

}  // namespace sigmascape::product
