#pragma once

#include <cstddef>
#include <vector>

namespace sigmascape::bench {

/// Noise of a map, from two independent ones of it: half the squared difference of a pair has the variance for its
/// mean.
struct Noise {
  double median_relative = 0.0;  ///< of standard deviation over mean, over the texels that are looked at
  double l1 = 0.0;               ///< sum of the standard deviations over the sum of the means, all texels
};

/// The value in the middle; of an even number the upper one. 0 of none.
[[nodiscard]] double median_of(std::vector<double> values);

/// Texels that first surfaces light, as `direct` says, and in which sampling has anything to do: where the pair differs
/// by more than a thousandth. On open level ground every sample returns the same.
[[nodiscard]] std::vector<std::size_t> noisy_texels(const std::vector<float>& one, const std::vector<float>& other,
                                                    const std::vector<float>& direct);

[[nodiscard]] Noise noise_of(const std::vector<float>& one, const std::vector<float>& other,
                             const std::vector<std::size_t>& texels);

/// The power of a map in all, mean of two independent ones.
struct Total {
  double power = 0.0;
  double standard_error = 0.0;  ///< of the mean; errors of texels are taken to be independent
};

[[nodiscard]] Total total_of(const std::vector<float>& one, const std::vector<float>& other);

/// What two independent maps say of their own errors against what they differ by.
struct Honesty {
  double predicted_over_actual = 0.0;  ///< root mean squares over the texels, relative to their mean power
  double covered = 0.0;                ///< part of the texels whose difference keeps within its 95 % interval
};

/// A map and the relative standard errors that it tells of itself.
struct MapWithErrors {
  const std::vector<float>& power;
  const std::vector<float>& relative_errors;
};

/// The interval is Student's t for the 128 degrees of freedom of two times 64 pairs.
[[nodiscard]] Honesty honesty_of(const MapWithErrors& one, const MapWithErrors& other,
                                 const std::vector<std::size_t>& texels);

}  // namespace sigmascape::bench
