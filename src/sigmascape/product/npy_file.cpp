#include "sigmascape/product/npy_file.h"

#include <charconv>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <system_error>

#include "sigmascape/base/error.h"

namespace sigmascape::product {
namespace {

constexpr const char* magic = "\x93NUMPY";
constexpr std::size_t head = 10;

Error not_wanted(const std::filesystem::path& path, const std::string& what) {
  return {path.string(), what, "give a .npy file of complex64 that sigmascape wrote, or numpy.save of such an array"};
}

/// The header's words: {'descr': '<c8', 'fortran_order': False, 'shape': (3, 4), }.
std::vector<std::size_t> shape_in(const std::string& words) {
  std::vector<std::size_t> shape;
  const std::size_t open = words.find('(', words.find("'shape'"));
  for (std::size_t at = open + 1; at < words.size() && words[at] != ')';) {
    if (words[at] < '0' || words[at] > '9') {
      ++at;
      continue;
    }
    std::size_t length = 0;
    const auto [stopped, fault] = std::from_chars(words.data() + at, words.data() + words.size(), length);
    if (fault != std::errc{}) length = std::numeric_limits<std::size_t>::max();
    shape.push_back(length);
    at = static_cast<std::size_t>(stopped - words.data());
  }
  return shape;
}

}  // namespace

ComplexArray read_complex_npy(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw not_wanted(path, "cannot be opened");
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (bytes.size() < head || bytes.compare(0, 6, magic, 6) != 0 || bytes[6] != 1)
    throw not_wanted(path, "is no NumPy file of format 1");
  const auto low = static_cast<unsigned char>(bytes[8]), high = static_cast<unsigned char>(bytes[9]);
  const std::size_t begin = head + low + std::size_t{256} * high;
  if (begin > bytes.size()) throw not_wanted(path, "ends within its header");
  const std::string words = bytes.substr(head, begin - head);
  if (words.find("'<c8'") == std::string::npos || words.find("False") == std::string::npos ||
      words.find("'shape'") == std::string::npos)
    throw not_wanted(path, "holds something else than complex64 in C order");
  ComplexArray array{.shape = shape_in(words), .numbers = {}};
  const std::size_t held = (bytes.size() - begin) / sizeof(std::complex<float>);
  std::size_t count = 1;
  for (const std::size_t length : array.shape) {
    // Whose product may be a number that none holds.
    if (length > 0 && count > held / length) throw not_wanted(path, "is cut off");
    count *= length;
  }
  if (bytes.size() - begin != count * sizeof(std::complex<float>)) throw not_wanted(path, "is cut off");
  array.numbers.resize(count);
  std::memcpy(array.numbers.data(), bytes.data() + begin, bytes.size() - begin);
  return array;
}

}  // namespace sigmascape::product
