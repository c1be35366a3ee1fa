#pragma once

#include <string>
#include <utility>
#include <vector>

namespace sigmascape::cli {

struct PlotSeries {
  std::string name;
  std::vector<std::pair<double, double>> points = {};
  bool joined = false;  ///< a line through the points, in their order
};

struct Plot {
  std::string title = {}, x_label = {}, y_label = {};
  bool x_is_logarithmic = false;
  std::vector<PlotSeries> series = {};
};

/// The plot as an SVG picture that stands alone. Points with a number that is not finite are left out.
[[nodiscard]] std::string svg_of(const Plot& plot);

}  // namespace sigmascape::cli
