#include "sigmascape/bake/noise_sharing.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "sigmascape/base/parallel.h"

namespace sigmascape::bake {
namespace {

/// Texels of a patch at most so far away along either axis from one, in the order of their rows.
class Around {
 public:
  Around(std::size_t columns, std::size_t rows) : columns_(columns), rows_(rows) {}

  /// Calls `visit(column, row, across, down)` for each, the last two counted from the first of the whole neighbourhood.
  template <typename Visit>
  void each(std::size_t column, std::size_t row, std::size_t reach, const Visit& visit) const {
    const std::size_t last_row = std::min(row + reach, rows_ - 1), last_column = std::min(column + reach, columns_ - 1);
    for (std::size_t r = row - std::min(row, reach); r <= last_row; ++r) {
      for (std::size_t c = column - std::min(column, reach); c <= last_column; ++c)
        visit(c, r, c + reach - column, r + reach - row);
    }
  }

 private:
  std::size_t columns_, rows_;
};

constexpr std::size_t reach = 2;
constexpr std::array<double, 2 * reach + 1> binomial{1.0, 4.0, 6.0, 4.0, 1.0};

double power_of(const radar::Channels& texel) {
  return static_cast<double>(texel.power(radar::Polarization::Sum));
}

/// What a texel gives to those around it.
struct Gift {
  double part = 0.0;     // 1 − w, of its power
  double weights = 0.0;  // Σ_m b_mj g_m
};

class Sharing {
 public:
  Sharing(const NoisyTexels& texels, unsigned threads)
      : texels_(texels),
        columns_(texels.power.columns()),
        rows_(texels.power.rows()),
        threads_(thread_count(threads)),
        around_(columns_, rows_),
        lit_about_(columns_, rows_),
        gifts_(columns_, rows_) {
    for_each_texel([this](std::size_t c, std::size_t r) { lit_about_(c, r) = part_lit_about(c, r); });
    for_each_texel([this](std::size_t c, std::size_t r) { gifts_(c, r) = gift_of(c, r); });
  }

  [[nodiscard]] NoisyTexels shared() const {
    NoisyTexels result = texels_;
    for_each_texel([&](std::size_t c, std::size_t r) { receive(c, r, result); });
    return result;
  }

 private:
  template <typename Body>
  void for_each_texel(const Body& body) const {
    parallel_for(rows_, threads_, [&](std::size_t row, unsigned) {
      for (std::size_t column = 0; column < columns_; ++column) body(column, row);
    });
  }

  [[nodiscard]] double power(std::size_t column, std::size_t row) const { return power_of(texels_.power(column, row)); }

  [[nodiscard]] double part_lit_about(std::size_t column, std::size_t row) const {
    int lit = 0;
    around_.each(column, row, 1,
                 [&](std::size_t c, std::size_t r, std::size_t, std::size_t) { lit += power(c, r) > 0.0; });
    return lit / 9.0;
  }

  [[nodiscard]] Gift gift_of(std::size_t column, std::size_t row) const {
    const double x = power(column, row);
    if (!(x > 0.0) || texels_.variance(column, row) <= 0.0) return {};
    Gift gift{.part = std::min(1.0, texels_.variance(column, row) / (x * x))};
    around_.each(column, row, reach, [&](std::size_t c, std::size_t r, std::size_t across, std::size_t down) {
      gift.weights += binomial[across] * binomial[down] * lit_about_(c, r);
    });
    return gift;
  }

  void receive(std::size_t column, std::size_t row, NoisyTexels& result) const {
    const double lit = lit_about_(column, row);
    if (lit == 0.0) return;
    std::array<double, radar::Channels::count> sum{};
    double variance = 0.0;
    const auto add = [&](std::size_t c, std::size_t r, double part) {
      const radar::Channels& x = texels_.power(c, r);
      sum[0] += part * static_cast<double>(x.vv);
      sum[1] += part * static_cast<double>(x.hh);
      sum[2] += part * static_cast<double>(x.hv);
      sum[3] += part * static_cast<double>(x.re_vvhh);
      variance += part * part * texels_.variance(c, r);
    };
    bool changes = false;
    around_.each(column, row, reach, [&](std::size_t c, std::size_t r, std::size_t across, std::size_t down) {
      const Gift& gift = gifts_(c, r);
      const double kept = c == column && r == row ? 1.0 - gift.part : 0.0;
      const double given = gift.part > 0.0 ? gift.part * binomial[across] * binomial[down] * lit / gift.weights : 0.0;
      changes = changes || given > 0.0;
      if (kept + given > 0.0) add(c, r, kept + given);
    });
    if (!changes) return;
    result.power(column, row) = {static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2]),
                                 static_cast<float>(sum[3])};
    const double x = power_of(result.power(column, row));
    result.variance(column, row) = std::max(gifts_(column, row).part * x * x, variance);
  }

  const NoisyTexels& texels_;
  std::size_t columns_, rows_;
  unsigned threads_;
  Around around_;
  Array2D<double> lit_about_;
  Array2D<Gift> gifts_;
};

}  // namespace

NoisyTexels with_noise_shared(const NoisyTexels& texels, unsigned threads) {
  return Sharing(texels, threads).shared();
}

}  // namespace sigmascape::bake
