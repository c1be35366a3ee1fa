#pragma once

#include <cstddef>
#include <optional>

#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/complex_channels.h"
#include "sigmascape/radar/curved_earth.h"
#include "sigmascape/radar/doppler.h"

namespace sigmascape::radar {

/// Bins along one axis of an image.
struct ImageAxis {
  double first = 0.0;  ///< middle of bin 0
  double step = 1.0;
  std::size_t bins = 0;

  friend constexpr bool operator==(const ImageAxis&, const ImageAxis&) = default;
  /// In units of bins, 0.5 being the middle of bin 0.
  [[nodiscard]] constexpr double place_of(double value) const { return (value - first) / step + 0.5; }
  [[nodiscard]] constexpr double middle_of(double place) const { return first + (place - 0.5) * step; }
};

/// An image in slant range and Doppler, as beam sharpening and spotlight SAR make it from one coherent interval. A lone
/// point in the middle of a bin has its amplitude there: |·|² is its cross-section. The phase of a point at range r is
/// −4π r/λ, its own added.
struct RangeDopplerImage {
  ImageAxis range_m;
  ImageAxis doppler_hz;                  ///< one pulse repetition frequency: what lies outside is folded in
  Array2D<ComplexChannels> amplitude_m;  ///< [Doppler, range]; in `values()` Doppler runs fastest
  Motion platform;                       ///< in the middle of the interval
  double frequency_hz = 0.0;
  double interval_s = 0.0;
  double pulse_repetition_hz = 0.0;
  /// Where the axis of the beam pointed in the middle of the interval, clockwise from the frame's north, if the
  /// antenna's pattern is in the image and the beam stayed on one azimuth or place.
  std::optional<double> beam_azimuth_rad = {};
  /// ∫|h|² of the two responses: even ground has σ0 times the area of this cell in a bin, in the mean.
  double range_cell_m = 0.0, doppler_cell_hz = 0.0;
  CurvedEarth earth = CurvedEarth::flat();  ///< under the platform

  /// Where something is to be found, in bins: {Doppler, range}. Works for ground (at rest) as for movers.
  [[nodiscard]] Vec2d place_of(const Motion& in_frame) const;
  [[nodiscard]] Vec2d place_of(Vec3d point) const { return place_of(Motion{point}); }
};

/// An image in closest slant range and place along a straight flight path, as stripmap SAR makes it. Amplitudes as
/// above, with the phase of the closest range.
struct StripmapImage {
  ImageAxis closest_range_m;
  ImageAxis along_m;                     ///< from where the platform is at `platform`
  Array2D<ComplexChannels> amplitude_m;  ///< [along, closest range]; in `values()` places along run fastest
  Motion platform;
  double squint_rad = 0.0;  ///< of the beam, ahead of broadside
  /// Where the axis of the beam pointed all along the strip, clockwise from the frame's north, if the antenna's pattern
  /// is in the image.
  std::optional<double> beam_azimuth_rad = {};
  double frequency_hz = 0.0;
  double closest_range_cell_m = 0.0, along_cell_m = 0.0;  ///< as above
  CurvedEarth earth = CurvedEarth::flat();                ///< under the platform

  /// Where a point at rest is to be found, in bins: {along, closest range}.
  [[nodiscard]] Vec2d place_of(Vec3d point) const;
};

}  // namespace sigmascape::radar
