#pragma once

#include <string>
#include <variant>
#include <vector>

#include "sigmascape/base/vec.h"
#include "sigmascape/product/colour_scale.h"
#include "sigmascape/product/picture.h"

namespace sigmascape::product {

/// Where a text stands relative to its point, along the line of writing.
enum class Anchor { Start, Middle, End };

struct Stroke {
  std::vector<Vec2d> points;
  Rgba ink;
  double width = 1.5;
};
struct Dot {
  Vec2d centre;
  double radius = 3.5;
  Rgba ink;
};
/// A rectangle by its upper left corner.
struct Patch {
  Vec2d corner, size;
  Rgba ink;  ///< whose alpha says how much of what is below it is covered
};
struct Words {
  Vec2d at;  ///< on the base line
  Anchor anchor = Anchor::Start;
  std::string text;
  bool upwards = false;  ///< written from bottom to top
};

/// Strokes, dots, patches and words on white paper, later ones over earlier ones. Places count from the upper left, x
/// to the right and y downwards.
struct Drawing {
  double width = 640.0, height = 400.0;
  std::vector<std::variant<Stroke, Dot, Patch, Words>> marks;
};

/// As an SVG picture that stands alone.
[[nodiscard]] std::string svg_of(const Drawing& drawing);

/// As pixels, `scale` along a unit: strokes and dots with smooth edges, words in the bitmap font.
[[nodiscard]] Picture picture_of(const Drawing& drawing, unsigned scale = 2);

}  // namespace sigmascape::product
