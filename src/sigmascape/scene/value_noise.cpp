#include "sigmascape/scene/value_noise.h"

#include <algorithm>
#include <cmath>

#include "sigmascape/base/hash.h"

namespace sigmascape::scene {
namespace {

double lattice_value(std::uint64_t seed, std::int64_t x, std::int64_t y) {
  return unit_float(hashed(seed, x, y));
}

double quintic(double t) {
  return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

}  // namespace

double value_noise(std::uint64_t seed, Vec2d p) {
  const double left = std::floor(p.x), below = std::floor(p.y);
  const auto x = static_cast<std::int64_t>(left), y = static_cast<std::int64_t>(below);
  const double u = quintic(p.x - left), v = quintic(p.y - below);
  const double low = std::lerp(lattice_value(seed, x, y), lattice_value(seed, x + 1, y), u);
  const double high = std::lerp(lattice_value(seed, x, y + 1), lattice_value(seed, x + 1, y + 1), u);
  return std::lerp(low, high, v);
}

double fractal_noise(std::uint64_t seed, Vec2d p, unsigned octaves) {
  double sum = 0.0, weights = 0.0, weight = 1.0;
  for (unsigned octave = 0; octave < octaves; ++octave, weight *= 0.5, p = p * 2.0) {
    sum += weight * value_noise(hashed(seed, octave), p);
    weights += weight;
  }
  return sum / weights;
}

double smooth_step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace sigmascape::scene
