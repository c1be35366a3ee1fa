#pragma once

namespace sigmascape::bench {

/// Least processor times of what a frame cannot do without, each alone, for 1,048,576 ground samples and 512 × 512
/// bins, seconds.
struct Floors {
  double sweep = 0.0;      ///< steepest line of sight over terrain, at the edges of 512 beams, 1024 steps each
  double look_up = 0.0;    ///< eight looks of interleaved halves, four channels, a weight a look
  double speckle = 0.0;    ///< three complex Gaussian numbers and a phasor a sample
  double histogram = 0.0;  ///< eight numbers a sample added to one bin of 32 bytes

  [[nodiscard]] double sum() const { return sweep + look_up + speckle + histogram; }
};

[[nodiscard]] Floors measured_floors(int repetitions);

}  // namespace sigmascape::bench
