#include "sigmascape/product/plot.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>
#include <vector>

namespace sigmascape::product {
namespace {

constexpr double left = 64, right = 16, top = 36, bottom = 56;
/// Told apart by those who do not see all colours (M. Okabe, K. Ito, "Color Universal Design", 2008).
constexpr Rgba colours[] = {{0x00, 0x72, 0xb2}, {0xd5, 0x5e, 0x00}, {0x00, 0x9e, 0x73},
                            {0xcc, 0x79, 0xa7}, {0xe6, 0x9f, 0x00}, {0x56, 0xb4, 0xe9}};
constexpr double names_row = 16.0, names_spare = 10.0;
constexpr Rgba grid_grey{0xdd, 0xdd, 0xdd};
/// Names are read over it, and curves beneath it are still made out.
constexpr Rgba behind_names{0xff, 0xff, 0xff, 0xd9};

/// Of the i-th series. When all have been taken they come again darker, and then lighter.
Rgba colour_of(std::size_t i) {
  Rgba colour = colours[i % std::size(colours)];
  const std::size_t round = i / std::size(colours) % 3;
  for (std::uint8_t* part : {&colour.red, &colour.green, &colour.blue}) {
    if (round == 1) *part = static_cast<std::uint8_t>(*part / 2);
    if (round == 2) *part = static_cast<std::uint8_t>(255 - (255 - *part) / 2);
  }
  return colour;
}

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
  Axis(Extent values, double start, double end, bool is_logarithmic, bool from_zero, std::vector<double> marked = {})
      : is_logarithmic_(is_logarithmic), marked_(std::move(marked)), start_(start), end_(end) {
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

  struct Mark {
    double value;
    std::string text;
  };

  [[nodiscard]] std::vector<Mark> marks() const {
    if (!marked_.empty()) return marks_at(marked_);
    return is_logarithmic_ ? logarithmic_marks() : even_marks();
  }

 private:
  [[nodiscard]] double scaled(double value) const { return is_logarithmic_ ? std::log10(value) : value; }

  /// Those of the values that the axis reaches.
  [[nodiscard]] std::vector<Mark> marks_at(const std::vector<double>& values) const {
    std::vector<Mark> marks;
    for (const double value : values) {
      if (holds(value) && scaled(value) >= low_ && scaled(value) <= high_)
        marks.push_back({value, fmt::format("{:g}", value)});
    }
    return marks;
  }

  [[nodiscard]] std::vector<Mark> logarithmic_marks() const {
    std::vector<double> values;
    // Over many decades powers of ten alone have room.
    const bool is_wide = high_ - low_ > 3.5;
    for (int exponent = -12; exponent <= 12; ++exponent) {
      for (const double mantissa : {1.0, 2.0, 5.0}) {
        if (!is_wide || mantissa == 1.0) values.push_back(mantissa * std::pow(10.0, exponent));
      }
    }
    return marks_at(values);
  }

  [[nodiscard]] std::vector<Mark> even_marks() const {
    std::vector<Mark> marks;
    const double rough = (high_ - low_) / 5.0, magnitude = std::pow(10.0, std::floor(std::log10(rough)));
    const double step = rough / magnitude < 1.5 ? magnitude : rough / magnitude < 3.5 ? 2 * magnitude : 5 * magnitude;
    for (double k = std::ceil(low_ / step); k * step <= high_; k += 1.0) {
      const double value = k * step + 0.0;  // and no −0
      marks.push_back({value, text_of(value, step)});
    }
    return marks;
  }

  /// With as many digits as tell one mark from the next.
  [[nodiscard]] std::string text_of(double value, double step) const {
    const bool is_handy = std::max(std::abs(low_), std::abs(high_)) < 1e6 && step > 0.9e-6;
    if (!is_handy) return fmt::format("{:.10g}", value);
    return fmt::format("{:.{}f}", value, std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9))));
  }

  bool is_logarithmic_;
  std::vector<double> marked_;
  double low_ = 0.0, high_ = 1.0, start_, end_;
};

class PlotDrawer {
 public:
  explicit PlotDrawer(const Plot& plot)
      : plot_(plot),
        x_(x_extent(), left, drawing_.width - right, plot.x_is_logarithmic, plot.x_from_zero, plot.x_marks),
        y_(extent_of(&std::pair<double, double>::second), drawing_.height - bottom, top, plot.y_is_logarithmic,
           plot.y_from_zero) {}

  Drawing drawn() {
    frame();
    for (std::size_t i = 0; i < plot_.series.size(); ++i) series(plot_.series[i], colour_of(i));
    place_names();
    labels();
    legend();
    return std::move(drawing_);
  }

 private:
  [[nodiscard]] bool is_shown(const std::pair<double, double>& point) const {
    // Between larger ones, finite as they are, a difference may not be.
    constexpr double most = 1e300;
    const bool has_room = std::abs(point.first) <= most && std::abs(point.second) <= most;
    return has_room && point.second >= plot_.y_floor && (!plot_.x_is_logarithmic || point.first > 0.0) &&
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

  [[nodiscard]] Extent x_extent() const {
    Extent extent = extent_of(&std::pair<double, double>::first);
    if (plot_.x_ends) {
      extent.add(plot_.x_ends->first);
      extent.add(plot_.x_ends->second);
    }
    return extent;
  }

  void words(Vec2d at, Anchor anchor, std::string text, bool upwards = false) {
    if (!text.empty()) drawing_.marks.emplace_back(Words{at, anchor, std::move(text), upwards});
  }

  void frame() {
    const double foot = drawing_.height - bottom, end = drawing_.width - right;
    for (const auto& [mark, text] : x_.marks()) {
      const double place = x_.place_of(mark);
      drawing_.marks.emplace_back(Stroke{{{place, top}, {place, foot}}, grid_grey, 1.0});
      words({place, foot + 16}, Anchor::Middle, text);
    }
    for (const auto& [mark, text] : y_.marks()) {
      const double place = y_.place_of(mark);
      drawing_.marks.emplace_back(Stroke{{{left, place}, {end, place}}, grid_grey, 1.0});
      words({left - 6, place + 4}, Anchor::End, text);
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
    for (std::size_t i = 0; i < series.points.size(); ++i) {
      const auto& point = series.points[i];
      if (!is_shown(point)) {
        end_stroke();
        continue;
      }
      const Vec2d place{x_.place_of(point.first), y_.place_of(point.second)};
      if (series.dots) drawing_.marks.emplace_back(Dot{place, 3.5, ink});
      if (i < series.labels.size()) labels_.push_back({place, series.labels[i], stroke.points.empty()});
      take(place);
      if (series.joined && !stroke.points.empty()) take_line(stroke.points.back(), place);
      stroke.points.push_back(place);
    }
    end_stroke();
  }

  /// Each above or below its point, to the right or to the left, where least is hidden; of a line's first point rather
  /// to the left, where no other of it comes.
  void labels() {
    constexpr double height = 12.0, aside = 6.0, below = 15.0;
    for (const auto& [point, text, begins] : labels_) {
      const Vec2d size{width_of(text), height};
      std::vector<Vec2d> starts;
      for (const double y : {point.y - aside, point.y + below}) {
        const double to_right = point.x + aside, to_left = point.x - aside - size.x;
        for (const double x : {begins ? to_left : to_right, begins ? to_right : to_left}) {
          if (x > left && x + size.x < drawing_.width) starts.push_back({x, y});
        }
      }
      if (starts.empty()) continue;  // wider than the picture
      const Vec2d start = *std::ranges::min_element(starts, {}, [&](Vec2d at) {
        return taken_within(at - Vec2d{0.0, height}, size);
      });
      words(start, Anchor::Start, text);
      // Along its middle, so that no other is written over it.
      const Vec2d middle = start - Vec2d{0.0, height / 2.0};
      take(middle);
      take_line(middle, middle + Vec2d{size.x, 0.0});
    }
  }

  /// Of a letter in most fonts; those of more than one byte count as several, which leaves room.
  static double width_of(const std::string& text) { return 6.5 * static_cast<double>(text.size()); }

  /// Of many that lie closely, one: names are placed among at most so many as the picture has room for.
  void take(Vec2d place) {
    constexpr double apart = 4.0;
    const auto place_on = [](double along, double size) {
      return static_cast<std::size_t>(std::clamp(along, 0.0, size) / apart);
    };
    const std::size_t columns = place_on(drawing_.width, drawing_.width) + 1;
    const std::size_t rows = place_on(drawing_.height, drawing_.height) + 1;
    is_taken_.resize(columns * rows);
    auto is_taken = is_taken_[place_on(place.y, drawing_.height) * columns + place_on(place.x, drawing_.width)];
    if (!is_taken) taken_.push_back(place);
    is_taken = true;
  }

  /// The places on the way from one to another, the ends left out.
  void take_line(Vec2d from, Vec2d to) {
    constexpr double apart = 8.0;
    const auto parts = static_cast<int>(length(to - from) / apart) + 1;
    for (int i = 1; i < parts; ++i) take(from + (to - from) * (static_cast<double>(i) / parts));
  }

  /// Side by side where there are more names than fit above one another; of so many that even these do not, every
  /// other, or third and so on. In a corner, or, where they would hide something in each, where they hide least.
  void place_names() {
    const double foot = drawing_.height - bottom, end = drawing_.width - right;
    std::vector<std::size_t> named;
    double longest = 0.0;
    for (std::size_t i = 0; i < plot_.series.size(); ++i) {
      if (plot_.series[i].name.empty()) continue;
      named.push_back(i);
      longest = std::max(longest, width_of(plot_.series[i].name));
    }
    if (named.empty()) return;
    const double width = 30.0 + longest;
    const auto most_rows = static_cast<std::size_t>((foot - top - names_spare) / names_row);
    const auto most_columns = std::max<std::size_t>(1, static_cast<std::size_t>((end - left) / width));
    const std::size_t every = (named.size() - 1) / (most_rows * most_columns) + 1;
    for (std::size_t k = 0; k < named.size(); k += every) names_.shown.push_back(named[k]);
    const std::size_t columns = (names_.shown.size() - 1) / most_rows + 1;
    names_.rows = (names_.shown.size() - 1) / columns + 1;
    names_.width = width;
    names_.size = {width * static_cast<double>(columns), names_row * static_cast<double>(names_.rows) + names_spare};

    const Vec2d& size = names_.size;
    std::vector<Vec2d> corners{{left, foot - size.y}, {end - size.x, foot - size.y}, {end - size.x, top}, {left, top}};
    constexpr double step = 8.0;
    const auto hidden = [&](Vec2d corner) { return taken_within(corner, size); };
    if (std::ranges::none_of(corners, [&](Vec2d corner) { return hidden(corner) == 0; })) {
      for (double y = foot - size.y - step; y > top; y -= step) {
        for (double x = left; x <= end - size.x; x += step) corners.push_back({x, y});
      }
    }
    names_.corner = *std::ranges::min_element(corners, {}, hidden);
    for (double y = 0.0; y <= size.y; y += step)
      take_line(names_.corner + Vec2d{0.0, y}, names_.corner + Vec2d{size.x, y});
  }

  void legend() {
    if (names_.shown.empty()) return;
    drawing_.marks.emplace_back(Patch{names_.corner, names_.size, behind_names});
    for (std::size_t k = 0; k < names_.shown.size(); ++k) {
      const Vec2d at = names_.corner + Vec2d{names_.width * static_cast<double>(k / names_.rows),
                                             names_row * static_cast<double>(k % names_.rows + 1)};
      drawing_.marks.emplace_back(Dot{{at.x + 12, at.y - 4}, 4.0, colour_of(names_.shown[k])});
      words({at.x + 22, at.y}, Anchor::Start, plot_.series[names_.shown[k]].name);
    }
  }

  [[nodiscard]] std::ptrdiff_t taken_within(Vec2d corner, Vec2d size) const {
    return std::ranges::count_if(taken_, [&](Vec2d place) {
      const Vec2d from = place - corner;
      return from.x >= 0.0 && from.y >= 0.0 && from.x <= size.x && from.y <= size.y;
    });
  }

  const Plot& plot_;
  Drawing drawing_;
  Axis x_, y_;
  struct Label {
    Vec2d point;
    std::string text;
    bool begins;  // a line, or one after a gap
  };
  std::vector<Label> labels_;
  std::vector<bool> is_taken_;  ///< by place, row by row
  std::vector<Vec2d> taken_;    ///< by points, lines and words: where more words would hide something

  /// Where the names of the series stand, which of them, and in how many rows of columns so wide.
  struct Names {
    std::vector<std::size_t> shown;
    std::size_t rows = 0;
    double width = 0.0;
    Vec2d corner, size;
  };
  Names names_;
};

}  // namespace

Drawing drawing_of(const Plot& plot) {
  return PlotDrawer(plot).drawn();
}

std::string svg_of(const Plot& plot) {
  return svg_of(drawing_of(plot));
}

}  // namespace sigmascape::product
