#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "sigmascape/base/array2d.h"
#include "sigmascape/radar/channels.h"

namespace sigmascape::receiver {

/// A line of bins for one thread alone. Sums are those of PowerBins, which takes them up.
class PowerLine {
 public:
  explicit PowerLine(std::size_t bins)
      : units_(bins * radar::Channels::count, 0), rests_(units_.size(), 0), first_(bins) {}

  /// Adds at a position in units of bins, shared between the two nearest as PowerBins::add_shared does.
  void add_shared(double place, const radar::Channels& rcs_m2);

 private:
  friend class PowerBins;
  void add(std::size_t bin, const radar::Channels& rcs_m2);

  std::vector<std::int64_t> units_;  // [bin, channel]
  std::vector<std::uint32_t> rests_;
  std::size_t first_, end_ = 0;  // of the bins that have been added to
  std::uint64_t overflows_ = 0;
};

/// Sums cross-sections into a rectangle of bins, from any number of threads, with a result that does not depend on
/// their order.
///
/// Sums are kept as 64-bit integers in units of 2⁻³⁶ m² (1.5e-11 m²), which hold up to 6.7e7 m² a bin, and as 2⁻³²
/// parts of a unit, so that what many weak echoes bring is not rounded to nothing; integer addition has no order. What
/// does not fit is left out and counted.
class PowerBins {
 public:
  static constexpr std::size_t bytes_a_bin = radar::Channels::count * (sizeof(std::int64_t) + sizeof(std::uint32_t));

  PowerBins(std::size_t columns, std::size_t rows);

  [[nodiscard]] std::size_t columns() const { return columns_; }
  [[nodiscard]] std::size_t rows() const { return rows_; }

  /// Forgets what was added.
  void clear();

  /// Adds to one bin.
  void add(std::size_t column, std::size_t row, const radar::Channels& rcs_m2);

  /// Adds at a position in units of bins, (0.5, 0.5) being the centre of bin (0, 0), shared between the four nearest
  /// bins by linear weights that sum to one, so that where in a bin an echo lies makes itself felt and no power is
  /// lost. What falls outside the bins is left out.
  void add_shared(double column, double row, const radar::Channels& rcs_m2);

  /// Adds a line of bins, one a row, to a column.
  void add_column(std::size_t column, const PowerLine& line);

  [[nodiscard]] radar::Channels sum(std::size_t column, std::size_t row) const;
  /// [column, row], m².
  [[nodiscard]] Array2D<radar::Channels> sums() const;
  /// Over all bins, in double precision: VV, HH, HV, Re VV·HH*.
  [[nodiscard]] std::array<double, radar::Channels::count> total() const;
  [[nodiscard]] std::uint64_t overflows() const { return overflows_; }

 private:
  /// Each for every so many rows, on lines of their own of the processors' caches.
  struct alignas(64) RowLock {
    std::atomic_flag is_held;
  };
  static constexpr std::size_t locks = 64;
  class HeldRow;

  void add_to_held(std::size_t column, std::size_t row, const radar::Channels& rcs_m2);
  [[nodiscard]] double in_m2(std::size_t number) const;

  std::size_t columns_, rows_;
  std::vector<std::int64_t> units_;   // [row, column, channel]
  std::vector<std::uint32_t> rests_;  // the same
  std::unique_ptr<std::array<RowLock, locks>> locks_;
  std::uint64_t overflows_ = 0;
};

}  // namespace sigmascape::receiver
