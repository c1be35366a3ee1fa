#include "sigmascape/receiver/response_plane.h"

#include <cmath>
#include <complex>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numeric>

#include "scratch_folder.h"

#include "sigmascape/base/hash.h"
#include "sigmascape/base/units.h"

namespace sigmascape::receiver {
namespace {

constexpr radar::Window even{.shape = radar::WindowShape::Rectangular};
constexpr radar::Window hamming{.shape = radar::WindowShape::Hamming};

/// What the axis must answer at a bin to a point, summed term by term.
std::complex<double> answer(const ResponseAxis& axis, double bin, double place) {
  const std::vector<double> weights = radar::window_weights(axis.window, axis.band);
  std::complex<double> sum;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const double cycles = static_cast<double>(k) - std::floor((static_cast<double>(axis.band) - 1.0) / 2.0);
    sum += std::polar(weights[k], 2.0 * pi * cycles * (bin - (place - 0.5)) / static_cast<double>(axis.bins));
  }
  return sum / std::accumulate(weights.begin(), weights.end(), 0.0);
}

TEST(ResponsePlane, answers_a_point_as_the_sum_over_its_band_does) {
  const ResponseAxis columns{.bins = 64, .band = 33, .window = even, .periodic = true},
      rows{.bins = 50, .band = 41, .window = hamming};
  ResponsePlane plane(columns, rows);
  const PlacedAmplitude point{12.81, 20.27, {{2.0F, 0.0F}, {0.0F, -1.0F}, {0.5F, 0.5F}}};
  plane.add({&point, 1});
  const auto bins = plane.bins();
  for (std::size_t row = 0; row < 50; ++row) {
    for (std::size_t column = 0; column < 64; ++column) {
      const std::complex<double> expected = answer(columns, static_cast<double>(column), point.column) *
                                            answer(rows, static_cast<double>(row), point.row);
      // −80 dB of the peak.
      EXPECT_LT(std::abs(std::complex<double>(bins(column, row).vv) - 2.0 * expected), 2e-4);
      EXPECT_LT(std::abs(std::complex<double>(bins(column, row).hh) - std::complex<double>(0, -1) * expected), 1e-4);
      EXPECT_LT(std::abs(std::complex<double>(bins(column, row).hv) - std::complex<double>(.5, .5) * expected), 1e-4);
    }
  }
}

TEST(ResponsePlane, lets_a_periodic_axis_fold_and_cuts_the_other) {
  const ResponseAxis columns{.bins = 32, .band = 16, .window = even, .periodic = true},
      rows{.bins = 32, .band = 15, .window = even};
  ResponsePlane once(columns, rows), folded(columns, rows), outside(columns, rows);
  const PlacedAmplitude inside{5.3, 8.5, {.vv = {1.0F, 0.0F}, .hh = {}, .hv = {}}};
  PlacedAmplitude beyond = inside;
  beyond.column += 3 * 32;
  PlacedAmplitude far = inside;
  far.row += 32;
  once.add({&inside, 1});
  folded.add({&beyond, 1});
  outside.add({&far, 1});
  const auto a = once.bins(), b = folded.bins(), c = outside.bins();
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_LT(std::abs(a.values()[i].vv - b.values()[i].vv), 1e-6F);
    EXPECT_EQ(std::abs(c.values()[i].vv), 0.0F);
  }
}

TEST(ResponsePlane, does_not_depend_on_the_number_of_threads) {
  const ResponseAxis columns{.bins = 64, .band = 40, .window = even, .periodic = true},
      rows{.bins = 80, .band = 51, .window = even};
  std::vector<PlacedAmplitude> placed;
  for (std::uint64_t i = 0; i < 5000; ++i) {
    placed.push_back({unit_float(hashed(i, 0)) * 70.0 - 3.0,
                      unit_float(hashed(i, 1)) * 90.0 - 5.0,
                      {{unit_float(hashed(i, 2)), unit_float(hashed(i, 3))}, {1.0F, 0.0F}, {0.0F, 1.0F}}});
  }
  ResponsePlane one(columns, rows), many(columns, rows);
  one.add(placed, 1);
  many.add(placed, 5);
  const auto a = one.bins({}, 1), b = many.bins({}, 5);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a.values()[i], b.values()[i]);
}

TEST(ResponsePlane, refuses_more_bins_than_memory_holds) {
  const ResponseAxis axis{.bins = 1 << 14, .band = 10'000, .window = even};
  EXPECT_THAT(message_of_error([&] { const ResponsePlane plane(axis, axis); }),
              testing::HasSubstr("coherent image: would have 16384 by 16384 bins; map less"));
}

}  // namespace
}  // namespace sigmascape::receiver
