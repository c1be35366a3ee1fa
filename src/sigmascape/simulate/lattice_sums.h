#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <unordered_map>

#include "sigmascape/radar/channels.h"
#include "sigmascape/radar/scatterer_lattice.h"

namespace sigmascape::simulate {

/// What echoes bring to the cells of a lattice: their power and where in the bins its middle lies. From any number of
/// threads, with a result that does not depend on their order: sums are 64-bit integers in units of 2⁻³⁶ times the
/// cell's area at first, or up to half of that, which hold as much as ground of a σ0 of 75 dB returns. What does not
/// fit is left out and counted.
///
/// Memory is taken where something lands, by squares of a few cells a side and with 48 bytes a cell: where that may be
/// need not be known beforehand.
class LatticeSums {
 public:
  /// `cell_m`: side of a cell.
  explicit LatticeSums(double cell_m);

  /// Where an echo lies, in beams and range bins from wherever its cell's user counts them: near by, so that products
  /// of power and place need no more room than power does.
  struct Place {
    double beam = 0.0, range = 0.0;
  };
  void add(radar::LatticeCell cell, const radar::Channels& rcs_m2, Place place);

  /// To be called now and then, while nobody adds: once a sum is more than half full, all go on in units twice as
  /// large.
  void make_room();

  struct Sum {
    radar::Channels rcs_m2;  ///< the sum times `scale`
    Place place;             ///< mean of the echoes' places, weighted by their total power
  };
  /// Cells of a row side by side, from `first` eastwards; those that nothing has come to have zero power.
  using RunBody = std::function<void(radar::LatticeCell first, std::span<const Sum> sums)>;
  /// Calls `body` for all that anything has come to, row by row from the south and in every row from the west, while
  /// nobody adds.
  void for_each_run(double scale, const RunBody& body) const;

  /// Cells that memory has been taken for.
  [[nodiscard]] std::size_t cells_held() const;
  [[nodiscard]] std::uint64_t overflows() const;

 private:
  enum Number : std::size_t { Vv, Hh, Hv, ReVvhh, BeamMoment, RangeMoment, Count };
  using CellSums = std::array<std::int64_t, Count>;

  static constexpr int side_bits = 3;
  static constexpr std::int32_t side = 1 << side_bits;            // of a square, in cells
  using Square = std::array<CellSums, std::size_t{side} * side>;  // [row, column]

  /// Squares that are added to under one lock. There are more of these than threads that are likely to meet.
  struct Shard {
    std::mutex guard;
    std::unordered_map<std::uint64_t, Square> squares;  // by key_of
    std::uint64_t overflows = 0;
  };
  static constexpr std::size_t shard_count = 64;

  /// Grows from row to row of squares, and within a row from column to column.
  [[nodiscard]] static std::uint64_t key_of(radar::LatticeCell cell);
  /// The south-western cell of a square.
  [[nodiscard]] static radar::LatticeCell first_cell_of(std::uint64_t key);
  [[nodiscard]] static constexpr std::size_t number_in_square(std::int32_t column, std::int32_t row) {
    return static_cast<std::size_t>(row * side + column);
  }
  [[nodiscard]] Sum sum_of(const CellSums& sums, double scale) const;

  double units_per_m2_;
  std::array<Shard, shard_count> shards_;
};

}  // namespace sigmascape::simulate
