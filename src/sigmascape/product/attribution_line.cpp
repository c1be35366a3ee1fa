#include "sigmascape/product/attribution_line.h"

#include <algorithm>
#include <sstream>

#include "sigmascape/product/bitmap_font.h"
#include "sigmascape/product/legend_look.h"

namespace sigmascape::product {
namespace {

// In dots of the font.
constexpr std::size_t line_margin = 4;
constexpr std::size_t line_height = glyph_height + 3;

/// A narrower picture is made as wide as that: on fewer letters a line nobody could read it.
constexpr std::size_t fewest_letters = 8;

/// In letters that the font has.
std::string spelled(std::string text) {
  constexpr std::string_view copyright = "©";
  for (auto at = text.find(copyright); at != std::string::npos; at = text.find(copyright, at)) {
    text.replace(at, copyright.size(), "(c)");
  }
  return text;
}

bool goes_on_a_letter(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

/// Letters of UTF-8 text.
std::size_t letters_in(std::string_view text) {
  return text.size() - static_cast<std::size_t>(std::ranges::count_if(text, goes_on_a_letter));
}

/// The first letters of a text, or all where it has no more.
std::string_view first_letters(std::string_view text, std::size_t letters) {
  std::size_t end = 0;
  for (; end < text.size(); ++end) {
    if (!goes_on_a_letter(text[end]) && letters-- == 0) break;
  }
  return text.substr(0, end);
}

/// The picture with so many more rows below it, and at least so wide, in the colour of legends.
Array2D<Rgba> with_room_below(const Array2D<Rgba>& pixels, std::size_t least_columns, std::size_t rows) {
  Array2D<Rgba> larger(std::max(pixels.columns(), least_columns), pixels.rows() + rows, legend_background);
  for (std::size_t row = 0; row < pixels.rows(); ++row) std::ranges::copy(pixels.row(row), larger.row(row).begin());
  return larger;
}

}  // namespace

std::vector<std::string> broken_into_lines(std::string_view text, std::size_t most_letters) {
  std::istringstream words{std::string(text)};
  std::vector<std::string> lines;
  for (std::string word; words >> word;) {
    if (!lines.empty() && letters_in(lines.back()) + 1 + letters_in(word) <= most_letters) {
      lines.back() += " " + word;
      continue;
    }
    for (std::string_view rest = word; !rest.empty(); rest.remove_prefix(lines.back().size()))
      lines.emplace_back(first_letters(rest, most_letters));
  }
  return lines;
}

Picture with_attribution(const Picture& picture) {
  const auto attribution = picture.metadata.find("attribution");
  if (attribution == picture.metadata.end() || attribution->second.empty()) return picture;
  const std::size_t rows = picture.pixels.rows(), dot = legend_dot(picture.pixels.columns());
  const std::size_t letter = text_width("nn", dot) - text_width("n", dot), margins = 2 * line_margin * dot;
  const std::size_t columns = std::max(picture.pixels.columns(), margins + fewest_letters * letter);
  const std::vector<std::string> lines = broken_into_lines(spelled(attribution->second), (columns - margins) / letter);

  Picture signed_picture = picture;
  signed_picture.pixels =
      with_room_below(picture.pixels, columns, (2 * line_margin + lines.size() * line_height) * dot);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    draw_text(signed_picture.pixels, line_margin * dot, rows + (line_margin + i * line_height) * dot, lines[i], dot,
              legend_ink);
  }
  return signed_picture;
}

}  // namespace sigmascape::product
