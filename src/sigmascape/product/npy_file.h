#pragma once

#include <complex>
#include <cstddef>
#include <filesystem>
#include <vector>

namespace sigmascape::product {

/// Complex numbers of a NumPy file, C order.
struct ComplexArray {
  std::vector<std::size_t> shape;
  std::vector<std::complex<float>> numbers;
};

/// Reads a NumPy file (.npy, little-endian complex64, C order), as `write_iq` makes it. Throws Error when it cannot be
/// read or holds something else.
[[nodiscard]] ComplexArray read_complex_npy(const std::filesystem::path& path);

}  // namespace sigmascape::product
