#include "sigmascape/product/attribution_line.h"

#include <algorithm>
#include <sstream>

#include "sigmascape/product/bitmap_font.h"
#include "sigmascape/product/legend_look.h"

namespace sigmascape::product {
namespace {

// In dots of the font.
constexpr std::size_t margin = 4;
constexpr std::size_t line_height = glyph_height + 3;

/// In letters that the font has.
std::string spelled(std::string text) {
  constexpr std::string_view copyright = "©";
  for (auto at = text.find(copyright); at != std::string::npos; at = text.find(copyright, at)) {
    text.replace(at, copyright.size(), "(c)");
  }
  return text;
}

}  // namespace

std::vector<std::string> broken_into_lines(std::string_view text, std::size_t most_letters) {
  std::istringstream words{std::string(text)};
  std::vector<std::string> lines;
  for (std::string word; words >> word;) {
    if (!lines.empty() && lines.back().size() + 1 + word.size() <= most_letters) {
      lines.back() += " " + word;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

Picture with_attribution(const Picture& picture) {
  const auto attribution = picture.metadata.find("attribution");
  if (attribution == picture.metadata.end() || attribution->second.empty()) return picture;
  const std::size_t columns = picture.pixels.columns(), rows = picture.pixels.rows();
  const std::size_t dot = legend_dot(columns), letter = text_width("nn", dot) - text_width("n", dot);
  const std::size_t room = columns - std::min(columns, 2 * margin * dot);
  const std::vector<std::string> lines = broken_into_lines(spelled(attribution->second), room / letter);
  if (std::ranges::any_of(lines, [&](const std::string& line) { return text_width(line, dot) > room; })) return picture;

  Picture signed_picture = picture;
  const std::size_t height = (2 * margin + lines.size() * line_height) * dot;
  signed_picture.pixels = Array2D<Rgba>(columns, rows + height, legend_background);
  std::ranges::copy(picture.pixels.values(), signed_picture.pixels.values().begin());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    draw_text(signed_picture.pixels, margin * dot, rows + (margin + i * line_height) * dot, lines[i], dot, legend_ink);
  }
  return signed_picture;
}

}  // namespace sigmascape::product
