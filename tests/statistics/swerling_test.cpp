#include "sigmascape/radar/swerling.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <vector>

#include "validation/validation_record.h"

#include "sigmascape/base/units.h"
#include "sigmascape/radar/scatterer_lattice.h"
#include "sigmascape/radar/target.h"
#include "sigmascape/receiver/doppler_imager.h"

namespace sigmascape {
namespace {

/// Kolmogorov and Smirnov's distance between samples and a distribution, times √n: above 1.63 with probability 1 %.
double kolmogorov_smirnov(std::vector<double> samples, const std::function<double(double)>& distribution) {
  std::ranges::sort(samples);
  const auto count = static_cast<double>(samples.size());
  double distance = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double expected = distribution(samples[i]);
    distance = std::max({distance, std::abs(expected - static_cast<double>(i) / count),
                         std::abs(expected - static_cast<double>(i + 1) / count)});
  }
  return distance * std::sqrt(count);
}

constexpr double one_per_cent = 1.63;

double many_alike(double x) {
  return 1.0 - std::exp(-x);
}
double one_dominates(double x) {
  return 1.0 - (1.0 + 2.0 * x) * std::exp(-2.0 * x);
}

TEST(Swerling, cases_follow_their_distributions) {
  using radar::Swerling;
  constexpr std::uint64_t count = 20'000;
  struct Example {
    Swerling swerling;
    double (*distribution)(double);
    bool by_pulse;
  };
  int number = 1;
  for (const Example& e : {Example{Swerling::Case1, many_alike, false},
                           {Swerling::Case2, many_alike, true},
                           {Swerling::Case3, one_dominates, false},
                           {Swerling::Case4, one_dominates, true}}) {
    std::vector<double> samples;
    for (std::uint64_t i = 0; i < count; ++i) {
      samples.push_back(e.by_pulse ? radar::fluctuation(e.swerling, 17, 3, i)
                                   : radar::fluctuation(e.swerling, 17, i, 5));
    }
    const double distance = kolmogorov_smirnov(samples, e.distribution);
    validation::expect_close({"Targets", "Swerling " + std::to_string(number++) + ", Kolmogorov–Smirnov distance · √n",
                              0.0, distance, one_per_cent, "1", "χ² of 2 or 4 degrees of freedom"});
  }
}

TEST(Swerling, slow_cases_hold_within_a_dwell_and_fast_ones_do_not) {
  using radar::Swerling;
  EXPECT_EQ(radar::fluctuation(Swerling::Case0, 1, 2, 3), 1.0);
  for (const Swerling slow : {Swerling::Case1, Swerling::Case3}) {
    EXPECT_EQ(radar::fluctuation(slow, 1, 2, 3), radar::fluctuation(slow, 1, 2, 4));
    EXPECT_NE(radar::fluctuation(slow, 1, 2, 3), radar::fluctuation(slow, 1, 3, 3));
    EXPECT_NE(radar::fluctuation(slow, 1, 2, 3), radar::fluctuation(slow, 2, 2, 3));
  }
  for (const Swerling fast : {Swerling::Case2, Swerling::Case4}) {
    EXPECT_NE(radar::fluctuation(fast, 1, 2, 3), radar::fluctuation(fast, 1, 2, 4));
  }
}

/// Power of a steady target on clutter of mean one: Rician with K the target's power over the clutter's. Its
/// distribution by adding up the density (1+…) exp(−x−K) I₀(2√(Kx)).
class Rician {
 public:
  explicit Rician(double k) {
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
      const double x = (i + 0.5) * width;
      sum += std::exp(-x - k + 2.0 * std::sqrt(k * x)) * scaled_bessel(2.0 * std::sqrt(k * x)) * width;
      cumulative_.push_back(sum);
    }
  }
  [[nodiscard]] double operator()(double x) const {
    const double place = x / width;
    const auto i = static_cast<std::size_t>(place);
    if (i >= cumulative_.size()) return 1.0;
    const double before = i == 0 ? 0.0 : cumulative_[i - 1];
    return before + (place - static_cast<double>(i)) * (cumulative_[i] - before);
  }

 private:
  static constexpr int steps = 40'000;
  static constexpr double width = 2e-3;
  /// exp(−z) I₀(z), by the integral over half a turn.
  static double scaled_bessel(double z) {
    double sum = 0.0;
    for (int i = 0; i < 64; ++i) sum += std::exp(z * (std::cos((i + 0.5) * pi / 64.0) - 1.0));
    return sum / 64.0;
  }
  std::vector<double> cumulative_;
};

/// Many targets on a field of scatterers, each in the middle of a bin and far enough from the others to be alone.
TEST(SteadyTarget, in_clutter_is_rician) {
  radar::Radar radar;
  radar.range_resolution_m = 5.0;
  constexpr double range_m = 5000.0, speed_mps = 100.0;
  const radar::ScattererLattice lattice({.seed = 31, .cell_m = 2.0});
  std::vector<radar::Scatterer> ground;
  for (std::int32_t row = 2270; row < 2730; ++row) {
    for (std::int32_t column = -300; column < 300; ++column) {
      const Vec2d place = lattice.position_in({column, row}, 0);
      ground.push_back({{place.x, place.y, 0.0}, polarized(lattice.drawn({column, row}, 0), {1.0F, 1.0F, 0.0F, 0.0F})});
    }
  }
  const auto track = radar::Track::straight({0.0, 0.0, 0.0}, {speed_mps, 0.0, 0.0});
  receiver::DopplerImager imager(radar, track, {.pulses = 151, .repetition_hz = 1500.0},
                                 {range_m - 350.0, range_m + 350.0, 2.0}, {0.0, range_m, 0.0});
  imager.add(ground);
  const auto bare = imager.image();
  std::vector<radar::LatticeCell> bins;
  for (std::int32_t row = 40; row + 40 < static_cast<std::int32_t>(bare.range_m.bins); row += 8) {
    for (std::int32_t column = 20; column + 20 < static_cast<std::int32_t>(bare.doppler_hz.bins); column += 10) {
      bins.push_back({column, row});
    }
  }
  ASSERT_GT(bins.size(), 500U);
  const auto power_at = [](const radar::RangeDopplerImage& image, radar::LatticeCell bin) {
    return static_cast<double>(
        std::norm(image.amplitude_m(static_cast<std::size_t>(bin.column), static_cast<std::size_t>(bin.row)).vv));
  };
  double mean = 0.0;
  for (const radar::LatticeCell bin : bins) mean += power_at(bare, bin) / static_cast<double>(bins.size());

  for (const double k : {0.5, 4.0}) {
    std::vector<radar::Target> targets;
    for (const radar::LatticeCell bin : bins) {
      const double r = bare.range_m.middle_of(bin.row + 0.5), f = bare.doppler_hz.middle_of(bin.column + 0.5);
      const double x = r * f * wavelength_m(radar.frequency_hz) / (2.0 * speed_mps);
      radar::Target target;
      target.track = radar::Track::straight({x, std::sqrt(r * r - x * x), 0.0});
      target.rcs_m2 = radar::Channels{static_cast<float>(k * mean), 0.0F, 0.0F, 0.0F};
      targets.push_back(target);
    }
    auto with_targets = imager;
    with_targets.add(targets);
    const auto image = with_targets.image();
    std::vector<double> powers;
    for (const radar::LatticeCell bin : bins) powers.push_back(power_at(image, bin) / mean);
    validation::expect_close({"Targets", "Rician, K = " + std::to_string(k) + ", Kolmogorov–Smirnov distance · √n", 0.0,
                              kolmogorov_smirnov(powers, Rician(k)), one_per_cent, "1", "Rice's distribution"});
  }
}

TEST(Multilook, of_so_many_looks_has_that_many) {
  radar::Radar radar;
  radar.range_resolution_m = 4.0;
  radar.waveform.window = {.shape = radar::WindowShape::Rectangular};
  constexpr double range_m = 5000.0;
  const radar::ScattererLattice lattice({.seed = 77, .cell_m = 1.5});
  const auto track = radar::Track::straight({0.0, 0.0, 1.0}, {100.0, 0.0, 0.0});
  receiver::DopplerImager imager(radar, track,
                                 {.pulses = 240,
                                  .repetition_hz = 1500.0,
                                  .window = {.shape = radar::WindowShape::Rectangular},
                                  .oversampling = 1.0},
                                 {range_m - 300.0, range_m + 300.0, 1.0}, {0.0, range_m, 0.0});
  std::vector<radar::Scatterer> ground;
  for (std::int32_t row = 3050; row < 3620; ++row) {
    for (std::int32_t column = -500; column < 500; ++column) {
      const Vec2d place = lattice.position_in({column, row}, 0);
      ground.push_back(
          {{place.x, place.y, 0.0}, polarized(lattice.drawn({column, row}, 0), {2.25F, 1.0F, 0.0F, 0.0F})});
    }
  }
  imager.add(ground);
  for (const std::size_t looks : {1, 2, 4, 8}) {
    Array2D<double> power;
    for (std::size_t look = 0; look < looks; ++look) {
      const auto image = imager.image({look, looks});
      if (look == 0) power = Array2D<double>(image.amplitude_m.columns(), image.amplitude_m.rows());
      for (std::size_t i = 0; i < power.size(); ++i)
        power.values()[i] +=
            static_cast<double>(std::norm(image.amplitude_m.values()[i].vv)) / static_cast<double>(looks);
    }
    double sum = 0.0, squares = 0.0, count = 0.0;
    for (std::size_t row = 10; row + 10 < power.rows(); ++row) {
      // The middle half of Doppler is evenly filled.
      for (std::size_t column = power.columns() / 4; column < power.columns() * 3 / 4; ++column) {
        const double p = power(column, row);
        sum += p;
        squares += p * p;
        count += 1.0;
      }
    }
    const double mean = sum / count, variance = squares / count - mean * mean;
    validation::expect_close({"Speckle", "equivalent number of looks of " + std::to_string(looks),
                              static_cast<double>(looks), mean * mean / variance, 0.12 * static_cast<double>(looks),
                              "1", "independent looks"});
    // σ0 = 1 over a cell of c/2B in range by λr/2vT across; L looks are L times as wide.
    if (looks == 1) {
      const double cell_m2 =
          (4.0 / 0.8859) * radar::cross_range_resolution_m(range_m, wavelength_m(10e9), 100.0, 0.16, pi / 2.0);
      validation::expect_close({"Speckle", "mean power of a cell of even ground", 0.0, db_from_linear(mean / cell_m2),
                                0.2, "dB", "σ0 · cell area"});
    }
  }
}

}  // namespace
}  // namespace sigmascape
