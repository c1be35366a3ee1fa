#include "sigmascape/live/row_scatterers.h"

#include <cmath>
#include <cstdint>

#include "sigmascape/base/vector_targets.h"
#include "sigmascape/live/lesser_greater.h"
#include "sigmascape/radar/complex_gaussian.h"

namespace sigmascape::live {

SIGMASCAPE_VECTOR_TARGETS
void scatter(LatticeRow& row, const std::array<LatticeRow::Of<float>, 6>& gaussians, double turns_per_m) {
  const double* const range = row.range_m.data();
  const std::size_t count = row.whole_vectors();
  for (std::size_t i = 0; i < count; ++i) {
    const double turns = range[i] * turns_per_m;
    // The phase falls with range; of it only the broken part of a turn matters.
    const double rest_of_turn = std::floor(turns) - turns + 0.5;
    const auto phase = static_cast<std::uint32_t>(static_cast<std::int32_t>(rest_of_turn * 0x1p32)) + 0x80000000U;
    const radar::ComplexPair phasor = radar::unit_phasor(phase);
    row.phasor[0][i] = phasor.re;
    row.phasor[1][i] = phasor.im;
  }
  SIGMASCAPE_INDEPENDENT_TURNS
  for (std::size_t i = 0; i < count; ++i) {
    const float re = row.phasor[0][i], im = row.phasor[1][i];
    const float vv = std::sqrt(row.returned[0][i]), hh = std::sqrt(row.returned[1][i]);
    const float hv = std::sqrt(row.returned[2][i]);
    const float correlation = lesser(greater(row.returned[3][i] / greater(vv * hh, 1e-30F), -1.0F), 1.0F);
    const float rest = std::sqrt(1.0F - correlation * correlation);
    const float first_re = gaussians[0][i], first_im = gaussians[1][i];
    const float other_re = correlation * first_re + rest * gaussians[2][i];
    const float other_im = correlation * first_im + rest * gaussians[3][i];
    const float third_re = gaussians[4][i], third_im = gaussians[5][i];
    const float hv_re = hv * (third_re * re - third_im * im), hv_im = hv * (third_re * im + third_im * re);
    float* const to = row.amplitudes.data() + 8 * i;
    to[0] = vv * (first_re * re - first_im * im);
    to[1] = vv * (first_re * im + first_im * re);
    to[2] = hh * (other_re * re - other_im * im);
    to[3] = hh * (other_re * im + other_im * re);
    to[4] = hv_re;
    to[5] = hv_im;
    to[6] = hv_re;
    to[7] = hv_im;
  }
}

}  // namespace sigmascape::live
