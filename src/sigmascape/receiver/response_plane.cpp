#include "sigmascape/receiver/response_plane.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <fmt/format.h>
#include <vector>

#include "sigmascape/base/error.h"
#include "sigmascape/base/hash.h"
#include "sigmascape/base/machine_memory.h"
#include "sigmascape/base/parallel.h"
#include "sigmascape/radar/complex_gaussian.h"

namespace sigmascape::receiver {
namespace {

constexpr std::size_t margin = SpreadingKernel::taps;

using Line = std::vector<std::complex<float>>;

std::complex<float>& polarization(radar::ComplexChannels& channels, std::size_t index) {
  return index == 0 ? channels.vv : index == 1 ? channels.hh : channels.hv;
}

/// A place in bins, as fine samples from the axis' beginning; not a number where the axis does not reach.
double fine_place(double place, const ResponseAxis& axis, std::size_t fine) {
  const auto bins = static_cast<double>(axis.bins);
  double periods = (place - 0.5) / bins;
  if (axis.periodic) {
    periods -= std::floor(periods);
  } else if (periods < -0.5 / bins || periods >= 1.0 - 0.5 / bins) {
    return std::nan("");
  }
  return periods * static_cast<double>(fine);
}

/// The last step of an image: one polarization's frequencies along the rows, a row of bins a row of `spectra`.
void to_bins_along_rows(const ResponseTransform& across, const Array2D<std::complex<float>>& spectra, std::size_t p,
                        unsigned threads, Array2D<radar::ComplexChannels>& out) {
  parallel_for(out.rows(), threads, [&](std::size_t row, unsigned) {
    Line line(out.columns());
    across.to_bins(spectra.row(row), line);
    for (std::size_t c = 0; c < line.size(); ++c) polarization(out(c, row), p) = line[c];
  });
}

/// The first of two axes, whose bins memory can hold with all that is needed on the way to them.
const ResponseAxis& held_with(const ResponseAxis& columns, const ResponseAxis& rows) {
  constexpr double bytes_a_bin = 190.0;
  const double most_bins = std::min(0x1p26, machine_memory_bytes() / bytes_a_bin);
  if (static_cast<double>(columns.bins) * static_cast<double>(rows.bins) > most_bins) {
    throw Error(
        "coherent image", fmt::format("would have {} by {} bins", columns.bins, rows.bins),
        fmt::format("map less, resolve less or send fewer pulses a second, for at most {:.1e} bins", most_bins));
  }
  return columns;
}

/// Where the sample at an index with margin belongs in the period.
std::size_t folded(std::size_t index, std::size_t fine) {
  return (index + 2 * fine - margin) % fine;
}

}  // namespace

ResponsePlane::ResponsePlane(const ResponseAxis& columns, const ResponseAxis& rows)
    : columns_(held_with(columns, rows)),
      rows_(rows),
      fine_columns_(ResponseTransform(columns).fine_samples()),
      fine_rows_(ResponseTransform(rows).fine_samples()),
      fine_(fine_columns_ + 2 * margin, fine_rows_ + 2 * margin) {}

void ResponsePlane::add(std::span<const PlacedAmplitude> placed, unsigned threads) {
  std::vector<PlacedAmplitude> fine(placed.begin(), placed.end());
  for (PlacedAmplitude& point : fine) {
    point.column = fine_place(point.column, columns_, fine_columns_) + static_cast<double>(margin);
    point.row = fine_place(point.row, rows_, fine_rows_) + static_cast<double>(margin);
  }
  static_assert(SpreadingKernel::taps <= RowBands::band_rows / 2, "two even bands must never meet in a row");
  RowBands(fine, fine_.rows()).for_each(threads, [&](const PlacedAmplitude& point) {
    if (std::isnan(point.column)) return;
    const auto across = kernel_.weights(point.column), down = kernel_.weights(point.row);
    const auto left = static_cast<std::size_t>(SpreadingKernel::first_tap(point.column));
    const auto top = static_cast<std::size_t>(SpreadingKernel::first_tap(point.row));
    for (std::size_t r = 0; r < SpreadingKernel::taps; ++r) {
      const radar::ComplexChannels weighted = point.amplitude * down[r];
      radar::ComplexChannels* const to = &fine_(left, top + r);
      for (std::size_t c = 0; c < SpreadingKernel::taps; ++c) to[c] += weighted * across[c];
    }
  });
}

Array2D<radar::ComplexChannels> ResponsePlane::bins(const Subband& subband, unsigned threads) const {
  const ResponseTransform across(columns_, subband), down(rows_);
  Array2D<radar::ComplexChannels> periodic(fine_columns_, fine_rows_);
  for (std::size_t row = 0; row < fine_.rows(); ++row) {
    for (std::size_t column = 0; column < fine_.columns(); ++column) {
      periodic(folded(column, fine_columns_), folded(row, fine_rows_)) += fine_(column, row);
    }
  }

  Array2D<radar::ComplexChannels> out(columns_.bins, rows_.bins);
  Array2D<std::complex<float>> half_way(fine_rows_, across.kept()), spectra(across.kept(), rows_.bins);
  for (std::size_t p = 0; p < radar::ComplexChannels::count; ++p) {
    parallel_for(fine_rows_, threads, [&](std::size_t row, unsigned) {
      Line line(fine_columns_), band(across.kept());
      for (std::size_t c = 0; c < fine_columns_; ++c) line[c] = polarization(periodic(c, row), p);
      across.to_band(line, band);
      for (std::size_t k = 0; k < band.size(); ++k) half_way(row, k) = band[k];
    });
    parallel_for(across.kept(), threads, [&](std::size_t k, unsigned) {
      Line band(down.kept()), line(rows_.bins);
      down.to_band(half_way.row(k), band);
      down.to_bins(band, line);
      for (std::size_t row = 0; row < line.size(); ++row) spectra(k, row) = line[row];
    });
    to_bins_along_rows(across, spectra, p, threads, out);
  }
  return out;
}

Array2D<radar::ComplexChannels> ResponsePlane::noise(std::uint64_t seed, const Subband& subband,
                                                     unsigned threads) const {
  const ResponseTransform across(columns_, subband), down(rows_);
  Array2D<radar::ComplexChannels> out(columns_.bins, rows_.bins);
  Array2D<std::complex<float>> spectra(across.kept(), rows_.bins);
  for (std::size_t p = 0; p < radar::ComplexChannels::count; ++p) {
    parallel_for(across.kept(), threads, [&](std::size_t k, unsigned) {
      const std::uint64_t key = hashed(seed, p, across.first_frequency() + static_cast<std::ptrdiff_t>(k));
      Line band(down.kept()), line(rows_.bins);
      for (std::size_t l = 0; l < band.size(); ++l) {
        const std::uint64_t words = hashed(key, l);
        const radar::ComplexPair draw =
            radar::complex_gaussian({static_cast<std::uint32_t>(words), static_cast<std::uint32_t>(words >> 32U)});
        const float weight = across.noise_window()[k] * down.noise_window()[l];
        band[l] = {draw.re * weight, draw.im * weight};
      }
      down.to_bins(band, line);
      for (std::size_t row = 0; row < line.size(); ++row) spectra(k, row) = line[row];
    });
    to_bins_along_rows(across, spectra, p, threads, out);
  }
  return out;
}

}  // namespace sigmascape::receiver
