#include "sigmascape/render/row_bins.h"

#include <cmath>
#include <cstdint>

#include "sigmascape/base/vector_targets.h"

namespace sigmascape::render {
namespace {

/// Bins' centres lie at halves: the last one before a position, and what of it goes there and what to the next.
SIGMASCAPE_VECTOR_TARGETS
void split_positions(const float* position, std::size_t count, bool amplitudes, std::int32_t* bin, float* here,
                     float* next) {
  for (std::size_t i = 0; i < count; ++i) {
    const float from_centre = position[i] - 0.5F;
    const float whole = std::floor(from_centre);
    bin[i] = static_cast<std::int32_t>(whole);
    next[i] = from_centre - whole;
    here[i] = 1.0F - next[i];
  }
  if (!amplitudes) return;
  for (std::size_t i = 0; i < count; ++i) {
    here[i] = std::sqrt(here[i]);
    next[i] = std::sqrt(next[i]);
  }
}

void find_shares(LatticeRow& row, bool amplitudes) {
  BinShares& shares = row.shares;
  split_positions(row.beam.data(), row.whole_vectors(), amplitudes, shares.beam.data(), shares.beam_here.data(),
                  shares.beam_next.data());
  split_positions(row.range_bin.data(), row.whole_vectors(), amplitudes, shares.range.data(), shares.range_here.data(),
                  shares.range_next.data());
}

// All numbers of a bin, added in one go.
using FourNumbers = float __attribute__((vector_size(16), aligned(4)));
using EightNumbers = float __attribute__((vector_size(32), aligned(4)));

/// Adds one texel's numbers to the four bins about it; what lies outside the sector falls away.
template <typename Numbers>
[[gnu::always_inline]] inline void share(const SectorBins& sector, const BinShares& shares, std::size_t i,
                                         const Numbers& numbers) {
  constexpr std::size_t count = sizeof(Numbers) / sizeof(float);
  const std::int32_t beam = shares.beam[i], range = shares.range[i];
  const auto first_beam = static_cast<std::int32_t>(sector.first_beam);
  const auto beams = static_cast<std::int32_t>(sector.end_beam), ranges = static_cast<std::int32_t>(sector.ranges);
  const auto stride = static_cast<std::int32_t>(sector.stride);
  const auto bin = [&](std::int32_t b, std::int32_t r) {
    return reinterpret_cast<Numbers*>(sector.bins +
                                      static_cast<std::ptrdiff_t>(b * stride + r) * static_cast<std::ptrdiff_t>(count));
  };
  const Numbers here = numbers * shares.beam_here[i], next = numbers * shares.beam_next[i];
  if (beam >= first_beam && beam + 1 < beams && range >= 0 && range + 1 < ranges) {
    Numbers* const first = bin(beam, range);
    Numbers* const second = bin(beam + 1, range);
    first[0] += here * shares.range_here[i];
    first[1] += here * shares.range_next[i];
    second[0] += next * shares.range_here[i];
    second[1] += next * shares.range_next[i];
    return;
  }
  const auto add_within = [&](std::int32_t b, std::int32_t r, const Numbers& part) {
    if (b >= first_beam && b < beams && r >= 0 && r < ranges) *bin(b, r) += part;
  };
  add_within(beam, range, here * shares.range_here[i]);
  add_within(beam, range + 1, here * shares.range_next[i]);
  add_within(beam + 1, range, next * shares.range_here[i]);
  add_within(beam + 1, range + 1, next * shares.range_next[i]);
}

}  // namespace

SIGMASCAPE_VECTOR_TARGETS
void deposit_amplitudes(LatticeRow& row, const SectorBins& sector) {
  find_shares(row, true);
  const auto& a = row.amplitude;
  for (std::size_t i = 0; i < row.count; ++i) {
    if (row.lit[i] == 0.0F) continue;
    share(sector, row.shares, i, EightNumbers{a[0][i], a[1][i], a[2][i], a[3][i], a[4][i], a[5][i], a[4][i], a[5][i]});
  }
}

void deposit_powers(LatticeRow& row, const SectorBins& sector) {
  find_shares(row, false);
  const auto& p = row.returned;
  for (std::size_t i = 0; i < row.count; ++i) {
    if (row.lit[i] == 0.0F) continue;
    share(sector, row.shares, i, FourNumbers{p[0][i], p[1][i], p[2][i], p[3][i]});
  }
}

}  // namespace sigmascape::render
