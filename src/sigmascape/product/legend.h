#pragma once

#include "sigmascape/product/picture.h"

namespace sigmascape::product {

/// What a legend holds beside the colour scale.
struct LegendParts {
  bool colour_scale = true;  ///< false where colours stand for no decibels
  bool scale_bar = true;     ///< false where a pixel is not as long one way as the other
  bool north_arrow = true;   ///< false where north is not at the top; then no arrow says whence the radar looks
};

/// The picture with a strip below it: the colour scale with the decibels of its ends (and of the middle, of
/// differences), a scale bar of a round length on the ground, an arrow the way the radar looks (where the picture's
/// metadata have radar_azimuth_key) and one to true north, both as its coordinate system has them in its middle. The
/// ground keeps its pixels and its place. What does not fit beside one another into a narrow picture is left out, the
/// radar's arrow first; a picture too narrow for a colour scale comes back as it is.
[[nodiscard]] Picture with_legend(const Picture& picture, const LegendParts& parts = {});

/// The longest of 1, 2, 5, 10, 20, … metres (and of 0.1, 0.2, 0.5, …) that is no longer than `longest_m`, which must be
/// positive.
[[nodiscard]] double round_length_m(double longest_m);

}  // namespace sigmascape::product
