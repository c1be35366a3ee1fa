#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sigmascape/product/drawing.h"

namespace sigmascape::product {

struct PlotSeries {
  std::string name;
  std::vector<std::pair<double, double>> points = {};
  bool joined = false;  ///< a line through the points, in their order
  bool dots = true;     ///< a dot on each point
  /// Written beside the points, in their order; points beyond have none.
  std::vector<std::string> labels = {};
};

struct Plot {
  std::string title = {}, x_label = {}, y_label = {};
  bool x_is_logarithmic = false;
  bool y_is_logarithmic = false;
  bool x_from_zero = true;  ///< the axis begins at zero even when no point comes near it; not when logarithmic
  bool y_from_zero = true;
  std::vector<double> x_marks = {};                      ///< where the axis is marked; empty: at round numbers
  std::optional<std::pair<double, double>> x_ends = {};  ///< the axis holds both, whether points come near them or not
  double y_floor = -std::numeric_limits<double>::infinity();  ///< what lies lower is not drawn
  std::vector<PlotSeries> series = {};
};

/// A picture of 640 × 400 units. The names stand in a corner, or, where they would hide something in each, where they
/// hide least of points and lines. Points with a number that is not finite, and those below the floor, are left out and
/// break lines.
[[nodiscard]] Drawing drawing_of(const Plot& plot);

/// The plot as an SVG picture that stands alone.
[[nodiscard]] std::string svg_of(const Plot& plot);

}  // namespace sigmascape::product
