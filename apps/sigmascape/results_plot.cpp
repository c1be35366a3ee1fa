#include "results_plot.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace sigmascape::cli {
namespace {

constexpr double width = 640, height = 400, left = 64, right = 16, top = 36, bottom = 56;
/// Told apart by those who do not see all colours (M. Okabe, K. Ito, "Color Universal Design", 2008).
constexpr const char* colours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};

bool is_finite(const std::pair<double, double>& point) {
  return std::isfinite(point.first) && std::isfinite(point.second);
}

/// One axis: from numbers to places, with round numbers to mark.
class Axis {
 public:
  Axis(double lowest, double highest, double start, double end, bool is_logarithmic)
      : is_logarithmic_(is_logarithmic), low_(scaled(lowest)), high_(scaled(highest)), start_(start), end_(end) {
    if (!(high_ > low_)) high_ = low_ + 1.0;
    const double spare = 0.04 * (high_ - low_);
    high_ += spare;
    low_ -= lowest == 0.0 ? 0.0 : spare;
  }

  [[nodiscard]] double place_of(double value) const {
    return start_ + (end_ - start_) * (scaled(value) - low_) / (high_ - low_);
  }

  [[nodiscard]] std::vector<double> marks() const {
    std::vector<double> marks;
    if (is_logarithmic_) {
      for (int exponent = -12; exponent <= 12; ++exponent) {
        for (const double mantissa : {1.0, 2.0, 5.0}) {
          const double value = mantissa * std::pow(10.0, exponent);
          if (scaled(value) >= low_ && scaled(value) <= high_) marks.push_back(value);
        }
      }
      return marks;
    }
    const double rough = (high_ - low_) / 5.0, magnitude = std::pow(10.0, std::floor(std::log10(rough)));
    const double step = rough / magnitude < 1.5 ? magnitude : rough / magnitude < 3.5 ? 2 * magnitude : 5 * magnitude;
    for (double k = std::ceil(low_ / step); k * step <= high_; k += 1.0) marks.push_back(k * step);
    return marks;
  }

 private:
  [[nodiscard]] double scaled(double value) const { return is_logarithmic_ ? std::log10(value) : value; }

  bool is_logarithmic_;
  double low_, high_, start_, end_;
};

std::string text(double x, double y, const char* anchor, const std::string& words) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, words);
}

std::string frame_of(const Plot& plot, const Axis& x, const Axis& y) {
  std::string svg;
  for (const double mark : x.marks()) {
    svg += fmt::format("<path d=\"M{0:.1f} {1} V{2}\" stroke=\"#ddd\"/>\n", x.place_of(mark), top, height - bottom);
    svg += text(x.place_of(mark), height - bottom + 16, "middle", fmt::format("{:g}", mark));
  }
  for (const double mark : y.marks()) {
    svg += fmt::format("<path d=\"M{0} {1:.1f} H{2}\" stroke=\"#ddd\"/>\n", left, y.place_of(mark), width - right);
    svg += text(left - 6, y.place_of(mark) + 4, "end", fmt::format("{:.3g}", mark));
  }
  svg += text((left + width - right) / 2, height - 16, "middle", plot.x_label);
  svg += text(left, 20, "start", plot.title);
  svg += fmt::format("<text transform=\"translate(16 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                     (top + height - bottom) / 2, plot.y_label);
  return svg;
}

std::string series_svg(const PlotSeries& series, const Axis& x, const Axis& y, const char* colour) {
  std::string svg, line;
  for (const auto& point : series.points) {
    if (!is_finite(point)) continue;
    const double px = x.place_of(point.first), py = y.place_of(point.second);
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"/>\n", px, py, colour);
    line += fmt::format("{}{:.1f} {:.1f}", line.empty() ? "M" : " L", px, py);
  }
  if (series.joined && !line.empty())
    svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"/>\n", line, colour);
  return svg;
}

}  // namespace

std::string svg_of(const Plot& plot) {
  double lowest_x = std::numeric_limits<double>::infinity(), highest_x = -lowest_x, highest_y = 0.0;
  for (const PlotSeries& series : plot.series) {
    for (const auto& point : series.points) {
      if (!is_finite(point)) continue;
      lowest_x = std::min(lowest_x, point.first);
      highest_x = std::max(highest_x, point.first);
      highest_y = std::max(highest_y, point.second);
    }
  }
  if (!std::isfinite(lowest_x)) lowest_x = highest_x = 1.0;
  const Axis x(plot.x_is_logarithmic ? lowest_x : 0.0, highest_x, left, width - right, plot.x_is_logarithmic);
  const Axis y(0.0, highest_y, height - bottom, top, false);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n",
      width, height);
  svg += frame_of(plot, x, y);
  // Below the points, which seldom come near zero.
  double legend_y = height - bottom - 16.0 * static_cast<double>(plot.series.size()) + 6;
  std::size_t index = 0;
  for (const PlotSeries& series : plot.series) {
    const char* colour = colours[index++ % std::size(colours)];
    svg += series_svg(series, x, y, colour);
    svg += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"4\" fill=\"{}\"/>\n", left + 12, legend_y - 4, colour);
    svg += text(left + 22, legend_y, "start", series.name);
    legend_y += 16;
  }
  return svg + "</svg>\n";
}

}  // namespace sigmascape::cli
