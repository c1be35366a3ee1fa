#include "sigmascape/atlas/error_texture.h"

#include <algorithm>
#include <cmath>

namespace sigmascape::atlas {
namespace {

constexpr double smallest = 1e-3;
constexpr double steps_per_decade = 50.0;

}  // namespace

std::uint8_t error_code(float relative_error, bool is_lit) {
  if (!is_lit) return 0;
  const double error = std::max(static_cast<double>(relative_error), smallest);
  return static_cast<std::uint8_t>(std::min(1.0 + std::round(std::log10(error / smallest) * steps_per_decade), 255.0));
}

float error_of(std::uint8_t code) {
  return code == 0 ? 0.0F : static_cast<float>(smallest * std::pow(10.0, (code - 1) / steps_per_decade));
}

std::filesystem::path errors_path(const std::filesystem::path& texture) {
  std::filesystem::path name = texture.stem();
  name += "_error.tif";
  return texture.parent_path() / name;
}

}  // namespace sigmascape::atlas
