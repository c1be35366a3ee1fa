#pragma once

#include <cmath>
#include <cstdint>

namespace sigmascape::trace {

/// What became of the power that the paths of a tracer carried, the mean over transmit polarizations and frequencies.
/// Each path brings one unit. docs/physics/estimator.md, Eq. (11).
struct PowerBooks {
  std::uint64_t paths = 0;  ///< the incident power
  double absorbed = 0.0;    ///< by surfaces, found with directions of a density that no model has a part in
  double escaped = 0.0;     ///< carried away by paths that meet nothing more
  double cut = 0.0;         ///< carried by paths that the limit of bounces ended
  /// Lost to Russian roulette less what its survivors gained: no power leaves this way in the mean.
  double roulette = 0.0;
  double squared_imbalance = 0.0;  ///< sum over paths of (absorbed + escaped + cut − incident)²

  /// (absorbed + escaped + cut − incident) / incident: 0 in the mean when all densities, weights and albedos are right.
  [[nodiscard]] double imbalance() const {
    const auto incident = static_cast<double>(paths);
    return (absorbed + escaped + cut - incident) / incident;
  }
  /// Its standard error.
  [[nodiscard]] double imbalance_error() const { return std::sqrt(squared_imbalance) / static_cast<double>(paths); }

  PowerBooks& operator+=(const PowerBooks& other) {
    paths += other.paths;
    absorbed += other.absorbed;
    escaped += other.escaped;
    cut += other.cut;
    roulette += other.roulette;
    squared_imbalance += other.squared_imbalance;
    return *this;
  }
};

}  // namespace sigmascape::trace
