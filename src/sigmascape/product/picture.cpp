#include "sigmascape/product/picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <limits>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/base/units.h"
#include "sigmascape/product/block_mean.h"
#include "sigmascape/product/described_map.h"
#include "sigmascape/product/low_pass.h"
#include "sigmascape/product/map_metrics.h"
#include "sigmascape/radar/polarization_words.h"

namespace sigmascape::product {
namespace {

void require(bool holds, const std::string& where, const std::string& what, const std::string& remedy) {
  if (!holds) throw Error(where, what, remedy);
}

void check(const MapView& map, const PictureOptions& options) {
  require(!map.cells.empty(), "picture", "the map has no cells", "render a map of at least one cell");
  require(!options.top_db || std::isfinite(*options.top_db), "picture top", "is no finite number of dB",
          "give the sigma0 that is to be shown brightest");
  require(options.span_db > 0.0 && std::isfinite(options.span_db), "picture span",
          fmt::format("{} dB is no span", options.span_db), "give a positive number of dB");
  require(options.magnification > 0, "picture magnification", "is 0", "give at least 1 pixel a cell");
  require(options.low_pass_cells >= 0.0 && std::isfinite(options.low_pass_cells), "picture low-pass",
          fmt::format("{} cells is no width", options.low_pass_cells), "give 0 or more cells");
  require(options.top_percentile > 0.0 && options.top_percentile <= 100.0, "picture top percentile",
          fmt::format("is {}", options.top_percentile), "give a number above 0 and up to 100");
}

Array2D<double> smoothed_power(const MapView& map, const PictureOptions& options) {
  return low_pass(block_mean(map.cells, options.polarization, 1), options.low_pass_cells);
}

double percentile_db(const Array2D<double>& power, double percentile) {
  std::vector<double> seen;
  seen.reserve(power.size());
  std::copy_if(power.values().begin(), power.values().end(), std::back_inserter(seen),
               [](double p) { return p > 0.0; });
  if (seen.empty()) return 0.0;
  const double rank = std::ceil(percentile / 100.0 * static_cast<double>(seen.size()));
  const auto index = static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
  std::nth_element(seen.begin(), seen.begin() + index, seen.end());
  return db_from_linear(seen[static_cast<std::size_t>(index)]);
}

radar::GroundGrid magnified(radar::GroundGrid grid, unsigned magnification) {
  grid.cell_m /= magnification;
  grid.columns *= magnification;
  grid.rows *= magnification;
  return grid;
}

/// Paints levels in dB; NaN means unseen.
Picture painted(const MapView& map, const Array2D<double>& level_db, ColourScale scale, double bottom_db, double top_db,
                unsigned magnification, Rgba unseen) {
  Picture picture;
  picture.grid = magnified(map.grid, magnification);
  picture.scale = scale;
  picture.bottom_db = bottom_db;
  picture.top_db = top_db;
  picture.metadata = map.metadata;
  picture.metadata["crs"] = map.crs;
  picture.metadata["scale_bottom_db"] = fmt::format("{:.2f}", bottom_db);
  picture.metadata["scale_top_db"] = fmt::format("{:.2f}", top_db);
  picture.pixels = Array2D<Rgba>(level_db.columns() * magnification, level_db.rows() * magnification);
  for (std::size_t row = 0; row < picture.pixels.rows(); ++row) {
    for (std::size_t column = 0; column < picture.pixels.columns(); ++column) {
      const double db = level_db(column / magnification, row / magnification);
      picture.pixels(column, row) = std::isnan(db) ? unseen : colour_at(scale, (db - bottom_db) / (top_db - bottom_db));
    }
  }
  return picture;
}

}  // namespace

PictureOptions scope_look() {
  return {.scale = ColourScale::Scope, .low_pass_cells = 1.0};
}

double percentile_top_db(const radar::GroundMap& map, const PictureOptions& options) {
  const MapView view = view_of(map);
  check(view, options);
  return percentile_db(smoothed_power(view, options), options.top_percentile);
}

Picture picture_of(const MapView& map, const PictureOptions& options) {
  check(map, options);
  Array2D<double> levels = smoothed_power(map, options);
  const double top_db = options.top_db ? *options.top_db : percentile_db(levels, options.top_percentile);
  for (double& level : levels.values()) level = db_from_linear(level);
  Rgba unseen = unseen_colour;
  if (options.transparent_unseen) unseen.alpha = 0;

  Picture picture =
      painted(map, levels, options.scale, top_db - options.span_db, top_db, options.magnification, unseen);
  picture.metadata["quantity"] = fmt::format("sigma0 {} [dB]", polarization_name(options.polarization));
  picture.metadata[polarization_key] = radar::polarization_word(options.polarization);
  picture.metadata["low_pass_cells"] = fmt::format("{}", options.low_pass_cells);
  return picture;
}

Picture difference_picture(const radar::GroundMap& tested, const radar::GroundMap& truth,
                           const DifferenceOptions& options) {
  check(view_of(truth), {.span_db = options.span_db, .magnification = options.magnification});
  require(tested.grid == truth.grid, "difference picture", "the two maps have different grids",
          "render both onto the same grid");
  const double floor = linear_from_db(options.floor_db);
  Array2D<double> ratio_db(truth.sigma0.columns(), truth.sigma0.rows());
  for (std::size_t i = 0; i < ratio_db.size(); ++i) {
    const double a = static_cast<double>(tested.sigma0.values()[i].power(options.polarization));
    const double b = static_cast<double>(truth.sigma0.values()[i].power(options.polarization));
    ratio_db.values()[i] = std::isnan(a) || std::isnan(b) ? std::numeric_limits<double>::quiet_NaN()
                                                          : db_from_linear(std::max(a, floor) / std::max(b, floor));
  }
  Picture picture = painted(view_of(truth), ratio_db, ColourScale::Diverging, -options.span_db / 2.0,
                            options.span_db / 2.0, options.magnification, unseen_colour);
  picture.metadata["quantity"] = fmt::format("tested over truth, {} [dB]", polarization_name(options.polarization));
  picture.metadata[polarization_key] = radar::polarization_word(options.polarization);
  return picture;
}

}  // namespace sigmascape::product
