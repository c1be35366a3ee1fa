#include <array>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <vector>

#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/radar/scatterer_lattice.h"
#include "sigmascape/receiver/coherent_bins.h"

namespace sigmascape {
namespace {

using radar::ComplexChannels;
using radar::Draw;
using radar::ScattererLattice;

constexpr std::string_view speckle_group = "Speckle";

/// Bins of cross-section one, each the coherent sum of so many neighbouring scatterers with the phases of their places.
std::vector<double> bin_powers(std::size_t bins, std::size_t scatterers_a_bin, std::uint64_t seed,
                               double wavelength_m = 0.03) {
  const ScattererLattice lattice({.seed = seed, .cell_m = 0.5, .levels = 3});
  std::vector<double> powers(bins);
  std::vector<std::int32_t> columns(scatterers_a_bin), rows(scatterers_a_bin);
  std::vector<float> re(scatterers_a_bin), im(scatterers_a_bin);
  receiver::CoherentBins sums(bins, 1);
  std::vector<receiver::PlacedAmplitude> placed;
  for (std::size_t bin = 0; bin < bins; ++bin) {
    for (std::size_t i = 0; i < scatterers_a_bin; ++i) {
      columns[i] = static_cast<std::int32_t>(i);
      rows[i] = static_cast<std::int32_t>(bin);
    }
    lattice.values_of(columns, rows, 0, Draw::First, re, im);
    for (std::size_t i = 0; i < scatterers_a_bin; ++i) {
      const Vec2d place = lattice.position_in({columns[i], rows[i]}, 0);
      const double phase = -4.0 * pi * (20'000.0 + place.x) / wavelength_m;
      const std::complex<float> amplitude =
          std::complex<float>(re[i], im[i]) * std::polar(1.0F / std::sqrt(static_cast<float>(scatterers_a_bin)),
                                                         static_cast<float>(std::remainder(phase, 2.0 * pi)));
      placed.push_back({static_cast<double>(bin) + 0.5, 0.5, {.vv = amplitude, .hh = {}, .hv = {}}});
    }
  }
  sums.add(placed);
  for (std::size_t bin = 0; bin < bins; ++bin) powers[bin] = std::norm(sums.sums()(bin, 0).vv);
  return powers;
}

struct Statistics {
  double mean = 0.0, second_moment = 0.0, mean_of_db = 0.0, deviation_db = 0.0, looks = 0.0;
};

Statistics statistics_of(const std::vector<double>& powers) {
  Statistics s;
  double squares = 0.0, squares_of_db = 0.0;
  for (const double power : powers) {
    s.mean += power;
    squares += power * power;
    s.mean_of_db += db_from_linear(power);
    squares_of_db += db_from_linear(power) * db_from_linear(power);
  }
  const auto count = static_cast<double>(powers.size());
  s.deviation_db = std::sqrt(squares_of_db / count - std::pow(s.mean_of_db / count, 2));
  s.mean /= count;
  squares /= count;
  s.mean_of_db = s.mean_of_db / count - db_from_linear(s.mean);
  s.second_moment = squares / (s.mean * s.mean);
  s.looks = s.mean * s.mean / (squares - s.mean * s.mean);
  return s;
}

class SpeckleOfSoManyScatterers : public testing::TestWithParam<std::size_t> {};

TEST_P(SpeckleOfSoManyScatterers, is_fully_developed) {
  const std::size_t scatterers = GetParam();
  const Statistics s = statistics_of(bin_powers(200'000, scatterers, 11 + scatterers));
  const std::string with = ", scatterers a bin: " + std::to_string(scatterers);
  validation::expect_close(
      {speckle_group, "second moment" + with, 2.0, s.second_moment, 0.02, "1", "exponential power"});
  validation::expect_close({speckle_group, "mean of dB below dB of mean" + with, -2.507, s.mean_of_db, 0.02, "dB",
                            "Euler's constant, −10 γ/ln 10"});
  validation::expect_close({speckle_group, "standard deviation of dB" + with, 5.57, s.deviation_db, 0.05, "dB",
                            "trigamma, (10/ln 10) π/√6"});
  validation::expect_close(
      {speckle_group, "equivalent number of looks" + with, 1.0, s.looks, 0.02, "1", "exponential power"});
  validation::expect_close({speckle_group, "mean power" + with, 1.0, s.mean, 0.01, "1", "cross-sections add"});
}

INSTANTIATE_TEST_SUITE_P(Speckle, SpeckleOfSoManyScatterers, testing::Values(1, 2, 3, 5, 10, 30));

TEST(Speckle, of_all_levels_of_the_lattice_is_gaussian) {
  const ScattererLattice lattice({.seed = 5, .cell_m = 1.0, .levels = 6});
  for (int level = 0; level < 6; ++level) {
    std::vector<double> powers;
    for (std::int32_t row = 0; row < 400; ++row) {
      for (std::int32_t column = 0; column < 400; ++column) {
        const radar::ComplexPair v = lattice.value_of({column, row}, level, Draw::First);
        powers.push_back(static_cast<double>(v.re) * v.re + static_cast<double>(v.im) * v.im);
      }
    }
    const Statistics s = statistics_of(powers);
    EXPECT_NEAR(s.second_moment, 2.0, 0.03) << level;
    EXPECT_NEAR(s.mean, 1.0, 0.01) << level;
  }
}

TEST(Speckle, of_neighbouring_cells_is_independent) {
  const ScattererLattice lattice({.seed = 5, .cell_m = 1.0, .levels = 6});
  std::array<std::complex<double>, 3> products{};
  constexpr std::int32_t side = 500;
  for (std::int32_t row = 0; row < side; ++row) {
    for (std::int32_t column = 0; column < side; ++column) {
      const auto at = [&](std::int32_t c, std::int32_t r) {
        const radar::ComplexPair v = lattice.value_of({c, r}, 0, Draw::First);
        return std::complex<double>(v.re, v.im);
      };
      const std::complex<double> here = at(column, row);
      products[0] += here * std::conj(at(column + 1, row));
      products[1] += here * std::conj(at(column, row + 1));
      products[2] += here * std::conj(at(column + 1, row + 1));
    }
  }
  // The standard error is 1/side.
  for (const std::complex<double>& product : products) EXPECT_LT(std::abs(product) / (side * side), 4.0 / side);
}

TEST(Speckle, of_two_polarizations_is_as_correlated_as_stored) {
  const ScattererLattice lattice({.seed = 9});
  for (const double correlation : {-0.9, -0.3, 0.0, 0.6, 1.0}) {
    const radar::Channels stored{2.0F, 0.5F, 0.1F, static_cast<float>(correlation)};
    std::complex<double> vvhh, vvhv;
    double vv = 0.0, hh = 0.0, hv = 0.0;
    constexpr int count = 200'000;
    for (int i = 0; i < count; ++i) {
      const ComplexChannels a = polarized(lattice.drawn({i % 1000, i / 1000}, 0), stored);
      vvhh += std::complex<double>(a.vv * std::conj(a.hh));
      vvhv += std::complex<double>(a.vv * std::conj(a.hv));
      vv += std::norm(a.vv);
      hh += std::norm(a.hh);
      hv += std::norm(a.hv);
    }
    validation::expect_close({speckle_group, "VV–HH correlation " + std::to_string(correlation), correlation,
                              vvhh.real() / std::sqrt(vv * hh), 0.01, "1", "stored covariance"});
    EXPECT_NEAR(vvhh.imag() / std::sqrt(vv * hh), 0.0, 0.01);
    EXPECT_NEAR(std::abs(vvhv) / std::sqrt(vv * hv), 0.0, 0.01);
    EXPECT_NEAR(vv / count, 2.0, 0.02);
    EXPECT_NEAR(hh / count, 0.5, 0.005);
    EXPECT_NEAR(hv / count, 0.1, 0.001);
  }
}

/// The response of a cell of width D to its scatterers, and how alike it is from another angle or at another frequency.
/// Both change the phase 4π/λ · x along the cell by a slope: from an angle Δ, 4π/λ · Δ · x across the line of sight; at
/// another frequency, 4π Δf/c · x along it.
double decorrelation(double slope_cycles_per_width, bool sinc) {
  const ScattererLattice lattice({.seed = 21, .cell_m = 1.0});
  constexpr int cells_a_width = 12, looks = 30'000;
  const int reach = sinc ? 16 : 1;  // widths
  const int cells = cells_a_width * reach;
  std::complex<double> product;
  double first_power = 0.0, second_power = 0.0;
  for (std::int32_t look = 0; look < looks; ++look) {
    std::complex<double> first, second;
    for (std::int32_t k = 0; k < cells; ++k) {
      const radar::ComplexPair value = lattice.value_of({k, look}, 0, Draw::First);
      const double x = lattice.position_in({k, look}, 0).x / cells_a_width - 0.5 * reach;
      const double weight = !sinc ? 1.0 : std::abs(x) < 1e-9 ? 1.0 : std::sin(pi * x) / (pi * x);
      const std::complex<double> a = weight * std::complex<double>(value.re, value.im);
      first += a;
      second += a * std::polar(1.0, 2.0 * pi * slope_cycles_per_width * x);
    }
    product += first * std::conj(second);
    first_power += std::norm(first);
    second_power += std::norm(second);
  }
  return std::abs(product) / std::sqrt(first_power * second_power);
}

/// 4π/λ · Δ · D = 2π · slope: an angle of λ/4D is half a cycle over the cell, λ/2D a whole one; in frequency c/4D and
/// c/2D.
/// Phases know nothing of one another over 10 and 15 GHz; strengths are the same: docs/physics/speckle.md, Eq. (7a).
TEST(Speckle, keeps_the_strength_of_its_scatterers_over_frequency) {
  constexpr std::size_t bins = 40'000;
  for (const std::size_t scatterers : {1U, 3U, 10U}) {
    const std::vector<double> one = bin_powers(bins, scatterers, 5), other = bin_powers(bins, scatterers, 5, 0.02);
    double mean_one = 0.0, mean_other = 0.0, product = 0.0, square_one = 0.0, square_other = 0.0;
    for (std::size_t bin = 0; bin < bins; ++bin) {
      mean_one += one[bin] / bins;
      mean_other += other[bin] / bins;
    }
    for (std::size_t bin = 0; bin < bins; ++bin) {
      product += (one[bin] - mean_one) * (other[bin] - mean_other);
      square_one += (one[bin] - mean_one) * (one[bin] - mean_one);
      square_other += (other[bin] - mean_other) * (other[bin] - mean_other);
    }
    EXPECT_NEAR(product / std::sqrt(square_one * square_other), 1.0 / static_cast<double>(scatterers), 0.03);
  }
}

TEST(Speckle, decorrelates_with_angle_and_frequency) {
  validation::expect_close({speckle_group, "correlation after λ/4D or c/4D, evenly weighted cell", 0.64,
                            decorrelation(0.5, false), 0.03, "1", "sinc(1/2) = 2/π"});
  validation::expect_close({speckle_group, "correlation after λ/2D or c/2D, evenly weighted cell", 0.0,
                            decorrelation(1.0, false), 0.05, "1", "sinc(1) = 0"});
  validation::expect_close({speckle_group, "correlation after λ/4D, unweighted sinc", 0.50, decorrelation(0.5, true),
                            0.03, "1", "overlap of two bands, 1 − 1/2"});
  validation::expect_close({speckle_group, "correlation after λ/2D, unweighted sinc", 0.0, decorrelation(1.0, true),
                            0.05, "1", "overlap of two bands, 1 − 1"});
}

}  // namespace
}  // namespace sigmascape
