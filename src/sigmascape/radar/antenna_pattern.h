#pragma once

#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "sigmascape/base/vec.h"
#include "sigmascape/radar/window_response.h"

namespace sigmascape::radar {

/// Shapes of a beam in one plane. None has a width of its own: the half-power width is given beside it.

/// The same in all directions.
struct EvenBeam {};
/// Power exp(−4 ln 2 (φ/θ)²); no side lobes.
struct GaussianBeam {};
/// A line aperture under this taper: Window{Rectangular} is the uniform aperture with sinc side lobes, Cosine and
/// Taylor have lower ones.
struct ApertureBeam {
  Window taper = {};
};
/// In elevation: from the peak downwards the gain goes as csc² of the depression angle, so that level ground returns
/// the same from all ranges; above the peak, and below the steepest angle, it falls like a Gaussian of the half-power
/// width.
struct CosecantSquaredBeam {
  double steepest_depression_rad = 0.7;
};
/// Measured: one-way power relative to the peak over the offset in units of the half-power width, clockwise from the
/// axis in azimuth and upwards in elevation. Offsets increase; between them decibels are linear; beyond the ends the
/// gain is that of the end.
struct TabulatedBeam {
  struct Sample {
    double offset = 0.0;
    double power = 1.0;
  };
  std::vector<Sample> samples;
};

using BeamShape = std::variant<EvenBeam, GaussianBeam, ApertureBeam, CosecantSquaredBeam, TabulatedBeam>;

/// An antenna as it is described: two cuts, a gain, and where it points in elevation. Its half-power width in azimuth
/// is Radar::beam_width_rad.
struct Antenna {
  BeamShape azimuth = GaussianBeam{};
  BeamShape elevation = EvenBeam{};
  double elevation_width_rad = 0.1;  ///< one-way half-power width; without meaning for EvenBeam
  double tilt_rad = 0.0;             ///< elevation of the peak above the horizontal: negative looks down
  /// One-way power gain at the peak over an isotropic antenna, losses included. A constant, whatever the beam's widths
  /// are: `directivity` tells what follows from them, which is what a radar file takes unless it states the gain.
  double gain = 1000.0;
  /// Nowhere is the power gain of a cut lower, relative to its peak, than this: the average of far side lobes.
  double side_lobe_floor = 0.0;
};

/// The one-way gain in one plane, relative to the peak.
class AntennaCut {
 public:
  /// `peak_rad`: the elevation at which the peak lies, which only CosecantSquaredBeam needs.
  AntennaCut(const BeamShape& shape, double half_power_width_rad, double side_lobe_floor = 0.0, double peak_rad = 0.0);

  /// Relative amplitude at an angle from the peak: one at the peak, negative in every other side lobe of an aperture.
  [[nodiscard]] double voltage(double offset_rad) const;
  /// One-way power: the square of the voltage.
  [[nodiscard]] double power(double offset_rad) const {
    const double amplitude = voltage(offset_rad);
    return amplitude * amplitude;
  }
  [[nodiscard]] double two_way_power(double offset_rad) const {
    const double one_way = power(offset_rad);
    return one_way * one_way;
  }
  /// The offsets, one to either side of the peak, at which the two-way power, the square of the one-way power, is half
  /// of it. The peak of a measured cut may lie off the axis.
  [[nodiscard]] std::pair<double, double> two_way_half_power_rad() const;
  /// From one to the other.
  [[nodiscard]] double two_way_width_rad() const {
    const auto [below_rad, above_rad] = two_way_half_power_rad();
    return above_rad - below_rad;
  }
  /// Beyond this offset to either side the two-way power is nothing at all, too small for a double; infinite where it
  /// never is.
  [[nodiscard]] double silent_beyond_rad() const;
  /// True when the gain is the same in all directions.
  [[nodiscard]] bool even() const { return std::holds_alternative<EvenBeam>(shape_); }

 private:
  [[nodiscard]] double shape_voltage(double offset_rad) const;

  BeamShape shape_;
  double width_rad_, floor_voltage_, peak_rad_;
  std::optional<WindowResponse> aperture_;
  double aperture_scale_ = 0.0;  // t of the aperture's response per sine of the offset
};

/// The whole antenna: separable in azimuth and elevation, as for a line array or a rectangular aperture near its axis.
/// `azimuth_offset_rad` is measured in the horizontal plane from where the antenna points.
///
///     G(φ, ε) = G₀ g_φ²(φ) g_ε²(ε − tilt)                                  docs/physics/antenna.md, Eq. (1)
class AntennaPattern {
 public:
  AntennaPattern(const Antenna& antenna, double beam_width_rad);

  /// One-way power gain over isotropic.
  [[nodiscard]] double gain(double azimuth_offset_rad, double elevation_rad) const;
  /// √G with the sign of the pattern: what multiplies a field, one way.
  [[nodiscard]] double voltage(double azimuth_offset_rad, double elevation_rad) const;
  [[nodiscard]] double peak_gain() const { return peak_gain_; }
  [[nodiscard]] const AntennaCut& azimuth() const { return azimuth_; }
  [[nodiscard]] const AntennaCut& elevation() const { return elevation_; }
  [[nodiscard]] double tilt_rad() const { return tilt_rad_; }

 private:
  AntennaCut azimuth_, elevation_;
  double tilt_rad_, peak_gain_;
};

/// The gain over isotropic that the pattern's shape implies, 4π over ∬ g_φ² g_ε² cos ε dε dφ: an antenna without
/// losses. docs/physics/antenna.md, Eq. (2).
[[nodiscard]] double directivity(const Antenna& antenna, double beam_width_rad);

}  // namespace sigmascape::radar
