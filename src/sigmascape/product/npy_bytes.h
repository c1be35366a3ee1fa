#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace sigmascape::product {

/// A NumPy file (.npy, format 1.0, C order) as bytes. `type` is NumPy's word for the numbers: "<f4", "<f2", "|u1";
/// `shape` counts them along each axis, the slowest first. Assumes as many numbers as the shape says.
[[nodiscard]] std::string npy_bytes(std::string_view type, std::span<const std::size_t> shape,
                                    std::span<const std::byte> numbers);

/// Words as a NumPy file of bytes: text of NumPy's own would take four bytes a letter.
[[nodiscard]] std::string npy_text(std::string_view words);

}  // namespace sigmascape::product
