#pragma once

namespace sigmascape::live {

/// The smaller, and the greater, of two numbers: by value, as vector units do it.
inline float lesser(float a, float b) {
  return a < b ? a : b;
}
inline float greater(float a, float b) {
  return a > b ? a : b;
}

}  // namespace sigmascape::live
