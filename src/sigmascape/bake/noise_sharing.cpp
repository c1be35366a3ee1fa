#include "sigmascape/bake/noise_sharing.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "sigmascape/base/parallel.h"

namespace sigmascape::bake {
namespace {

/// Weights by the distance along an axis, from none on.
constexpr std::array binomial{6.0, 4.0, 1.0};
constexpr std::array even{1.0, 1.0};

/// The weight between two texels of a line of `count`. At its ends the line is thought to go on as its mirror image, so
/// that weights between two texels are the same both ways and those of a texel add up to the same everywhere.
template <std::size_t count_of_weights>
double weight_along(const std::array<double, count_of_weights>& weights, std::size_t i, std::size_t j,
                    std::size_t count) {
  const auto at = [&](std::size_t distance) { return distance < count_of_weights ? weights[distance] : 0.0; };
  return at(i < j ? j - i : i - j) + at(i + j + 1) + at(2 * count - 1 - i - j);
}

/// Texels of a patch about one, in the order of their rows.
class Around {
 public:
  Around(std::size_t columns, std::size_t rows) : columns_(columns), rows_(rows) {}

  /// Calls `visit(column, row, weight)` for each that the weights reach.
  template <std::size_t count, typename Visit>
  void each(const std::array<double, count>& weights, std::size_t column, std::size_t row, const Visit& visit) const {
    constexpr std::size_t reach = count - 1;
    const std::size_t last_row = std::min(row + reach, rows_ - 1), last_column = std::min(column + reach, columns_ - 1);
    for (std::size_t r = row - std::min(row, reach); r <= last_row; ++r) {
      const double down = weight_along(weights, row, r, rows_);
      for (std::size_t c = column - std::min(column, reach); c <= last_column; ++c)
        visit(c, r, down * weight_along(weights, column, c, columns_));
    }
  }

 private:
  std::size_t columns_, rows_;
};

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
    double lit = 0.0;
    around_.each(even, column, row,
                 [&](std::size_t c, std::size_t r, double weight) { lit += power(c, r) > 0.0 ? weight : 0.0; });
    return lit / 9.0;
  }

  [[nodiscard]] Gift gift_of(std::size_t column, std::size_t row) const {
    const double x = power(column, row);
    if (!(x > 0.0) || texels_.variance(column, row) <= 0.0) return {};
    Gift gift{.part = std::min(1.0, texels_.variance(column, row) / (x * x))};
    around_.each(binomial, column, row,
                 [&](std::size_t c, std::size_t r, double weight) { gift.weights += weight * lit_about_(c, r); });
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
    around_.each(binomial, column, row, [&](std::size_t c, std::size_t r, double weight) {
      const Gift& gift = gifts_(c, r);
      const double kept = c == column && r == row ? 1.0 - gift.part : 0.0;
      const double given = gift.part > 0.0 ? gift.part * weight * lit / gift.weights : 0.0;
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
