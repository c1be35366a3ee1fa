#include "sigmascape/live/row_bins.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sigmascape/base/vector_targets.h"

namespace sigmascape::live {
namespace {

/// Instead of a bin, for texels whose four bins do not all lie in the sector, for dark ones, and for those that are
/// wider than a beam.
constexpr std::int32_t at_an_edge = -1, dark = -2, wide = -3;

/// Bins' centres lie at halves: the last one before a position, and what of it goes there and what to the next.
struct Split {
  std::int32_t bin;
  float here, next;
};

[[gnu::always_inline]] inline Split split(float position) {
  const float from_centre = position - 0.5F;
  const float whole = std::floor(from_centre);
  const float next = from_centre - whole;
  return {static_cast<std::int32_t>(whole), 1.0F - next, next};
}

SIGMASCAPE_VECTOR_TARGETS
void find_shares(LatticeRow& row, const SectorBins& sector) {
  BinShares& shares = row.shares;
  const auto first_beam = static_cast<std::int32_t>(sector.first_beam);
  const auto last_beam = static_cast<std::int32_t>(sector.end_beam) - 1;
  const auto last_range = static_cast<std::int32_t>(sector.ranges) - 1,
             stride = static_cast<std::int32_t>(sector.stride);
  const std::size_t count = row.whole_vectors();
  SIGMASCAPE_INDEPENDENT_TURNS
  for (std::size_t i = 0; i < count; ++i) {
    const Split beam = split(row.beam[i]), range = split(row.range_bin[i]);
    const bool inside = (beam.bin >= first_beam) & (beam.bin < last_beam) & (range.bin >= 0) & (range.bin < last_range);
    const std::int32_t first = inside ? beam.bin * stride + range.bin : at_an_edge;
    shares.beam[i] = beam.bin;
    shares.range[i] = range.bin;
    shares.first[i] = row.lit[i] > 0.0F ? first : dark;
    shares.here_here[i] = beam.here * range.here;
    shares.here_next[i] = beam.here * range.next;
    shares.next_here[i] = beam.next * range.here;
    shares.next_next[i] = beam.next * range.next;
  }
}

/// Of texels that are wider than a beam each beam has the part of their width that lies in it: the first, all that lie
/// between, and the last.
SIGMASCAPE_VECTOR_TARGETS
void find_wide_shares(LatticeRow& row) {
  BinShares& shares = row.shares;
  const std::size_t count = row.whole_vectors();
  SIGMASCAPE_INDEPENDENT_TURNS
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_wide = (row.beams_wide[i] > 1.0F) & (shares.first[i] != dark);
    const Split range = split(row.range_bin[i]);
    const float per_width = 1.0F / row.beams_wide[i];
    const float left = row.middle_beam[i] - 0.5F * row.beams_wide[i], right = left + row.beams_wide[i];
    const float first = std::floor(left), last = std::floor(right);
    shares.first[i] = is_wide ? wide : shares.first[i];
    shares.beam[i] = is_wide ? static_cast<std::int32_t>(first) : shares.beam[i];
    shares.last_beam[i] = static_cast<std::int32_t>(last);
    shares.here_here[i] = is_wide ? range.here : shares.here_here[i];
    shares.here_next[i] = is_wide ? range.next : shares.here_next[i];
    shares.first_part[i] = (first + 1.0F - left) * per_width;
    shares.whole_part[i] = per_width;
    shares.last_part[i] = (right - last) * per_width;
  }
}

[[gnu::always_inline]] inline void take_roots(BinShares::Of<float>& parts, std::size_t count) {
  float* const part = parts.data();
  for (std::size_t i = 0; i < count; ++i) part[i] = std::sqrt(part[i]);
}

/// Amplitudes are shared by the roots of powers' parts.
SIGMASCAPE_VECTOR_TARGETS
void take_roots(BinShares& shares, std::size_t count) {
  for (auto* const parts : {&shares.here_here, &shares.here_next, &shares.next_here, &shares.next_next})
    take_roots(*parts, count);
}
SIGMASCAPE_VECTOR_TARGETS
void take_wide_roots(BinShares& shares, std::size_t count) {
  for (auto* const parts : {&shares.first_part, &shares.whole_part, &shares.last_part}) take_roots(*parts, count);
}

// All numbers of a bin, added in one go.
using FourNumbers = float __attribute__((vector_size(16), aligned(4)));
using EightNumbers = float __attribute__((vector_size(32), aligned(4)));

/// Adds one texel's numbers to all beams that its width takes in; what lies outside the sector falls away.
template <typename Numbers>
[[gnu::always_inline]] inline void share_among_beams(const SectorBins& sector, const BinShares& shares, std::size_t i,
                                                     const Numbers& numbers) {
  const std::int32_t range = shares.range[i], last_range = static_cast<std::int32_t>(sector.ranges) - 1;
  const std::int32_t first = shares.beam[i], last = shares.last_beam[i];
  const auto end = std::min(last + 1, static_cast<std::int32_t>(sector.end_beam));
  const Numbers here = numbers * shares.here_here[i], next = numbers * shares.here_next[i];
  for (std::int32_t beam = std::max(first, static_cast<std::int32_t>(sector.first_beam)); beam < end; ++beam) {
    const auto& parts = beam == first ? shares.first_part : beam == last ? shares.last_part : shares.whole_part;
    auto* const bins = reinterpret_cast<Numbers*>(sector.bins) + static_cast<std::size_t>(beam) * sector.stride;
    if (range >= 0 && range <= last_range) bins[range] += here * parts[i];
    if (range >= -1 && range < last_range) bins[range + 1] += next * parts[i];
  }
}

/// Adds one texel's numbers to the four bins about it; what lies outside the sector falls away.
template <typename Numbers>
[[gnu::always_inline]] inline void share(const SectorBins& sector, const BinShares& shares, std::size_t i,
                                         const Numbers& numbers) {
  constexpr std::size_t count = sizeof(Numbers) / sizeof(float);
  if (const std::int32_t first = shares.first[i]; first >= 0) {
    auto* const here = reinterpret_cast<Numbers*>(sector.bins + static_cast<std::size_t>(first) * count);
    auto* const next = here + sector.stride;
    here[0] += numbers * shares.here_here[i];
    here[1] += numbers * shares.here_next[i];
    next[0] += numbers * shares.next_here[i];
    next[1] += numbers * shares.next_next[i];
    return;
  }
  if (shares.first[i] == dark) return;
  const auto first_beam = static_cast<std::int32_t>(sector.first_beam);
  const auto beams = static_cast<std::int32_t>(sector.end_beam), ranges = static_cast<std::int32_t>(sector.ranges);
  const auto add_within = [&](std::int32_t beam, std::int32_t range, const Numbers& part) {
    if (beam < first_beam || beam >= beams || range < 0 || range >= ranges) return;
    const std::size_t bin = static_cast<std::size_t>(beam) * sector.stride + static_cast<std::size_t>(range);
    *reinterpret_cast<Numbers*>(sector.bins + bin * count) += part;
  };
  const std::int32_t beam = shares.beam[i], range = shares.range[i];
  add_within(beam, range, numbers * shares.here_here[i]);
  add_within(beam, range + 1, numbers * shares.here_next[i]);
  add_within(beam + 1, range, numbers * shares.next_here[i]);
  add_within(beam + 1, range + 1, numbers * shares.next_next[i]);
}

/// Adds all texels of a row; `numbers_of(i)` are those of one. Most rows have none that is wider than a beam, and are
/// not asked for each.
template <typename NumbersOf>
[[gnu::always_inline]] inline void share_row(const SectorBins& sector, const LatticeRow& row,
                                             const NumbersOf& numbers_of) {
  const BinShares& shares = row.shares;
  if (!row.may_span_beams) {
    for (std::size_t i = 0; i < row.count; ++i) share(sector, shares, i, numbers_of(i));
    return;
  }
  for (std::size_t i = 0; i < row.count; ++i) {
    if (shares.first[i] == wide)
      share_among_beams(sector, shares, i, numbers_of(i));
    else
      share(sector, shares, i, numbers_of(i));
  }
}

}  // namespace

SIGMASCAPE_VECTOR_TARGETS
void deposit_amplitudes(LatticeRow& row, const SectorBins& sector) {
  find_shares(row, sector);
  if (row.may_span_beams) find_wide_shares(row);
  take_roots(row.shares, row.whole_vectors());
  if (row.may_span_beams) take_wide_roots(row.shares, row.whole_vectors());
  share_row(sector, row, [&row] [[gnu::always_inline]] (std::size_t i) -> const EightNumbers& {
    return *reinterpret_cast<const EightNumbers*>(&row.amplitudes[8 * i]);
  });
}

void deposit_powers(LatticeRow& row, const SectorBins& sector) {
  find_shares(row, sector);
  if (row.may_span_beams) find_wide_shares(row);
  share_row(sector, row, [&p = row.returned] [[gnu::always_inline]] (std::size_t i) {
    return FourNumbers{p[0][i], p[1][i], p[2][i], p[3][i]};
  });
}

}  // namespace sigmascape::live
