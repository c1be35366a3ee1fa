#include "sigmascape/product/plot.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace sigmascape::product {
namespace {

constexpr double left = 64, right = 16, top = 36, bottom = 56;
/// Told apart by those who do not see all colours (M. Okabe, K. Ito, "Color Universal Design", 2008).
constexpr Rgba colours[] = {{0x00, 0x72, 0xb2}, {0xd5, 0x5e, 0x00}, {0x00, 0x9e, 0x73},
                            {0xcc, 0x79, 0xa7}, {0xe6, 0x9f, 0x00}, {0x56, 0xb4, 0xe9}};
constexpr Rgba grid_grey{0xdd, 0xdd, 0xdd};

struct Extent {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();

  void add(double value) {
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }
};

/// One axis: from numbers to places, with round numbers to mark.
class Axis {
 public:
  Axis(Extent values, double start, double end, bool is_logarithmic, bool from_zero)
      : is_logarithmic_(is_logarithmic), start_(start), end_(end) {
    if (!std::isfinite(values.lowest)) values = {1.0, 1.0};
    const bool zero_below = from_zero && !is_logarithmic && values.lowest >= 0.0;
    low_ = scaled(zero_below ? 0.0 : values.lowest);
    high_ = scaled(values.highest);
    // Of numbers that differ by their rounding alone there is nothing to mark between.
    const double size = std::max(std::abs(low_), std::abs(high_));
    if (!(high_ - low_ > 1e-9 * size)) high_ = low_ + std::max(1.0, 1e-3 * size);
    const double spare = 0.04 * (high_ - low_);
    high_ += spare;
    low_ -= zero_below ? 0.0 : spare;
  }

  [[nodiscard]] bool holds(double value) const { return !is_logarithmic_ || value > 0.0; }
  [[nodiscard]] double place_of(double value) const {
    return start_ + (end_ - start_) * (scaled(value) - low_) / (high_ - low_);
  }

  [[nodiscard]] std::vector<double> marks() const { return is_logarithmic_ ? logarithmic_marks() : even_marks(); }

 private:
  [[nodiscard]] double scaled(double value) const { return is_logarithmic_ ? std::log10(value) : value; }

  [[nodiscard]] std::vector<double> logarithmic_marks() const {
    std::vector<double> marks;
    // Over many decades powers of ten alone have room.
    const bool is_wide = high_ - low_ > 3.5;
    for (int exponent = -12; exponent <= 12; ++exponent) {
      for (const double mantissa : {1.0, 2.0, 5.0}) {
        const double value = mantissa * std::pow(10.0, exponent);
        if (is_wide && mantissa > 1.0) continue;
        if (scaled(value) >= low_ && scaled(value) <= high_) marks.push_back(value);
      }
    }
    return marks;
  }

  [[nodiscard]] std::vector<double> even_marks() const {
    std::vector<double> marks;
    const double rough = (high_ - low_) / 5.0, magnitude = std::pow(10.0, std::floor(std::log10(rough)));
    const double step = rough / magnitude < 1.5 ? magnitude : rough / magnitude < 3.5 ? 2 * magnitude : 5 * magnitude;
    for (double k = std::ceil(low_ / step); k * step <= high_; k += 1.0) marks.push_back(k * step + 0.0);  // and no −0
    return marks;
  }

  bool is_logarithmic_;
  double low_ = 0.0, high_ = 1.0, start_, end_;
};

class PlotDrawer {
 public:
  explicit PlotDrawer(const Plot& plot)
      : plot_(plot),
        x_(extent_of(&std::pair<double, double>::first), left, drawing_.width - right, plot.x_is_logarithmic,
           plot.x_from_zero),
        y_(extent_of(&std::pair<double, double>::second), drawing_.height - bottom, top, plot.y_is_logarithmic,
           plot.y_from_zero) {}

  Drawing drawn() {
    frame();
    for (std::size_t i = 0; i < plot_.series.size(); ++i) series(plot_.series[i], colours[i % std::size(colours)]);
    legend();
    return std::move(drawing_);
  }

 private:
  [[nodiscard]] bool is_shown(const std::pair<double, double>& point) const {
    const bool is_finite = std::isfinite(point.first) && std::isfinite(point.second);
    return is_finite && (!plot_.x_is_logarithmic || point.first > 0.0) &&
           (!plot_.y_is_logarithmic || point.second > 0.0);
  }
  [[nodiscard]] Extent extent_of(double std::pair<double, double>::*coordinate) const {
    Extent extent;
    for (const PlotSeries& series : plot_.series) {
      for (const auto& point : series.points) {
        if (is_shown(point)) extent.add(point.*coordinate);
      }
    }
    return extent;
  }

  void words(Vec2d at, Anchor anchor, std::string text, bool upwards = false) {
    if (!text.empty()) drawing_.marks.emplace_back(Words{at, anchor, std::move(text), upwards});
  }

  void frame() {
    const double foot = drawing_.height - bottom, end = drawing_.width - right;
    for (const double mark : x_.marks()) {
      const double place = x_.place_of(mark);
      drawing_.marks.emplace_back(Stroke{{{place, top}, {place, foot}}, grid_grey, 1.0});
      words({place, foot + 16}, Anchor::Middle, fmt::format("{:g}", mark));
    }
    for (const double mark : y_.marks()) {
      const double place = y_.place_of(mark);
      drawing_.marks.emplace_back(Stroke{{{left, place}, {end, place}}, grid_grey, 1.0});
      words({left - 6, place + 4}, Anchor::End, fmt::format("{:.3g}", mark));
    }
    words({(left + end) / 2, drawing_.height - 16}, Anchor::Middle, plot_.x_label);
    words({left, 20}, Anchor::Start, plot_.title);
    words({16, (top + foot) / 2}, Anchor::Middle, plot_.y_label, true);
  }

  void series(const PlotSeries& series, Rgba ink) {
    Stroke stroke{{}, ink, 1.5};
    const auto end_stroke = [&] {
      if (series.joined && stroke.points.size() > 1) drawing_.marks.emplace_back(stroke);
      stroke.points.clear();
    };
    for (const auto& point : series.points) {
      if (!is_shown(point)) {
        end_stroke();
        continue;
      }
      const Vec2d place{x_.place_of(point.first), y_.place_of(point.second)};
      if (series.dots) drawing_.marks.emplace_back(Dot{place, 3.5, ink});
      stroke.points.push_back(place);
    }
    end_stroke();
  }

  void legend() {
    // In that corner below the points, or above them, which comes near fewest of them.
    const double rows = 16.0 * static_cast<double>(plot_.series.size());
    const double foot = drawing_.height - bottom, end = drawing_.width - right;
    std::size_t longest = 0;
    for (const PlotSeries& series : plot_.series) longest = std::max(longest, series.name.size());
    const double width = 30.0 + 6.5 * static_cast<double>(longest);
    Vec2d best{left, foot - rows - 10.0};
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    for (const Vec2d corner :
         {best, Vec2d{end - width, foot - rows - 10.0}, Vec2d{end - width, top}, Vec2d{left, top}}) {
      const std::size_t covered = points_within(corner, {width, rows + 10.0});
      if (covered < fewest) fewest = covered, best = corner;
    }
    double line = best.y + 16.0;
    for (std::size_t i = 0; i < plot_.series.size(); ++i) {
      if (plot_.series[i].name.empty()) continue;
      drawing_.marks.emplace_back(Dot{{best.x + 12, line - 4}, 4.0, colours[i % std::size(colours)]});
      words({best.x + 22, line}, Anchor::Start, plot_.series[i].name);
      line += 16.0;
    }
  }

  [[nodiscard]] std::size_t points_within(Vec2d corner, Vec2d size) const {
    std::size_t count = 0;
    for (const PlotSeries& series : plot_.series) {
      for (const auto& point : series.points) {
        if (!is_shown(point)) continue;
        const double x = x_.place_of(point.first) - corner.x, y = y_.place_of(point.second) - corner.y;
        if (x >= 0.0 && y >= 0.0 && x <= size.x && y <= size.y) ++count;
      }
    }
    return count;
  }

  const Plot& plot_;
  Drawing drawing_;
  Axis x_, y_;
};

}  // namespace

Drawing drawing_of(const Plot& plot) {
  return PlotDrawer(plot).drawn();
}

std::string svg_of(const Plot& plot) {
  return svg_of(drawing_of(plot));
}

}  // namespace sigmascape::product
