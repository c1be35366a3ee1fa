#pragma once

#include <cstddef>

#include "sigmascape/product/map_metrics.h"
#include "sigmascape/radar/ground_map.h"

namespace sigmascape::product {

/// A map made twice from random numbers that have nothing to do with one another, all else equal.
struct RepeatedMap {
  const radar::GroundMap& first;
  const radar::GroundMap& second;
};

/// How close the tested map would come to the truth at one cell size if neither had noise.
struct NoiseFreeComparison {
  double cell_m = 0.0;
  std::size_t cells = 0;
  double correlation_db = 0.0;
  double rms_db = 0.0;
};

/// Takes the noise of two maps out of what they say of one another. With A₁, A₂ the tested map's dB, no lower than the
/// floor, and B₁, B₂ the truth's, over the cells that all four maps saw wholly,
///
///     correlation_db = ¼ Σᵢⱼ cov(Aᵢ, Bⱼ) / √(cov(A₁, A₂) cov(B₁, B₂))
///     rms_db         = √max(0, ¼ Σᵢⱼ ⟨(Aᵢ − Bⱼ)²⟩ − ½ ⟨(A₁ − A₂)²⟩ − ½ ⟨(B₁ − B₂)²⟩),
///
/// the first after Spearman (1904), "The proof and measurement of association between two things". With A = E[A] +
/// noise and B alike, noises of mean zero and independent of one another, both follow exactly for E[A] and E[B] as the
/// cells become many. No more is assumed of the noise: it may differ from cell to cell.
///
/// E[A] is the expected dB, not the dB of the expected power, below which it lies the farther the fewer echoes a cell
/// got. Maps of equally many rays lie below alike, and the correlation of a map without fault comes out as 1, its RMS
/// as 0; with fewer rays than the truth the RMS comes out too high. Faults that noise buries are not brought back: the
/// correlation of a faulty map comes out somewhat too high.
///
/// The correlation is NaN where a covariance of repeated maps is not positive. It can exceed 1, by chance. The options'
/// cell sizes and shadow are not asked for. Throws Error when grids or frames differ, when the cell is no multiple of
/// the maps', and when no cell is left that all four saw.
[[nodiscard]] NoiseFreeComparison compare_without_noise(const RepeatedMap& tested, const RepeatedMap& truth,
                                                        double cell_m, const CompareOptions& options = {});

}  // namespace sigmascape::product
