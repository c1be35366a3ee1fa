#pragma once

#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/radar.h"
#include "sigmascape/radar/range_azimuth_image.h"
#include "sigmascape/radar/received_image.h"

namespace sigmascape::receiver {

/// Mean power in every bin, without speckle, as it reaches the antenna's terminals, and that of the noise beside it.
struct ReceivedPower {
  radar::RangeAzimuthGrid grid;
  /// [azimuth, range], W: a compressed pulse with the beam's axis in the bin's middle and the receiver sampling there.
  /// In `values()` azimuths run fastest, ranges slowest: the other way round than the bins of a live frame.
  Array2D<float> signal_w;
  double noise_w = 0.0;  ///< k T₀ B F, the same in every bin
};

/// Throws Error for the sum of polarizations, which no receiver has.
void check_receivable(radar::Polarization polarization);

/// Power in a bin over the cross-section in it once the responses of pulse and beam are laid over the bins, for each
/// range, W/m². docs/physics/receiver.md, Eq. (3).
[[nodiscard]] std::vector<double> watts_per_m2(const radar::Radar& radar, const radar::RangeAzimuthGrid& grid);
/// The same into memory that is there, of a radar of which is known what it takes some time to find: its
/// radar::compression_gain, and the product of the `peak_bins` of its two responses.
void find_watts_per_m2(const radar::Radar& radar, const radar::RangeAzimuthGrid& grid, double compression_gain,
                       double bins_of_a_point, std::span<double> factors);

/// The radar equation, laid over bins of cross-section. docs/physics/receiver.md, Eq. (3).
///
/// A lone point of cross-section σ in the middle of a bin gives that bin the power P_t G² λ² σ / ((4π)³ r⁴ L) times the
/// compression gain. Ranges at which the transmitter deafens the receiver are darkened. What the signal falls short of
/// the noise, `signal_w / noise_w`, is the signal-to-noise ratio of one pulse. Throws Error for the sum of
/// polarizations, which no receiver has.
[[nodiscard]] ReceivedPower received_power(const radar::Radar& radar, const radar::RangeAzimuthImage& image,
                                           radar::Polarization polarization);

/// The same in every channel at once: what `received_power` gives for VV, HH and HV, and the correlation of VV and HH
/// on the same scale.
[[nodiscard]] radar::ReceivedImage received_image(const radar::Radar& radar, const radar::RangeAzimuthImage& image);

/// Adds complex Gaussian noise of mean power `noise_w` in `impedance_ohm` to voltages (root mean square), the real and
/// imaginary part having half of it each. Independent from sample to sample; of one seed always the same.
void add_noise(std::span<std::complex<float>> volts, double noise_w, double impedance_ohm, std::uint64_t seed);

/// Real and imaginary part after the converter: in steps, and saturated. Counts the samples that saturate.
std::uint64_t digitise(std::span<std::complex<float>> volts, const radar::AnalogToDigital& converter);

/// The detector's answer to a voltage: |V|, |V|² in V², or 10 log₁₀ of |V|² in dB over one V².
[[nodiscard]] float detected(std::complex<float> volts, radar::Detector detector);

/// What leaves the receiver for one realisation of the noise.
struct DetectedImage {
  radar::RangeAzimuthGrid grid;
  Array2D<float> video;  ///< [azimuth, range], azimuths running fastest; V, V² or dB over one V², by the detector
  std::uint64_t saturated = 0;
};

/// Signal plus noise through gain, sensitivity time control, converter and detector, each pulse with its own noise; the
/// mean of `pulses_integrated` outputs. The signal is its mean power at constant phase, without speckle. Noise is white
/// over the band, so it is correlated over range as the compressed pulse is; from azimuth to azimuth it is independent.
[[nodiscard]] DetectedImage detected_image(const radar::Radar& radar, const ReceivedPower& power, std::uint64_t seed,
                                           unsigned threads = 0);

}  // namespace sigmascape::receiver
