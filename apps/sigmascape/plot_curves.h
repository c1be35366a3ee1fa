#pragma once

#include <cstddef>
#include <span>

#include "sigmascape/atlas/atlas.h"
#include "sigmascape/product/plot.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/scatter/material.h"

namespace sigmascape::cli {

/// σ0 of even ground in dB over grazing angle from 0.5° to 89.5°, a curve a material.
[[nodiscard]] product::Plot sigma0_plot(std::span<const scatter::Material> materials, double frequency_hz,
                                        radar::Polarization polarization);

// Pictures of responses end 80 dB below their highest point; their numbers go on, and are not finite where nothing
// comes back.

/// One-way gain of both cuts through the beam's axis, dB over isotropic, out to `reach_rad` on either side.
[[nodiscard]] product::Plot antenna_plot(const radar::Radar& radar, double reach_rad);

/// The answer to a point over slant range, dB below its peak, out to `widths` half-power widths.
[[nodiscard]] product::Plot range_response_plot(const radar::Radar& radar, double widths);
/// The same over azimuth: the beam's two-way pattern.
[[nodiscard]] product::Plot azimuth_response_plot(const radar::Radar& radar, double widths);

/// How a sample is spread: densities by bins beside that of its kind.
struct Histogram {
  std::size_t samples = 0;
  double mean = 0.0;
  double deviation_over_mean = 0.0;  ///< standard deviation of the values over their mean
  product::Plot plot;
};

/// Powers over their mean, beside the exponential density, or with more looks that of their mean, Gamma.
///                                                                            docs/physics/speckle.md
[[nodiscard]] Histogram power_histogram(std::span<const double> powers, double looks, std::size_t bins);
/// Amplitudes over their root mean square, beside Rayleigh's density 2 x exp(−x²).
[[nodiscard]] Histogram amplitude_histogram(std::span<const double> amplitudes, std::size_t bins);

/// σ0 of a point in dB over azimuth, a curve a baked elevation; or over elevation, a curve a baked azimuth. Where the
/// atlas keeps the ground apart, that of level ground that nothing hides is added.
[[nodiscard]] product::Plot aspect_plot(const atlas::Atlas& atlas, Vec2d point, double frequency_hz,
                                        radar::Polarization polarization, bool over_elevation);

}  // namespace sigmascape::cli
