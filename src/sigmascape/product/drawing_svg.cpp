#include <fmt/format.h>

#include "sigmascape/product/drawing.h"

namespace sigmascape::product {
namespace {

std::string colour(Rgba ink) {
  return fmt::format("#{:02x}{:02x}{:02x}", ink.red, ink.green, ink.blue);
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (static_cast<unsigned char>(c) < 0x20) {
      out += ' ';  // of which XML knows next to none
    } else {
      out += c;
    }
  }
  return out;
}

const char* word_for(Anchor anchor) {
  return anchor == Anchor::Start ? "start" : anchor == Anchor::Middle ? "middle" : "end";
}

struct SvgWriter {
  std::string operator()(const Stroke& stroke) const {
    std::string line;
    for (const Vec2d& point : stroke.points)
      line += fmt::format("{}{:.1f} {:.1f}", line.empty() ? "M" : " L", point.x, point.y);
    return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"/>\n", line, colour(stroke.ink),
                       stroke.width);
  }
  std::string operator()(const Dot& dot) const {
    return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"/>\n", dot.centre.x, dot.centre.y,
                       dot.radius, colour(dot.ink));
  }
  std::string operator()(const Patch& patch) const {
    return fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\" fill-opacity=\"{:.2f}\"/>\n",
        patch.corner.x, patch.corner.y, patch.size.x, patch.size.y, colour(patch.ink), patch.ink.alpha / 255.0);
  }
  std::string operator()(const Words& words) const {
    const std::string place =
        words.upwards ? fmt::format("transform=\"translate({:.1f} {:.1f}) rotate(-90)\"", words.at.x, words.at.y)
                      : fmt::format("x=\"{:.1f}\" y=\"{:.1f}\"", words.at.x, words.at.y);
    return fmt::format("<text {} text-anchor=\"{}\">{}</text>\n", place, word_for(words.anchor), escaped(words.text));
  }
};

}  // namespace

std::string svg_of(const Drawing& drawing) {
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n",
      drawing.width, drawing.height);
  for (const auto& mark : drawing.marks) svg += std::visit(SvgWriter{}, mark);
  return svg + "</svg>\n";
}

}  // namespace sigmascape::product
