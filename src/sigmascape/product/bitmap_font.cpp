#include "sigmascape/product/bitmap_font.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "sigmascape/product/rectangle_fill.h"

namespace sigmascape::product {
namespace {

constexpr std::size_t glyph_width = 5;
constexpr std::size_t advance = glyph_width + 1;

struct Glyph {
  char letter;
  std::array<std::uint8_t, glyph_height> rows;  ///< five bits each, the leftmost dot first
};

constexpr Glyph glyphs[] = {
    {'0', {0b01110, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01110}},
    {'1', {0b00100, 0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110}},
    {'2', {0b01110, 0b10001, 0b00001, 0b00110, 0b01000, 0b10000, 0b11111}},
    {'3', {0b11110, 0b00001, 0b00001, 0b01110, 0b00001, 0b00001, 0b11110}},
    {'4', {0b00010, 0b00110, 0b01010, 0b10010, 0b11111, 0b00010, 0b00010}},
    {'5', {0b11111, 0b10000, 0b11110, 0b00001, 0b00001, 0b10001, 0b01110}},
    {'6', {0b00110, 0b01000, 0b10000, 0b11110, 0b10001, 0b10001, 0b01110}},
    {'7', {0b11111, 0b00001, 0b00010, 0b00100, 0b00100, 0b01000, 0b01000}},
    {'8', {0b01110, 0b10001, 0b10001, 0b01110, 0b10001, 0b10001, 0b01110}},
    {'9', {0b01110, 0b10001, 0b10001, 0b01111, 0b00001, 0b00010, 0b01100}},
    {'-', {0b00000, 0b00000, 0b00000, 0b11111, 0b00000, 0b00000, 0b00000}},
    {'+', {0b00000, 0b00100, 0b00100, 0b11111, 0b00100, 0b00100, 0b00000}},
    {'.', {0b00000, 0b00000, 0b00000, 0b00000, 0b00000, 0b01100, 0b01100}},
    {'d', {0b00001, 0b00001, 0b01111, 0b10001, 0b10001, 0b10001, 0b01111}},
    {'B', {0b11110, 0b10001, 0b10001, 0b11110, 0b10001, 0b10001, 0b11110}},
    {'m', {0b00000, 0b00000, 0b11010, 0b10101, 0b10101, 0b10101, 0b10101}},
    {'k', {0b10000, 0b10000, 0b10010, 0b10100, 0b11000, 0b10100, 0b10010}},
    {'N', {0b10001, 0b11001, 0b10101, 0b10101, 0b10011, 0b10001, 0b10001}},
};

const Glyph* glyph_of(char letter) {
  const auto* found =
      std::find_if(std::begin(glyphs), std::end(glyphs), [&](const Glyph& g) { return g.letter == letter; });
  return found == std::end(glyphs) ? nullptr : found;
}

void draw_glyph(Array2D<Rgba>& pixels, std::size_t column, std::size_t row, const Glyph& glyph, std::size_t dot_size,
                Rgba ink) {
  for (std::size_t y = 0; y < glyph_height; ++y) {
    for (std::size_t x = 0; x < glyph_width; ++x) {
      if (((glyph.rows[y] >> (glyph_width - 1 - x)) & 1U) == 0) continue;
      fill_rectangle(pixels, {column + x * dot_size, row + y * dot_size, dot_size, dot_size}, ink);
    }
  }
}

}  // namespace

std::size_t text_width(std::string_view text, std::size_t dot_size) {
  return text.empty() ? 0 : (text.size() * advance - 1) * dot_size;
}

void draw_text(Array2D<Rgba>& pixels, std::size_t column, std::size_t row, std::string_view text, std::size_t dot_size,
               Rgba ink) {
  for (const char letter : text) {
    if (const Glyph* glyph = glyph_of(letter)) draw_glyph(pixels, column, row, *glyph, dot_size, ink);
    column += advance * dot_size;
  }
}

}  // namespace sigmascape::product
