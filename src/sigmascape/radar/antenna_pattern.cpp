#include "sigmascape/radar/antenna_pattern.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sigmascape/base/units.h"

namespace sigmascape::radar {
namespace {

/// Amplitude of a Gaussian beam; `x` in half-power widths of the power. docs/physics/antenna.md, Eq. (3).
double gaussian_voltage(double x) {
  return std::exp(-2.0 * std::numbers::ln2 * x * x);
}

double cosecant_voltage(const CosecantSquaredBeam& beam, double offset_rad, double peak_rad, double width_rad) {
  if (offset_rad >= 0.0) return gaussian_voltage(offset_rad / width_rad);
  const double depression = -(offset_rad + peak_rad);
  const double within = std::min(depression, beam.steepest_depression_rad);
  return std::sin(-peak_rad) / std::sin(within) * gaussian_voltage((depression - within) / width_rad);
}

double tabulated_voltage(const std::vector<TabulatedBeam::Sample>& samples, double x) {
  if (!(x > samples.front().offset)) return std::sqrt(samples.front().power);
  if (x >= samples.back().offset) return std::sqrt(samples.back().power);
  const auto right = std::ranges::upper_bound(samples, x, {}, &TabulatedBeam::Sample::offset);
  const auto left = right - 1;
  const double part = (x - left->offset) / (right->offset - left->offset);
  return std::exp(0.5 * std::lerp(std::log(left->power), std::log(right->power), part));
}

/// The angle from the peak, up to `limit_rad`, at which f falls to `level`; the limit when it never does.
template <typename F>
double falling_through(double level, double limit_rad, F&& f) {
  constexpr int steps = 2000;
  for (int k = 1; k <= steps; ++k) {
    double low = limit_rad * (k - 1) / steps, high = limit_rad * k / steps;
    if (f(high) > level) continue;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (f(middle) > level ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }
  return limit_rad;
}

/// ∫ f over an interval, finely within twenty widths of the peak.
template <typename F>
double integral_about(double peak, double width, Vec2d interval, F&& f) {
  const double left = std::clamp(peak - 20.0 * width, interval.x, interval.y),
               right = std::clamp(peak + 20.0 * width, interval.x, interval.y);
  double sum = 0.0;
  for (const Vec2d part : {Vec2d{interval.x, left}, {left, right}, {right, interval.y}}) {
    constexpr int steps = 20'000;
    const double step = (part.y - part.x) / steps;
    for (int k = 0; k < steps; ++k) sum += f(part.x + (k + 0.5) * step) * step;
  }
  return sum;
}

}  // namespace

AntennaCut::AntennaCut(const BeamShape& shape, double half_power_width_rad, double side_lobe_floor, double peak_rad)
    : shape_(shape),
      width_rad_(half_power_width_rad),
      floor_voltage_(std::sqrt(side_lobe_floor)),
      peak_rad_(std::min(peak_rad, -1e-3)) {
  if (const auto* aperture = std::get_if<ApertureBeam>(&shape_)) {
    aperture_.emplace(aperture->taper);
    aperture_scale_ = 0.5 * aperture_->half_power_width() / std::sin(0.5 * width_rad_);
  }
}

double AntennaCut::shape_voltage(double offset_rad) const {
  if (std::holds_alternative<EvenBeam>(shape_)) return 1.0;
  if (std::holds_alternative<GaussianBeam>(shape_)) return gaussian_voltage(offset_rad / width_rad_);
  if (const auto* cosecant = std::get_if<CosecantSquaredBeam>(&shape_))
    return cosecant_voltage(*cosecant, offset_rad, peak_rad_, width_rad_);
  if (const auto* table = std::get_if<TabulatedBeam>(&shape_))
    return tabulated_voltage(table->samples, offset_rad / width_rad_);
  // An aperture radiates to its front.
  return std::abs(offset_rad) < 0.5 * pi ? aperture_->voltage(aperture_scale_ * std::sin(offset_rad)) : 0.0;
}

double AntennaCut::voltage(double offset_rad) const {
  const double amplitude = shape_voltage(std::remainder(offset_rad, 2.0 * pi));
  return std::abs(amplitude) < floor_voltage_ ? std::copysign(floor_voltage_, amplitude) : amplitude;
}

std::pair<double, double> AntennaCut::two_way_half_power_rad() const {
  if (std::holds_alternative<GaussianBeam>(shape_)) {
    const double half_rad = 0.5 * (width_rad_ / std::numbers::sqrt2);
    return {-half_rad, half_rad};
  }
  const double limit = std::min(pi, 2.0 * width_rad_);
  double peak_offset_rad = 0.0;
  if (const auto* table = std::get_if<TabulatedBeam>(&shape_))
    peak_offset_rad = std::ranges::max_element(table->samples, {}, &TabulatedBeam::Sample::power)->offset * width_rad_;
  const auto towards = [&](double side) {
    return falling_through(0.5, limit, [&](double offset) { return two_way_power(peak_offset_rad + side * offset); });
  };
  return {peak_offset_rad - towards(-1.0), peak_offset_rad + towards(1.0)};
}

double AntennaCut::silent_beyond_rad() const {
  if (!std::holds_alternative<GaussianBeam>(shape_) || floor_voltage_ > 0.0)
    return std::numeric_limits<double>::infinity();
  // exp(−8 ln 2 x²) is below the least double from x = 11.6 on.
  return 12.0 * width_rad_;
}

AntennaPattern::AntennaPattern(const Antenna& antenna, double beam_width_rad)
    : azimuth_(antenna.azimuth, beam_width_rad, antenna.side_lobe_floor),
      elevation_(antenna.elevation, antenna.elevation_width_rad, antenna.side_lobe_floor, antenna.tilt_rad),
      tilt_rad_(antenna.tilt_rad),
      peak_gain_(antenna.gain) {}

double AntennaPattern::voltage(double azimuth_offset_rad, double elevation_rad) const {
  return std::sqrt(peak_gain_) * azimuth_.voltage(azimuth_offset_rad) * elevation_.voltage(elevation_rad - tilt_rad_);
}

double AntennaPattern::gain(double azimuth_offset_rad, double elevation_rad) const {
  const double amplitude = voltage(azimuth_offset_rad, elevation_rad);
  return amplitude * amplitude;
}

double directivity(const Antenna& antenna, double beam_width_rad) {
  const AntennaPattern pattern(antenna, beam_width_rad);
  const double over_azimuth =
      integral_about(0.0, beam_width_rad, {-pi, pi}, [&](double azimuth) { return pattern.azimuth().power(azimuth); });
  const double over_elevation = integral_about(
      antenna.tilt_rad, antenna.elevation_width_rad, {-0.5 * pi, 0.5 * pi},
      [&](double elevation) { return pattern.elevation().power(elevation - antenna.tilt_rad) * std::cos(elevation); });
  return 4.0 * pi / (over_azimuth * over_elevation);
}

}  // namespace sigmascape::radar
