#pragma once

#include <map>
#include <optional>
#include <string>

#include "sigmascape/base/array2d.h"
#include "sigmascape/product/colour_scale.h"
#include "sigmascape/product/map_view.h"
#include "sigmascape/radar/ground_map.h"

namespace sigmascape::product {

/// Pixels, north up, and where they lie on the ground.
struct Picture {
  Array2D<Rgba> pixels;  ///< [column, row], row 0 the northernmost
  /// Of the pixels that show ground; a legend may add rows below them.
  radar::GroundGrid grid;
  ColourScale scale = ColourScale::Grey;
  double bottom_db = 0.0;  ///< what the scale's low end stands for
  double top_db = 0.0;     ///< and its high end
  std::map<std::string, std::string> metadata;
};

/// How a ground map becomes a picture.
struct PictureOptions {
  radar::Polarization polarization = radar::Polarization::Sum;
  ColourScale scale = ColourScale::Grey;
  double span_db = 50.0;
  /// The level shown brightest; without it that of `top_percentile`. Pictures to be compared need the same one.
  std::optional<double> top_db = std::nullopt;
  double top_percentile = 99.8;
  double low_pass_cells = 0.0;  ///< standard deviation of the smoothing in cells of the map, see low_pass.h; 0 for none
  bool transparent_unseen = false;  ///< unseen ground is transparent instead of dark blue
  unsigned magnification = 1;       ///< pixels along a cell's side
};

/// The look of a radar scope: green, and smoothed over one cell, so that bright points bloom.
[[nodiscard]] PictureOptions scope_look();

/// σ0 in dB over a span that ends at the top, bottom at the scale's low end. Unseen cells are dark blue or transparent;
/// cells without power are at the low end. Throws Error when the span is not positive, the top not finite, the
/// percentile not in (0, 100], the magnification zero, the low-pass negative or the map empty. A view is one of σ0.
[[nodiscard]] Picture picture_of(const MapView& map, const PictureOptions& options = {});
[[nodiscard]] inline Picture picture_of(const radar::GroundMap& map, const PictureOptions& options = {}) {
  return picture_of(view_of(map), options);
}

/// The level, in dB, below which `top_percentile` of the map's seen cells with power lie: the top that picture_of takes
/// by itself. 0 dB when no cell has power.
[[nodiscard]] double percentile_top_db(const radar::GroundMap& map, const PictureOptions& options = {});

/// How two maps differ.
struct DifferenceOptions {
  radar::Polarization polarization = radar::Polarization::Sum;
  double span_db = 20.0;    ///< the scale runs from −span_db / 2 to +span_db / 2
  double floor_db = -45.0;  ///< σ0 below this counts as this in both maps
  unsigned magnification = 1;
};

/// 10 lg (tested / truth), red where the tested map is brighter, blue where it is darker, near-white where they agree;
/// dark blue where either was not seen. Throws Error when the maps' grids differ.
[[nodiscard]] Picture difference_picture(const radar::GroundMap& tested, const radar::GroundMap& truth,
                                         const DifferenceOptions& options = {});

}  // namespace sigmascape::product
