#include "sigmascape/atlas/power_error.h"

#include <algorithm>
#include <cstddef>

namespace sigmascape::atlas {
namespace {

using Figure = std::optional<double> (PowerError::*)() const;

std::optional<double> mean_of(const std::map<LookIndex, PowerError>& by_look, Figure figure) {
  double sum = 0.0;
  std::size_t looks = 0;
  for (const auto& [look, error] : by_look) {
    const auto of_look = (error.*figure)();
    if (!of_look) continue;
    sum += *of_look;
    ++looks;
  }
  return looks > 0 ? std::optional(sum / static_cast<double>(looks)) : std::nullopt;
}

}  // namespace

std::optional<double> PowerError::relative() const {
  return power > 0.0 ? std::optional(standard_error / power) : std::nullopt;
}

std::optional<double> PowerError::part_above_target() const {
  return power > 0.0 && above_target ? std::optional(*above_target / power) : std::nullopt;
}

std::optional<double> PowerError::part_of_all() const {
  const double all = power + ground_power;
  return all > 0.0 ? std::optional(power / all) : std::nullopt;
}

PowerError& PowerError::operator+=(const PowerError& other) {
  power += other.power;
  standard_error += other.standard_error;
  ground_power += other.ground_power;
  if (other.above_target) above_target = above_target.value_or(0.0) + *other.above_target;
  return *this;
}

PowerError power_error(const Array2D<radar::Channels>& texels, const Array2D<float>& relative_errors,
                       std::optional<double> relative_target) {
  double power = 0.0, standard_error = 0.0, above_target = 0.0;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const auto of_texel = static_cast<double>(texels.values()[i].power(radar::Polarization::Sum));
    const auto relative_error = static_cast<double>(relative_errors.values()[i]);
    power += of_texel;
    standard_error += relative_error * of_texel;
    if (relative_target && relative_error > *relative_target) above_target += of_texel;
  }
  const auto count = static_cast<double>(texels.size());
  return {.power = power / count,
          .standard_error = standard_error / count,
          .above_target = relative_target ? std::optional(above_target / count) : std::nullopt};
}

std::optional<double> PowerErrors::relative() const {
  return mean_of(by_look_, &PowerError::relative);
}

std::optional<double> PowerErrors::part_above_target() const {
  return mean_of(by_look_, &PowerError::part_above_target);
}

std::optional<double> PowerErrors::part_of_all() const {
  return mean_of(by_look_, &PowerError::part_of_all);
}

std::optional<PowerErrors::Spread> PowerErrors::spread() const {
  std::optional<Spread> spread;
  for (const auto& [look, error] : by_look_) {
    const auto relative = error.relative();
    if (!relative) continue;
    if (!spread) spread = {*relative, *relative};
    spread->smallest = std::min(spread->smallest, *relative);
    spread->largest = std::max(spread->largest, *relative);
  }
  return spread;
}

}  // namespace sigmascape::atlas
