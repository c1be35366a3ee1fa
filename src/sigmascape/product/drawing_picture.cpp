#include <algorithm>
#include <cmath>

#include "sigmascape/product/bitmap_font.h"
#include "sigmascape/product/drawing.h"

namespace sigmascape::product {
namespace {

constexpr Rgba paper{255, 255, 255, 255}, black{0, 0, 0, 255};

double distance_to(Vec2d point, Vec2d from, Vec2d to) {
  const Vec2d along = to - from;
  const double length2 = dot(along, along);
  const double part = length2 > 0.0 ? std::clamp(dot(point - from, along) / length2, 0.0, 1.0) : 0.0;
  return length(point - from - along * part);
}

class Brush {
 public:
  Brush(Array2D<Rgba>& pixels, double scale) : pixels_(&pixels), scale_(scale) {}

  void operator()(const Stroke& stroke) const {
    for (std::size_t i = 1; i < stroke.points.size(); ++i)
      line(stroke.points[i - 1] * scale_, stroke.points[i] * scale_, stroke.width * scale_ / 2.0, stroke.ink);
  }
  void operator()(const Dot& mark) const {
    line(mark.centre * scale_, mark.centre * scale_, mark.radius * scale_, mark.ink);
  }
  void operator()(const Patch& patch) const {
    const Vec2d first = patch.corner * scale_, end = (patch.corner + patch.size) * scale_;
    for (double y = std::round(first.y); y < std::round(end.y); y += 1.0) {
      for (double x = std::round(first.x); x < std::round(end.x); x += 1.0)
        put({x, y}, patch.ink, patch.ink.alpha / 255.0);
    }
  }
  void operator()(const Words& words) const {
    const auto dot_size = static_cast<std::size_t>(scale_);
    Array2D<Rgba> strip(std::max<std::size_t>(1, text_width(words.text, dot_size)),
                        (glyph_height + glyph_depth) * dot_size, paper);
    draw_text(strip, 0, 0, words.text, dot_size, black);
    const auto width = static_cast<double>(strip.columns()), height = static_cast<double>(glyph_height * dot_size);
    const double before = words.anchor == Anchor::Start ? 0.0 : words.anchor == Anchor::Middle ? width / 2.0 : width;
    const Vec2d at = words.at * scale_;
    for (std::size_t row = 0; row < strip.rows(); ++row) {
      for (std::size_t column = 0; column < strip.columns(); ++column) {
        if (strip(column, row) != black) continue;
        const double along = static_cast<double>(column) - before, above = height - static_cast<double>(row);
        put(words.upwards ? Vec2d{at.x - above, at.y - along} : Vec2d{at.x + along, at.y - above}, black, 1.0);
      }
    }
  }

 private:
  /// A line with round ends: pixels whose middles are within `radius`, those at its edge in part.
  void line(Vec2d from, Vec2d to, double radius, Rgba ink) const {
    const double reach = radius + 1.0;
    for (double y = std::floor(std::min(from.y, to.y) - reach); y <= std::max(from.y, to.y) + reach; y += 1.0) {
      for (double x = std::floor(std::min(from.x, to.x) - reach); x <= std::max(from.x, to.x) + reach; x += 1.0) {
        const double cover = radius + 0.5 - distance_to({x + 0.5, y + 0.5}, from, to);
        if (cover > 0.0) put({x, y}, ink, std::min(cover, 1.0));
      }
    }
  }

  void put(Vec2d at, Rgba ink, double cover) const {
    if (at.x < 0.0 || at.y < 0.0) return;
    const auto column = static_cast<std::size_t>(at.x), row = static_cast<std::size_t>(at.y);
    if (column >= pixels_->columns() || row >= pixels_->rows()) return;
    Rgba& pixel = (*pixels_)(column, row);
    const auto mixed = [cover](std::uint8_t below, std::uint8_t above) {
      return static_cast<std::uint8_t>(std::lround(below + cover * (above - below)));
    };
    pixel = {mixed(pixel.red, ink.red), mixed(pixel.green, ink.green), mixed(pixel.blue, ink.blue), 255};
  }

  Array2D<Rgba>* pixels_;
  double scale_;
};

}  // namespace

Picture picture_of(const Drawing& drawing, unsigned scale) {
  Picture picture;
  const auto pixels = [scale](double units) { return static_cast<std::size_t>(std::lround(units * scale)); };
  picture.pixels = Array2D<Rgba>(pixels(drawing.width), pixels(drawing.height), paper);
  picture.grid = {0.0, 0.0, 1.0, picture.pixels.columns(), picture.pixels.rows()};
  const Brush brush(picture.pixels, scale);
  for (const auto& mark : drawing.marks) std::visit(brush, mark);
  return picture;
}

}  // namespace sigmascape::product
