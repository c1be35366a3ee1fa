#include "sigmascape/product/npy_bytes.h"

#include <array>
#include <bit>
#include <fmt/format.h>

namespace sigmascape::product {

static_assert(std::endian::native == std::endian::little);

std::string npy_bytes(std::string_view type, std::span<const std::size_t> shape, std::span<const std::byte> numbers) {
  std::string axes;
  for (const std::size_t length : shape) axes += fmt::format("{}, ", length);
  if (shape.size() > 1) axes.resize(axes.size() - 2);
  std::string words = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, axes);
  // The numbers begin at a multiple of 64 bytes, behind magic, version and the length of the words.
  constexpr std::size_t before = 10, alignment = 64;
  words.append(alignment - 1 - (before + words.size()) % alignment, ' ');
  words += '\n';
  std::string bytes = "\x93NUMPY";
  bytes += {'\x01', '\x00', static_cast<char>(words.size() & 0xffU), static_cast<char>(words.size() >> 8U)};
  bytes += words;
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size());
  return bytes;
}

std::string npy_text(std::string_view words) {
  const std::array shape{words.size()};
  return npy_bytes("|u1", shape, std::as_bytes(std::span(words)));
}

}  // namespace sigmascape::product
