#pragma once

#include <cstddef>
#include <string_view>

#include "sigmascape/base/array2d.h"
#include "sigmascape/product/colour_scale.h"

namespace sigmascape::product {

/// Letters of 5 × 7 dots, and two more for what hangs below the base line, for the few words on legends and plots:
/// digits, the Latin alphabet, common signs and σ, ψ, λ, °, ². Text is UTF-8; letters lose their accents, other
/// characters are question marks.

inline constexpr std::size_t glyph_height = 7;  ///< dots above the base line
inline constexpr std::size_t glyph_depth = 2;   ///< dots below it

/// Width of a text in pixels, every dot `dot_size` pixels wide.
[[nodiscard]] std::size_t text_width(std::string_view text, std::size_t dot_size);

/// Draws a text with its upper left corner at (column, row); what lies outside the pixels is cut off.
void draw_text(Array2D<Rgba>& pixels, std::size_t column, std::size_t row, std::string_view text, std::size_t dot_size,
               Rgba ink);

}  // namespace sigmascape::product
