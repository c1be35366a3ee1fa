#include "floors.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "figures.h"

#include "sigmascape/base/hash.h"
#include "sigmascape/base/vector_targets.h"
#include "sigmascape/live/visible_ground.h"
#include "sigmascape/radar/complex_gaussian.h"
#include "sigmascape/radar/scatterer_lattice.h"

namespace sigmascape::bench {
namespace {

constexpr std::size_t samples = 1U << 20U, bins = 512 * 512, looks = 8, channels = 4, side = 1024;
/// Of the horizon under 512 × 512 bins: the edges of the beams, and two steps a range.
constexpr std::size_t edges = 513, steps = 1024;

template <typename Work>
double least_seconds(int repetitions, Work work) {
  double least = 1e30;
  for (int run = 0; run < repetitions; ++run) {
    const double start = processor_seconds();
    work();
    least = std::min(least, processor_seconds() - start);
  }
  return least;
}

double sweep_seconds(int repetitions) {
  const terrain::HeightField field{
      .west_m = -1100.0, .north_m = 22000.0, .spacing_m = 10.0, .height_m = Array2D<float>(221, 221, 0.0F)};
  const live::HorizonGrid grid{.first_azimuth_rad = -0.05,
                               .azimuth_step_rad = 2e-4,
                               .azimuths = edges,
                               .near_m = 19900.0,
                               .step_m = 2.0,
                               .distances = steps};
  live::VisibleGround visible;
  WorkerTeam team(1);
  visible.reset(grid, false);
  return least_seconds(repetitions, [&] {
    visible.find(0, edges, {0.0, 0.0, 4000.0}, {.terrain = terrain::view_of(field)}, team);
  });
}

/// Written as plainly as it can be: all of a sample's halves stand together.
SIGMASCAPE_VECTOR_TARGETS
void look_up(const std::uint16_t* texels, const float* weights, float* out) {
  for (std::size_t i = 0; i < samples; ++i) {
    float sum[channels] = {};
    for (std::size_t look = 0; look < looks; ++look) {
      for (std::size_t channel = 0; channel < channels; ++channel) {
        const std::uint32_t half = texels[(i * looks + look) * channels + channel];
        sum[channel] += weights[look] * std::bit_cast<float>(((half & 0x7fffU) << 13U) | ((half & 0x8000U) << 16U));
      }
    }
    for (std::size_t channel = 0; channel < channels; ++channel) out[i * channels + channel] = sum[channel] * 0x1p112F;
  }
}

double look_up_seconds(int repetitions) {
  std::vector<std::uint16_t> texels(samples * looks * channels, 0x3400);
  const std::vector<float> weights(looks, 0.125F);
  std::vector<float> out(samples * channels);
  const double seconds = least_seconds(repetitions, [&] { look_up(texels.data(), weights.data(), out.data()); });
  prove(out[samples / 2] == 0.25F, "the floor's look-up returns the mean of its looks");
  return seconds;
}

double speckle_seconds(int repetitions) {
  const radar::ScattererLattice lattice({.seed = 1, .cell_m = 2.0, .levels = 1});
  constexpr std::size_t at_once = 256;
  std::vector<std::int32_t> columns(at_once), rows(at_once);
  std::vector<float> re(at_once), im(at_once);
  std::iota(columns.begin(), columns.end(), 0);
  float kept = 0.0F;
  const double seconds = least_seconds(repetitions, [&] {
    for (std::size_t first = 0; first < samples; first += at_once) {
      std::ranges::fill(rows, static_cast<std::int32_t>(first / at_once));
      for (const auto draw : {radar::Draw::First, radar::Draw::Second, radar::Draw::Third}) {
        lattice.values_of(columns, rows, 0, draw, re, im);
      }
      for (std::size_t i = 0; i < at_once; ++i) {
        const radar::ComplexPair turn = radar::unit_phasor(static_cast<std::uint32_t>((first + i) * 2654435761U));
        re[i] *= turn.re;
        im[i] *= turn.im;
      }
      kept += re[0] + im[0];
    }
  });
  prove(std::isfinite(kept), "the floor's speckle is finite");
  return seconds;
}

double histogram_seconds(int repetitions) {
  using Numbers = float __attribute__((vector_size(32)));
  std::vector<std::uint32_t> bin(samples);
  // Neighbouring samples of a row fall into neighbouring beams, at nearly one range.
  for (std::size_t i = 0; i < samples; ++i) {
    const std::size_t row = i / side, column = i % side;
    bin[i] = static_cast<std::uint32_t>(column / 2 * 512 + (row + column / 64) / 2 % 512);
  }
  std::vector<float> sums(bins * 8);
  Numbers numbers{1, 1, 1, 1, 1, 1, 1, 1};
  const double seconds = least_seconds(repetitions, [&] {
    std::ranges::fill(sums, 0.0F);
    for (const std::uint32_t index : bin) {
      Numbers sum;
      __builtin_memcpy(&sum, &sums[index * 8], sizeof(sum));
      sum += numbers;
      __builtin_memcpy(&sums[index * 8], &sum, sizeof(sum));
    }
  });
  prove(std::accumulate(sums.begin(), sums.end(), 0.0) == 8.0 * samples, "the floor's histogram holds every sample");
  return seconds;
}

}  // namespace

Floors measured_floors(int repetitions) {
  return {.sweep = sweep_seconds(repetitions),
          .look_up = look_up_seconds(repetitions),
          .speckle = speckle_seconds(repetitions),
          .histogram = histogram_seconds(repetitions)};
}

}  // namespace sigmascape::bench
